"""A calm table: whole rows, no grid, no frame around the current cell."""

from collections.abc import Iterable

from PySide6.QtCore import (
    QAbstractItemModel,
    QEvent,
    QItemSelection,
    QItemSelectionModel,
    QModelIndex,
    QSize,
    Qt,
    Signal,
)
from PySide6.QtGui import QFont, QFontMetrics, QKeyEvent, QPainter, QPaintEvent, QResizeEvent
from PySide6.QtWidgets import (
    QAbstractItemView,
    QApplication,
    QHeaderView,
    QTableView,
)

from hullquad_app.colours import Palette
from hullquad_app.panels.cells import Cells
from hullquad_app.panels.figures import CAPTION, sized
from hullquad_app.panels.ground import dress

_EXTENDS = Qt.KeyboardModifier.ShiftModifier | Qt.KeyboardModifier.ControlModifier
_HEADER = (
    "QHeaderView::section {{ background: {panel}; color: {dim}; border: none;"
    " border-bottom: 1px solid {rule}; padding: 2px 4px; }}"
)


class Table(QTableView):
    """A table of which the user chooses rows; what is selected is told by `select_rows` alone."""

    chosen = Signal(int, bool)
    """Row that was clicked or reached by a key, and whether it extends the selection."""
    resized = Signal()
    """There is another width for the columns."""
    opened = Signal(int)
    """Row that was clicked twice, or Enter was pressed in."""

    def __init__(self, model: QAbstractItemModel, empty: str) -> None:
        super().__init__()
        self._empty = empty
        self.setModel(model)
        self._cells = Cells(self)
        self.setItemDelegate(self._cells)
        self.setSelectionBehavior(QAbstractItemView.SelectionBehavior.SelectRows)
        self.setSelectionMode(QAbstractItemView.SelectionMode.SingleSelection)
        self.setEditTriggers(QAbstractItemView.EditTrigger.NoEditTriggers)
        self.setVerticalScrollMode(QAbstractItemView.ScrollMode.ScrollPerPixel)
        self.setAlternatingRowColors(True)
        self.setShowGrid(False)
        self.setWordWrap(False)
        self.setTabKeyNavigation(False)
        self.setFrameShape(QTableView.Shape.NoFrame)
        self.horizontalHeader().setHighlightSections(False)
        self.horizontalHeader().setSectionsClickable(False)
        self.verticalHeader().hide()
        self.verticalHeader().setSectionResizeMode(QHeaderView.ResizeMode.Fixed)
        self.clicked.connect(self._choose)
        self.doubleClicked.connect(lambda index: self.opened.emit(index.row()))
        self.horizontalHeader().setTextElideMode(Qt.TextElideMode.ElideRight)
        self._fit_texts()

    def set_palette(self, palette: Palette) -> None:
        """Take the colours of a theme."""
        dress(self, palette)
        dress(self.viewport(), palette)  # under a style sheet it does not inherit
        self.horizontalHeader().setStyleSheet(_HEADER.format(panel=palette.panel, dim=palette.dim, rule=palette.rule))

    def select_rows(self, rows: Iterable[int]) -> None:
        """Show which rows are selected; tells nobody."""
        selection, last = QItemSelection(), self.model().columnCount() - 1
        for row in rows:
            selection.select(self.model().index(row, 0), self.model().index(row, last))
        self.selectionModel().select(selection, QItemSelectionModel.SelectionFlag.ClearAndSelect)

    def keyPressEvent(self, press: QKeyEvent) -> None:
        """Choose the row that a key leads to."""
        before = self.currentIndex().row()
        super().keyPressEvent(press)
        row = self.currentIndex().row()
        if row >= 0 and press.key() in (Qt.Key.Key_Return, Qt.Key.Key_Enter):
            self.opened.emit(row)
        elif row >= 0 and row != before:
            self.chosen.emit(row, bool(press.modifiers() & Qt.KeyboardModifier.ShiftModifier))

    def _choose(self, index: QModelIndex) -> None:
        self.chosen.emit(index.row(), bool(QApplication.keyboardModifiers() & _EXTENDS))

    def resizeEvent(self, change: QResizeEvent) -> None:
        """Tell who fits the columns."""
        super().resizeEvent(change)
        self.resized.emit()

    def changeEvent(self, change: QEvent) -> None:
        """Follow the font."""
        super().changeEvent(change)
        if change.type() == QEvent.Type.FontChange:
            self._fit_texts()
            self.resized.emit()

    def paintEvent(self, painting: QPaintEvent) -> None:
        """Draw the rows, or say that there are none."""
        super().paintEvent(painting)
        if not self.model().rowCount():
            painter = QPainter(self.viewport())
            painter.setFont(sized(self.font(), CAPTION))
            painter.setPen(self.palette().placeholderText().color())
            painter.drawText(self.viewport().rect(), Qt.AlignmentFlag.AlignCenter, self._empty)

    def minimumSizeHint(self) -> QSize:
        """The header and a row."""
        return QSize(super().minimumSizeHint().width(), round(2.75 * self.fontMetrics().height()))

    def width_of(self, *texts: str, bold: bool = False) -> int:
        """Width of a column in which any of the texts fits."""
        font = QFont(self.font())
        font.setBold(bold)
        letters = QFontMetrics(font)
        return max(letters.horizontalAdvance(text) for text in texts) + round(1.6 * letters.averageCharWidth())

    def _fit_texts(self) -> None:
        self._cells.set_font(self.font())
        self.verticalHeader().setDefaultSectionSize(round(1.45 * self.fontMetrics().height()))
        self.horizontalHeader().setFont(sized(self.font(), CAPTION))
