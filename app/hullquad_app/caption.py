"""What is written in a picture for a report: above the plate what it is, below it the colours and a scale."""

from functools import cache

import attrs
import numpy as np
from PIL import ImageDraw, ImageFont
from PySide6.QtCore import QCoreApplication

from hullquad.histogram import axis_edges
from hullquad.quality import Quality
from hullquad_app.assets import FOLDER
from hullquad_app.canvas.ruler import nice_length, written
from hullquad_app.colours import INVERTED, LIGHT, ColourMap
from hullquad_app.limits import limit_words
from hullquad_app.panels.axis import Axis, ticks
from hullquad_app.panels.bars import axis_labels
from hullquad_app.panels.figures import counted, plain, valued
from hullquad_app.scene import Scene

MARGIN = 48
HEADER, FOOTER = 128, 116
"""Heights of what is above and below the plate."""
_FONTS = {False: "DejaVuSans.ttf", True: "DejaVuSans-Bold.ttf"}
_TITLE, _LINE, _CAPTION, _FIGURE, _SMALL = 26, 18, 15, 26, 15
_STRIP_WIDTH, _STRIP_HEIGHT = 640, 14
_COLUMN, _GAP = 100, 36
"""Least width of a key figure, and room between two of them."""
_ALMOST = -1e-9


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


def write_header(pen: Pen, width: float, scene: Scene, quality: Quality) -> None:
    """Plate, metric, limit and iteration on the left; worst, mean and failing on the right."""
    right = width - MARGIN
    for caption, value, colour in reversed(_figures(quality)):
        pen.write(right, 62, caption, _CAPTION, LIGHT.dim, anchor="rs")
        pen.write(right, 97, value, _FIGURE, colour, anchor="rs")
        right -= max(_COLUMN, pen.width(value, _FIGURE)) + _GAP
    room = right - MARGIN
    pen.write(MARGIN, 64, pen.fitting(_title(scene), room, _TITLE, bold=True), _TITLE, LIGHT.text, bold=True)
    pen.write(MARGIN, 97, pen.fitting(_line(scene, quality), room, _LINE), _LINE, LIGHT.dim)


def write_footer(pen: Pen, width: float, height: float, quality: Quality, chosen: ColourMap, pixel: float) -> None:
    """The colours with the limit on the left, a scale on the right; `pixel` is the length of a unit [mm]."""
    _write_strip(pen, height - 62, quality, chosen)
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
    if quality.inverted_count:
        _write_inverted(pen, MARGIN + _STRIP_WIDTH + 32, top)


def _write_inverted(pen: Pen, left: float, top: float) -> None:
    pen.fill(left, top, left + _STRIP_HEIGHT, top + _STRIP_HEIGHT, INVERTED)
    pen.write(left + _STRIP_HEIGHT + 8, top + _STRIP_HEIGHT - 1, _tr("inverted"), _SMALL, LIGHT.dim)


def _title(scene: Scene) -> str:
    return (scene.plate.title if scene.plate is not None else "") or scene.view.key or scene.state.title


def _line(scene: Scene, quality: Quality) -> str:
    by, count = quality.metric, len(quality.values)
    parts = [scene.plate.id] if scene.plate is not None and scene.plate.title else []
    parts += [by.title, _tr("limit {limit}").format(limit=limit_words(by, quality.band))]
    if scene.track is not None and len(scene.track.iterates) > 1 and scene.iterate is not None:
        last = scene.track.last.number
        parts.append(_tr("iteration {number} of {last}").format(number=scene.iterate.number, last=last))
    parts.append(_tr("1 element") if count == 1 else _tr("{count} elements").format(count=counted(count)))
    return " · ".join(parts)


def _figures(quality: Quality) -> list[tuple[str, str, str]]:
    """Caption, value and colour of the key figures, from left to right."""
    by, alarm = quality.metric, LIGHT.fail if quality.failing_count else LIGHT.text
    failing = _tr("{failing} of {count}").format(
        failing=counted(quality.failing_count), count=counted(len(quality.values))
    )
    worst = LIGHT.fail if quality.failing[quality.worst_element] else LIGHT.text
    rows = [
        (_tr("worst"), valued(quality.worst, by), worst),
        (_tr("mean"), valued(quality.mean, by), LIGHT.text),
        (_tr("failing"), failing, alarm),
    ]
    inverted = (_tr("inverted"), counted(quality.inverted_count), INVERTED)
    return [*rows, inverted] if quality.inverted_count else rows


def _colour(quality: Quality, value: float, chosen: ColourMap) -> str:
    grade = quality.grade(value)
    is_within = quality.metric.is_within(quality.band, np.array(value))
    return chosen.colour(grade if is_within else min(grade, _ALMOST))


@cache
def _font(size: int, *, bold: bool) -> ImageFont.FreeTypeFont:
    return ImageFont.truetype(str(FOLDER / "fonts" / _FONTS[bold]), size)


def _tr(text: str) -> str:
    return QCoreApplication.translate("Picture", text)
