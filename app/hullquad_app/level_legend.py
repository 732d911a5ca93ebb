"""What the colours of a rule set's levels mean, with the number of elements of each."""

from typing import TYPE_CHECKING

import attrs
from PySide6.QtCore import QCoreApplication, QRectF, Qt
from PySide6.QtGui import QColor, QPainter, QPen

from hullquad_app.colours import INVERTED, Palette
from hullquad_app.hatching import draw_hatching
from hullquad_app.level_colours import LEVELS
from hullquad_app.panels.figures import counted

if TYPE_CHECKING:
    from hullquad.rules import Assessment


@attrs.frozen
class Entry:
    """One colour with its meaning."""

    colour: str
    """Empty: hatched."""
    text: str


def entries(assessment: "Assessment", inverted: int) -> list[Entry]:
    """Numbers of elements at each level, from the best to the worst, then inverted and given ones if there are any."""
    counts = list(assessment.counts.values())
    texts = (_tr("{count} ok"), _tr("{count} warn"), _tr("{count} fail"))
    found = [
        Entry(colour, text.format(count=counted(count)))
        for colour, text, count in zip(LEVELS, texts, counts, strict=True)
    ]
    if inverted:
        found.append(Entry(INVERTED, _tr("{count} inverted").format(count=counted(inverted))))
    if given := int(assessment.given.sum()):
        found.append(Entry("", _tr("{count} given by the contour").format(count=counted(given))))
    return found


def draw_swatch(painter: QPainter, square: QRectF, colour: str, palette: Palette) -> None:
    """Draw the square of an entry; a hatched one where there is no colour."""
    if colour:
        painter.fillRect(square, QColor(colour))
        return
    draw_hatching(painter, square, QColor(palette.dim))
    painter.setPen(QPen(QColor(palette.dim), 1))
    painter.setBrush(Qt.BrushStyle.NoBrush)
    painter.drawRect(square)


def _tr(text: str) -> str:
    return QCoreApplication.translate("Rules", text)
