"""Triangles that a finished mesh has beside the unavoidable ones: which they are, and why they are left."""

from enum import Enum

from hullquad.mesh import Mesh
from hullquad.plate import Notice
from hullquad.quads.settings import Preference

_NAMED = 3
"""Elements that are named; of more it is told how many."""


class Cause(Enum):
    """Why a mesher leaves triangles that could be avoided: cases of the sentence W_TRIANGLES."""

    NO_WAY = ""
    """None of its changes takes them out with valid elements only."""
    PAPER = "paper"
    """It joins triangles and does nothing else."""
    QUALITY = "quality"
    """The worst element is better with them."""


def cause_of(prefer: Preference) -> Cause:
    """Why the best mesher leaves triangles."""
    return Cause.QUALITY if prefer is Preference.QUALITY else Cause.NO_WAY


def remaining_triangles(mesh: Mesh, place: str, cause: Cause) -> Notice | None:
    """A warning of the triangles of a new mesh, if it has more than the plate asks for."""
    topology = mesh.topology
    excess = len(topology.triangles) - mesh.triangles_unavoidable
    if excess <= 0 or mesh.parameters is None:
        return None
    labels = topology.element_labels[topology.is_triangle].tolist()
    middles = mesh.parameters[topology.triangles].mean(axis=1).tolist()
    named = [f"{label} at ({u:.4g}, {v:.4g})" for label, (u, v) in zip(labels, middles, strict=True)][:_NAMED]
    more = f" and {len(labels) - _NAMED} more" if len(labels) > _NAMED else ""
    numbers = {"excess": excess, "which": ", ".join(named) + more, "unavoidable": mesh.triangles_unavoidable}
    return Notice("W_TRIANGLES", place, cause.value, numbers)
