"""The main window: arranges what the program shows, nothing else."""

from pathlib import Path

from PySide6.QtCore import Qt
from PySide6.QtGui import QDragEnterEvent, QDropEvent
from PySide6.QtWidgets import QDockWidget, QFileDialog, QMainWindow, QMessageBox, QVBoxLayout, QWidget

from hullquad import __version__
from hullquad.errors import HullquadError
from hullquad.formats import FORMATS, read_plates
from hullquad_app.actions import fill_menus
from hullquad_app.message_bar import MessageBar
from hullquad_app.panels.plates import PlatesPanel
from hullquad_app.welcome import Welcome


class MainWindow(QMainWindow):
    """Menus, the message bar, the sample plates, and the plates of the document that is open."""

    def __init__(self) -> None:
        super().__init__()
        self.setWindowTitle(self.tr("HullQuad"))
        self.setAcceptDrops(True)
        fill_menus(self)
        self.messages = MessageBar()
        self.welcome = Welcome()
        self.welcome.chosen.connect(self.open)
        self.plates = PlatesPanel()
        self._arrange()

    def open(self, path: Path) -> None:
        """Open a plate document; what is wrong with it is said in the message bar."""
        try:
            document = read_plates(path)
        except HullquadError as error:
            self.messages.say(str(error))
            return
        self.messages.hide()
        self.plates.show_document(document)
        self.setWindowTitle(self.tr("{name} - HullQuad").format(name=document.name))

    def choose_file(self) -> None:
        """Ask for a document and open it."""
        kinds = [f"{kind.title} (*{kind.suffix})" for kind in FORMATS if kind.read_plates]
        name, _ = QFileDialog.getOpenFileName(self, self.tr("Open"), "", ";;".join(kinds))
        if name:
            self.open(Path(name))

    def about(self) -> None:
        """Say what this program is."""
        text = self.tr("HullQuad {version}\n\nQuadrilateral meshes of ship hull plates: made, judged and improved.")
        QMessageBox.about(self, self.tr("About HullQuad"), text.format(version=__version__))

    def dragEnterEvent(self, event: QDragEnterEvent) -> None:
        """Take files."""
        if _dropped(event):
            event.acceptProposedAction()

    def dropEvent(self, event: QDropEvent) -> None:
        """Open the first of the files."""
        event.acceptProposedAction()
        self.open(_dropped(event)[0])

    def _arrange(self) -> None:
        centre = QWidget()
        column = QVBoxLayout(centre)
        column.addWidget(self.messages)
        column.addWidget(self.welcome)
        self.setCentralWidget(centre)
        dock = QDockWidget(self.tr("Plates"))
        dock.setObjectName("plates")
        dock.setWidget(self.plates)
        self.addDockWidget(Qt.DockWidgetArea.RightDockWidgetArea, dock)
        letter = self.fontMetrics()
        self.resize(letter.averageCharWidth() * 220, letter.height() * 55)
        self.resizeDocks([dock], [letter.averageCharWidth() * 80], Qt.Orientation.Horizontal)


def _dropped(event: QDropEvent) -> list[Path]:
    return [Path(url.toLocalFile()) for url in event.mimeData().urls() if url.isLocalFile()]
