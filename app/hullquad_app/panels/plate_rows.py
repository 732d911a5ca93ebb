"""The plates of a document as a model for tables: what has become of each."""

from typing import Any

from PySide6.QtCore import QAbstractTableModel, QModelIndex, QObject, QPersistentModelIndex, Qt

from hullquad.mesh import Mesh
from hullquad.quality import Quality, quality
from hullquad.surface import Plane
from hullquad_app.colours import LIGHT, Palette
from hullquad_app.panels.cell import LEFT, RIGHT, Cell
from hullquad_app.panels.figures import counted, shown
from hullquad_app.scene import Scene
from hullquad_app.track import Track

COLUMNS = ("plate", "title", "state", "worst")
_ROOT = QModelIndex()

Index = QModelIndex | QPersistentModelIndex


class PlateModel(QAbstractTableModel):
    """A row for each plate; qualities are looked up when a row is painted, and kept."""

    def __init__(self, parent: QObject | None = None) -> None:
        super().__init__(parent)
        self._scene, self._palette = Scene(), LIGHT
        self._known: dict[Mesh, Quality] = {}

    def show_scene(self, scene: Scene) -> None:
        """List the plates of a scene."""
        is_other = scene.state.keys != self._scene.state.keys
        if is_other:
            self.beginResetModel()
        self._scene = scene
        meshes = {track.last.mesh for key in scene.state.keys if (track := self._track(key)) is not None}
        self._known = {mesh: judged for mesh, judged in self._known.items() if mesh in meshes}
        if is_other:
            self.endResetModel()
        self._repaint()

    def set_palette(self, palette: Palette) -> None:
        """Take other colours."""
        self._palette = palette
        self._repaint()

    def key(self, row: int) -> str:
        """Id of the plate in a row."""
        return self._scene.state.keys[row]

    def rowCount(self, parent: Index = _ROOT) -> int:
        """Number of plates."""
        return 0 if parent.isValid() else len(self._scene.state.keys)

    def columnCount(self, parent: Index = _ROOT) -> int:
        """Number of columns."""
        return 0 if parent.isValid() else len(COLUMNS)

    def headerData(self, section: int, orientation: Qt.Orientation, role: int = Qt.ItemDataRole.DisplayRole) -> Any:
        """Title of a column."""
        if orientation != Qt.Orientation.Horizontal:
            return None
        if role == Qt.ItemDataRole.TextAlignmentRole:
            return RIGHT if COLUMNS[section] == "worst" else LEFT
        unit = self._scene.view.metric.unit
        worst = self.tr("Worst") + (f" [{unit}]" if unit else "")
        titles = (self.tr("Plate"), self.tr("Title"), self.tr("State"), worst)
        return titles[section] if role == Qt.ItemDataRole.DisplayRole else None

    def data(self, index: Index, role: int = Qt.ItemDataRole.DisplayRole) -> Any:
        """What a cell shows."""
        if not index.isValid():
            return None
        return self._cell(self.key(index.row()), COLUMNS[index.column()]).data(role)

    def _cell(self, key: str, name: str) -> Cell:
        return Cell(
            text=self._text(key, name),
            colour=self._colour(key, name),
            is_bold=name == "plate" and key == self._scene.view.key,
            is_number=name == "worst",
            tip=self._tip(key),
        )

    def _text(self, key: str, name: str) -> str:
        plate, judged = self._scene.state.plate(key), self._quality(key)
        if name == "plate":
            return key
        if name == "title":
            return "" if plate is None else plate.title
        if name == "worst":
            return "" if judged is None or not len(judged.values) else shown(judged.worst, judged.metric)
        if judged is not None:
            return self._failing_words(judged)
        is_curved = plate is not None and not isinstance(plate.surface, Plane)
        return self.tr("curved: not yet") if is_curved else self.tr("not meshed")

    def _failing_words(self, judged: Quality) -> str:
        if not judged.failing_count:
            return self.tr("meshed")
        return self.tr("{count} failing").format(count=counted(judged.failing_count))

    def _colour(self, key: str, name: str) -> str:
        judged = self._quality(key) if name in ("state", "worst") else None
        if name == "state" and judged is not None and judged.failing_count:
            return self._palette.fail
        if name == "worst" and judged is not None and len(judged.values) and judged.failing[judged.worst_element]:
            return self._palette.fail
        return self._palette.dim if name in ("title", "state") else ""

    def _tip(self, key: str) -> str:
        plate = self._scene.state.plate(key)
        if plate is None:
            return ""
        text = self.tr("{title}\n{thickness:g} mm {material}, elements of {size:g} mm")
        return text.format(
            title=plate.title or key, thickness=plate.thickness, material=plate.material, size=plate.target_size
        ).strip()

    def _track(self, key: str) -> Track | None:
        return self._scene.track if key == self._scene.view.key else self._scene.state.tracks.get(key)

    def _quality(self, key: str) -> Quality | None:
        """Of the newest mesh of a plate, by the chosen metric."""
        track, scene = self._track(key), self._scene
        if track is None:
            return None
        mesh, by = track.last.mesh, scene.view.metric
        band = scene.view.bands.get(by.key, by.band)
        candidates: list[Quality | None] = [track.last.quality, self._known.get(mesh)]
        if mesh is scene.mesh:
            candidates.append(scene.quality)
        for known in candidates:
            if known is not None and known.metric is by and known.band == band:
                return known
        judged = self._known[mesh] = quality(mesh, by, band)
        return judged

    def _repaint(self) -> None:
        if self.rowCount():
            self.dataChanged.emit(self.index(0, 0), self.index(self.rowCount() - 1, len(COLUMNS) - 1))
        self.headerDataChanged.emit(Qt.Orientation.Horizontal, 0, len(COLUMNS) - 1)
