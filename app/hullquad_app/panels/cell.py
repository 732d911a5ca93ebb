"""What a table shows in one place."""

from typing import Any

import attrs
from PySide6.QtCore import Qt
from PySide6.QtGui import QColor, QFont

CELL = Qt.ItemDataRole.UserRole + 1
"""Role of the cell itself: a table that paints asks once, and not for each of its parts."""
RIGHT = Qt.AlignmentFlag.AlignRight | Qt.AlignmentFlag.AlignVCenter
LEFT = Qt.AlignmentFlag.AlignLeft | Qt.AlignmentFlag.AlignVCenter
_ROLES = Qt.ItemDataRole


@attrs.frozen(kw_only=True)
class Cell:
    """A text, or a square of a colour."""

    text: str = ""
    detail: str = ""
    """A second line, small and dim."""
    colour: str = ""
    """Of the text; empty: the table's."""
    is_bold: bool = False
    is_number: bool = False
    """Stands at the right."""
    swatch: str = ""
    """Colour of the square; empty: none."""
    is_hatched: bool = False
    """The square is."""
    tip: str = ""

    def data(self, role: int) -> Any:
        """What a role asks of it."""
        if role == CELL:
            return self
        if role == _ROLES.DisplayRole:
            return self.text
        if role == _ROLES.TextAlignmentRole:
            return RIGHT if self.is_number else LEFT
        if role == _ROLES.ForegroundRole:
            return QColor(self.colour) if self.colour else None
        if role == _ROLES.DecorationRole:
            return QColor(self.swatch) if self.swatch else None
        if role == _ROLES.ToolTipRole:
            return self.tip or None
        return _bold() if role == _ROLES.FontRole and self.is_bold else None


def _bold() -> QFont:
    font = QFont()
    font.setBold(True)
    return font
