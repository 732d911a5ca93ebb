"""What will not be good in the mesh of a plate, as a list whose rows show their places."""

from collections.abc import Sequence

from PySide6.QtCore import QSize, Qt, Signal
from PySide6.QtGui import QResizeEvent
from PySide6.QtWidgets import QAbstractItemView, QListView, QListWidget, QListWidgetItem, QSizePolicy

from hullquad.plate import Notice
from hullquad_app.panels.explained import explain

_LINES = 7
"""Height that it has at most, in lines of text."""


class NoticeList(QListWidget):
    """One row for each notice; hidden where there is none."""

    place_wanted = Signal(object)
    """Emitted with a `Notice`, when its place is to be shown."""

    def __init__(self) -> None:
        super().__init__()
        self.setWordWrap(True)
        self.setResizeMode(QListView.ResizeMode.Adjust)
        self.setSizePolicy(QSizePolicy.Policy.Ignored, QSizePolicy.Policy.Fixed)
        self.setVerticalScrollMode(QAbstractItemView.ScrollMode.ScrollPerPixel)
        self.setHorizontalScrollBarPolicy(Qt.ScrollBarPolicy.ScrollBarAlwaysOff)
        explain(self, self.tr("What to look at"), self.tr("A click shows on the plate where it is."))
        self.itemClicked.connect(self._want)
        self.itemActivated.connect(self._want)
        self.hide()

    def show_notices(self, notices: Sequence[Notice]) -> None:
        """List them in their order."""
        self.clear()
        for notice in notices:
            row = QListWidgetItem(notice.text[:1].upper() + notice.text[1:])
            row.setData(Qt.ItemDataRole.UserRole, notice)
            row.setToolTip(self.tr("{code} at {place}").format(code=notice.code, place=notice.place))
            self.addItem(row)
        self.setVisible(bool(notices))
        self.updateGeometry()

    def sizeHint(self) -> QSize:
        """As high as its rows, up to some lines of text."""
        rows = sum(self.sizeHintForRow(row) for row in range(self.count()))
        most = _LINES * self.fontMetrics().lineSpacing()
        return QSize(super().sizeHint().width(), min(rows, most) + 2 * self.frameWidth())

    def resizeEvent(self, resize: QResizeEvent) -> None:
        """Rows that are broken otherwise have another height."""
        super().resizeEvent(resize)
        if resize.oldSize().width() != resize.size().width():
            self.updateGeometry()

    def _want(self, row: QListWidgetItem) -> None:
        self.place_wanted.emit(row.data(Qt.ItemDataRole.UserRole))
