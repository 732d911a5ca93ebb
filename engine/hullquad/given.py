"""What the contour gives: elements that no move of free nodes can make acceptable.

Nodes on the contour and fixed ones are *held*. An element cannot be mended when all of its nodes are held; when the
bad corner lies between two held edges, for its angle and its edges are what they are; or when its held edges alone
are too unequal or too long. With what is held, a value that no place of the free nodes betters is found and judged.
"""

from collections.abc import Callable
from math import inf

import attrs
import numpy as np

from hullquad.arrays import Bools, Floats, Ints, Longs, ints
from hullquad.mesh import Mesh
from hullquad.metrics import Metric, metric
from hullquad.quality import Quality
from hullquad.topology import NodeState

Ends = tuple[float | Floats, float | Floats]
"""Least and greatest acceptable value, of all elements or of each."""

_OPEN = 1e-12
"""A corner of a smaller scaled Jacobian is of no valid element."""

_OF_ONE_CORNER = {
    key: key
    for key in (
        *("scaled_jacobian", "shear", "shape", "condition", "min_angle", "max_angle", "corner_angle"),
        *("ansys_max_corner_angle", "ansys_skewness"),
    )
} | {"shear_and_size": "shear", "shape_and_size": "shape"}
"""Metrics that are no better than what one corner has by itself, and by which metric it has that."""


def given(mesh: Mesh, judged: Quality) -> Bools:
    """(E,) which elements fail, and cannot be mended by moving nodes."""
    found = np.zeros(len(judged.values), dtype=bool)
    of_triangles = (judged.is_triangle, judged.metric.triangle_metric, judged.triangle_band)
    for is_kind, by, band in ((~judged.is_triangle, judged.metric, judged.band), of_triangles):
        rows = np.flatnonzero(judged.failing & is_kind)
        found[rows] = beyond_mending(mesh, by, band, rows)
    inverted = np.flatnonzero(~judged.valid)
    found[inverted] |= inverted_for_good(mesh, inverted)
    return found


@np.errstate(invalid="ignore", over="ignore")
def beyond_mending(mesh: Mesh, by: Metric, band: Ends, rows: Longs) -> Bools:
    """(V,) which of these elements, all outside the band, are so wherever their free nodes go."""
    found, near = _none_of(mesh, rows)
    held = _held(mesh, rows[near])
    band = _ends_of(band, near)
    stuck = _all_held(held)
    if not _accepts_inverted(by, band):
        stuck |= _has_folded_corner(mesh, held)
    if by.key in _BEST:
        stuck |= _is_beyond(band, _BEST[by.key](held))
    if by.key in _OF_ONE_CORNER:
        stuck |= _is_beyond(band, *_corner_values(mesh, metric(_OF_ONE_CORNER[by.key]), held).T)
    found[near] = stuck
    return found


@np.errstate(invalid="ignore", over="ignore")
def inverted_for_good(mesh: Mesh, rows: Longs) -> Bools:
    """(V,) which of these elements, all inverted, are so wherever their free nodes go."""
    found, near = _none_of(mesh, rows)
    held = _held(mesh, rows[near])
    found[near] = _all_held(held) | _has_folded_corner(mesh, held)
    return found


def _none_of(mesh: Mesh, rows: Longs) -> tuple[Bools, Longs]:
    """(V,) false for each element, and the numbers of those with two held nodes: of others nothing is given."""
    elements = mesh.topology.elements[rows]
    is_held = _is_held(mesh)[elements] & (elements >= 0)
    return np.zeros(len(rows), dtype=bool), np.flatnonzero(is_held.sum(axis=1) >= 2)


def _is_held(mesh: Mesh) -> Bools:
    """(N,) which nodes cannot move."""
    states = mesh.topology.node_states
    return np.asarray((states == NodeState.CONTOUR) | (states == NodeState.FIXED))


def _ends_of(band: Ends, rows: Longs) -> Ends:
    """The band of some elements where each has its own."""
    low, high = (end if np.ndim(end) == 0 else np.asarray(end)[rows] for end in band)
    return low, high


@attrs.frozen(eq=False)
class _Held:
    """Of some elements, what cannot move."""

    elements: Ints
    """(V, 4) their nodes."""
    normals: Floats
    """(V, 3) direction that they must face, at least that which they face now."""
    is_held: Bools
    """(V, 4) which corners; also the fourth one that a triangle does not have."""
    shortest: Floats
    """(V,) least length of an edge between held nodes; infinite where there is none [mm]."""
    longest: Floats
    """(V,) greatest one; 0 where there is none [mm]."""
    diagonal: Floats
    """(V,) greatest length of a diagonal between held nodes; 0 where there is none [mm]."""


_BEST: dict[str, Callable[[_Held], Floats]] = {
    "aspect_ratio": lambda held: _quotient(held.longest, held.shortest),
    "stretch": lambda held: np.sqrt(2.0) / _quotient(held.diagonal, held.shortest),
    "longest_edge": lambda held: held.longest,
}
"""(V,) a value that no place of the free nodes betters, by the key of the metric."""


def _held(mesh: Mesh, rows: Longs) -> _Held:
    elements = mesh.topology.elements[rows]
    ends = np.roll(elements, -1, axis=1)
    is_held = _is_held(mesh)
    edges, are_held = _lengths(mesh, elements, np.where(ends < 0, elements[:, :1], ends), is_held)
    diagonals, are_held_too = _lengths(mesh, elements[:, :2], elements[:, 2:], is_held)
    return _Held(
        elements=elements,
        normals=_facing(mesh, rows),
        is_held=is_held[elements] | (elements < 0),
        shortest=np.where(are_held, edges, inf).min(axis=1),
        longest=np.where(are_held, edges, 0.0).max(axis=1),
        diagonal=np.where(are_held_too, diagonals, 0.0).max(axis=1),
    )


def _all_held(held: _Held) -> Bools:
    return np.asarray(held.is_held.all(axis=1))


def _lengths(mesh: Mesh, starts: Ints, ends: Ints, is_held: Bools) -> tuple[Floats, Bools]:
    """Distances from nodes to others [mm], and between which of them neither can move."""
    are_held = is_held[starts] & is_held[ends] & (starts >= 0) & (ends >= 0)
    return np.linalg.norm(mesh.points[ends] - mesh.points[starts], axis=-1), are_held


def _facing(mesh: Mesh, rows: Longs) -> Floats:
    """(V, 3) direction that elements must face; where only their own sense is known, the one that they have."""
    a, b, c, d = (mesh.points[mesh.topology.elements[rows, corner]] for corner in range(4))
    wanted = np.broadcast_to(mesh.normals, (len(mesh.topology.elements), 3))[rows]
    return np.where(wanted.any(axis=1, keepdims=True), wanted, np.cross(c - a, d - b))


def _corner_values(mesh: Mesh, by: Metric, held: _Held) -> Floats:
    """(V, 4) what corners between two held edges have at best by themselves; nan for other corners.

    A corner is never better than in the parallelogram that its two edges span, where nothing is warped.
    """
    from hullquad.metrics.values import corner_values  # noqa: PLC0415  brings Numba: half a second

    values = np.full(held.elements.shape, np.nan)
    is_between = held.is_held & np.roll(held.is_held, 1, axis=1) & np.roll(held.is_held, -1, axis=1)
    row, corner = np.nonzero(is_between & (held.elements[:, 3:] >= 0))
    if len(row):
        before, at, after = (mesh.points[held.elements[row, (corner + step) % 4]] for step in (-1, 0, 1))
        points = np.stack([before, at, after, before + after - at], axis=1).reshape(-1, 3)
        spanned = np.arange(len(points)).reshape(-1, 4)
        values[row, corner] = corner_values(by, points, ints(spanned), held.normals[row])[:, 1]
    return values


def _has_folded_corner(mesh: Mesh, held: _Held) -> Bools:
    """(V,) whether a corner between two held edges is none of a valid element."""
    return _is_beyond((_OPEN, inf), *_corner_values(mesh, metric("scaled_jacobian"), held).T)


def _accepts_inverted(by: Metric, band: Ends) -> bool:
    """Whether the metric may have an acceptable value where an element is inverted."""
    least, most = by.invalid
    return bool(np.any((most >= np.asarray(band[0])) & (least <= np.asarray(band[1]))))


def _is_beyond(band: Ends, *values: Floats) -> Bools:
    """(V,) whether any of an element's values is outside the band; those that are no numbers do not count."""
    low, high = band
    return np.asarray(np.any([(each < low) | (each > high) for each in values], axis=0))


def _quotient(dividend: Floats, divisor: Floats) -> Floats:
    """The quotient, at least 1; infinite where the divisor is 0."""
    with np.errstate(divide="ignore", invalid="ignore"):
        return np.where(divisor > 0.0, np.maximum(dividend / divisor, 1.0), inf)
