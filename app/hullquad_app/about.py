"""What the program says of itself: its keys, its version, and the licences it stands under."""

from collections.abc import Iterable

from PySide6.QtCore import QObject, Qt
from PySide6.QtGui import QAction, QKeySequence
from PySide6.QtWidgets import QMessageBox, QWidget

from hullquad import __version__

_LICENCES = (
    ("HullQuad", "MIT"),
    ("Triangle, by J. R. Shewchuk", "commercial distribution only by arrangement with its author"),
    ("Qt for Python", "LGPL 3"),
    ("VTK, PyVista, PyVistaQt", "BSD, MIT, MIT"),
    ("NumPy, SciPy, Numba", "BSD"),
    ("Shapely, GEOS", "BSD, LGPL 2.1"),
    ("attrs, Pillow", "MIT, MIT-CMU"),
)
"""Parts of the program and the terms each stands under."""


class About(QObject):
    """What the Help menu shows."""

    def __init__(self, window: QWidget) -> None:
        super().__init__(window)
        self._window = window

    def show_about(self) -> None:
        """Say what this program is."""
        rows = "".join(f"<tr><td>{part}&nbsp;&nbsp;</td><td>{terms}</td></tr>" for part, terms in _LICENCES)
        text = self.tr("Quadrilateral meshes of ship hull plates: made, judged and improved.")
        method = self.tr("Method: A. Kniat, Optimization of quadrilateral mesh for ship hull modelling.")
        words = f"<h3>HullQuad {__version__}</h3><p>{text}</p><p>{method}</p><table>{rows}</table>"
        self._tell(self.tr("About HullQuad"), words)

    def show_keys(self) -> None:
        """Say what the keys do."""
        self._tell(self.tr("Keys"), _table(self._window.findChildren(QAction)))

    def _tell(self, title: str, text: str) -> None:
        box = QMessageBox(QMessageBox.Icon.NoIcon, title, text, QMessageBox.StandardButton.Close, self._window)
        box.setTextFormat(Qt.TextFormat.RichText)
        box.setAttribute(Qt.WidgetAttribute.WA_DeleteOnClose)
        box.open()


def _table(actions: Iterable[QAction]) -> str:
    """Keys and what they do, as HTML."""
    native = QKeySequence.SequenceFormat.NativeText
    known = {action.shortcut().toString(native): action.statusTip() for action in actions}
    rows = (f"<tr><td><b>{key}</b>&nbsp;&nbsp;</td><td>{tip}</td></tr>" for key, tip in known.items() if key and tip)
    return f"<table>{''.join(rows)}</table>"
