r"""Pairs of neighbouring triangles that could be joined to a quad, and how good each quad would be.

::

        w                  triangles  u v w  and  v u x  have the edge u-v in common;
       /|\                 without it they are the quad  w u x v
      / | \
     v--+--u               (drawn lying: the edge u-v is the one taken out)
      \ | /
       \|/
        x
"""

import attrs
import numpy as np

from hullquad.arrays import Bools, Floats, Ints, Longs, floats, ints
from hullquad.metrics import metric
from hullquad.metrics.values import judged_values
from hullquad.topology import paired_sides

LEAST_SCALED_JACOBIAN = 0.02
LARGEST_ANGLE = 178.0
"""[degrees]; a joined quad must be better than both."""

HOPE = 0.01
"""Score of a quad that is not acceptable as it is, but may be when its free nodes have moved."""


@attrs.frozen(eq=False, kw_only=True)
class Pairs:
    """Neighbours of every triangle and the quads they would make."""

    triangles: Ints = attrs.field(converter=ints)
    """(T, 3) nodes."""
    neighbours: Ints = attrs.field(converter=ints)
    """(T, 3) triangle across each edge, -1 at the contour and at a constraint line."""
    pair_across: Ints = attrs.field(converter=ints)
    """(T, 3) pair made with the triangle across each edge, -1 where there is no acceptable one."""
    members: Ints = attrs.field(converter=ints)
    """(P, 2) triangles of each acceptable pair."""
    quads: Ints = attrs.field(converter=ints)
    """(P, 4) nodes of each pair's quad, in the sense of the triangles."""
    scores: Floats = attrs.field(converter=floats)
    """(P,) (shape * stretch * scaled Jacobian)^(1/3), from 0 to 1."""

    @property
    def at_rim(self) -> Bools:
        """(T,) triangles with an edge on the contour or on a constraint line."""
        return np.asarray((self.neighbours < 0).any(axis=1))


def pairs(
    points: Floats, triangles: Ints, normals: Floats, constraints: Ints | None = None, held: int | None = None
) -> Pairs:
    """Acceptable pairs: convex, scaled Jacobian above 0.02, largest angle below 178 degrees.

    Parameters
    ----------
    points : (N, 3) float array
        [mm]
    triangles : (T, 3) int array
        Counter-clockwise against the normal.
    normals : (1, 3) float array
        Normal of the plate.
    constraints : (K, 2) int array, optional
        Edges that must stay.
    held : int, optional
        So many nodes, the first ones, cannot be moved; pairs that moving the others may mend are then acceptable
        too, with the least of scores.
    """
    one, other, side, other_side = _common_edges(triangles, constraints)
    quads = np.stack(
        [
            triangles[one, (side + 2) % 3],
            triangles[one, side],
            triangles[other, (other_side + 2) % 3],
            triangles[one, (side + 1) % 3],
        ],
        axis=1,
    ).astype(np.int32)
    scores, acceptable = _judged(points, quads, normals)
    neighbours, pair_across = np.full((2, *triangles.shape), -1, dtype=np.int32)
    neighbours[one, side], neighbours[other, other_side] = other, one
    if held is not None:
        rest = np.flatnonzero(~acceptable)
        ways = (one[rest], side[rest]), (other[rest], other_side[rest])
        hopeful = rest[_may_be_mended(points, quads[rest], normals, neighbours, *ways, held)]
        scores[hopeful], acceptable[hopeful] = HOPE, True
    row = np.where(acceptable, np.cumsum(acceptable) - 1, -1)
    pair_across[one, side] = pair_across[other, other_side] = row
    return Pairs(
        triangles=triangles,
        neighbours=neighbours,
        pair_across=pair_across,
        members=np.stack([one, other], axis=1)[acceptable],
        quads=quads[acceptable],
        scores=scores[acceptable],
    )


def _common_edges(triangles: Ints, constraints: Ints | None) -> tuple[Longs, Longs, Longs, Longs]:
    """Triangles on both sides of every edge that may go, and the edge's place (0..2) in each."""
    sides = np.stack([triangles, np.roll(triangles, -1, axis=1)], axis=2).reshape(-1, 2)
    first, second = paired_sides(sides)
    if constraints is not None and len(constraints):
        nodes = int(triangles.max()) + 1
        kept = np.sort(constraints, axis=1) @ np.array([nodes, 1])
        stays = np.isin(np.sort(sides[first], axis=1) @ np.array([nodes, 1]), kept)
        first, second = first[~stays], second[~stays]
    return first // 3, second // 3, first % 3, second % 3


def _judged(points: Floats, quads: Ints, normals: Floats) -> tuple[Floats, Bools]:
    """Scores of all quads and which are acceptable."""
    shape, valid = judged_values(metric("shape"), points, quads, normals)
    stretch, _ = judged_values(metric("stretch"), points, quads, normals)
    scaled_jacobian, _ = judged_values(metric("scaled_jacobian"), points, quads, normals)
    max_angle, _ = judged_values(metric("max_angle"), points, quads, normals)
    acceptable = valid & (scaled_jacobian > LEAST_SCALED_JACOBIAN) & (max_angle < LARGEST_ANGLE)
    return np.cbrt(np.maximum(0.0, shape * stretch * scaled_jacobian)), acceptable


def _may_be_mended(
    points: Floats,
    quads: Ints,
    normals: Floats,
    neighbours: Ints,
    first: tuple[Longs, Longs],
    second: tuple[Longs, Longs],
    held: int,
) -> Bools:
    """Which quads can be made convex by moving nodes: no bad corner is given by two edges of the contour."""
    (one, side), (other, other_side) = first, second
    on_rim = np.stack(  # sides of the quad, from each node to the next
        [
            neighbours[one, (side + 2) % 3] < 0,
            neighbours[other, (other_side + 1) % 3] < 0,
            neighbours[other, (other_side + 2) % 3] < 0,
            neighbours[one, (side + 1) % 3] < 0,
        ],
        axis=1,
    )
    corners = points[quads]
    ahead, back = np.roll(corners, -1, axis=1) - corners, np.roll(corners, 1, axis=1) - corners
    jacobians = np.cross(ahead, back) @ normals[0]
    is_flat = jacobians < 0.03 * np.linalg.norm(ahead, axis=2) * np.linalg.norm(back, axis=2)
    is_given = on_rim & np.roll(on_rim, 1, axis=1)
    return np.asarray(~(is_flat & is_given).any(axis=1) & (quads >= held).any(axis=1))
