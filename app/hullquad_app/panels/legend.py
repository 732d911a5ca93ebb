"""The words of a histogram: the line below that says what its signs mean, and the range of a bin."""

from math import isinf

from PySide6.QtCore import QCoreApplication, QLineF, QPointF, QRectF, Qt
from PySide6.QtGui import QColor, QPainter

from hullquad_app.colours import ColourMap, Palette
from hullquad_app.count_words import number_of
from hullquad_app.level_legend import draw_swatch
from hullquad_app.metric_words import name_of
from hullquad_app.panels.bars import LEGEND_LINE, Bars, first_pen
from hullquad_app.panels.figures import plain
from hullquad_app.panels.limit import draw_triangle, has_triangle_limit

_LEFT = Qt.AlignmentFlag.AlignLeft | Qt.AlignmentFlag.AlignVCenter


def draw_legend(painter: QPainter, plot: Bars, palette: Palette, chosen: ColourMap) -> None:
    """Draw as many entries as there is room for."""
    line = LEGEND_LINE * painter.fontMetrics().height()
    place = QRectF(plot.legend.left(), plot.legend.top(), 0, line)
    for sign, text in _entries(plot):
        width = _width(painter, sign, text)
        if place.left() + width > plot.legend.right():
            place.moveTo(plot.legend.left(), place.top() + line)
        if place.bottom() > plot.legend.bottom() + 1 or place.left() + width > plot.legend.right():
            return
        place.setWidth(width)
        _draw_entry(painter, palette, chosen, place, sign, text)
        place.moveLeft(place.right() + 0.8 * line)


def _entries(plot: Bars) -> list[tuple[str, str]]:
    """Signs with their meanings, the important ones first."""
    row, triangles = plot.quality.metric, int(plot.quality.is_triangle.sum())
    is_other = bool(triangles) and row.triangles is None
    judge = name_of(row.triangle_metric)
    entries = [("now", _tr("now"))]
    if plot.first is not None:
        entries.append(("first", _tr("iteration 0")))
    if is_other and not row.holds_triangles:
        text = _tr("{triangles} by {judge}: not here")
        entries.append(("", text.format(triangles=number_of("triangle", triangles), judge=judge)))
    elif has_triangle_limit(plot.quality):
        text = _tr("limit of triangles, by {judge}") if is_other else _tr("limit of triangles")
        entries.append(("triangle", text.format(judge=judge)))
    elif is_other:
        entries.append(("", _tr("triangles by {judge}").format(judge=judge)))
    if plot.given_count:
        entries.append(("given", _tr("given by the contour")))
    return [*entries, ("", _tr("click a bar to select its elements"))]


def bin_words(plot: Bars, number: int) -> str:
    """Range and number of the elements of a bin."""
    return f"{_range(plot, number)}: {number_of('element', int(plot.now.totals[number]))}"


def _range(plot: Bars, number: int) -> str:
    bounds = plot.now.bounds(number)
    low, high = (plain(end, plot.quality.metric) for end in bounds)
    if isinf(bounds[0]):
        return _tr("below {value}").format(value=high)
    return _tr("over {value}").format(value=low) if isinf(bounds[1]) else f"{low}–{high}"


def _width(painter: QPainter, sign: str, text: str) -> float:
    letters = painter.fontMetrics()
    return letters.horizontalAdvance(text) + 1 + (0.9 * letters.height() if sign else 0)


def _draw_entry(painter: QPainter, palette: Palette, chosen: ColourMap, place: QRectF, sign: str, text: str) -> None:
    room = painter.fontMetrics().height()
    reach, middle, left = 0.3 * room, place.center().y(), place.left()
    square = QRectF(left, middle - reach, 2 * reach, 2 * reach)
    if sign == "now":
        painter.fillRect(square, QColor(chosen.colour(0.8)))
    elif sign == "first":
        painter.setPen(first_pen(palette))
        painter.drawLine(QLineF(left, middle, left + 2 * reach, middle))
    elif sign == "triangle":
        draw_triangle(painter, QPointF(left + reach, middle), reach, palette)
    elif sign == "given":
        draw_swatch(painter, square, "", palette)
    painter.setPen(QColor(palette.dim))
    painter.drawText(place.adjusted(0.9 * room if sign else 0, 0, 0, 0), _LEFT, text)


def _tr(text: str) -> str:
    return QCoreApplication.translate("Histogram", text)
