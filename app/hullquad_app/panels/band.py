"""One band of the objective history: a line over the iterations, with its own title and axis."""

import attrs
import numpy as np
from PySide6.QtCore import QCoreApplication, QLineF, QPointF, QRectF, Qt
from PySide6.QtGui import QColor, QPainter, QPen

from hullquad.arrays import Floats
from hullquad_app.colours import Palette
from hullquad_app.metric_words import name_of
from hullquad_app.objectives import objective_name
from hullquad_app.panels.axis import Axis, labels, padded, ticks
from hullquad_app.panels.course import Course, Part, thinned
from hullquad_app.panels.figures import summed, valued

_RIGHT = Qt.AlignmentFlag.AlignRight | Qt.AlignmentFlag.AlignVCenter
_LEFT = Qt.AlignmentFlag.AlignLeft | Qt.AlignmentFlag.AlignVCenter

_HIGH = 4.5
"""Height from which there are two bands [lines of text]."""
_PIECE = 8
"""Points that are drawn as one line: of a long one that crosses itself Qt first finds the outline, very slowly."""


@attrs.frozen(eq=False, kw_only=True)
class Band:
    """Values over the iterations, on one pair of axes."""

    title: str
    shown: str
    """The value of the shown iterate, written at the right of the title."""
    values: Floats
    colour: str
    width: float
    x: Axis
    y: Axis
    area: QRectF
    """Of the title and the line."""
    line: float
    """Height of a line of text."""

    @property
    def tick_values(self) -> list[float]:
        """Values that are written beside the band: round ones, in a low band only the outer two, or one."""
        tries = (ticks(self.y.low, self.y.high, most) for most in (4, 5, 7))
        found = next((values for values in tries if len(values) > 1), [])
        outer = found if self.y.start - self.y.end > 3 * self.line else found[:: max(len(found) - 1, 1)]
        return outer if not outer or self.y.at(outer[0]) - self.y.at(outer[-1]) > self.line else outer[-1:]

    @property
    def tick_texts(self) -> list[str]:
        """The same as they are written."""
        return labels(self.tick_values)


def bands(course: Course, position: int, area: QRectF, line: float, palette: Palette) -> tuple[Band, ...]:
    """The objective, and the worst value below where there is room; axes fit iterates judged as the shown one is."""
    part = course.part_at(position)
    upper, lower = QRectF(area), QRectF(area)
    has_both = area.height() >= _HIGH * line
    if has_both:
        upper.setHeight(round(0.6 * area.height() - 0.2 * line))
    lower.setTop(upper.bottom() + round(0.4 * line))
    objective, worst = float(course.objectives[position]), float(course.worsts[position])
    (sum_title, worst_title), by = _titles(part), None if part.weighted else part.by
    x = Axis(course.numbers[0], course.numbers[-1], area.left(), area.right())
    rows = (
        (sum_title, summed(objective, by), course.objectives, upper, palette.accent, 2.0),
        (worst_title, valued(worst, part.by), course.worsts, lower, palette.dim, 1.5),
    )
    alike = course.alike(part)
    return tuple(
        Band(title=title, shown=text, values=values, x=x, y=_y_axis(values[alike], place, line), area=place, line=line,
             colour=colour, width=width)
        for title, text, values, place, colour, width in rows[: 1 + has_both]
    )  # fmt: skip


def _titles(part: Part) -> tuple[str, str]:
    """Titles with an arrow to where it is better."""
    better = "↑" if part.by.higher_is_better else "↓"
    worst = QCoreApplication.translate("History", "worst") + f" {better}"
    if part.weighted is not None:
        return f"{objective_name(part.weighted)} ↑", worst
    return f"Σ {name_of(part.by)} {better}", worst


def _y_axis(values: Floats, area: QRectF, line: float) -> Axis:
    low, high = padded(values.tolist())
    return Axis(low, high, area.bottom() - 2, area.top() + 1.3 * line)


def draw_frame(painter: QPainter, row: Band, palette: Palette) -> None:
    """Draw title, value and the lines of the axis."""
    line = painter.fontMetrics().height()
    for value, text in zip(row.tick_values, row.tick_texts, strict=True):
        y = round(row.y.at(value))
        painter.setPen(QPen(QColor(palette.rule), 1))
        painter.drawLine(QLineF(row.x.start, y, row.x.end, y))
        painter.setPen(QColor(palette.dim))
        painter.drawText(QRectF(0, y - line, row.x.start - 0.5 * line, 2 * line), _RIGHT, text)
    title = QRectF(row.x.start, row.area.top(), row.x.end - row.x.start, line)
    painter.setPen(QColor(row.colour))
    painter.drawText(title, _LEFT, row.title)
    painter.setPen(QColor(palette.text))
    painter.drawText(title, _RIGHT, row.shown)


def draw_course(painter: QPainter, row: Band, course: Course, active: Part, palette: Palette) -> None:
    """Draw the line; parts of another kind than the active one in grey, each on a scale of its own."""
    for part in course.parts:
        numbers, values = course.numbers[part.start : part.end], row.values[part.start : part.end]
        if part.is_like(active):
            _draw_line(painter, row.x, row.y, numbers, values, QPen(QColor(row.colour), row.width))
        else:
            low, high = padded(values.tolist())
            own = attrs.evolve(row.y, low=low, high=high)
            _draw_line(painter, row.x, own, numbers, values, QPen(QColor(palette.rule), row.width))


def _draw_line(painter: QPainter, x: Axis, y: Axis, numbers: Floats, values: Floats, pen: QPen) -> None:
    """Draw a line through the finite values; it is broken where one is not."""
    places = x.start + (numbers - x.low) / max(x.high - x.low, 1.0) * (x.end - x.start)
    is_finite = np.isfinite(values)
    rows = thinned(places, np.where(is_finite, values, y.low), pen.widthF())
    pen.setJoinStyle(Qt.PenJoinStyle.RoundJoin)
    pen.setCapStyle(Qt.PenCapStyle.RoundCap)
    painter.setPen(pen)
    for run in np.split(rows, np.flatnonzero(~is_finite[rows])):
        kept = run[is_finite[run]]
        points = [QPointF(*at) for at in zip(places[kept].tolist(), map(y.at, values[kept].tolist()), strict=True)]
        for start in range(0, len(points), _PIECE - 1):
            painter.drawPolyline(points[start : start + _PIECE])


def draw_mark(painter: QPainter, row: Band, course: Course, position: int, ground: str) -> None:
    """Draw a dot with a rim at one iterate."""
    _draw_circle(painter, row, course, position, QPen(QColor(ground), 1.5), row.colour)


def draw_ring(painter: QPainter, row: Band, course: Course, position: int, ground: str, text: str) -> None:
    """Draw an open ring at one iterate, and what it means on the side away from the line."""
    _draw_circle(painter, row, course, position, QPen(QColor(row.colour), 1.5), ground)
    part, line = course.part_at(position), row.line
    width = painter.fontMetrics().horizontalAdvance(text)
    left = min(max(row.x.at(course.numbers[position]) - width / 2, row.x.start), row.x.end - width)
    middle = row.y.at(float(row.values[position])) + (line if part.rises else -line)
    painter.drawText(QRectF(left, middle - line / 2, width + 1, line), _LEFT, text)


def draw_station(painter: QPainter, row: Band, number: float, colour: str) -> None:
    """Draw an upright line through the band at one iteration."""
    at = round(row.x.at(number))
    painter.setPen(QPen(QColor(colour), 1))
    painter.drawLine(QLineF(at, row.y.end - 0.1 * row.line, at, row.area.bottom()))


def _draw_circle(painter: QPainter, row: Band, course: Course, position: int, pen: QPen, fill: str) -> None:
    value = float(row.values[position])
    if not np.isfinite(value):
        return
    reach = 0.3 * painter.fontMetrics().height()
    painter.setPen(pen)
    painter.setBrush(QColor(fill))
    painter.drawEllipse(QPointF(row.x.at(course.numbers[position]), row.y.at(value)), reach, reach)
