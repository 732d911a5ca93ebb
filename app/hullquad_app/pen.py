"""Writing and drawing on the image of a picture for a report."""

from functools import cache

import attrs
from PIL import ImageDraw, ImageFont

from hullquad_app.assets import FOLDER

_FONTS = {False: "DejaVuSans.ttf", True: "DejaVuSans-Bold.ttf"}


@attrs.frozen(eq=False)
class Pen:
    """Writes and draws on an image in units of which it is `scale` times as large."""

    canvas: ImageDraw.ImageDraw
    scale: int

    def write(
        self, x: float, y: float, text: str, size: int, colour: str, *, anchor: str = "ls", bold: bool = False
    ) -> None:
        """Write a text; `anchor` as of Pillow: l, m or r and s for the base line."""
        self.canvas.text(
            (x * self.scale, y * self.scale), text, colour, font=_font(size * self.scale, bold=bold), anchor=anchor
        )

    def width(self, text: str, size: int, *, bold: bool = False) -> float:
        """Width of a text."""
        return _font(size * self.scale, bold=bold).getlength(text) / self.scale

    def fitting(self, text: str, room: float, size: int, *, bold: bool = False) -> str:
        """The text, cut off where there is no room for it."""
        if self.width(text, size, bold=bold) <= room:
            return text
        while text and self.width(text + "…", size, bold=bold) > room:
            text = text[:-1]
        return text.rstrip() + "…"

    def fill(self, left: float, top: float, right: float, bottom: float, colour: str) -> None:
        """Fill a rectangle, to the pixel."""
        ends = [round(end * self.scale) for end in (left, top, right, bottom)]
        self.canvas.rectangle((ends[0], ends[1], ends[2] - 1, ends[3] - 1), fill=colour)

    def hatch(self, left: float, top: float, side: float, colour: str) -> None:
        """Hatch a square, and frame it."""
        low, step, width = self.scale, self.scale * side / 3, max(1, self.scale)
        x, y, reach = left * low, top * low, side * low
        for number in range(-2, 3):
            start = number * step
            ends = max(0.0, start), min(reach, reach + start)
            self.canvas.line((x + ends[0], y + ends[0] - start, x + ends[1], y + ends[1] - start), colour, width)
        self.canvas.rectangle((x, y, x + reach, y + reach), outline=colour, width=width)


@cache
def _font(size: int, *, bold: bool) -> ImageFont.FreeTypeFont:
    return ImageFont.truetype(str(FOLDER / "fonts" / _FONTS[bold]), size)
