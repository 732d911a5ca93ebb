"""What the chosen rule set says: every rule with the elements that break it."""

from PySide6.QtCore import Qt, Signal
from PySide6.QtGui import QFont
from PySide6.QtWidgets import QHeaderView, QLabel, QSizePolicy, QVBoxLayout, QWidget

from hullquad_app.colours import COLOUR_MAPS, LIGHT, ColourMap, Palette
from hullquad_app.panels.ground import coloured, dress
from hullquad_app.panels.pace import Pace
from hullquad_app.panels.rule_rows import COLUMNS, RuleModel
from hullquad_app.panels.table import Table
from hullquad_app.rule_words import about
from hullquad_app.scene import Scene

_SAMPLES = {"swatch": ("00",), "warn": ("0000",), "error": ("0000",), "given": ("0000",)}
"""Long texts of the columns with a width of their own."""
_ROW = 2.2
"""Height of a row, in lines."""


class RulesPanel(QWidget):
    """A row for each rule of the set by which the shown mesh is judged."""

    selected = Signal(object, bool)
    """Rows in the mesh of the elements that break a rule (frozenset), and whether they extend the selection."""
    zoom_wanted = Signal(object)
    """The same, to look at closely."""

    def __init__(self) -> None:
        super().__init__()
        self._scene, self._listed = Scene(), Scene()
        self.title = QLabel()
        self.model = RuleModel(self)
        self.table = Table(self.model, empty=self.tr("Choose a rule set at “Judge by”"))
        self.table.setAccessibleName(self.tr("Rules"))
        self.table.chosen.connect(lambda row, extend: self._choose(row, extend=extend))
        self.table.opened.connect(lambda row: self.zoom_wanted.emit(self._rows(row)))
        self.table.resized.connect(self._fit)
        self._pace = Pace(self._refresh, self)
        self._arrange()
        self.set_palette(LIGHT)

    def show_scene(self, scene: Scene) -> None:
        """List the rules of a scene; while it runs not more than a few times a second."""
        before, self._scene = self._scene, scene
        if scene.assessment is not self._listed.assessment or scene.running != before.running:
            self._pace.ask(at_once=not scene.running)
        elif scene.view.selection is not before.view.selection:
            self._select()

    def set_palette(self, palette: Palette, _: ColourMap = COLOUR_MAPS[0]) -> None:
        """Draw in the colours of a theme."""
        dress(self, palette)
        coloured(self.title, palette.text)
        self.table.set_palette(palette)
        self.model.set_palette(palette)

    def _refresh(self) -> None:
        self._listed = self._scene
        rules = None if self._scene.assessment is None else self._scene.assessment.rule_set
        self.title.setText("" if rules is None else rules.title)
        self.title.setToolTip("" if rules is None else about(rules))
        self.title.setVisible(rules is not None)
        self.model.show_assessment(self._scene.assessment)
        self._fit()
        self._select()

    def _rows(self, row: int) -> frozenset[int]:
        return frozenset(self.model.finding(row).rows.tolist())

    def _select(self) -> None:
        """Show as chosen what breaks exactly the selected elements."""
        selection = self._scene.view.selection
        counts = [len(self.model.finding(row).rows) for row in range(self.model.rowCount())]
        alike = [row for row, count in enumerate(counts) if count and count == len(selection)]
        self.table.select_rows(row for row in alike if self._rows(row) == selection)

    def _choose(self, row: int, *, extend: bool) -> None:
        self._select()  # until the document agrees
        self.selected.emit(self._rows(row), extend)

    def _arrange(self) -> None:
        font = QFont(self.title.font())
        font.setWeight(QFont.Weight.DemiBold)
        self.title.setFont(font)
        self.title.setSizePolicy(QSizePolicy.Policy.Ignored, QSizePolicy.Policy.Fixed)
        self.title.setContentsMargins(10, 6, 10, 4)
        column = QVBoxLayout(self)
        column.setContentsMargins(0, 0, 0, 0)
        column.setSpacing(0)
        column.addWidget(self.title)
        column.addWidget(self.table, stretch=1)
        header = self.table.horizontalHeader()
        header.setMinimumSectionSize(1)
        header.setSectionResizeMode(QHeaderView.ResizeMode.Fixed)
        header.setSectionResizeMode(COLUMNS.index("rule"), QHeaderView.ResizeMode.Stretch)
        self.title.hide()

    def _fit(self) -> None:
        """Give the numbers what they need and the rule the rest."""
        self.table.verticalHeader().setDefaultSectionSize(round(_ROW * self.fontMetrics().height()))
        for name, texts in _SAMPLES.items():
            title = self.model.headerData(COLUMNS.index(name), Qt.Orientation.Horizontal)
            self.table.setColumnWidth(COLUMNS.index(name), self.table.width_of(*texts, title))
