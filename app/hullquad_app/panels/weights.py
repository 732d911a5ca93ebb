"""Several metrics that are optimised together, each with its weight."""

from typing import Any

import attrs
from PySide6.QtCore import Signal
from PySide6.QtWidgets import QHBoxLayout, QPushButton, QToolButton, QVBoxLayout, QWidget

from hullquad.metrics import OBJECTIVES, metric
from hullquad.optimization.objective import Term
from hullquad_app.grouped_box import GroupedBox, metric_choices
from hullquad_app.panels.explained import explain
from hullquad_app.panels.scale_spin import ScaleSpin

_LETTERS = 8
_DIGITS = 10
_LEAST, _MOST = 1e-3, 1e3


class Weights(QWidget):
    """A row for each metric; says by `changed` what is wanted, `show_terms` tells it what is used."""

    changed = Signal(object)
    """Emitted with the tuple of `Term`, when the user has changed it."""

    def __init__(self) -> None:
        super().__init__()
        self._terms: tuple[Term, ...] = ()
        self._rows: list[_Row] = []
        self.add = QPushButton(self.tr("Add a metric"))
        self.add.setAutoDefault(False)
        explain(self.add, self.tr("Add a metric to the objective"), self.tr("Optimise by one more metric"))
        self.add.clicked.connect(self._add)
        self._column = QVBoxLayout(self)
        self._column.setContentsMargins(0, 0, 0, 0)
        self._column.addWidget(self.add)

    @property
    def rows(self) -> tuple["_Row", ...]:
        """The rows, from the first metric on."""
        return tuple(self._rows)

    def show_terms(self, terms: tuple[Term, ...]) -> None:
        """Show the metrics and their weights."""
        self._terms = terms
        while len(self._rows) < len(terms):
            self._put(_Row())
        for row in self._rows[len(terms) :]:
            row.hide()
            row.deleteLater()
        del self._rows[len(terms) :]
        for row, term in zip(self._rows, terms, strict=True):
            row.show_term(term, can_go=len(terms) > 1)
        self.add.setEnabled(len(terms) < len(OBJECTIVES))

    def _put(self, row: "_Row") -> None:
        self._rows.append(row)
        self._column.insertWidget(len(self._rows) - 1, row)
        row.by.chosen.connect(lambda key: self._change(row, metric=metric(key)))
        row.weight.valueChanged.connect(lambda value: self._change(row, weight=value))
        row.remove.clicked.connect(lambda: self._remove(row))

    def _change(self, row: "_Row", **changes: Any) -> None:
        terms = list(self._terms)
        at = self._rows.index(row)
        terms[at] = attrs.evolve(terms[at], **changes)
        self._want(terms)

    def _remove(self, row: "_Row") -> None:
        at = self._rows.index(row)
        self._want([*self._terms[:at], *self._terms[at + 1 :]])

    def _add(self) -> None:
        used = {term.metric.key for term in self._terms}
        self._want([*self._terms, Term(next(row for row in OBJECTIVES if row.key not in used))])

    def _want(self, terms: list[Term]) -> None:
        self.show_terms(tuple(terms))
        self.changed.emit(self._terms)


class _Row(QWidget):
    """Metric, weight, and a button that takes them away."""

    def __init__(self) -> None:
        super().__init__()
        self.by, self.weight, self.remove = GroupedBox(_LETTERS), ScaleSpin(_LEAST, _MOST), QToolButton()
        self.by.fill(metric_choices(OBJECTIVES))
        self.weight.setFixedWidth(self.fontMetrics().averageCharWidth() * _DIGITS)
        self.remove.setText("×")
        self.remove.setAutoRaise(True)
        explain(self.by, self.tr("Metric of the objective"), self.tr("Optimise by this metric, among others"))
        explain(
            self.weight,
            self.tr("Weight of the metric"),
            self.tr("How much it counts: what it gains from its limit to its ideal is worth so much"),
        )
        explain(self.remove, self.tr("Remove the metric from the objective"), self.tr("Optimise without it"))
        line = QHBoxLayout(self)
        line.setContentsMargins(0, 0, 0, 0)
        for widget, stretch in ((self.by, 1), (self.weight, 0), (self.remove, 0)):
            line.addWidget(widget, stretch=stretch)

    def show_term(self, term: Term, *, can_go: bool) -> None:
        """Show a term."""
        self.by.show_choice(term.metric.key)
        self.weight.blockSignals(True)
        self.weight.setValue(term.weight)
        self.weight.blockSignals(False)
        self.remove.setEnabled(can_go)
