"""A region of the plane as Triangle gets it: loops of contour nodes and points inside."""

from functools import cached_property

import attrs
import numpy as np
import shapely

from hullquad.arrays import Floats, Longs, floats, longs
from hullquad.triangulation.clearance import segments


@attrs.frozen(eq=False)
class Region:
    """A polygon with holes, and points inside it."""

    nodes: Floats = attrs.field(converter=floats)
    """(K, 2) loop after loop, the outer one counter-clockwise, the holes clockwise; then the points inside."""
    starts: Longs = attrs.field(converter=longs)
    """(L + 1,) loop i is ``nodes[starts[i]:starts[i + 1]]``."""

    @cached_property
    def contour(self) -> Floats:
        """(C, 2) nodes of all loops."""
        return self.nodes[: self.starts[-1]]

    @cached_property
    def inside(self) -> Floats:
        """(P, 2) points inside."""
        return self.nodes[self.starts[-1] :]

    @cached_property
    def loops(self) -> list[Floats]:
        """Nodes of each loop."""
        return np.split(self.contour, self.starts[1:-1])

    @cached_property
    def edges(self) -> Longs:
        """(C, 2) nodes of the contour's edges."""
        return segments(len(self.contour), self.starts.tolist())

    @cached_property
    def polygon(self) -> shapely.Polygon:
        """The region without the points inside."""
        return shapely.Polygon(self.loops[0], self.loops[1:])

    @cached_property
    def tolerance(self) -> float:
        """Distance below which things touch: what double precision can tell apart, with room to spare."""
        diagonal = np.hypot(*np.ptp(self.nodes, axis=0))
        return float(max(1e-9 * diagonal, 64 * np.spacing(np.abs(self.nodes).max())))

    @cached_property
    def hole_points(self) -> Floats:
        """(H, 2) a point strictly inside each hole."""
        return floats(np.reshape([_inner_point(loop) for loop in self.loops[1:]], (-1, 2)))


@attrs.frozen(eq=False)
class Box:
    """A box of size one around the origin, to which coordinates are brought: large ones cost Triangle digits.

    The scale is a power of two, so that scaling changes no digit.
    """

    centre: Floats = attrs.field(converter=floats)
    exponent: int

    def into(self, points: Floats) -> Floats:
        """(N, 2) places in the box."""
        return np.ldexp(points - self.centre, -self.exponent)

    def out_of(self, places: Floats) -> Floats:
        """(N, 2) points of places in the box."""
        return np.ldexp(places, self.exponent) + self.centre

    def area_into(self, area: float) -> float:
        """An area measured in the box."""
        return float(np.ldexp(area, -2 * self.exponent))


def box_around(points: Floats) -> Box:
    """Box of (N, 2) points."""
    low, high = points.min(axis=0), points.max(axis=0)
    return Box((low + high) / 2, int(np.frexp(np.hypot(*(high - low)))[1]))


def _inner_point(loop: Floats) -> Floats:
    """A point strictly inside a loop; in the narrowest slit the corners' own triangles are the last resort."""
    hole = shapely.Polygon(loop)
    usual = hole.representative_point()
    if shapely.contains_properly(hole, usual):
        return floats([usual.x, usual.y])
    corners = np.stack([np.roll(loop, 1, axis=0), loop, np.roll(loop, -1, axis=0)], axis=1)
    candidates = corners.mean(axis=1)
    inside = shapely.contains_properly(hole, shapely.points(candidates))
    return floats(candidates[np.argmax(inside)])
