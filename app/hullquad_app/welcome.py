"""What an empty window shows: how to open a document, and the sample plates as pictures."""

from pathlib import Path

from PySide6.QtCore import QSize, Qt, Signal
from PySide6.QtGui import QFont, QIcon
from PySide6.QtWidgets import QLabel, QListView, QListWidget, QListWidgetItem, QVBoxLayout, QWidget

from hullquad_app.assets import Sample, samples

_PATH = Qt.ItemDataRole.UserRole
_PICTURE = QSize(208, 130)
_LINES = 3
"""Of text below a picture."""


class Welcome(QWidget):
    """The sample plates; a double click or Enter chooses one."""

    chosen = Signal(Path)

    def __init__(self) -> None:
        super().__init__()
        title = QLabel(self.tr("Open a plate"))
        font = title.font()
        font.setPointSizeF(font.pointSizeF() * 1.5)
        font.setWeight(QFont.Weight.DemiBold)
        title.setFont(font)
        hint = QLabel(
            self.tr("Drop a plate document (.json) or a mesh (.vtu) here, press Ctrl+O, or double-click a sample.")
        )
        hint.setWordWrap(True)
        self.gallery = _gallery(self.fontMetrics().lineSpacing())
        self.gallery.setAccessibleName(self.tr("Sample plates"))
        self.gallery.itemActivated.connect(lambda item: self.chosen.emit(item.data(_PATH)))
        for sample in samples():
            self.gallery.addItem(self._item(sample))
        self.gallery.setCurrentRow(0)
        column = QVBoxLayout(self)
        margin = self.fontMetrics().height()
        column.setContentsMargins(2 * margin, 2 * margin, margin, 0)
        column.addWidget(title)
        column.addWidget(hint)
        column.addSpacing(margin)
        column.addWidget(self.gallery)

    def _item(self, sample: Sample) -> QListWidgetItem:
        name = sample.name.replace("_", " ").capitalize()
        several = self.tr("{name}: {count} plates").format(name=name, count=len(sample.titles))
        title = sample.titles[0] if len(sample.titles) == 1 else several
        curved = self.tr("{title} (curved: not meshed yet)")
        picture = QIcon(str(sample.path.with_suffix(".png")))  # read when it is painted
        item = QListWidgetItem(picture, curved.format(title=title) if sample.is_curved else title)
        item.setData(_PATH, sample.path)
        item.setToolTip(sample.path.name)
        item.setTextAlignment(Qt.AlignmentFlag.AlignHCenter | Qt.AlignmentFlag.AlignTop)
        return item


def _gallery(line: int) -> QListWidget:
    made = QListWidget()
    made.setViewMode(QListView.ViewMode.IconMode)
    made.setResizeMode(QListView.ResizeMode.Adjust)
    made.setMovement(QListView.Movement.Static)
    made.setUniformItemSizes(True)
    made.setWordWrap(True)
    made.setTextElideMode(Qt.TextElideMode.ElideRight)
    made.setIconSize(_PICTURE)
    made.setGridSize(QSize(_PICTURE.width() + 2 * line, _PICTURE.height() + (_LINES + 1) * line))
    made.setFrameShape(QListWidget.Shape.NoFrame)
    made.setAutoFillBackground(False)
    made.viewport().setAutoFillBackground(False)
    return made
