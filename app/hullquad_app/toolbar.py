"""What is chosen at the top of the window: plate, metric and limit."""

from PySide6.QtCore import QCoreApplication, QSignalBlocker, Qt, Signal
from PySide6.QtWidgets import QComboBox, QDoubleSpinBox, QHBoxLayout, QLabel, QSizePolicy, QWidget

from hullquad.metrics import DEGREES, METRICS, Metric
from hullquad_app.document import Scene

_LARGEST_LIMIT = 1e6
_LIMIT = 12
"""Width of the limit's box, in letters."""
_SHORTEST, _LONGEST = 10, 44
"""Letters of a plate's name that the box has room for at least and at most; the whole is in its tooltip."""


class Choices(QWidget):
    """Boxes that show what a scene is looked at by, and tell what the user wants instead."""

    plate_chosen = Signal(str)
    metric_chosen = Signal(str)
    limit_chosen = Signal(float)
    limit_reset = Signal()

    def __init__(self) -> None:
        super().__init__()
        self._shown = Scene()
        self.plates = QComboBox()
        self.metrics = QComboBox()
        self.limits = QDoubleSpinBox()
        self.setSizePolicy(QSizePolicy.Policy.Expanding, QSizePolicy.Policy.Preferred)
        self._fill()
        self._lay_out()
        self.plates.activated.connect(lambda row: self.plate_chosen.emit(self.plates.itemData(row)))
        self.metrics.activated.connect(lambda row: self.metric_chosen.emit(self.metrics.itemData(row)))
        self.limits.valueChanged.connect(self.limit_chosen)

    def show_scene(self, scene: Scene) -> None:
        """Show what a scene is looked at by."""
        before, self._shown = self._shown, scene
        if scene.state.keys != before.state.keys:
            self._list_plates(scene)
        if scene.view.key != before.view.key:
            self.plates.setCurrentIndex(self.plates.findData(scene.view.key))
        if scene.view.metric is not before.view.metric:
            self._show_metric(scene.view.metric)
        with QSignalBlocker(self.limits):
            self.limits.setValue(scene.view.metric.limits(scene.band)[0])

    def _fill(self) -> None:
        for row in METRICS:
            self.metrics.addItem(row.title, row.key)
            self.metrics.setItemData(self.metrics.count() - 1, _meaning(row), Qt.ItemDataRole.ToolTipRole)
        self.limits.setRange(-1.0, _LARGEST_LIMIT)
        self.limits.setKeyboardTracking(False)
        self.limits.setFixedWidth(_LIMIT * self.fontMetrics().averageCharWidth())
        self._show_metric(self._shown.view.metric)
        self.plates.setSizeAdjustPolicy(QComboBox.SizeAdjustPolicy.AdjustToMinimumContentsLengthWithIcon)
        self.plates.setMinimumContentsLength(_SHORTEST)
        self.plates.setMaximumWidth(_LONGEST * self.fontMetrics().averageCharWidth())
        self.plates.setSizePolicy(QSizePolicy.Policy.Expanding, QSizePolicy.Policy.Fixed)
        self.plates.setEnabled(False)

    def _lay_out(self) -> None:
        row = QHBoxLayout(self)
        row.setContentsMargins(0, 0, 0, 0)
        row.setSpacing(self.fontMetrics().averageCharWidth() // 2)
        for text, name, box in (
            (self.tr("Plate"), self.tr("Plate that is shown"), self.plates),
            (self.tr("Metric"), self.tr("Metric that colours the elements and is optimised"), self.metrics),
            (self.tr("Limit"), self.tr("Value at which quads begin to fail"), self.limits),
        ):
            label = QLabel(text)
            label.setBuddy(box)
            box.setAccessibleName(name)
            box.setToolTip(name)
            row.addWidget(label)
            row.addWidget(box, stretch=box is self.plates)
            row.addSpacing(self.fontMetrics().averageCharWidth())
        row.addStretch()

    def _list_plates(self, scene: Scene) -> None:
        self.plates.clear()
        for key in scene.state.keys:
            plate = scene.state.plate(key)
            title = plate.title if plate is not None and plate.title else key
            several = len(scene.state.keys) > 1 and title != key
            self.plates.addItem(f"{key} · {title}" if several else title, key)
            self.plates.setItemData(self.plates.count() - 1, title, Qt.ItemDataRole.ToolTipRole)
        self.plates.setEnabled(len(scene.state.keys) > 1)
        self.plates.setCurrentIndex(self.plates.findData(scene.view.key))
        self.plates.setToolTip(self.plates.currentText())

    def _show_metric(self, metric: Metric) -> None:
        self.metrics.setCurrentIndex(self.metrics.findData(metric.key))
        self.metrics.setToolTip(_meaning(metric))
        with QSignalBlocker(self.limits):
            is_angle = metric.unit == DEGREES
            self.limits.setDecimals(1 if is_angle else 2)
            self.limits.setSingleStep(1.0 if is_angle else 0.05)
            self.limits.setSuffix(metric.unit)


def _meaning(metric: Metric) -> str:
    """What a metric is, for its tooltip."""
    sense = _translated(metric.sense.value)
    text = _translated("{title}: {formula}.\nAcceptable {low} to {high}, {sense}; ideal {ideal}.\n{source}")
    low, high, ideal = (f"{value:g}{metric.unit}" for value in (*metric.quads.acceptable, metric.quads.ideal))
    return text.format(
        title=metric.title, formula=metric.formula, low=low, high=high, sense=sense, ideal=ideal, source=metric.source
    )


def _translated(text: str) -> str:
    return QCoreApplication.translate("Choices", text)
