"""What the contour gives: elements whose quality no move of free nodes can make acceptable.

Nodes on the contour and fixed ones are *held*. An element cannot be mended when all of its nodes are held; when the
bad corner lies between two held edges, for its angle is what it is; or when its held edges alone are too unequal or
too long.
"""

from collections.abc import Callable

import attrs
import numpy as np

from hullquad.arrays import Bools, Floats, Ints, Longs
from hullquad.mesh import Mesh
from hullquad.metrics import Band
from hullquad.quality import Quality
from hullquad.topology import NodeState

_HELD = (NodeState.CONTOUR, NodeState.FIXED)


def given(mesh: Mesh, judged: Quality) -> Bools:
    """(E,) which elements fail, and cannot be mended by moving nodes."""
    found = np.zeros(len(judged.values), dtype=bool)
    for is_kind, band in ((~judged.is_triangle, judged.band), (judged.is_triangle, judged.metric.triangle_band)):
        rows = np.flatnonzero(judged.failing & is_kind)
        found[rows] = beyond_mending(mesh, judged, band, rows)
    return found


def beyond_mending(mesh: Mesh, judged: Quality, band: Band, rows: Longs) -> Bools:
    """(V,) which of these failing elements are outside the band wherever their free nodes go."""
    held = _held(mesh, rows)
    found: Bools = np.asarray(held.is_held.all(axis=1))
    best = _BEST.get(judged.metric.key)
    if best is not None:
        applies = ~judged.is_triangle[rows] | (judged.metric.triangles is not None)
        with np.errstate(divide="ignore", invalid="ignore"):
            found |= applies & ~judged.metric.is_within(band, best(held))
    return found


def inverted_for_good(mesh: Mesh, rows: Longs) -> Bools:
    """(V,) which of these elements are inverted wherever their free nodes go."""
    return np.asarray(_held(mesh, rows).is_held.all(axis=1))


@attrs.frozen(eq=False)
class _Held:
    """What cannot move of some elements."""

    is_held: Bools
    """(V, 4) which corners; also the fourth one that a triangle does not have."""
    shortest: Floats
    """(V,) least length of an edge between held nodes; infinite where there is none [mm]."""
    longest: Floats
    """(V,) greatest one; 0 where there is none [mm]."""
    diagonal: Floats
    """(V,) greatest length of a diagonal between held nodes; 0 where there is none [mm]."""


_BEST: dict[str, Callable[[_Held], Floats]] = {
    "aspect_ratio": lambda held: np.maximum(held.longest / held.shortest, 1.0),
    "stretch": lambda held: np.minimum(np.sqrt(2.0) * held.shortest / held.diagonal, 1.0),
    "longest_edge": lambda held: held.longest,
}
"""(V,) a value that no place of the free nodes betters, by the key of the metric."""


def _held(mesh: Mesh, rows: Longs) -> _Held:
    elements = mesh.topology.elements[rows]
    ends = np.roll(elements, -1, axis=1)
    is_held = np.isin(mesh.topology.node_states, _HELD)
    edges, are_held = _lengths(mesh, elements, np.where(ends < 0, elements[:, :1], ends), is_held)
    diagonals, are_held_too = _lengths(mesh, elements[:, :2], elements[:, 2:], is_held)
    return _Held(
        is_held=is_held[elements] | (elements < 0),
        shortest=np.where(are_held, edges, np.inf).min(axis=1),
        longest=np.where(are_held, edges, 0.0).max(axis=1),
        diagonal=np.where(are_held_too, diagonals, 0.0).max(axis=1),
    )


def _lengths(mesh: Mesh, starts: Ints, ends: Ints, is_held: Bools) -> tuple[Floats, Bools]:
    """Distances from nodes to others [mm], and between which of them neither can move."""
    are_held = is_held[starts] & is_held[ends] & (starts >= 0) & (ends >= 0)
    return np.linalg.norm(mesh.points[ends] - mesh.points[starts], axis=-1), are_held
