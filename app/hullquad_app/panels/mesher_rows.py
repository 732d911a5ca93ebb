"""Which mesher, and its options: rows of a form."""

from contextlib import ExitStack
from typing import Any

import attrs
from PySide6.QtCore import QObject, QSignalBlocker, Signal
from PySide6.QtWidgets import QCheckBox, QComboBox, QDoubleSpinBox, QFormLayout, QHBoxLayout, QLabel

from hullquad.quads.settings import LARGEST_GRADING, LEAST_GRADING, Preference
from hullquad_app.grouped_box import narrow
from hullquad_app.mesher import BEST, PAPER, Mesher
from hullquad_app.panels.explained import explain

_STEP = 0.05
"""Width that a box has at least."""


class MesherRows(QObject):
    """Boxes for all that a `Mesher` says; the paper's mesher has no options but the lines."""

    changed = Signal(object)
    """Emitted with a `Mesher`, when the user has changed it."""

    def __init__(self) -> None:
        super().__init__()
        self._mesher, self._form, self._options = Mesher(), QFormLayout(), QHBoxLayout()
        self.names, self.preferences = QComboBox(), QComboBox()
        self.grading = QDoubleSpinBox(minimum=LEAST_GRADING, maximum=LARGEST_GRADING, singleStep=_STEP)
        self.grading.setKeyboardTracking(False)
        self.lines = QCheckBox(self.tr("Fo&llow stiffeners and seams"))
        self.names.addItem(self.tr("best: no avoidable triangle"), BEST)
        self.names.addItem(self.tr("paper: Delaunay, advancing front"), PAPER)
        self.preferences.addItem(self.tr("fewest triangles"), Preference.QUADS.value)
        self.preferences.addItem(self.tr("best worst element"), Preference.QUALITY.value)
        for box in (self.names, self.preferences):
            narrow(box)
        self._explain()
        self.names.activated.connect(lambda: self._change(name=self.names.currentData()))
        self.preferences.activated.connect(lambda: self._change(prefer=self.preferences.currentData()))
        self.lines.clicked.connect(lambda checked: self._change(follows_lines=checked))
        self.grading.valueChanged.connect(lambda value: self._change(grading=round(value, 2)))

    @property
    def mesher(self) -> Mesher:
        """How plates are meshed."""
        return self._mesher

    def add_to(self, form: QFormLayout) -> None:
        """Put the boxes into a form."""
        self._form = form
        form.addRow(self.tr("M&esher"), self.names)
        grading = QLabel(self.tr("&Grading"))
        grading.setBuddy(self.grading)
        self._options.addWidget(self.preferences, stretch=1)
        self._options.addWidget(grading)
        self._options.addWidget(self.grading)
        prefer = QLabel(self.tr("P&refer"))
        prefer.setBuddy(self.preferences)
        form.addRow(prefer, self._options)
        form.addRow("", self.lines)
        self.show_mesher(self._mesher)

    def show_mesher(self, mesher: Mesher) -> None:
        """Show how plates are meshed."""
        self._mesher = mesher
        with ExitStack() as quiet:
            for box in (self.names, self.preferences, self.grading):
                quiet.enter_context(QSignalBlocker(box))
            self.names.setCurrentIndex(self.names.findData(mesher.name))
            self.preferences.setCurrentIndex(self.preferences.findData(mesher.prefer))
            self.grading.setValue(mesher.grading)
        self.lines.setChecked(mesher.follows_lines)
        if self._options.count():
            self._form.setRowVisible(self._options, mesher.name == BEST)

    def _change(self, **changes: Any) -> None:
        self.show_mesher(attrs.evolve(self._mesher, **changes))
        self.changed.emit(self._mesher)

    def _explain(self) -> None:
        explain(
            self.lines,
            self.tr("Follow stiffeners and seams"),
            self.tr("Elements have edges along stiffeners and seams; else there are only nodes at their ends."),
        )
        explain(
            self.names,
            self.tr("Mesher"),
            self.tr("The best one tries several ways and repairs what is left; the paper's is there to compare."),
        )
        explain(
            self.preferences,
            self.tr("What matters most"),
            self.tr("Where one mesh cannot have both: no triangle that can be avoided, or the best worst element."),
        )
        explain(
            self.grading,
            self.tr("Grading"),
            self.tr("How quickly elements may grow away from short edges: less makes more and better elements."),
        )
