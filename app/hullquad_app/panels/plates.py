"""The plates of the open document."""

from PySide6.QtCore import Qt
from PySide6.QtWidgets import QHeaderView, QTreeWidget, QTreeWidgetItem

from hullquad.plate import Document, Plate

_TITLE, _NUMBERS = 1, (2, 4)
_RIGHT = Qt.AlignmentFlag.AlignRight | Qt.AlignmentFlag.AlignVCenter


class PlatesPanel(QTreeWidget):
    """A row for each plate: id, title, thickness, material, target size."""

    def __init__(self) -> None:
        super().__init__()
        self.setRootIsDecorated(False)
        columns = [self.tr("Plate"), self.tr("Title"), self.tr("t [mm]"), self.tr("Material"), self.tr("Size [mm]")]
        self.setHeaderLabels(columns)
        self.header().setStretchLastSection(False)
        self.header().setSectionResizeMode(QHeaderView.ResizeMode.ResizeToContents)
        self.header().setSectionResizeMode(_TITLE, QHeaderView.ResizeMode.Stretch)

    def show_document(self, document: Document) -> None:
        """List the plates of another document."""
        self.clear()
        self.addTopLevelItems([_row(plate) for plate in document.plates])


def _row(plate: Plate) -> QTreeWidgetItem:
    row = QTreeWidgetItem([plate.id, plate.title, f"{plate.thickness:g}", plate.material, f"{plate.target_size:g}"])
    row.setToolTip(_TITLE, plate.title)
    for column in _NUMBERS:
        row.setTextAlignment(column, _RIGHT)
    return row
