"""The menu of files that were opened lately."""

from functools import partial
from pathlib import Path

from PySide6.QtWidgets import QMenu, QWidget

from hullquad_app.filing import Filing
from hullquad_app.settings import Settings


class RecentFiles(QMenu):
    """Lists them when it is opened, the last one first."""

    def __init__(self, settings: Settings, filing: Filing, parent: QWidget) -> None:
        super().__init__(parent)
        self.setTitle(self.tr("Open &recent"))
        self._settings, self._filing = settings, filing
        self.aboutToShow.connect(self._list)

    def _list(self) -> None:
        self.clear()
        for path in self._settings.recent:
            row = self.addAction(_shown(path))
            row.setToolTip(str(path))
            row.triggered.connect(partial(self._open, path))
        if self.isEmpty():
            self.addAction(self.tr("none yet")).setEnabled(False)

    def _open(self, path: Path, _checked: bool = False) -> None:
        self._filing.open(path)


def _shown(path: Path) -> str:
    """Name and folder of a file; an ampersand is one, and no key."""
    return f"{path.name}  ({path.parent.name})".replace("&", "&&")
