"""The edit that makes a contour even, in words."""

from typing import TYPE_CHECKING

from PySide6.QtCore import QCoreApplication

if TYPE_CHECKING:
    from hullquad.triangulation.remedies import Remedy


def edge_words(change: "Remedy") -> str:
    """The edge, by its numbers in the document."""
    if change.loop:
        return _tr("edge {edge} of hole {hole}").format(edge=change.edge, hole=change.loop - 1)
    return _tr("edge {edge}").format(edge=change.edge)


def remedy_words(change: "Remedy") -> str:
    """Name of the edit, in the menu and on its button."""
    text = _tr("Divide {edge} of {plate} in {number}")
    return text.format(edge=edge_words(change), plate=change.plate, number=change.number)


def _tr(text: str) -> str:
    return QCoreApplication.translate("RemedyWords", text)
