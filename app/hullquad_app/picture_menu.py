"""How large pictures are, and on what ground."""

from PySide6.QtGui import QAction, QActionGroup
from PySide6.QtWidgets import QMenu, QWidget

_SCALES = {1: "1600 × 1000", 2: "3200 × 2000", 3: "4800 × 3000", 4: "6400 × 4000"}


class PictureMenu(QMenu):
    """The choices for pictures of the plate."""

    def __init__(self, parent: QWidget) -> None:
        super().__init__(parent)
        self.setTitle(self.tr("Picture si&ze"))
        self._scales = QActionGroup(self)
        for scale, pixels in _SCALES.items():
            choice = self._scales.addAction(self.tr("{scale}×: {pixels} pixels").format(scale=scale, pixels=pixels))
            choice.setCheckable(True)
            choice.setData(scale)
            self.addAction(choice)
        self._scales.actions()[1].setChecked(True)
        self.addSeparator()
        self._transparent = QAction(self.tr("&Transparent ground"), self)
        self._transparent.setCheckable(True)
        self.addAction(self._transparent)

    @property
    def scale(self) -> int:
        """How many times 1600 by 1000 pixels."""
        return int(self._scales.checkedAction().data())

    @property
    def is_transparent(self) -> bool:
        """Whether the ground is transparent instead of white."""
        return self._transparent.isChecked()
