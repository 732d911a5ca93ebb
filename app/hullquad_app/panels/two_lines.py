"""Cells with a second line: small and dim, below the first."""

from PySide6.QtCore import QRect, Qt
from PySide6.QtGui import QFontMetrics, QPainter, QPalette
from PySide6.QtWidgets import QStyle, QStyleOptionViewItem

from hullquad_app.panels.figures import CAPTION, sized
from hullquad_app.panels.table import Cells, Index

DETAIL = Qt.ItemDataRole.UserRole + 1
"""Role of the second line."""


class TwoLines(Cells):
    """Draws both lines, each cut with three points where there is no room for it."""

    def paint(self, painter: QPainter, option: QStyleOptionViewItem, index: Index) -> None:
        """Draw a cell."""
        detail = index.data(DETAIL)
        if not detail:
            super().paint(painter, option, index)
            return
        drawn = QStyleOptionViewItem(option)
        self.initStyleOption(drawn, index)
        text, drawn.text = drawn.text, ""
        drawn.widget.style().drawControl(QStyle.ControlElement.CE_ItemViewItem, drawn, painter, drawn.widget)
        self._write(painter, drawn, text, detail)

    def _write(self, painter: QPainter, drawn: QStyleOptionViewItem, text: str, detail: str) -> None:
        margin = drawn.fontMetrics.averageCharWidth() // 2
        area, small = drawn.rect.adjusted(margin, 0, -margin, 0), sized(drawn.font, CAPTION)
        heights = drawn.fontMetrics.height(), QFontMetrics(small).height()
        top = area.top() + (area.height() - sum(heights)) // 2
        is_selected = bool(drawn.state & QStyle.StateFlag.State_Selected)
        roles = (QPalette.ColorRole.HighlightedText,) * 2 if is_selected else (
            QPalette.ColorRole.Text, QPalette.ColorRole.PlaceholderText)  # fmt: skip
        painter.save()
        for line, height, font, role in zip((text, detail), heights, (drawn.font, small), roles, strict=True):
            painter.setFont(font)
            painter.setPen(drawn.palette.color(role))
            place = QRect(area.left(), top, area.width(), height)
            shown = QFontMetrics(font).elidedText(line, Qt.TextElideMode.ElideRight, area.width())
            painter.drawText(place, Qt.AlignmentFlag.AlignLeft | Qt.AlignmentFlag.AlignVCenter, shown)
            top += height
        painter.restore()
