"""The options of every optimiser but the paper's, in plain words."""

from contextlib import ExitStack
from typing import Any

import attrs
from PySide6.QtCore import QObject, QSignalBlocker, Signal
from PySide6.QtWidgets import QComboBox, QSpinBox, QWidget

from hullquad.optimizers import Optimizer
from hullquad_app.grouped_box import narrow
from hullquad_app.panels.explained import explain
from hullquad_app.plan import PAPER
from hullquad_app.rules_box import RulesBox
from hullquad_app.search import FLOORS, MOST_ITERATIONS, MOST_SECONDS, Search

_LETTERS = 8


class ModeOptions(QObject):
    """Controls for a form; says by `changed` what is wanted, `show_search` tells it what is used."""

    changed = Signal(object)
    """Emitted with a `Search`, when the user has changed it."""

    def __init__(self, parent: QWidget) -> None:
        super().__init__(parent)
        self._search = Search()
        self.floor = QComboBox()
        for words in (
            self.tr("0.3: none is sacrificed"),
            self.tr("0.6: all acceptable"),
            self.tr("off: the sum alone counts"),
        ):
            self.floor.addItem(words)
        narrow(self.floor)
        self.rules = RulesBox(_LETTERS)
        self.iterations = QSpinBox(minimum=1, maximum=MOST_ITERATIONS)
        self.seconds = QSpinBox(minimum=0, maximum=MOST_SECONDS, suffix=self.tr(" s"))
        self.seconds.setSpecialValueText(self.tr("as long as it takes"))
        for box in (self.iterations, self.seconds):
            box.setKeyboardTracking(False)
            box.setGroupSeparatorShown(True)
        self._explain()
        self.floor.activated.connect(lambda row: self._change(floor=FLOORS[row]))
        self.iterations.valueChanged.connect(lambda value: self._change(iterations=value))
        self.seconds.valueChanged.connect(lambda value: self._change(seconds=value))

    def rows(self) -> tuple[tuple[str, QWidget], ...]:
        """Rows of a form: what is written at the left, and the control."""
        return (
            (self.tr("R&ules to meet"), self.rules),
            (self.tr("Quality f&loor"), self.floor),
            (self.tr("Most &iterations"), self.iterations),
            (self.tr("Most &time"), self.seconds),
        )

    def of(self, row: Optimizer) -> tuple[QWidget, ...]:
        """The controls that an optimiser has."""
        if row.key == PAPER:
            return ()
        rules = (self.rules,) if row.has_rules else ()
        floor = (self.floor,) if row.has_floor else ()
        return (*rules, *floor, self.iterations, self.seconds)

    def show_search(self, search: Search) -> None:
        """Show the options that the next run uses."""
        self._search = search
        with ExitStack() as quiet:
            for widget in (self.floor, self.iterations, self.seconds):
                quiet.enter_context(QSignalBlocker(widget))
            self.floor.setCurrentIndex(FLOORS.index(search.floor))
            self.iterations.setValue(search.iterations)
            self.seconds.setValue(search.seconds)

    def _change(self, **changes: Any) -> None:
        self.show_search(attrs.evolve(self._search, **changes))
        self.changed.emit(self._search)

    def _explain(self) -> None:
        explain(
            self.rules,
            self.tr("Rules to meet"),
            self.tr("The rule set whose violations are to become fewest; elements are judged by it, too."),
        )
        explain(
            self.floor,
            self.tr("Quality floor"),
            self.tr(
                "No element is pushed below this scaled Jacobian for the sake of others. 0.6 makes every element "
                "acceptable where the contour allows it, and costs about 1 % of the sum; without a floor a few "
                "elements may be sacrificed to the sum."
            ),
        )
        explain(
            self.iterations,
            self.tr("Most iterations"),
            self.tr("The run ends after so many iterations, if nothing else ends it before."),
        )
        explain(
            self.seconds,
            self.tr("Most time"),
            self.tr("The run ends after so much time; pauses do not count. 0: as long as it takes."),
        )
