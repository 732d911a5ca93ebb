"""By what elements are judged: the metric, or a rule set of a class society, a solver or the user's."""

from collections.abc import Callable
from pathlib import Path

from PySide6.QtCore import Signal

from hullquad_app.grouped_box import Choice, GroupedBox
from hullquad_app.rule_words import about
from hullquad_app.scene import Scene

METRIC, OTHER = "", "…"
"""Data of the rows that are no rule sets."""
_SOLVERS = ("msc_nastran", "autodesk_nastran", "optistruct", "ansys", "abaqus")
_PAPER = "table_1"


class RulesBox(GroupedBox):
    """Lists the rule sets when it is opened; what is in force is told by the scene alone."""

    picked = Signal(str)
    """Emitted with the name of a rule set, that of a file, or nothing for the metric."""
    file_wanted = Signal()
    """Another file is to be read."""

    def __init__(self, letters: int = 0) -> None:
        super().__init__(letters)
        self._key = METRIC
        self._listed: list[Path] | None = None
        """Files in the list; None until it is complete."""
        self._files: Callable[[], list[Path]] = list
        self.fill([self._by_metric()])
        self.chosen.connect(self._choose)

    def show_scene(self, scene: Scene) -> None:
        """Show by what a scene is judged."""
        rules = scene.view.rules
        self._key = METRIC if rules is None else rules.key
        if rules is not None and self.findData(rules.key) < 0:
            self._listed = None
            self.fill([self._by_metric(), Choice("", rules.title, rules.key)])
        self.show_choice(self._key)
        self.setToolTip(self.tr("Elements are judged by the metric and its limit") if rules is None else about(rules))

    def offer(self, files: Callable[[], list[Path]]) -> None:
        """Offer files of the user's, too: those that there are when the list is opened."""
        self._files, self._listed = files, None

    def complete(self) -> None:
        """List all that can be chosen."""
        if self._listed != (files := self._files()):
            self._listed = files
            self.fill([self._by_metric(), *self._built_in(), *self._own(files)])
            self.show_choice(self._key)

    def showPopup(self) -> None:
        """Open the list."""
        self.complete()
        super().showPopup()

    def _choose(self, data: str) -> None:
        self.show_choice(self._key)  # until the document agrees
        if data == OTHER:
            self.file_wanted.emit()
        else:
            self.picked.emit(data)

    def _by_metric(self) -> Choice:
        return Choice("", self.tr("Metric and limit"), METRIC, self.tr("Every element by the chosen metric"))

    def _built_in(self) -> list[Choice]:
        from hullquad.rules import rule_sets  # noqa: PLC0415  an empty window does not wait for it

        societies, solvers = self.tr("Class societies"), self.tr("Solvers")
        headings = {_PAPER: self.tr("The paper"), **dict.fromkeys(_SOLVERS, solvers)}
        listed = [Choice(headings.get(row.key, societies), row.title, row.key, about(row)) for row in rule_sets()]
        order = [self.tr("The paper"), societies, solvers]
        return sorted(listed, key=lambda choice: order.index(choice.heading))

    def _own(self, files: list[Path]) -> list[Choice]:
        heading = self.tr("Own files")
        known = [Choice(heading, path.stem, str(path), str(path)) for path in files]
        other = Choice(heading, self.tr("Other…"), OTHER, self.tr("Read a file of rules (hullquad rules, JSON)"))
        return [*known, other]
