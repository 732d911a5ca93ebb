"""The plates of a document with several: what has become of each, and which is shown."""

from PySide6.QtCore import Qt, Signal
from PySide6.QtWidgets import QHeaderView, QVBoxLayout, QWidget

from hullquad_app.colours import COLOUR_MAPS, LIGHT, ColourMap, Palette
from hullquad_app.panels.ground import dress
from hullquad_app.panels.pace import Pace
from hullquad_app.panels.plate_rows import COLUMNS, PlateModel
from hullquad_app.panels.table import Table
from hullquad_app.scene import Scene

_SAMPLES = {"state": ("curved: not yet", "100 failing"), "worst": ("00.000",)}
"""Long texts of the columns with a width of their own."""


class PlatesPanel(QWidget):
    """A row for each plate; the one that is shown is selected."""

    chosen = Signal(str)
    """Id of the plate to show."""

    def __init__(self) -> None:
        super().__init__()
        self._scene, self._shown_key = Scene(), Scene().view.key
        self.model = PlateModel(self)
        self.table = Table(self.model, empty=self.tr("no plates yet"))
        self.table.setAccessibleName(self.tr("Plates of the document"))
        self.table.chosen.connect(self._choose)
        self.table.resized.connect(self._fit_columns)
        header = self.table.horizontalHeader()
        header.setSectionResizeMode(QHeaderView.ResizeMode.Fixed)
        header.setSectionResizeMode(COLUMNS.index("title"), QHeaderView.ResizeMode.Stretch)
        self._pace = Pace(self._refresh, self)
        column = QVBoxLayout(self)
        column.setContentsMargins(0, 0, 0, 0)
        column.addWidget(self.table)
        self.set_palette(LIGHT)

    def show_scene(self, scene: Scene) -> None:
        """List the plates of a scene; while it runs not more than a few times a second."""
        before, self._scene = self._scene, scene
        if any(new is not old for new, old in zip(_told(scene), _told(before), strict=True)):
            self._pace.ask(at_once=not scene.running)

    def set_palette(self, palette: Palette, _: ColourMap = COLOUR_MAPS[0]) -> None:
        """Draw in the colours of a theme."""
        dress(self, palette)
        self.table.set_palette(palette)
        self.model.set_palette(palette)

    def _refresh(self) -> None:
        is_other = self._scene.view.key != self._shown_key
        self.model.show_scene(self._scene)
        self._shown_key = self._scene.view.key
        self._fit_columns()
        self._select()
        if is_other and self._rows():
            self.table.scrollTo(self.model.index(self._rows()[0], 0))

    def _rows(self) -> list[int]:
        return [row for row, key in enumerate(self._scene.state.keys) if key == self._scene.view.key]

    def _select(self) -> None:
        self.table.select_rows(self._rows())

    def _choose(self, row: int) -> None:
        self._select()  # until the document agrees, no other plate is shown
        self.chosen.emit(self.model.key(row))

    def _fit_columns(self) -> None:
        """Give each column what its texts need and the title the rest."""
        names = self._scene.state.keys or ("",)
        longest = sorted(names, key=len)[-1]
        most = self.table.viewport().width() // 3
        self.table.setColumnWidth(0, min(self._width("plate", longest, bold=True), most))
        for name, texts in _SAMPLES.items():
            self.table.setColumnWidth(COLUMNS.index(name), self._width(name, *texts))

    def _width(self, name: str, *texts: str, bold: bool = False) -> int:
        title = self.model.headerData(COLUMNS.index(name), Qt.Orientation.Horizontal)
        return self.table.width_of(*texts, title, bold=bold)


def _told(scene: Scene) -> tuple[object, ...]:
    """All of a scene that is told."""
    return scene.state, scene.view.key, scene.track, scene.quality, scene.running
