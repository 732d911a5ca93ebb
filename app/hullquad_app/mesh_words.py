"""What goes on while a plate is meshed, and what has come of it, in words that fit a label."""

from collections.abc import Iterable
from typing import TYPE_CHECKING

from PySide6.QtCore import QT_TRANSLATE_NOOP, QCoreApplication

from hullquad.mesh import Mesh
from hullquad_app.count_words import number_of
from hullquad_app.mesher import BEST, PAPER

if TYPE_CHECKING:
    from hullquad.pipeline import MeshStage

STEPS = {
    "mapped": str(QT_TRANSLATE_NOOP("MeshWords", "laid out as grids")),
    "triangulated": str(QT_TRANSLATE_NOOP("MeshWords", "triangulated")),
    "joined": str(QT_TRANSLATE_NOOP("MeshWords", "triangles joined to quads")),
    "repaired": str(QT_TRANSLATE_NOOP("MeshWords", "triangles repaired")),
    "cleaned": str(QT_TRANSLATE_NOOP("MeshWords", "cleaned up")),
    "smoothed": str(QT_TRANSLATE_NOOP("MeshWords", "smoothed")),
    "shaken": str(QT_TRANSLATE_NOOP("MeshWords", "shaken and smoothed again")),
}
_MESHERS = {
    BEST: str(QT_TRANSLATE_NOOP("MeshWords", "best")),
    PAPER: str(QT_TRANSLATE_NOOP("MeshWords", "paper")),
}


def step_words(step: str) -> str:
    """What has just been done, by the value of its `Step`."""
    return _tr(STEPS[step]) if step in STEPS else step


def mesher_words(name: str) -> str:
    """Name of a mesher."""
    return _tr(_MESHERS[name])


def stage_progress(plate: str, stage: "MeshStage") -> str:
    """How far a plate is."""
    text = _tr("Meshing {plate}: {step}")
    if stage.candidates > 1:
        text = _tr("Meshing {plate}: {step}, candidate {number} of {count}")
    words = step_words(stage.step.value)
    return text.format(plate=plate, step=words, number=stage.candidate + 1, count=stage.candidates)


def element_words(meshes: Iterable[Mesh]) -> str:
    """``1 triangle, 26 quads``, of all meshes together."""
    grids = [mesh.topology for mesh in meshes]
    triangles, quads = sum(len(grid.triangles) for grid in grids), sum(len(grid.quads) for grid in grids)
    return ", ".join([number_of("triangle", triangles)] * bool(triangles) + [number_of("quad", quads)])


def _tr(text: str) -> str:
    return QCoreApplication.translate("MeshWords", text)
