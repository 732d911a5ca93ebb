"""The findings of an assessment as a model for tables: a row for each rule."""

from typing import TYPE_CHECKING, Any

from PySide6.QtCore import QAbstractTableModel, QModelIndex, QObject, QPersistentModelIndex, Qt

from hullquad_app.colours import LIGHT, Palette
from hullquad_app.level_colours import LEVELS
from hullquad_app.panels.cell import LEFT, RIGHT, Cell
from hullquad_app.panels.figures import counted
from hullquad_app.rule_words import kind_of, limit_of, mark_of, source_of

if TYPE_CHECKING:
    from hullquad.rules import Assessment, Finding

COLUMNS = ("swatch", "rule", "warn", "error", "given")
_COUNTS = ("warn", "error", "given")
_NONE = "–"

Index = QModelIndex | QPersistentModelIndex
_ROOT = QModelIndex()


class RuleModel(QAbstractTableModel):
    """What each rule of a set says: its limit, how many elements break it, and how many of them nodes cannot mend."""

    def __init__(self, parent: QObject | None = None) -> None:
        super().__init__(parent)
        self._findings: tuple[Finding, ...] = ()
        self._palette = LIGHT

    def show_assessment(self, assessment: "Assessment | None") -> None:
        """List the findings of an assessment."""
        findings = () if assessment is None else assessment.findings
        is_same_set = [new.rule for new in findings] == [old.rule for old in self._findings]
        if is_same_set:
            self._findings = findings
            self._repaint()
            return
        self.beginResetModel()
        self._findings = findings
        self.endResetModel()

    def set_palette(self, palette: Palette) -> None:
        """Take other colours."""
        self._palette = palette
        self._repaint()

    def finding(self, row: int) -> "Finding":
        """The finding in a row."""
        return self._findings[row]

    def rowCount(self, parent: Index = _ROOT) -> int:
        """Number of rules."""
        return 0 if parent.isValid() else len(self._findings)

    def columnCount(self, parent: Index = _ROOT) -> int:
        """Number of columns."""
        return 0 if parent.isValid() else len(COLUMNS)

    def headerData(self, section: int, orientation: Qt.Orientation, role: int = Qt.ItemDataRole.DisplayRole) -> Any:
        """Title of a column."""
        if orientation != Qt.Orientation.Horizontal:
            return None
        name = COLUMNS[section]
        if role == Qt.ItemDataRole.TextAlignmentRole:
            return RIGHT if name in _COUNTS else LEFT
        texts = {Qt.ItemDataRole.DisplayRole: self._titles, Qt.ItemDataRole.ToolTipRole: self._tips}.get(
            Qt.ItemDataRole(role)
        )
        return None if texts is None else texts()[name]

    def data(self, index: Index, role: int = Qt.ItemDataRole.DisplayRole) -> Any:
        """What a cell shows."""
        if not index.isValid():
            return None
        return self._cell(self._findings[index.row()], COLUMNS[index.column()]).data(role)

    def _cell(self, finding: "Finding", name: str) -> Cell:
        return Cell(
            text=self._text(finding, name),
            detail=self._detail(finding) if name == "rule" else "",
            colour=self._colour(finding, name),
            is_bold=name == "error" and _count(finding, name) > 0,
            is_number=name in _COUNTS,
            swatch=_swatch(finding) if name == "swatch" else "",
            tip=source_of(finding.rule),
        )

    def _titles(self) -> dict[str, str]:
        return {
            "swatch": "",
            "rule": self.tr("Rule"),
            "warn": self.tr("Warn"),
            "error": self.tr("Fail"),
            "given": self.tr("Given"),
        }

    def _tips(self) -> dict[str, str]:
        return {
            "swatch": self.tr("Colour in the view of an element that breaks no other rule"),
            "rule": self.tr("Click a rule to select the elements that break it, double-click to see them large"),
            "warn": self.tr("Elements that the rule warns of"),
            "error": self.tr("Elements that fail"),
            "given": self.tr("Elements that break the rule because of the contour: moving nodes cannot mend them"),
        }

    def _text(self, finding: "Finding", name: str) -> str:
        if name == "rule":
            parts = (finding.rule.title, kind_of(finding.rule), limit_of(finding.rule, _unit(finding)))
            return " · ".join(filter(None, parts))
        if name == "swatch":
            return ""
        return _NONE if finding.not_evaluated is not None else counted(_count(finding, name))

    def _detail(self, finding: "Finding") -> str:
        if finding.not_evaluated is not None:
            return self.tr("not evaluated: {reason}").format(reason=finding.not_evaluated)
        return f"{mark_of(finding.rule)}: {finding.rule.text}"

    def _colour(self, finding: "Finding", name: str) -> str:
        if finding.not_evaluated is not None:
            return self._palette.dim
        if name not in _COUNTS:
            return ""
        count = _count(finding, name)
        return self._palette.dim if not count else self._palette.fail if name == "error" else self._palette.text

    def _repaint(self) -> None:
        if self.rowCount():
            self.dataChanged.emit(self.index(0, 0), self.index(self.rowCount() - 1, len(COLUMNS) - 1))


def _swatch(finding: "Finding") -> str:
    return "" if finding.not_evaluated is not None else LEVELS[int(finding.levels.max(initial=0))]


def _count(finding: "Finding", name: str) -> int:
    if name == "given":
        return int(finding.given.sum())
    from hullquad.rules import Level  # noqa: PLC0415  there is an assessment, so it is loaded

    return finding.count(Level.WARN if name == "warn" else Level.ERROR)


def _unit(finding: "Finding") -> str:
    from hullquad.rules import MEASURES  # noqa: PLC0415

    measure = MEASURES.get(finding.rule.measure)
    return "" if measure is None else measure.unit
