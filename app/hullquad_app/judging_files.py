"""Files of rules and of criteria: asks which, and has the session read or write them."""

from pathlib import Path

from PySide6.QtCore import QObject
from PySide6.QtWidgets import QFileDialog, QWidget

from hullquad_app.judging import Judging

_CRITERIA = "criteria.json"


class JudgingFiles(QObject):
    """What the Quality menu and the chooser of rules do with files."""

    def __init__(self, judging: Judging, window: QWidget) -> None:
        super().__init__(window)
        self._judging, self._window = judging, window

    def choose_rules(self) -> None:
        """Ask for a file of rules, and judge by it."""
        if path := self._asked(self.tr("Judge by rules in a file"), self.tr("Rules (*.json)")):
            self._judging.judge_by(str(path.absolute()))

    def load_criteria(self) -> None:
        """Ask for a file of criteria, and take its limits."""
        if path := self._asked(self.tr("Load criteria"), self.tr("Criteria (*.json)")):
            self._judging.read_criteria(path)

    def save_criteria(self) -> None:
        """Ask for a file, and put the limits of all metrics into it."""
        kinds = self.tr("Criteria (*.json)")
        name, _ = QFileDialog.getSaveFileName(self._window, self.tr("Save criteria"), _CRITERIA, kinds)
        if name:
            self._judging.write_criteria(Path(name) if Path(name).suffix else Path(name + ".json"))

    def _asked(self, title: str, kinds: str) -> Path | None:
        name, _ = QFileDialog.getOpenFileName(self._window, title, "", kinds)
        return Path(name) if name else None
