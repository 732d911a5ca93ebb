"""Where the stages of runs begin, on a band of the objective history."""

from PySide6.QtCore import QLineF, QRectF, Qt
from PySide6.QtGui import QColor, QPainter, QPen

from hullquad_app.colours import Palette
from hullquad_app.panels.band import Band
from hullquad_app.panels.course import Course

_LEFT = Qt.AlignmentFlag.AlignLeft | Qt.AlignmentFlag.AlignVCenter
_GAP = 0.3
"""Between a mark and its label, and the next mark [lines of text]."""


def draw_stages(painter: QPainter, row: Band, course: Course, palette: Palette) -> None:
    """Draw a short upright line where each stage begins, and its name where there is room before the next one.

    They stand on the side of the band that the line comes from.
    """
    if not course.stages:
        return
    is_below = course.part_at(course.stages[-1].start).rises
    top, gap = row.area.bottom() - row.line if is_below else row.y.end, _GAP * row.line
    places = [round(row.x.at(course.numbers[stage.start])) for stage in course.stages]
    for stage, at, end in zip(course.stages, places, [*places[1:], row.x.end], strict=True):
        painter.setPen(QPen(QColor(palette.dim), 1))
        painter.drawLine(QLineF(at, top + gap, at, top + row.line - gap))
        width = painter.fontMetrics().horizontalAdvance(stage.words)
        if at + gap + width <= end - gap:
            painter.drawText(QRectF(at + gap, top, width + 1, row.line), _LEFT, stage.words)
