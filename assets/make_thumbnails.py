"""Draw the picture of every sample plate that the start page shows: ``python assets/make_thumbnails.py``."""

import os
from collections.abc import Iterator
from pathlib import Path

os.environ.setdefault("QT_QPA_PLATFORM", "offscreen")

import numpy as np
from PySide6.QtCore import QPointF, Qt
from PySide6.QtGui import QColor, QGuiApplication, QImage, QPainter, QPen, QPolygonF

from hullquad import pipeline
from hullquad.arrays import Floats
from hullquad.formats import read_plates
from hullquad.metrics import metric
from hullquad.optimization.iterate import outcome
from hullquad.optimization.paper import PaperSettings, paper_iterates
from hullquad.plate import Document
from hullquad.topology import edges
from hullquad.triangulation.contour import contours
from hullquad_app.colours import BROKEN

PLATES = Path(__file__).parent / "plates"
WIDTH, HEIGHT, MARGIN = 480, 300, 24
EDGE, CONTOUR, GROUND = "#8090A0", "#5B6776", "#CBDFEB"
ISOMETRIC = np.array([[0.866, -0.5], [0.866, 0.5], [0.0, 1.0]])

Polygon = tuple[Floats, str]


def drawn(document: Document) -> tuple[list[Polygon], list[Floats]]:
    """Coloured polygons (N, 2), and lines of the contour."""
    several = len(document.plates) > 1
    polygons: list[Polygon] = []
    lines: list[Floats] = []
    for contour in contours(document, "coarse").values():
        mesh = pipeline.paper_mesh(contour)
        best = outcome(paper_iterates(mesh, metric("stretch"), PaperSettings(iterations=300))).best
        flat = best.mesh.points @ ISOMETRIC if several else best.mesh.parameters
        colours = BROKEN.element_colours(best.quality)
        for corners, colour in zip(best.mesh.topology.elements, colours, strict=True):
            polygons.append((flat[corners[corners >= 0]], QColor(*(int(part) for part in colour)).name()))
        rim, counts = edges(best.mesh.topology.elements)
        lines += list(flat[rim[counts == 1]])
    if not polygons:
        for plate in document.plates:
            polygons += [(outline, GROUND) for outline in plate.outlines[:1]]
            lines += [np.concatenate([outline, outline[:1]]) for outline in plate.outlines]
            lines += [np.array([line.a, line.b]) for line in plate.lines]
    return polygons, lines


def fitted(polygons: list[Polygon], lines: list[Floats]) -> Iterator[tuple[QPolygonF, str | None]]:
    """The same in pixels; lines have no colour."""
    every = np.concatenate([points for points, _ in polygons])
    low, span = every.min(axis=0), np.ptp(every, axis=0)
    scale = min((WIDTH - 2 * MARGIN) / span[0], (HEIGHT - 2 * MARGIN) / span[1])
    shift = (np.array([WIDTH, HEIGHT]) - scale * span) / 2
    for points, colour in (*polygons, *((line, None) for line in lines)):
        x, y = ((points - low) * scale + shift).T
        yield QPolygonF([QPointF(a, HEIGHT - b) for a, b in zip(x, y, strict=True)]), colour


def thumbnail(document: Document) -> QImage:
    """Picture of a document on transparent ground."""
    image = QImage(WIDTH, HEIGHT, QImage.Format.Format_ARGB32_Premultiplied)
    image.fill(Qt.GlobalColor.transparent)
    painter = QPainter(image)
    painter.setRenderHint(QPainter.RenderHint.Antialiasing)
    for shape, colour in fitted(*drawn(document)):
        if colour is None:
            painter.setPen(QPen(QColor(CONTOUR), 3, j=Qt.PenJoinStyle.RoundJoin))
            painter.drawPolyline(shape)
        else:
            painter.setPen(QPen(QColor(EDGE), 1.5))
            painter.setBrush(QColor(colour))
            painter.drawPolygon(shape)
    painter.end()
    return image


def main() -> None:
    """Draw them all."""
    application = QGuiApplication([])
    for path in sorted(PLATES.glob("*.json")):
        thumbnail(read_plates(path)).save(str(path.with_suffix(".png")), "PNG", 40)
    del application


if __name__ == "__main__":
    main()
