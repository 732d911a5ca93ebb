"""The worst elements as a model for tables."""

from typing import Any

import attrs
import numpy as np
from PySide6.QtCore import QAbstractTableModel, QModelIndex, QObject, QPersistentModelIndex, Qt

from hullquad.arrays import Bools, Bytes
from hullquad.mesh import Mesh
from hullquad.metrics import Metric, metric
from hullquad.quality import Quality
from hullquad.ranking import Ranking, ranking
from hullquad_app.colours import COLOUR_MAPS, INVERTED, LIGHT, ColourMap, Palette
from hullquad_app.level_colours import LEVELS
from hullquad_app.metric_words import name_of
from hullquad_app.panels.cell import LEFT, RIGHT, Cell
from hullquad_app.panels.figures import shown
from hullquad_app.scene import Scene
from hullquad_app.verdict_words import Fate, fate

MOST = 200
"""Rows of the table."""
COLUMNS = ("element", "kind", "swatch", "value", "min_angle", "aspect_ratio", "state")
_NUMBERS = ("element", "value", "min_angle", "aspect_ratio")

Index = QModelIndex | QPersistentModelIndex
_ROOT = QModelIndex()


@attrs.frozen(eq=False)
class Listed:
    """A mesh, its quality and its worst elements."""

    mesh: Mesh
    quality: Quality
    given: Bools | None
    levels: Bytes | None
    """By the rule set, where elements are coloured by one."""
    ranking: Ranking

    def fate(self, row: int) -> Fate:
        """What becomes of the element in a row."""
        return fate(self.quality, self.given, int(self.ranking.rows[row]))


class WorstModel(QAbstractTableModel):
    """A row for each of the worst elements, the worst first."""

    def __init__(self, parent: QObject | None = None) -> None:
        super().__init__(parent)
        self._listed: Listed | None = None
        self._palette, self._map = LIGHT, COLOUR_MAPS[0]

    def show_scene(self, scene: Scene, *, without_given: bool = False) -> None:
        """List the worst elements of the mesh that a scene shows, on wish without those that the contour gives."""
        before, listed = self.rowCount(), None
        if scene.mesh is not None and scene.quality is not None:
            levels = None if scene.assessment is None else scene.assessment.levels
            worst = _mendable(scene) if without_given else ranking(scene.mesh, scene.quality, MOST)
            listed = Listed(scene.mesh, scene.quality, scene.given, levels, worst)
        if (0 if listed is None else len(listed.ranking.rows)) == before:
            self._listed = listed
            self._repaint()
            return
        self.beginResetModel()
        self._listed = listed
        self.endResetModel()

    def set_palette(self, palette: Palette, chosen: ColourMap = COLOUR_MAPS[0]) -> None:
        """Take other colours."""
        self._palette, self._map = palette, chosen
        self._repaint()

    def element(self, row: int) -> int:
        """Row in the mesh of the element in a row of the table."""
        assert self._listed is not None  # asked only for rows that there are
        return int(self._listed.ranking.rows[row])

    def row_of(self) -> dict[int, int]:
        """Rows of the table by the elements' rows in the mesh."""
        rows = [] if self._listed is None else self._listed.ranking.rows.tolist()
        return {element: row for row, element in enumerate(rows)}

    def rowCount(self, parent: Index = _ROOT) -> int:
        """Number of elements listed."""
        return 0 if parent.isValid() or self._listed is None else len(self._listed.ranking.rows)

    def columnCount(self, parent: Index = _ROOT) -> int:
        """Number of columns."""
        return 0 if parent.isValid() else len(COLUMNS)

    def headerData(self, section: int, orientation: Qt.Orientation, role: int = Qt.ItemDataRole.DisplayRole) -> Any:
        """Title of a column, with the unit."""
        if orientation != Qt.Orientation.Horizontal:
            return None
        name = COLUMNS[section]
        if role == Qt.ItemDataRole.TextAlignmentRole:
            return RIGHT if name in _NUMBERS else LEFT
        if role not in (Qt.ItemDataRole.DisplayRole, Qt.ItemDataRole.ToolTipRole):
            return None
        is_tip = role == Qt.ItemDataRole.ToolTipRole
        return self._tips()[name] if is_tip else self._titles()[name]

    def data(self, index: Index, role: int = Qt.ItemDataRole.DisplayRole) -> Any:
        """What a cell shows."""
        if self._listed is None or not index.isValid():
            return None
        return self._cell(self._listed, index.row(), COLUMNS[index.column()]).data(role)

    def _cell(self, listed: Listed, row: int, name: str) -> Cell:
        fate = listed.fate(row)
        return Cell(
            text=self._text(listed, row, name),
            colour=self._colour(listed, row, name),
            is_bold=name == "state" and fate.is_failing,
            is_number=name in _NUMBERS,
            swatch=self._swatch(listed, row) if name == "swatch" else "",
            is_hatched=fate.is_given,
            tip=self._tip(listed, row, name),
        )

    def _titles(self) -> dict[str, str]:
        by = None if self._listed is None else self._listed.quality.metric
        unit = f" [{by.unit}]" if by is not None and by.unit else ""
        return {
            "element": self.tr("Elem"),
            "kind": self.tr("Type"),
            "swatch": "",
            "value": self.tr("Value") if by is None else by.title + unit,
            "min_angle": self.tr("Min [°]"),
            "aspect_ratio": self.tr("Aspect"),
            "state": self.tr("State"),
        }

    def _tips(self) -> dict[str, str]:
        by = None if self._listed is None else self._listed.quality.metric
        return {
            "element": self.tr("Label of the element"),
            "kind": self.tr("Quad or triangle"),
            "swatch": self.tr("Colour in the view"),
            "value": "" if by is None else by.formula,
            "min_angle": metric("min_angle").formula + " [°]",
            "aspect_ratio": metric("aspect_ratio").formula,
            "state": self.tr("Whether the element is beyond its limit, turned inside out, or given so by the contour"),
        }

    def _text(self, listed: Listed, row: int, name: str) -> str:
        element, quality = int(listed.ranking.rows[row]), listed.quality
        if name == "element":
            return str(listed.mesh.topology.element_labels[element])
        if name == "kind":
            return self.tr("triangle") if quality.is_triangle[element] else self.tr("quad")
        if name == "value":
            return shown(float(quality.values[element]), _judge(listed, element))
        if name == "min_angle":
            return shown(float(listed.ranking.min_angles[row]), metric(name))
        if name == "aspect_ratio":
            return shown(float(listed.ranking.aspect_ratios[row]), metric(name))
        return listed.fate(row).word if name == "state" else ""

    def _colour(self, listed: Listed, row: int, name: str) -> str:
        if name == "kind" or (name == "value" and _is_by_other(listed, row)):
            return self._palette.dim
        return listed.fate(row).colour(self._palette) if name == "state" else ""

    def _swatch(self, listed: Listed, row: int) -> str:
        element, quality = int(listed.ranking.rows[row]), listed.quality
        if not quality.valid[element]:
            return INVERTED
        if listed.levels is not None:
            return LEVELS[listed.levels[element]]
        grade = float(quality.grades[element])
        return self._map.colour(min(grade, -1e-9) if quality.failing[element] else grade)

    def _tip(self, listed: Listed, row: int, name: str) -> str:
        if name == "value" and _is_by_other(listed, row):
            judge = name_of(listed.quality.metric.triangle_metric)
            return self.tr("triangles are judged by {metric}").format(metric=judge)
        return listed.fate(row).reason if name in ("state", "swatch") else ""

    def _repaint(self) -> None:
        if self.rowCount():
            self.dataChanged.emit(self.index(0, 0), self.index(self.rowCount() - 1, len(COLUMNS) - 1))
        self.headerDataChanged.emit(Qt.Orientation.Horizontal, 0, len(COLUMNS) - 1)


def _mendable(scene: Scene) -> Ranking:
    """The worst elements of a scene that moving nodes can help."""
    assert scene.mesh is not None  # it was judged
    assert scene.quality is not None
    given = np.zeros(len(scene.quality.values), dtype=bool) if scene.given is None else scene.given
    found = ranking(scene.mesh, scene.quality, MOST + int(given.sum()))
    kept = np.flatnonzero(~given[found.rows])[:MOST]
    return Ranking(rows=found.rows[kept], min_angles=found.min_angles[kept], aspect_ratios=found.aspect_ratios[kept])


def _is_by_other(listed: Listed, row: int) -> bool:
    """Whether an element is a triangle that is judged by another measure."""
    return listed.quality.metric.triangles is None and bool(listed.quality.is_triangle[listed.ranking.rows[row]])


def _judge(listed: Listed, element: int) -> Metric:
    row = listed.quality.metric
    return row.triangle_metric if listed.quality.is_triangle[element] else row
