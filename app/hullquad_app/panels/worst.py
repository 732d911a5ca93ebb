"""Worst elements: a table in step with view and histogram."""

from PySide6.QtCore import Qt, Signal
from PySide6.QtWidgets import QCheckBox, QHBoxLayout, QHeaderView, QVBoxLayout, QWidget

from hullquad_app.colours import COLOUR_MAPS, LIGHT, ColourMap, Palette
from hullquad_app.panels.elements import COLUMNS, WorstModel
from hullquad_app.panels.figures import CAPTION, sized
from hullquad_app.panels.ground import dress
from hullquad_app.panels.pace import Pace
from hullquad_app.panels.table import Table
from hullquad_app.scene import Scene
from hullquad_app.verdict_words import Fate

_SAMPLES = {
    "element": ("0000",),
    "kind": ("triangle",),
    "swatch": ("00",),
    "value": ("00.000",),
    "min_angle": ("90.0",),
    "aspect_ratio": ("00.00",),
    "state": ("FAIL, given", "State"),
}
"""Long texts of each column."""
_EXTRA = ("aspect_ratio", "min_angle", "kind")
"""Columns that can be done without, the first before the others."""


class WorstPanel(QWidget):
    """The worst elements of the shown mesh, worst first."""

    selected = Signal(object, bool)
    """The row in the mesh of one element (frozenset), and whether it extends the selection."""
    zoom_wanted = Signal(int)
    """Row in the mesh of the element to look at closely."""

    def __init__(self) -> None:
        super().__init__()
        self._scene, self._listed = Scene(), Scene()
        self.model = WorstModel(self)
        self.table = Table(self.model, empty=self.tr("no mesh yet"))
        self.table.setAccessibleName(self.tr("Worst elements"))
        self.table.chosen.connect(lambda row, extend: self._choose(row, extend=extend))
        self.table.opened.connect(lambda row: self.zoom_wanted.emit(self.model.element(row)))
        self.table.resized.connect(self._fit_columns)
        self._pace = Pace(self._refresh, self)
        self.without_given = QCheckBox(self.tr("without what the contour gives"))
        self.without_given.setToolTip(self.tr("Leave out elements that no node that may move can mend"))
        self.without_given.setFont(sized(self.font(), CAPTION))
        self.without_given.toggled.connect(lambda _: self._list())
        self.without_given.hide()
        column = QVBoxLayout(self)
        column.setContentsMargins(0, 0, 0, 0)
        column.setSpacing(0)
        column.addWidget(self.table, stretch=1)
        line = QHBoxLayout()
        line.setContentsMargins(10, 2, 10, 2)
        line.addWidget(self.without_given)
        column.addLayout(line)
        header = self.table.horizontalHeader()
        header.setMinimumSectionSize(1)
        header.setSectionResizeMode(QHeaderView.ResizeMode.Fixed)
        header.setSectionResizeMode(COLUMNS.index("value"), QHeaderView.ResizeMode.Stretch)
        self.set_palette(LIGHT)

    def show_scene(self, scene: Scene) -> None:
        """List the worst elements of a scene; while it runs not more than a few times a second."""
        before, self._scene = self._scene, scene
        if _is_other(scene, self._listed) or scene.running != before.running:
            self._pace.ask(at_once=not scene.running)
        if scene.view.selection is not before.view.selection:
            self._select()
            self._bring_into_view()

    def set_palette(self, palette: Palette, chosen: ColourMap = COLOUR_MAPS[0]) -> None:
        """Draw in the colours of a theme and a map."""
        dress(self, palette)
        self.table.set_palette(palette)
        self.model.set_palette(palette, chosen)

    def next(self) -> None:
        """Select the element after the selected one, or the worst."""
        self._go(1)

    def previous(self) -> None:
        """Select the element before the selected one."""
        self._go(-1)

    def _refresh(self) -> None:
        if not _is_other(self._scene, self._listed):
            return
        self._listed = self._scene
        has_given = self._scene.given is not None and bool(self._scene.given.any())
        self.without_given.setVisible(has_given or self.without_given.isChecked())
        self._list()

    def _list(self) -> None:
        self.model.show_scene(self._listed, without_given=self.without_given.isChecked())
        self._fit_columns()
        self._select()

    def _selected_rows(self) -> list[int]:
        places = self.model.row_of()
        return sorted(places[element] for element in self._scene.view.selection if element in places)

    def _select(self) -> None:
        self.table.select_rows(self._selected_rows())

    def _bring_into_view(self) -> None:
        rows = self._selected_rows()
        if rows:
            self.table.scrollTo(self.model.index(rows[0], 0))

    def _choose(self, row: int, *, extend: bool) -> None:
        self._select()  # until the document agrees, nothing else is selected
        self.selected.emit(frozenset({self.model.element(row)}), extend)

    def _go(self, step: int) -> None:
        last = self.model.rowCount() - 1
        if last < 0:
            return
        rows = self._selected_rows()
        row = min(max(rows[-1 if step > 0 else 0] + step, 0), last) if rows else 0
        self._choose(row, extend=False)

    def _fit_columns(self) -> None:
        """Give each column what its texts need and the value the rest; leave out what there is no room for."""
        table, widths = self.table, {name: self._width(name) for name in COLUMNS}
        by = self._scene.view.metric.key if self._listed.quality is not None else ""
        wanted = [name for name in COLUMNS if name != by]  # the value's column shows it already
        for name in _EXTRA:
            if sum(widths[known] for known in wanted) > table.viewport().width() and name in wanted:
                wanted.remove(name)
        for number, name in enumerate(COLUMNS):
            table.setColumnHidden(number, name not in wanted)
            if name != "value":
                table.setColumnWidth(number, widths[name])

    def _width(self, name: str) -> int:
        title = self.model.headerData(COLUMNS.index(name), Qt.Orientation.Horizontal)
        texts = [*_SAMPLES[name], "" if name == "value" else title]
        judged = self._listed.quality
        if name == "element" and self._listed.mesh is not None:
            texts.append(str(self._listed.mesh.topology.element_labels.max(initial=0)))
        if name == "state" and judged is not None and judged.inverted_count:
            texts.append(Fate(is_valid=False, is_failing=True, is_given=True).word)
        return self.table.width_of(*texts, bold=name == "state")


def _is_other(scene: Scene, listed: Scene) -> bool:
    return scene.quality is not listed.quality or scene.verdict is not listed.verdict
