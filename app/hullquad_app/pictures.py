"""Pictures of a plate for a report: white, in plan view, with all that a reader needs to know inside."""

import io
from pathlib import Path

import attrs
from PIL import Image, ImageDraw
from PIL.PngImagePlugin import PngInfo

from hullquad import __version__
from hullquad.errors import HullquadError
from hullquad.formats import atomic
from hullquad.sight import plan
from hullquad_app.canvas.camera import Camera
from hullquad_app.caption import FOOTER, HEADER, MARGIN, write_header
from hullquad_app.colour_bar import write_footer
from hullquad_app.colours import BROKEN, LIGHT, ColourMap
from hullquad_app.pen import Pen
from hullquad_app.scene import Scene

WIDTH, HEIGHT = 1600, 1000
"""[pixels at scale 1]"""
SCALES = (1, 2, 3, 4)
_SAMPLES = 8
_INCH, _A4_WIDTH = 25.4, 170.0
"""[mm]; between the margins of a page"""


def picture(scene: Scene, *, scale: int = 1, transparent: bool = False, chosen: ColourMap = BROKEN) -> Image.Image:
    """The shown mesh with its metric, figures, colours and a scale.

    Raises
    ------
    HullquadError
        E_PICTURE: the plate is not meshed.
    """
    if scene.quality is None:
        raise HullquadError("E_PICTURE", scene.view.key or "")
    plate, pixel = _plate(scene, scale, chosen)
    whole = Image.new("RGBA", (WIDTH * scale, HEIGHT * scale), (255, 255, 255, 0 if transparent else 255))
    whole.paste(plate, (0, HEADER * scale), plate)
    pen = Pen(ImageDraw.Draw(whole), scale)
    write_header(pen, WIDTH, scene, scene.quality)
    write_footer(pen, WIDTH, HEIGHT, scene, chosen, pixel)
    return whole if transparent else whole.convert("RGB")


def write(scene: Scene, path: Path, *, scale: int = 1, transparent: bool = False, chosen: ColourMap = BROKEN) -> None:
    """Put the picture into a PNG file, whole or not at all.

    Raises
    ------
    HullquadError
        The plate is not meshed, or the file cannot be written.
    """
    atomic.check(path)
    atomic.write(path, png(picture(scene, scale=scale, transparent=transparent, chosen=chosen)))


def to_clipboard(scene: Scene, *, scale: int = 2, chosen: ColourMap = BROKEN) -> None:
    """Put the picture on the clipboard.

    Raises
    ------
    HullquadError
        The plate is not meshed.
    """
    from PySide6.QtGui import QGuiApplication, QImage  # noqa: PLC0415  pictures without a window need no screen

    QGuiApplication.clipboard().setImage(QImage.fromData(png(picture(scene, scale=scale, chosen=chosen))))


def png(image: Image.Image) -> bytes:
    """The image as a PNG file that says what made it; as wide as the text of an A4 page."""
    about = PngInfo()
    about.add_text("Software", f"HullQuad {__version__}")
    dots = image.width / _A4_WIDTH * _INCH
    content = io.BytesIO()
    image.save(content, format="PNG", pnginfo=about, dpi=(dots, dots))
    return content.getvalue()


def _plate(scene: Scene, scale: int, chosen: ColourMap) -> tuple[Image.Image, float]:
    """The plate alone on a transparent ground, and the length of a pixel at scale 1 [mm]."""
    from hullquad_app.canvas.drawing import Drawing  # noqa: PLC0415  brings VTK
    from hullquad_app.canvas.stage import Stage  # noqa: PLC0415

    assert scene.mesh is not None  # it was judged
    height = HEIGHT - HEADER - FOOTER
    right, up = plan(scene.mesh)
    camera = Camera().turned(right, up).fitted(scene.mesh.points, WIDTH - MARGIN, height, MARGIN / 2)
    drawing = Drawing(samples=_SAMPLES, transparent=True)
    try:
        stage = Stage(drawing.renderer, LIGHT)
        stage.set_colour_map(chosen)
        stage.show(attrs.evolve(scene, view=attrs.evolve(scene.view, selection=frozenset())))
        camera.apply(drawing.renderer.GetActiveCamera(), height, stage.box)
        stage.look(camera.towards, camera.pixel, scale)
        return Image.fromarray(drawing.pixels(WIDTH * scale, height * scale)), camera.pixel
    finally:
        drawing.finish()
