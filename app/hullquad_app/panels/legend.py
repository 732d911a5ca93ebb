"""The words of a histogram: the line below that says what its signs mean, and the range of a bin."""

from math import isinf

from PySide6.QtCore import QCoreApplication, QLineF, QPointF, QRectF, Qt
from PySide6.QtGui import QColor, QPainter

from hullquad_app.colours import ColourMap, Palette
from hullquad_app.panels.bars import Bars, first_pen
from hullquad_app.panels.figures import counted, plain
from hullquad_app.panels.limit import draw_triangle, has_triangle_limit

_LEFT = Qt.AlignmentFlag.AlignLeft | Qt.AlignmentFlag.AlignVCenter


def draw_legend(painter: QPainter, plot: Bars, palette: Palette, chosen: ColourMap) -> None:
    """Draw as many entries as there is room for."""
    entries = [("now", _tr("now"))]
    if plot.first is not None:
        entries.append(("first", _tr("iteration 0")))
    if has_triangle_limit(plot.quality):
        entries.append(("triangle", _tr("limit of triangles")))
    entries.append(("", _tr("click a bar to select its elements")))
    left = plot.legend.left()
    for sign, text in entries:
        left = _draw_entry(painter, plot, palette, chosen, left, sign, text)


def bin_words(plot: Bars, number: int) -> str:
    """Range and number of the elements of a bin."""
    count = int(plot.now.totals[number])
    text = _tr("{range}: 1 element") if count == 1 else _tr("{range}: {count} elements")
    return text.format(range=_range(plot, number), count=counted(count))


def _range(plot: Bars, number: int) -> str:
    bounds = plot.now.bounds(number)
    low, high = (plain(end, plot.quality.metric) for end in bounds)
    if isinf(bounds[0]):
        return _tr("below {value}").format(value=high)
    return _tr("over {value}").format(value=low) if isinf(bounds[1]) else f"{low}–{high}"


def _draw_entry(
    painter: QPainter, plot: Bars, palette: Palette, chosen: ColourMap, left: float, sign: str, text: str
) -> float:
    letters = painter.fontMetrics()
    room, reach, middle = letters.height(), 0.3 * letters.height(), plot.legend.center().y()
    start = left + (0.9 * room if sign else 0)
    width = letters.horizontalAdvance(text)
    if start + width > plot.legend.right():
        return left
    if sign == "now":
        painter.fillRect(QRectF(left, middle - reach, 2 * reach, 2 * reach), QColor(chosen.colour(0.8)))
    elif sign == "first":
        painter.setPen(first_pen(palette))
        painter.drawLine(QLineF(left, middle, left + 2 * reach, middle))
    elif sign == "triangle":
        draw_triangle(painter, QPointF(left + reach, middle), reach, palette)
    painter.setPen(QColor(palette.dim))
    painter.drawText(QRectF(start, plot.legend.top(), width + 1, plot.legend.height()), _LEFT, text)
    return start + width + room


def _tr(text: str) -> str:
    return QCoreApplication.translate("Histogram", text)
