"""What every metric says of one element, as a model for tables: under headings, or only what fails."""

from typing import Any

from PySide6.QtCore import QAbstractTableModel, QModelIndex, QObject, QPersistentModelIndex, Qt

from hullquad.metrics import Metric
from hullquad_app.colours import LIGHT, Palette
from hullquad_app.inspection import Inspection, Reading
from hullquad_app.metric_words import accepted, meaning, name_of
from hullquad_app.panels.cell import LEFT, RIGHT, Cell
from hullquad_app.panels.figures import valued

COLUMNS = ("metric", "value", "band", "state")

Index = QModelIndex | QPersistentModelIndex
_ROOT = QModelIndex()


class ReadingModel(QAbstractTableModel):
    """A row for each metric, and one for each heading."""

    def __init__(self, parent: QObject | None = None) -> None:
        super().__init__(parent)
        self._rows: list[str | Reading] = []
        self._chosen: Metric | None = None
        self._palette = LIGHT

    def show_inspection(self, inspection: Inspection | None, *, only_failing: bool) -> None:
        """List what is said of an element."""
        before = [_key(row) for row in self._rows]
        rows = [] if inspection is None else _rows(inspection, only_failing=only_failing)
        self._chosen = None if inspection is None else inspection.metric
        if [_key(row) for row in rows] == before:
            self._rows = rows
            self._repaint()
            return
        self.beginResetModel()
        self._rows = rows
        self.endResetModel()

    def set_palette(self, palette: Palette) -> None:
        """Take other colours."""
        self._palette = palette
        self._repaint()

    @property
    def headings(self) -> list[int]:
        """Rows that are headings."""
        return [row for row, found in enumerate(self._rows) if isinstance(found, str)]

    def metric(self, row: int) -> Metric | None:
        """Metric of a row; none of a heading."""
        found = self._rows[row]
        return None if isinstance(found, str) else found.metric

    def rowCount(self, parent: Index = _ROOT) -> int:
        """Number of metrics and headings."""
        return 0 if parent.isValid() else len(self._rows)

    def columnCount(self, parent: Index = _ROOT) -> int:
        """Number of columns."""
        return 0 if parent.isValid() else len(COLUMNS)

    def flags(self, index: Index) -> Qt.ItemFlag:
        """Headings cannot be chosen."""
        is_heading = index.isValid() and isinstance(self._rows[index.row()], str)
        return Qt.ItemFlag.ItemIsEnabled if is_heading else super().flags(index)

    def headerData(self, section: int, orientation: Qt.Orientation, role: int = Qt.ItemDataRole.DisplayRole) -> Any:
        """Title of a column."""
        if orientation != Qt.Orientation.Horizontal:
            return None
        if role == Qt.ItemDataRole.TextAlignmentRole:
            return RIGHT if COLUMNS[section] == "value" else LEFT
        titles = (self.tr("Metric"), self.tr("Value"), self.tr("Accepted"), self.tr("State"))
        return titles[section] if role == Qt.ItemDataRole.DisplayRole else None

    def data(self, index: Index, role: int = Qt.ItemDataRole.DisplayRole) -> Any:
        """What a cell shows."""
        if not index.isValid():
            return None
        found, name = self._rows[index.row()], COLUMNS[index.column()]
        if isinstance(found, str):
            return Cell(text=found if name == "metric" else "", colour=self._palette.dim, is_bold=True).data(role)
        return self._cell(found, name).data(role)

    def _cell(self, found: Reading, name: str) -> Cell:
        is_bold = (name == "state" and found.fate.is_failing) or (name == "metric" and found.metric is self._chosen)
        return Cell(
            text=self._text(found, name),
            colour=self._colour(found, name),
            is_bold=is_bold,
            is_number=name == "value",
            tip=found.fate.reason if name == "state" else meaning(found.metric),
        )

    def _text(self, found: Reading, name: str) -> str:
        if name == "metric":
            is_other = found.judge is not found.metric
            by = self.tr("{metric}, by {judge}")
            return by.format(metric=found.metric.title, judge=name_of(found.judge)) if is_other else found.metric.title
        if name == "value":
            return valued(found.value, found.judge)
        return accepted(found.judge, found.band) if name == "band" else found.fate.word

    def _colour(self, found: Reading, name: str) -> str:
        if name == "band":
            return self._palette.dim
        if name == "value" and found.fate.is_failing:
            return self._palette.fail
        return found.fate.colour(self._palette) if name == "state" else ""

    def _repaint(self) -> None:
        if self.rowCount():
            self.dataChanged.emit(self.index(0, 0), self.index(self.rowCount() - 1, len(COLUMNS) - 1))


def _rows(inspection: Inspection, *, only_failing: bool) -> list[str | Reading]:
    rows: list[str | Reading] = []
    heading = ""
    for found in inspection.readings:
        if only_failing and not found.fate.is_failing:
            continue
        if found.metric.group != heading:
            heading = found.metric.group
            rows.append(heading)
        rows.append(found)
    return rows


def _key(row: str | Reading) -> str:
    return row if isinstance(row, str) else row.metric.key
