"""The limit on a histogram: its line, its value, and where triangles have another."""

from math import floor, log10

from PySide6.QtCore import QCoreApplication, QLineF, QPointF, QRectF, Qt
from PySide6.QtGui import QBrush, QColor, QPainter, QPen, QPolygonF

from hullquad.histogram import Histogram
from hullquad.quality import Quality
from hullquad_app.colours import Palette
from hullquad_app.panels.bars import Bars
from hullquad_app.panels.figures import plain

_LEFT = Qt.AlignmentFlag.AlignLeft | Qt.AlignmentFlag.AlignVCenter


def limit_step(now: Histogram) -> float:
    """Least change of the limit: a power of ten, less than a bin."""
    return float(10.0 ** floor(log10(now.edges[1] - now.edges[0])))


def rounded_limit(now: Histogram, limit: float) -> float:
    """The nearest limit on the axis that is a whole number of steps."""
    inside, step = min(max(limit, float(now.edges[0])), float(now.edges[-1])), limit_step(now)
    return round(round(inside / step) * step, 9)


def draw_limits(painter: QPainter, plot: Bars, palette: Palette, lively: int | None) -> None:
    """Draw each limit as a line with its value; in the accent colour the one that can be moved now."""
    limits = plot.quality.limits
    for number, limit in enumerate(limits):
        is_lower = number == 0 and len(limits) > 1
        _draw_line(painter, plot, palette, limit, lively=number == lively, on_left=is_lower)


def _draw_line(painter: QPainter, plot: Bars, palette: Palette, limit: float, *, lively: bool, on_left: bool) -> None:
    """The value stands on the outer side of a band with two ends, else at the right where there is room."""
    line, text = plot.strip.height() * 2, _tr("limit {limit}").format(limit=plain(limit, plot.quality.metric))
    at, colour = round(plot.x.at(limit)), QColor(palette.accent if lively else palette.text)
    painter.setPen(QPen(colour, 2 if lively else 1.5))
    painter.drawLine(QLineF(at, plot.y.end - 1.3 * line, at, plot.strip.bottom() + 2))
    width = painter.fontMetrics().horizontalAdvance(text)
    fits_right = at + width + 0.4 * line < plot.x.end + 0.7 * line
    fits_left = at - width - 0.4 * line > 0
    left = at - 0.3 * line - width if fits_left and (on_left or not fits_right) else at + 0.3 * line
    painter.drawText(QRectF(left, plot.y.end - 1.4 * line, width + 1, line), _LEFT, text)


def has_triangle_limit(quality: Quality) -> bool:
    """Whether there are triangles on the axis that fail at another value than quads."""
    row = quality.metric
    is_other = row.holds_triangles and quality.triangle_band != quality.band
    return is_other and bool(quality.is_triangle.any())


def draw_triangle_limit(painter: QPainter, plot: Bars, palette: Palette) -> None:
    """Mark on the strip where triangles fail."""
    if not has_triangle_limit(plot.quality):
        return
    row, reach = plot.quality.metric, plot.strip.height() / 2
    for limit in row.triangle_metric.limits(plot.quality.triangle_band):
        draw_triangle(painter, QPointF(plot.x.at(limit), plot.strip.center().y()), reach, palette)


def draw_triangle(painter: QPainter, centre: QPointF, reach: float, palette: Palette) -> None:
    """Draw the mark of the triangles' own limit."""
    shape = [QPointF(0, -reach), QPointF(reach, 0.8 * reach), QPointF(-reach, 0.8 * reach)]
    painter.setPen(QPen(QColor(palette.panel), 1))
    painter.setBrush(QBrush(QColor(palette.text)))
    painter.drawPolygon(QPolygonF([centre + corner for corner in shape]))


def _tr(text: str) -> str:
    return QCoreApplication.translate("Histogram", text)
