"""The element inspector: what the selected element is like, and what every metric says of it."""

from PySide6.QtCore import Qt, Signal
from PySide6.QtGui import QFont, QShowEvent
from PySide6.QtWidgets import QCheckBox, QHBoxLayout, QHeaderView, QLabel, QSizePolicy, QVBoxLayout, QWidget

from hullquad_app.canvas.dimensions import length_words
from hullquad_app.colours import COLOUR_MAPS, LIGHT, ColourMap, Palette
from hullquad_app.inspection import Inspection
from hullquad_app.metric_words import name_of
from hullquad_app.panels.figures import CAPTION, sized
from hullquad_app.panels.ground import coloured, dress
from hullquad_app.panels.pace import Pace
from hullquad_app.panels.reading_rows import COLUMNS, ReadingModel
from hullquad_app.panels.table import Table
from hullquad_app.scene import Scene

_SAMPLES = {"value": ("000.0 mm", "0000.00"), "band": ("at least 0.01", "45° to 135°"), "state": ("FAIL, given",)}
"""Long texts of the columns with a width of their own."""


class ElementPanel(QWidget):
    """Edges, corners and values of the one element that is selected."""

    metric_wanted = Signal(object)
    """Emitted with the key of a metric that the elements are to be coloured by."""

    def __init__(self) -> None:
        super().__init__()
        self._scene, self._listed = Scene(), Scene()
        self.title, self.shape = QLabel(), QLabel()
        self.only_failing = QCheckBox(self.tr("only what fails"))
        self.only_failing.setToolTip(self.tr("List only the metrics by which the element fails"))
        self.only_failing.toggled.connect(lambda _: self._list())
        self.model = ReadingModel(self)
        self.table = Table(self.model, empty=self.tr("Click one element in the view or in a table"))
        self.table.setAccessibleName(self.tr("Values of the selected element"))
        self.table.opened.connect(self._choose)
        self.table.resized.connect(self._fit)
        self._pace = Pace(self._refresh, self)
        self._arrange()
        self.set_palette(LIGHT)

    def show_scene(self, scene: Scene) -> None:
        """Tell about the selected element of a scene; while it runs not more than a few times a second."""
        before, self._scene = self._scene, scene
        if _told(scene) != _told(self._listed) or scene.running != before.running:
            self._pace.ask(at_once=not scene.running)

    def showEvent(self, showing: QShowEvent) -> None:
        """Catch up with what has been selected meanwhile."""
        super().showEvent(showing)
        self._refresh()

    def set_palette(self, palette: Palette, _: ColourMap = COLOUR_MAPS[0]) -> None:
        """Draw in the colours of a theme."""
        dress(self, palette)
        coloured(self.title, palette.text)
        coloured(self.shape, palette.dim)
        self.table.set_palette(palette)
        self.model.set_palette(palette)

    def _refresh(self) -> None:
        """Nothing is computed for a panel that nobody sees."""
        if self.isVisible() and _told(self._scene) != _told(self._listed):
            self._listed = self._scene
            self._list()

    def _list(self) -> None:
        found = self._listed.inspection
        for widget in (self.title, self.shape, self.only_failing):
            widget.setVisible(found is not None)
        if found is not None:
            self._describe(found)
        self.model.show_inspection(found, only_failing=self.only_failing.isChecked())
        self._fit()

    def _describe(self, found: Inspection) -> None:
        kind = self.tr("triangle") if found.is_triangle else self.tr("quad")
        self.title.setText(self.tr("Element {label}, {kind}").format(label=found.label, kind=kind))
        lengths = [length_words(length) for length in found.anatomy.edge_lengths.tolist()]
        angles = [f"{angle:.1f}°" for angle in found.anatomy.corner_angles.tolist()]
        tip = ""
        if found.worst_corner is not None:
            worst = self.tr("<b>{angle} worst</b>").format(angle=angles[found.worst_corner])
            angles[found.worst_corner] = worst
            tip = self.tr("The worst corner is that by {metric}").format(metric=name_of(found.metric))
        self.shape.setToolTip(tip)
        lines = (
            self.tr("Edges {lengths}").format(lengths=" · ".join(lengths)),
            self.tr("Corners {angles}").format(angles=" · ".join(angles)),
        )
        self.shape.setText("<br>".join(lines))

    def _choose(self, row: int) -> None:
        by = self.model.metric(row)
        if by is not None:
            self.metric_wanted.emit(by.key)

    def _arrange(self) -> None:
        bold = QFont(self.title.font())
        bold.setWeight(QFont.Weight.DemiBold)
        self.title.setFont(bold)
        self.shape.setTextFormat(Qt.TextFormat.RichText)
        self.shape.setFont(sized(self.font(), CAPTION))
        self.shape.setAccessibleName(self.tr("Edges and corners of the selected element"))
        for label in (self.title, self.shape):
            label.setSizePolicy(QSizePolicy.Policy.Ignored, QSizePolicy.Policy.Fixed)
        line = QHBoxLayout()
        line.addWidget(self.title, stretch=1)
        line.addWidget(self.only_failing)
        head = QVBoxLayout()
        head.setContentsMargins(10, 6, 10, 4)
        head.setSpacing(2)
        head.addLayout(line)
        head.addWidget(self.shape)
        column = QVBoxLayout(self)
        column.setContentsMargins(0, 0, 0, 0)
        column.setSpacing(0)
        column.addLayout(head)
        column.addWidget(self.table, stretch=1)
        header = self.table.horizontalHeader()
        header.setMinimumSectionSize(1)
        header.setSectionResizeMode(QHeaderView.ResizeMode.Fixed)
        header.setSectionResizeMode(COLUMNS.index("metric"), QHeaderView.ResizeMode.Stretch)

    def _fit(self) -> None:
        """Give each column what its texts need and the metric the rest; headings go over all of them."""
        for name, texts in _SAMPLES.items():
            self.table.setColumnWidth(COLUMNS.index(name), self.table.width_of(*texts, bold=name == "state"))
        self.table.clearSpans()
        for row in self.model.headings:
            self.table.setSpan(row, 0, 1, len(COLUMNS))


def _told(scene: Scene) -> tuple[object, ...]:
    """All of a scene that is told."""
    selection = scene.view.selection if len(scene.view.selection) == 1 else frozenset()
    return id(scene.mesh), selection, scene.view.metric.key, dict(scene.view.bands)
