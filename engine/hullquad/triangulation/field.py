r"""Directions and sizes that elements should have everywhere in a plate, from the segments of its contour.

Followed lines are segments of the contours of the regions that they divide the plate into: each region is by itself.

On a coarse background triangulation live five numbers per node: the **cross** (cos 4a, sin 4a), which is the same for
a direction and for those a quarter turn away, and the **size**, a symmetric matrix M: an edge along the unit vector t
should be t' M t long. Each segment of the contour wants its own direction and, along itself, its own length; in
between the fields are as smooth as can be (they solve Laplace's equation). So a rectangle has the spacing of one pair
of sides one way and of the other pair the other way.

Segments that are much shorter than the element size, at slots and small holes, are **fine seeds** instead: no element
is larger than the length of such a segment plus the grading times the distance from it.
"""

import attrs
import numpy as np
from scipy import sparse

from hullquad.arrays import Floats, Ints, Longs, floats, longs
from hullquad.topology import paired_sides
from hullquad.triangulation.contour import Contour
from hullquad.triangulation.delaunay import triangulate
from hullquad.triangulation.sides import Sides
from hullquad.triangulation.solving import solved

BACKGROUND_AREA = 2.0
"""Largest background triangle over the square of the element size."""

BACKGROUND_ANGLE = 20.0

SHORT = 0.6
"""Segments below this part of the element size are fine ones."""

GRADING = 0.4
"""By how much elements may grow per length."""

_STIFFNESS = 1e3
"""Weight of what a segment wants over the smoothness of the field."""

_FAINT = 1e-6
"""Weight that keeps a field without any wish where it is."""


@attrs.frozen(eq=False, kw_only=True)
class Field:
    """Cross and size on a background triangulation."""

    nodes: Floats = attrs.field(converter=floats)
    """(B, 2) those of the contour first, cut along followed lines [mm]."""
    triangles: Longs = attrs.field(converter=longs)
    """(S, 3)"""
    neighbours: Longs = attrs.field(converter=longs)
    """(S, 3) triangle across the side from corner i to corner i + 1, -1 on the contour and on followed lines."""
    values: Floats = attrs.field(converter=floats)
    """(B, 5) cos 4a, sin 4a and m1, m2, m3 of M = [[m1 + m2, m3], [m3, m1 - m2]] [mm]."""
    seeds: Floats = attrs.field(converter=floats)
    """(F, 3) middle and length of every fine segment [mm]."""
    grading: float
    """By how much elements may grow per length."""


def field(contour: Contour, grading: float = GRADING) -> Field:
    """Field of a plate.

    Raises
    ------
    MeshingError, WorkerError
        The plate could not be triangulated.
    """
    place = contour.plate.place
    ground = triangulate(
        contour.nodes,
        contour.loop_starts,
        area=BACKGROUND_AREA * contour.size**2,
        min_angle=BACKGROUND_ANGLE,
        place=place,
        lines=contour.line_edges,
    )
    nodes, triangles = contour.cut.cut(ground.nodes, ground.triangles)
    stiffness = _stiffness(nodes, triangles)
    wishes = _Wishes(contour, len(nodes))
    return Field(
        nodes=nodes,
        triangles=triangles,
        neighbours=_neighbours(triangles),
        values=np.hstack([_crosses(stiffness, wishes, place), _sizes(stiffness, wishes, contour.size, place)]),
        seeds=wishes.seeds,
        grading=grading,
    )


class _Wishes:
    """What the sides of a contour's regions want, at both of their ends."""

    def __init__(self, contour: Contour, nodes: int) -> None:
        cut, around = contour.cut, contour.sides
        ends = cut.segments
        along = cut.nodes[ends[:, 1]] - cut.nodes[ends[:, 0]]
        self.nodes = nodes
        self.ends = ends.ravel()
        self.lengths = np.repeat(np.hypot(*along.T), 2)
        self.angles = np.repeat(around.headings, 2)
        is_fine = self.lengths[::2] < SHORT * contour.size
        self.is_normal = np.repeat(~is_fine, 2)
        middles = cut.nodes[ends].mean(axis=1)
        self.seeds = np.column_stack([middles, self.lengths[::2]])[is_fine]
        self.crosses = 4 * _arms(around)


def _arms(around: Sides) -> Floats:
    """(S,) angle of the cross that fits best into the corner from which each side leaves [rad].

    The arms share the corner out evenly: between as many elements as fit, to the nearest right angle.
    """
    return floats(around.headings + around.angles / 2 + np.where(around.fitting % 2 == 1, np.pi / 4, 0.0))


def _crosses(stiffness: sparse.csc_array, wishes: _Wishes, place: str) -> Floats:
    """(B, 2) cos 4a and sin 4a, not of unit length."""
    rim = len(wishes.crosses)
    weight = np.where(np.arange(wishes.nodes) < rim, _STIFFNESS, _FAINT)
    wanted = np.zeros((wishes.nodes, 2))
    wanted[:rim] = _STIFFNESS * np.stack([np.cos(wishes.crosses), np.sin(wishes.crosses)], axis=1)
    return solved((stiffness + sparse.diags_array(weight)).tocsc(), wanted, place)


def _sizes(stiffness: sparse.csc_array, wishes: _Wishes, size: float, place: str) -> Floats:
    """(B, 3) m1, m2, m3: the smoothest for which every segment that is not fine has its length along itself."""
    count, chosen = wishes.nodes, wishes.is_normal
    double = 2 * wishes.angles[chosen]
    factors = np.stack([np.ones_like(double), np.cos(double), np.sin(double)])
    right = np.zeros((3, count))
    right[0] = _FAINT * size
    for i in range(3):
        right[i] += _STIFFNESS * np.bincount(wishes.ends[chosen], factors[i] * wishes.lengths[chosen], minlength=count)
    matrix = _size_matrix(stiffness, wishes.ends[chosen], factors)
    return _tamed(solved(matrix, right.ravel(), place).reshape(3, count).T, np.append(wishes.lengths[chosen], size))


def _size_matrix(stiffness: sparse.csc_array, ends: Longs, factors: Floats) -> sparse.csc_array:
    """(3B, 3B) smoothness of m1, m2, m3, and the wishes at the ends of segments, which bring the three together."""
    count, at = stiffness.shape[0], np.unique(ends)
    own = (stiffness + sparse.diags_array(np.full(count, _FAINT))).tocoo()
    wishes = [_STIFFNESS * np.bincount(ends, one * other, minlength=count)[at] for one in factors for other in factors]
    shifts = count * np.arange(3)[:, None]
    rows = np.concatenate([(own.row + shifts).ravel(), (at + np.repeat(shifts, 3, axis=0)).ravel()])
    columns = np.concatenate([(own.col + shifts).ravel(), (at + np.tile(shifts, (3, 1))).ravel()])
    values = np.concatenate([np.tile(own.data, 3), *wishes])
    return sparse.coo_array((values, (rows, columns)), shape=(3 * count, 3 * count)).tocsc()


def _tamed(sizes: Floats, lengths: Floats) -> Floats:
    """Sizes within those of segments that are not fine, and no more than three times as long one way as the other."""
    mean = np.clip(sizes[:, 0], lengths.min(), lengths.max())
    excess = np.hypot(sizes[:, 1], sizes[:, 2]) / (0.5 * mean)
    return floats(np.column_stack([mean, sizes[:, 1:] / np.maximum(excess, 1.0)[:, None]]))


def _stiffness(nodes: Floats, triangles: Ints) -> sparse.csc_array:
    """(B, B) stiffness of linear elements; an obtuse angle counts as a right one."""
    corners = nodes[triangles]
    following, last = np.roll(corners, -1, axis=1), np.roll(corners, 1, axis=1)
    u, w = following - corners, last - corners
    doubled = u[..., 0] * w[..., 1] - u[..., 1] * w[..., 0]
    weights = np.maximum(0.5 * (u * w).sum(axis=2) / doubled, 0.01)  # cotangent at a corner: of the side opposite
    one, other = np.roll(triangles, -1, axis=1).ravel(), np.roll(triangles, 1, axis=1).ravel()
    count = len(nodes)
    where = (np.concatenate([one, other]), np.concatenate([other, one]))
    pulls = sparse.coo_array((np.tile(weights.ravel(), 2), where), shape=(count, count)).tocsc()
    return (sparse.diags_array(np.asarray(pulls.sum(axis=0)).ravel()) - pulls).tocsc()


def _neighbours(triangles: Ints) -> Longs:
    sides = np.stack([triangles, np.roll(triangles, -1, axis=1)], axis=2).reshape(-1, 2)
    one, other = paired_sides(sides)
    found = np.full(len(sides), -1)
    found[one], found[other] = other // 3, one // 3
    return longs(found.reshape(-1, 3))
