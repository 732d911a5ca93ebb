"""The box in which one plate of a document is chosen."""

from PySide6.QtCore import Qt, Signal
from PySide6.QtWidgets import QComboBox, QSizePolicy

from hullquad_app.scene import Scene

_SHORTEST, _LONGEST = 8, 44
"""Letters of a plate's name that the box has room for at least and at most; the whole is in its tooltip."""


class PlateBox(QComboBox):
    """The plates by their titles; with one only there is nothing to choose."""

    chosen = Signal(str)
    """Emitted with the id of the plate that the user wants to see."""

    def __init__(self) -> None:
        super().__init__()
        self._shown = Scene()
        self.setSizeAdjustPolicy(QComboBox.SizeAdjustPolicy.AdjustToMinimumContentsLengthWithIcon)
        self.setMinimumContentsLength(_SHORTEST)
        self.setMaximumWidth(_LONGEST * self.fontMetrics().averageCharWidth())
        self.setSizePolicy(QSizePolicy.Policy.Expanding, QSizePolicy.Policy.Fixed)
        self.setEnabled(False)
        self.activated.connect(lambda row: self.chosen.emit(self.itemData(row)))

    def show_scene(self, scene: Scene) -> None:
        """Show which plate a scene shows."""
        before, self._shown = self._shown, scene
        if scene.state.keys != before.state.keys:
            self._list(scene)
        if scene.view.key != before.view.key:
            self.setCurrentIndex(self.findData(scene.view.key))

    def _list(self, scene: Scene) -> None:
        self.clear()
        for key in scene.state.keys:
            plate = scene.state.plate(key)
            title = plate.title if plate is not None and plate.title else key
            several = len(scene.state.keys) > 1 and title != key
            self.addItem(f"{key} · {title}" if several else title, key)
            self.setItemData(self.count() - 1, title, Qt.ItemDataRole.ToolTipRole)
        self.setEnabled(len(scene.state.keys) > 1)
        self.setCurrentIndex(self.findData(scene.view.key))
        self.setToolTip(self.currentText())
