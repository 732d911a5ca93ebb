"""How the cells of a table are drawn."""

from PySide6.QtCore import QModelIndex, QObject, QPersistentModelIndex, QRect, QRectF, Qt
from PySide6.QtGui import QColor, QFont, QFontMetrics, QPainter, QPalette
from PySide6.QtWidgets import QStyle, QStyledItemDelegate, QStyleOptionViewItem

from hullquad_app.hatching import draw_hatching, hatch_colour
from hullquad_app.panels.cell import CELL, LEFT, RIGHT, Cell
from hullquad_app.panels.figures import CAPTION, sized

Index = QModelIndex | QPersistentModelIndex
_SQUARE = 0.65
"""Side of a square, of the height of its row."""


class Letters:
    """A font and its measures."""

    def __init__(self, font: QFont) -> None:
        self.font, self.measures = font, QFontMetrics(font)

    def write(self, painter: QPainter, place: QRect, text: str, colour: QColor, side: Qt.AlignmentFlag = LEFT) -> None:
        """Write a text, cut with three points where there is no room for it."""
        if self.measures.horizontalAdvance(text) > place.width():
            text = self.measures.elidedText(text, Qt.TextElideMode.ElideRight, place.width())
        painter.setFont(self.font)
        painter.setPen(colour)
        painter.drawText(place, side, text)


class Cells(QStyledItemDelegate):
    """Draws every `Cell` at once: Qt's own way asks the model nine times for each."""

    def __init__(self, parent: QObject) -> None:
        super().__init__(parent)
        self.set_font(QFont())

    def set_font(self, font: QFont) -> None:
        """Write in a font, bold and small."""
        bold = QFont(font)
        bold.setBold(True)
        self._plain, self._bold = Letters(sized(font)), Letters(sized(bold))
        self._small = Letters(sized(font, CAPTION))

    def paint(self, painter: QPainter, option: QStyleOptionViewItem, index: Index) -> None:
        """Draw a cell on the ground of its row."""
        cell, area, colours = index.data(CELL), option.rect, option.palette
        is_selected = bool(option.state & QStyle.StateFlag.State_Selected)
        if is_selected:
            painter.fillRect(area, colours.color(QPalette.ColorRole.Highlight))
        if cell.swatch:
            self._draw_square(painter, area, cell)
        if cell.text:
            self._write(painter, area, cell, colours, is_selected=is_selected)

    def _draw_square(self, painter: QPainter, area: QRect, cell: Cell) -> None:
        side = min(round(_SQUARE * area.height()), self._plain.measures.height())
        square, colour = QRect(0, 0, side, side), QColor(cell.swatch)
        square.moveCenter(area.center())
        painter.fillRect(square, colour)
        if cell.is_hatched:
            draw_hatching(painter, QRectF(square), hatch_colour(colour))

    def _write(self, painter: QPainter, area: QRect, cell: Cell, colours: QPalette, *, is_selected: bool) -> None:
        above = self._bold if cell.is_bold else self._plain
        margin = above.measures.averageCharWidth() // 2
        place = area.adjusted(margin, 0, -margin, 0)
        lit = colours.color(QPalette.ColorRole.HighlightedText) if is_selected else None
        colour = lit or (QColor(cell.colour) if cell.colour else colours.color(QPalette.ColorRole.Text))
        if cell.detail:
            height, small = above.measures.height(), self._small
            place.setTop(area.top() + (area.height() - height - small.measures.height()) // 2)
            place.setHeight(height)
            below = place.translated(0, height)
            small.write(painter, below, cell.detail, lit or colours.color(QPalette.ColorRole.PlaceholderText))
        above.write(painter, place, cell.text, colour, RIGHT if cell.is_number else LEFT)
