"""A box to choose from a long list under headings: by mouse, arrows, or the first letters while it is open."""

from collections.abc import Iterable

import attrs
from PySide6.QtCore import QModelIndex, QPersistentModelIndex, QSize, Qt, Signal
from PySide6.QtGui import QFont
from PySide6.QtWidgets import QComboBox, QStyledItemDelegate, QStyleOptionViewItem, QWidget

from hullquad.metrics import Metric
from hullquad_app.metric_words import meaning
from hullquad_app.panels.figures import CAPTION, sized

_IS_HEADING = Qt.ItemDataRole.UserRole + 1
_MOST_VISIBLE = 40

Index = QModelIndex | QPersistentModelIndex


@attrs.frozen
class Choice:
    """One row of the list."""

    heading: str
    """Of the group that it belongs to; empty: of none."""
    title: str
    data: str | None
    tip: str = ""


class _Rows(QStyledItemDelegate):
    """Headings are small and bold, what is below them is indented."""

    def initStyleOption(self, option: QStyleOptionViewItem, index: Index) -> None:
        """Take the font of a heading."""
        super().initStyleOption(option, index)
        if index.data(_IS_HEADING):
            option.font = sized(option.font, CAPTION)
            option.font.setWeight(QFont.Weight.DemiBold)
        else:
            option.text = f"\N{EM SPACE}{option.text}"

    def sizeHint(self, option: QStyleOptionViewItem, index: Index) -> QSize:
        """A little air between rows, more above headings."""
        size, air = super().sizeHint(option, index), option.fontMetrics.height() // 4
        return size + QSize(2 * air, 3 * air if index.data(_IS_HEADING) and index.row() else air)


class GroupedBox(QComboBox):
    """Tells by `chosen` what is wanted; `show_choice` tells it what is in force.

    Parameters
    ----------
    letters
        Width of the box; 0: as wide as its longest row.
    """

    chosen = Signal(object)
    """Emitted with the data of the row that the user chose."""

    def __init__(self, letters: int = 0, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        if letters:
            narrow(self)
            self.set_letters(letters)
        self.setItemDelegate(_Rows(self))
        self.setMaxVisibleItems(_MOST_VISIBLE)
        self.activated.connect(lambda row: self.chosen.emit(self.itemData(row)))

    def set_letters(self, letters: int) -> None:
        """Take another width."""
        self.setMinimumContentsLength(letters)
        self.setMinimumWidth(self.sizeHint().width())  # Qt keeps the hint of the length before

    def fill(self, choices: Iterable[Choice]) -> None:
        """List these choices instead of those that were there."""
        before, heading = self.currentData(), ""
        self.clear()
        for choice in choices:
            if choice.heading != heading:
                heading = choice.heading
                self._add_heading(heading)
            self.addItem(choice.title, choice.data)
            self.setItemData(self.count() - 1, choice.tip or None, Qt.ItemDataRole.ToolTipRole)
        self.show_choice(before)

    def show_choice(self, data: str | None) -> None:
        """Show what is in force."""
        rows = (row for row in range(self.count()) if not self.itemData(row, _IS_HEADING))
        self.setCurrentIndex(next((row for row in rows if self.itemData(row) == data), -1))

    def showPopup(self) -> None:
        """Open the list, as wide as its longest row."""
        room = self.view().verticalScrollBar().sizeHint().width() + 2 * self.fontMetrics().averageCharWidth()
        self.view().setMinimumWidth(self.view().sizeHintForColumn(0) + room)
        super().showPopup()

    def _add_heading(self, text: str) -> None:
        self.addItem(text)
        row = self.count() - 1
        self.setItemData(row, True, _IS_HEADING)
        self.setItemData(row, 0, Qt.ItemDataRole.UserRole - 1)  # flags of QStandardItem: neither chosen nor enabled


def narrow(box: QComboBox, letters: int = 8) -> None:
    """Have a box need no more width than for so many letters; it takes what there is."""
    box.setSizeAdjustPolicy(QComboBox.SizeAdjustPolicy.AdjustToMinimumContentsLengthWithIcon)
    box.setMinimumContentsLength(letters)


def metric_choices(metrics: Iterable[Metric]) -> list[Choice]:
    """Metrics under the headings of their groups."""
    return [Choice(row.group, row.title, row.key, meaning(row)) for row in metrics]
