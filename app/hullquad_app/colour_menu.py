"""By which map elements are coloured."""

from PySide6.QtCore import Signal
from PySide6.QtGui import QActionGroup
from PySide6.QtWidgets import QMenu, QWidget

from hullquad_app.colours import COLOUR_MAPS, ColourMap


class ColourMenu(QMenu):
    """The maps there are; one of them is chosen."""

    picked = Signal(object)
    """Emitted with the `ColourMap` that the user wants."""

    def __init__(self, parent: QWidget) -> None:
        super().__init__(parent)
        self.setTitle(self.tr("&Colours"))
        self._choices = QActionGroup(self)
        for row in COLOUR_MAPS:
            choice = self._choices.addAction(row.title)
            choice.setCheckable(True)
            choice.setData(row)
            self.addAction(choice)
        self._choices.actions()[0].setChecked(True)
        self._choices.triggered.connect(lambda choice: self.picked.emit(choice.data()))

    @property
    def chosen(self) -> ColourMap:
        """The map that is chosen."""
        chosen: ColourMap = self._choices.checkedAction().data()
        return chosen
