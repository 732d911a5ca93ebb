"""What becomes of an element, in a word and a colour: the same in tables, tips and pictures."""

import attrs
from PySide6.QtCore import QCoreApplication

from hullquad.arrays import Bools
from hullquad.quality import Quality
from hullquad_app.colours import INVERTED, Palette


@attrs.frozen
class Fate:
    """Whether an element is valid, passes, and whether moving nodes could help it."""

    is_valid: bool
    is_failing: bool
    is_given: bool

    @property
    def word(self) -> str:
        """Pass, FAIL or INVERTED; failing ones that the contour gives say so."""
        word = _tr("FAIL") if self.is_failing else _tr("pass")
        if not self.is_valid:
            word = _tr("INVERTED")
        return _tr("{word}, given").format(word=word) if self.is_given else word

    @property
    def reason(self) -> str:
        """What the word means; nothing where it says enough."""
        return _tr("Given by the contour: no node that may move can mend it") if self.is_given else ""

    def colour(self, palette: Palette) -> str:
        """Colour of the word."""
        if not self.is_valid:
            return INVERTED
        return palette.fail if self.is_failing else palette.dim


def fate(quality: Quality, given: Bools | None, row: int) -> Fate:
    """What becomes of the element in a row of the mesh."""
    is_given = given is not None and bool(given[row])
    return Fate(bool(quality.valid[row]), bool(quality.failing[row]), is_given)


def _tr(text: str) -> str:
    return QCoreApplication.translate("Verdict", text)
