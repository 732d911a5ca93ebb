"""What an empty window shows: how to open a document, and the sample plates."""

from pathlib import Path

from PySide6.QtCore import QModelIndex, Qt, Signal
from PySide6.QtWidgets import QHeaderView, QLabel, QTreeWidget, QTreeWidgetItem, QVBoxLayout, QWidget

from hullquad_app.assets import Sample, samples

_PATH = Qt.ItemDataRole.UserRole


class Welcome(QWidget):
    """The sample plates by title and file name; a double click or Enter chooses one."""

    chosen = Signal(Path)

    def __init__(self) -> None:
        super().__init__()
        hint = QLabel(self.tr("Drop a plate document here, open one from the File menu, or choose a sample:"))
        hint.setWordWrap(True)
        self.table = QTreeWidget()
        self.table.setHeaderLabels([self.tr("Plate"), self.tr("File")])
        self.table.setRootIsDecorated(False)
        self.table.addTopLevelItems([self._row(sample) for sample in samples()])
        self.table.header().setSectionResizeMode(0, QHeaderView.ResizeMode.ResizeToContents)
        self.table.activated.connect(self._choose)
        layout = QVBoxLayout(self)
        layout.addWidget(hint)
        layout.addWidget(self.table)

    def _row(self, sample: Sample) -> QTreeWidgetItem:
        several = self.tr("{name}: {count} plates").format(name=sample.name, count=len(sample.titles))
        row = QTreeWidgetItem([sample.titles[0] if len(sample.titles) == 1 else several, sample.path.name])
        row.setData(0, _PATH, sample.path)
        return row

    def _choose(self, index: QModelIndex) -> None:
        self.chosen.emit(index.siblingAtColumn(0).data(_PATH))
