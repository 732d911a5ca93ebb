"""What is drawn below the plate in a picture for a report: what the colours mean, and a scale."""

import numpy as np
from PySide6.QtCore import QCoreApplication

from hullquad.arrays import Bools
from hullquad.histogram import axis_edges
from hullquad.quality import Quality
from hullquad_app.canvas.ruler import nice_length, written
from hullquad_app.caption import MARGIN
from hullquad_app.colours import INVERTED, LIGHT, ColourMap
from hullquad_app.level_legend import Entry, entries
from hullquad_app.panels.axis import Axis, ticks
from hullquad_app.panels.bars import axis_labels
from hullquad_app.panels.figures import counted, plain
from hullquad_app.pen import Pen
from hullquad_app.scene import Scene

_STRIP_WIDTH, _STRIP_HEIGHT, _SMALL = 640, 14, 15
_ALMOST = -1e-9


def write_footer(pen: Pen, width: float, height: float, scene: Scene, chosen: ColourMap, pixel: float) -> None:
    """The colours with the limit on the left, a scale on the right; `pixel` is the length of a unit [mm]."""
    top = height - 62
    if scene.assessment is None and scene.quality is not None:
        _write_strip(pen, top, scene.quality, chosen)
        _write_entries(pen, MARGIN + _STRIP_WIDTH + 32, top, _marks(scene.quality, scene.given))
    elif scene.assessment is not None and scene.quality is not None:
        _write_entries(pen, MARGIN, top, entries(scene.assessment, scene.quality.inverted_count))
    length = nice_length(200 * pixel)
    right, left, base = width - MARGIN, width - MARGIN - length / pixel, height - 62 + _STRIP_HEIGHT
    pen.fill(left, base - 2, right, base, LIGHT.text)
    for end in (left, right - 2):
        pen.fill(end, base - 8, end + 2, base, LIGHT.text)
    pen.write((left + right) / 2, base - 12, written(length), _SMALL, LIGHT.text, anchor="ms")


def _write_strip(pen: Pen, top: float, quality: Quality, chosen: ColourMap) -> None:
    edges = axis_edges(quality.metric, quality.band)
    axis = Axis(float(edges[0]), float(edges[-1]), MARGIN, MARGIN + _STRIP_WIDTH)
    bottom = top + _STRIP_HEIGHT
    step = 1 / pen.scale
    for column in range(_STRIP_WIDTH * pen.scale):
        left = MARGIN + column * step
        pen.fill(left, top, left + step, bottom, _colour(quality, axis.value(left + step / 2), chosen))
    values = ticks(axis.low, axis.high, 7)
    for value, text in zip(values, axis_labels(values, quality.metric), strict=True):
        pen.write(axis.at(value), bottom + 22, text, _SMALL, LIGHT.dim, anchor="ms")
    for limit in quality.limits:
        at = axis.at(limit)
        pen.fill(at - 1, top - 6, at + 1, bottom + 5, LIGHT.text)
        text = _tr("limit {limit}").format(limit=plain(limit, quality.metric))
        half = pen.width(text, _SMALL) / 2
        centre = min(max(at, MARGIN + half), MARGIN + _STRIP_WIDTH - half)
        pen.write(centre, top - 12, text, _SMALL, LIGHT.text, anchor="ms")


def _marks(quality: Quality, given: Bools | None) -> list[Entry]:
    """Signs that the strip does not explain."""
    marks = [Entry(INVERTED, _tr("inverted"))] if quality.inverted_count else []
    if given is not None and given.any():
        marks.append(Entry("", _tr("{count} given by the contour").format(count=counted(int(given.sum())))))
    return marks


def _write_entries(pen: Pen, left: float, top: float, rows: list[Entry]) -> None:
    for row in rows:
        if row.colour:
            pen.fill(left, top, left + _STRIP_HEIGHT, top + _STRIP_HEIGHT, row.colour)
        else:
            pen.hatch(left, top, _STRIP_HEIGHT, LIGHT.dim)
        pen.write(left + _STRIP_HEIGHT + 8, top + _STRIP_HEIGHT - 1, row.text, _SMALL, LIGHT.text)
        left += _STRIP_HEIGHT + 8 + pen.width(row.text, _SMALL) + 28


def _colour(quality: Quality, value: float, chosen: ColourMap) -> str:
    grade = quality.grade(value)
    is_within = quality.metric.is_within(quality.band, np.array(value))
    return chosen.colour(grade if is_within else min(grade, _ALMOST))


def _tr(text: str) -> str:
    return QCoreApplication.translate("Picture", text)
