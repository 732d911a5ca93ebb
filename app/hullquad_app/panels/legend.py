"""The line below a histogram that says what its signs mean."""

from PySide6.QtCore import QCoreApplication, QLineF, QPointF, QRectF, Qt
from PySide6.QtGui import QColor, QPainter

from hullquad_app.colours import ColourMap, Palette
from hullquad_app.panels import bars

_LEFT = Qt.AlignmentFlag.AlignLeft | Qt.AlignmentFlag.AlignVCenter


def draw_legend(painter: QPainter, plot: bars.Bars, palette: Palette, chosen: ColourMap) -> None:
    """Draw as many entries as there is room for."""
    entries = [("now", _tr("now"))]
    if plot.first is not None:
        entries.append(("first", _tr("iteration 0")))
    if bars.has_triangle_limit(plot.quality):
        entries.append(("triangle", _tr("limit of triangles")))
    entries.append(("", _tr("click a bar to select its elements")))
    left = plot.legend.left()
    for sign, text in entries:
        left = _draw_entry(painter, plot, palette, chosen, left, sign, text)


def _draw_entry(
    painter: QPainter, plot: bars.Bars, palette: Palette, chosen: ColourMap, left: float, sign: str, text: str
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
        painter.setPen(bars.first_pen(palette))
        painter.drawLine(QLineF(left, middle, left + 2 * reach, middle))
    elif sign == "triangle":
        bars.draw_triangle(painter, QPointF(left + reach, middle), reach, palette)
    painter.setPen(QColor(palette.dim))
    painter.drawText(QRectF(start, plot.legend.top(), width + 1, plot.legend.height()), _LEFT, text)
    return start + width + room


def _tr(text: str) -> str:
    return QCoreApplication.translate("Histogram", text)
