"""Which theme: the system's, light or dark."""

from PySide6.QtCore import Signal
from PySide6.QtGui import QActionGroup
from PySide6.QtWidgets import QMenu, QWidget

from hullquad_app.colours import Theme


class ThemeMenu(QMenu):
    """The themes there are; one of them is chosen."""

    picked = Signal(object)
    """Emitted with the `Theme` that the user wants."""

    def __init__(self, parent: QWidget) -> None:
        super().__init__(parent)
        self.setTitle(self.tr("&Theme"))
        titles = {
            Theme.SYSTEM: self.tr("As the &system has it"),
            Theme.LIGHT: self.tr("&Light"),
            Theme.DARK: self.tr("&Dark"),
        }
        choices = QActionGroup(self)
        self._rows = {theme: choices.addAction(title) for theme, title in titles.items()}
        for theme, row in self._rows.items():
            row.setCheckable(True)
            row.setData(theme)
            self.addAction(row)
        choices.triggered.connect(lambda row: self.picked.emit(Theme(row.data())))

    def show_choice(self, chosen: Theme) -> None:
        """Mark the theme that is in force."""
        self._rows[chosen].setChecked(True)
