"""The legend of a rule set, in a corner of the view: what its colours mean, and how many elements have them."""

from PySide6.QtCore import QPointF, QRectF, Qt
from PySide6.QtGui import QColor, QFont, QPainter, QPen

from hullquad_app.colours import Palette
from hullquad_app.level_legend import Entry, draw_swatch, entries
from hullquad_app.panels.figures import CAPTION, sized
from hullquad_app.scene import Scene

_LEFT = Qt.AlignmentFlag.AlignLeft | Qt.AlignmentFlag.AlignVCenter


def legend_of(scene: Scene) -> tuple[str, list[Entry]]:
    """Title and entries of a scene; none where it is judged by its metric, whose legend is the histogram."""
    if scene.assessment is None or scene.quality is None:
        return "", []
    return scene.assessment.rule_set.title, entries(scene.assessment, scene.quality.inverted_count)


def draw_legend(painter: QPainter, palette: Palette, corner: QPointF, title: str, rows: list[Entry]) -> QRectF:
    """Draw title and entries below one another from a corner on, on a ground of their own; the place they take."""
    if not rows:
        return QRectF()
    painter.save()
    painter.setFont(sized(painter.font(), CAPTION))
    letters, bold = painter.fontMetrics(), QFont(painter.font())
    bold.setBold(True)
    line = 1.25 * letters.height()
    wide = max(letters.horizontalAdvance(row.text) for row in rows) + 1.2 * line
    painter.setFont(bold)
    wide = max(wide, painter.fontMetrics().horizontalAdvance(title))
    box = QRectF(corner.x(), corner.y(), wide + line, line * (len(rows) + 1) + 0.6 * line)
    ground = QColor(palette.panel)
    ground.setAlpha(225)
    painter.setPen(QPen(QColor(palette.rule), 1))
    painter.setBrush(ground)
    painter.drawRoundedRect(box, 4, 4)
    place = QRectF(box.left() + 0.5 * line, box.top() + 0.3 * line, wide, line)
    painter.setPen(QColor(palette.text))
    painter.drawText(place, _LEFT, title)
    _draw_entries(painter, palette, place, rows)
    painter.restore()
    return box


def _draw_entries(painter: QPainter, palette: Palette, place: QRectF, rows: list[Entry]) -> None:
    font = QFont(painter.font())
    font.setBold(False)
    painter.setFont(font)
    side = round(0.7 * painter.fontMetrics().height())
    for row in rows:
        place.translate(0, place.height())
        square = QRectF(round(place.left()) + 0.5, round(place.center().y() - side / 2) + 0.5, side, side)
        draw_swatch(painter, square, row.colour, palette)
        painter.setPen(QColor(palette.text))
        painter.drawText(place.adjusted(1.6 * side, 0, 0, 0), _LEFT, row.text)
