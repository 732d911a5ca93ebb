"""The picture of a histogram: bars in the colours of the map, its limit, and the colours as a strip below."""

from functools import lru_cache

import attrs
import numpy as np
from PySide6.QtCore import QLineF, QPointF, QRectF, Qt
from PySide6.QtGui import QColor, QFontMetricsF, QPainter, QPen

from hullquad.grades import graded
from hullquad.histogram import Histogram
from hullquad.metrics import DEGREES, Band, Metric
from hullquad.quality import Quality
from hullquad_app.colours import ColourMap, Palette
from hullquad_app.panels.axis import Axis, labels, ticks, top
from hullquad_app.panels.figures import counted, unit_of

_ALMOST = -1e-9
_STRIPE = 2
"""Width of a stripe of the legend [px]."""
LEGEND_LINE = 1.2
"""Height of a line of the legend, in lines of text."""
_HIGH = 8.0
"""Height from which there is a line of the legend, and another with each line and a half more [lines of text]."""
_RIGHT = Qt.AlignmentFlag.AlignRight | Qt.AlignmentFlag.AlignVCenter
_CENTRE = Qt.AlignmentFlag.AlignCenter


@attrs.frozen(eq=False, kw_only=True)
class Bars:
    """What a histogram shows, and where."""

    quality: Quality
    now: Histogram
    first: Histogram | None
    """Of iteration 0, where that is another mesh."""
    selected: frozenset[int]
    """Bins with selected elements."""
    given_count: int
    """Elements that fail because of the contour."""
    x: Axis
    y: Axis
    strip: QRectF
    legend: QRectF

    def bin_at(self, point: QPointF) -> int | None:
        """Number of the bin at or above whose ground a point is; none beside the axes."""
        inside = self.x.start <= point.x() <= self.x.end and self.y.end <= point.y() <= self.strip.bottom()
        share = (point.x() - self.x.start) / max(self.x.end - self.x.start, 1.0)
        count = len(self.now.totals)
        return min(int(share * count), count - 1) if inside else None

    def limit_at(self, point: QPointF, reach: float) -> int | None:
        """Number of the limit on whose line a point is: of two that lie together the one on the point's side."""
        if not self.y.end - 2 * self.strip.height() <= point.y() <= self.strip.bottom() + self.strip.height():
            return None
        places = [self.x.at(limit) for limit in self.quality.limits]
        nearest = min(places, key=lambda place: abs(point.x() - place))
        ends = [end for end, place in enumerate(places) if place == nearest]
        return ends[-1 if point.x() >= nearest else 0] if abs(point.x() - nearest) <= reach else None

    def column(self, number: int) -> QRectF:
        """All of the ground of one bin."""
        edges = self.now.edges
        left, right = round(self.x.at(edges[number])), round(self.x.at(edges[number + 1]))
        return QRectF(left, self.y.end, right - left, self.y.start - self.y.end)


def bars(
    area: QRectF,
    letters: QFontMetricsF,
    quality: Quality,
    now: Histogram,
    first: Histogram | None,
    selected: frozenset[int],
    given_count: int = 0,
) -> Bars:
    """Arrange a histogram in an area."""
    line = letters.height()
    most = top(int(max(now.totals.max(), 0 if first is None else first.totals.max())))
    left = area.left() + letters.horizontalAdvance(counted(most)) + 0.5 * line
    right = area.right() - 0.7 * line
    legend = LEGEND_LINE * line * min(max(int((area.height() / line - _HIGH) / 1.5) + 1, 0), 2)
    ground = round(area.bottom() - 2.3 * line - legend)
    return Bars(
        quality=quality,
        now=now,
        first=first,
        selected=selected,
        given_count=given_count,
        x=Axis(float(now.edges[0]), float(now.edges[-1]), round(left), round(right)),
        y=Axis(0, most, ground, round(area.top() + 1.4 * line)),
        strip=QRectF(round(left), ground + round(0.25 * line), round(right) - round(left), round(0.5 * line)),
        legend=QRectF(left, area.bottom() - 0.1 * line - legend, area.right() - left, legend),
    )


def draw(painter: QPainter, plot: Bars, palette: Palette, chosen: ColourMap) -> None:
    """Draw all but the limit."""
    _draw_counts(painter, plot, palette)
    _draw_bars(painter, plot, chosen)
    _draw_selected(painter, plot, palette)
    _draw_first(painter, plot, palette)
    _draw_strip(painter, plot, palette, chosen)


def _draw_counts(painter: QPainter, plot: Bars, palette: Palette) -> None:
    line = plot.strip.height() * 2
    is_low = plot.y.start - plot.y.end < 1.2 * line
    for value in sorted({0, int(plot.y.high)} if is_low else {0, int(plot.y.high) // 2, int(plot.y.high)}):
        y = round(plot.y.at(value))
        painter.setPen(QPen(QColor(palette.rule), 1))
        painter.drawLine(QLineF(plot.x.start, y, plot.x.end, y))
        painter.setPen(QColor(palette.dim))
        painter.drawText(QRectF(0, y - line, plot.x.start - 0.4 * line, 2 * line), _RIGHT, counted(value))


def _draw_bars(painter: QPainter, plot: Bars, chosen: ColourMap) -> None:
    for number in plot.now.totals.nonzero()[0].tolist():
        ground, height = plot.column(number).adjusted(0, 0, -1, 0), 0.0
        for portion, count in enumerate(plot.now.counts[:, number].tolist()):
            if not count:
                continue
            tall = max(plot.y.start - plot.y.at(count), 2.0)  # one among a million is seen too
            colour = portion_colour(portion, float(plot.now.grades[portion, number]), chosen)
            bar = QRectF(ground.left(), ground.bottom() - height - tall, ground.width(), tall)
            painter.fillRect(bar, QColor(colour))
            height += tall


def portion_colour(portion: int, grade: float, chosen: ColourMap) -> str:
    """Colour of the elements that are not valid, that fail or that pass (see `hullquad.histogram.PORTIONS`)."""
    return chosen.colour(min(grade, _ALMOST) if portion == 1 else grade, valid=portion > 0)


def _draw_selected(painter: QPainter, plot: Bars, palette: Palette) -> None:
    painter.setPen(QPen(QColor(palette.selection), 1.5))
    painter.setBrush(Qt.BrushStyle.NoBrush)
    for number in plot.selected:
        height = max(plot.y.start - plot.y.at(float(plot.now.totals[number])), 3.0)
        column = plot.column(number)
        painter.drawRect(QRectF(column.left() - 1, column.bottom() - height - 1, column.width() + 1, height + 1))


def _draw_first(painter: QPainter, plot: Bars, palette: Palette) -> None:
    if plot.first is None:
        return
    painter.setPen(first_pen(palette))
    before = plot.y.start
    for number, count in enumerate(plot.first.totals.tolist()):
        column, height = plot.column(number), round(plot.y.at(count))
        if height != before:
            painter.drawLine(QLineF(column.left(), before, column.left(), height))
        if count:
            painter.drawLine(QLineF(column.left(), height, column.right(), height))
        before = height
    if before != plot.y.start:
        painter.drawLine(QLineF(plot.x.end, before, plot.x.end, plot.y.start))


def first_pen(palette: Palette) -> QPen:
    """Pen of the outline of iteration 0."""
    return QPen(QColor(palette.dim), 1, Qt.PenStyle.DotLine)


def _draw_strip(painter: QPainter, plot: Bars, palette: Palette, chosen: ColourMap) -> None:
    ends = (round(plot.strip.left()), round(plot.strip.right()))
    colours = _strip_colours(plot.quality.metric, plot.quality.band, plot.x, ends, chosen)
    for start, colour in zip(range(*ends, _STRIPE), colours, strict=True):
        stripe = min(_STRIPE, plot.strip.right() - start)
        painter.fillRect(QRectF(start, plot.strip.top(), stripe, plot.strip.height()), QColor(colour))
    line = plot.strip.height() * 2
    painter.setPen(QColor(palette.dim))
    values = _values(plot.x, plot.quality.metric.unit)
    rim = plot.x.end + 0.7 * line
    for value, text in zip(values, _value_labels(plot, values), strict=True):
        width = painter.fontMetrics().horizontalAdvance(text) + 1
        left = min(plot.x.at(value) - width / 2, rim - width)
        painter.drawText(QRectF(left, plot.strip.bottom() + 0.15 * line, width, line), _CENTRE, text)


@lru_cache(maxsize=8)
def _strip_colours(metric: Metric, band: Band, x: Axis, ends: tuple[int, int], chosen: ColourMap) -> tuple[str, ...]:
    """Colours of the stripes of the legend, from left to right."""
    values = [x.value(left + _STRIPE / 2) for left in range(*ends, _STRIPE)]
    return tuple(chosen.colour(_grade(metric, band, value)) for value in values)


def _grade(metric: Metric, band: Band, value: float) -> float:
    grade = float(graded(metric, np.array([value]), band)[0])
    return grade if metric.is_within(band, np.array(value)) else min(grade, _ALMOST)


def _values(x: Axis, unit: str) -> list[float]:
    if unit != DEGREES:
        return ticks(x.low, x.high, 6)
    return [float(angle) for angle in range(0, 361, 30) if x.low <= angle <= x.high]


def axis_labels(values: list[float], by: Metric) -> list[str]:
    """Values with their unit; of one in letters only the last."""
    texts = labels(values)
    if by.unit.isalpha():
        return [*texts[:-1], texts[-1] + unit_of(by)]
    return [text + by.unit for text in texts]


def _value_labels(plot: Bars, values: list[float]) -> list[str]:
    texts = axis_labels(values, plot.quality.metric)
    if plot.now.is_open_below and values[0] <= plot.x.low:
        texts[0] = "<" + texts[0]
    if plot.now.is_open_above and values[-1] >= plot.x.high:
        texts[-1] = ">" + texts[-1]
    return texts
