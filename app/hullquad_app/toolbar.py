"""What is chosen at the top of the window: plate, rules, metric and limit."""

from PySide6.QtCore import Signal
from PySide6.QtWidgets import QHBoxLayout, QLabel, QSizePolicy, QWidget

from hullquad.metrics import METRICS
from hullquad_app.colours import Palette
from hullquad_app.grouped_box import GroupedBox, metric_choices
from hullquad_app.limit_boxes import LimitBoxes
from hullquad_app.metric_words import meaning
from hullquad_app.panels.ground import frame
from hullquad_app.plate_box import PlateBox
from hullquad_app.rules_box import RulesBox
from hullquad_app.scene import Scene

_LETTERS = 10
"""Width of the boxes of rules and metrics; the whole title is in their tooltips."""
_SQUEEZED = 6
"""The same in a narrow window."""


class Choices(QWidget):
    """Boxes that show what a scene is looked at by, and tell what the user wants instead."""

    plate_chosen = Signal(str)
    metric_chosen = Signal(object)
    """Emitted with the key of a metric."""
    limit_moved = Signal(int, float)
    """Number of a limit (of two 0 is the lower one), and its value."""
    limit_reset = Signal()
    rules_chosen = Signal(str)
    """Emitted with the name of a rule set, or nothing for the metric."""
    rules_file_wanted = Signal()

    def __init__(self) -> None:
        super().__init__()
        self._shown: Scene | None = None
        self._labels: list[QLabel] = []
        self.plates, self.rules = PlateBox(), RulesBox(_LETTERS)
        self.metrics, self.limits = GroupedBox(_LETTERS), LimitBoxes()
        self.metrics.fill(metric_choices(METRICS))
        self.setSizePolicy(QSizePolicy.Policy.Expanding, QSizePolicy.Policy.Preferred)
        self._lay_out()
        self.plates.chosen.connect(self.plate_chosen)
        self.metrics.chosen.connect(self.metric_chosen)
        self.rules.picked.connect(self.rules_chosen)
        self.rules.file_wanted.connect(self.rules_file_wanted)
        self.limits.moved.connect(self.limit_moved)
        self.limits.reset_wanted.connect(self.limit_reset)

    def show_scene(self, scene: Scene) -> None:
        """Show what a scene is looked at by."""
        before, self._shown = self._shown, scene
        self.plates.show_scene(scene)
        if before is None or scene.view.rules is not before.view.rules:
            self.rules.show_scene(scene)
        if before is None or scene.view.metric is not before.view.metric:
            self.metrics.show_choice(scene.view.metric.key)
            self.metrics.setToolTip(meaning(scene.view.metric))
        if before is None or scene.view.metric is not before.view.metric or scene.band != before.band:
            self.limits.show_limits(scene.view.metric, scene.band)

    def squeeze(self, wanted: bool) -> None:
        """Leave out whatever can be done without; names are in the tooltips."""
        for label in self._labels:
            label.setVisible(not wanted)
        for box in (self.rules, self.metrics):
            box.set_letters(_SQUEEZED if wanted else _LETTERS)
        self.limits.squeeze(wanted)

    def set_palette(self, palette: Palette) -> None:
        """Take the colours of a theme."""
        self.limits.set_palette(palette)
        frame(self, palette)

    def _lay_out(self) -> None:
        row = QHBoxLayout(self)
        row.setContentsMargins(0, 0, 0, 0)
        row.setSpacing(self.fontMetrics().averageCharWidth() // 2)
        for text, name, box in (
            (self.tr("Plate"), self.tr("Plate that is shown"), self.plates),
            (self.tr("Judge by"), self.tr("What elements are judged and coloured by"), self.rules),
            (self.tr("Metric"), self.tr("Metric that colours the elements and is optimised"), self.metrics),
            (self.tr("Limit"), self.tr("Where quads begin to fail"), self.limits),
        ):
            label = QLabel(text)
            self._labels.append(label)
            label.setBuddy(box)
            box.setAccessibleName(name)
            box.setToolTip(name)
            row.addWidget(label)
            row.addWidget(box, stretch=box is self.plates)
            row.addSpacing(self.fontMetrics().averageCharWidth())
        row.addStretch()
