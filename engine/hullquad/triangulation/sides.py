r"""The regions that lines divide a plate into, by their sides: a side is a segment with the region on its left.

A segment of the contour is one side, a segment of a line is two, one for each direction. Around every node the sides
that leave it part the plate into corners, from one side counter-clockwise to the next segment::

         \  corner of a  /
        b \      .      / a        side a leaves the node, with its region on its left;
           \     .     /           the side that arrives along b is followed by a
            '----o----'

So there are as many corners as sides. A line that ends inside a region has that region on both of its sides.
"""

from functools import cached_property

import attrs
import numpy as np
import shapely

from hullquad.arrays import Floats, Longs, floats, longs


@attrs.frozen(eq=False)
class Sides:
    """Sides of all regions."""

    nodes: Floats = attrs.field(converter=floats)
    """(N, 2) [mm]"""
    ends: Longs = attrs.field(converter=longs)
    """(S, 2) nodes of each side: those of the contour, then those of the lines one way, then the other way."""
    contour: int
    """Number of sides of the contour."""

    @property
    def lines(self) -> int:
        """Number of segments of lines."""
        return (len(self.ends) - self.contour) // 2

    @cached_property
    def following(self) -> Longs:
        """(S,) side that follows each one around its region."""
        return self._corners[0]

    @cached_property
    def angles(self) -> Floats:
        """(S,) angle of the corner from which each side leaves [rad]; a full turn where a line ends inside."""
        return self._corners[1]

    @cached_property
    def headings(self) -> Floats:
        """(S,) direction of each side [rad]."""
        along = self.nodes[self.ends[:, 1]] - self.nodes[self.ends[:, 0]]
        return floats(np.arctan2(along[:, 1], along[:, 0]))

    @cached_property
    def cycles(self) -> Longs:
        """(S,) number of the closed row of sides that each one belongs to."""
        return connected_parts(len(self.ends), np.arange(len(self.ends)), self.following)

    @cached_property
    def regions(self) -> Longs:
        """(S,) region of each side, from 0 on in the order of the sides."""
        outer = self._outer_cycles
        _, numbers = np.unique(outer[self.cycles], return_inverse=True)
        first = np.full(numbers.max() + 1, len(numbers))
        np.minimum.at(first, numbers, np.arange(len(numbers)))
        return longs(np.argsort(np.argsort(first))[numbers])

    @cached_property
    def odd(self) -> Longs:
        """Regions with an odd number of sides: each of them is left with a triangle."""
        return longs(np.flatnonzero(np.bincount(self.regions) % 2))

    @cached_property
    def fitting(self) -> Longs:
        """(S,) number of elements that fit best into each corner."""
        return fitting_elements(self.angles)

    @cached_property
    def four_sided(self) -> dict[int, tuple[Longs, ...]]:
        """Regions with four corners for one element each and two everywhere else: the sides from corner to corner."""
        return {region: parts for region, parts in self._convex.items() if len(parts) == 4}

    @cached_property
    def three_sided(self) -> dict[int, tuple[Longs, ...]]:
        """The same of regions with three such corners."""
        return {region: parts for region, parts in self._convex.items() if len(parts) == 3}

    @cached_property
    def _convex(self) -> dict[int, tuple[Longs, ...]]:
        """Regions with corners for one element each and two everywhere else: the sides from corner to corner."""
        cycles_of = np.bincount(self.regions[np.unique(self.cycles, return_index=True)[1]])
        firsts = np.unique(self.regions, return_index=True)[1]
        found = {}
        for region in np.flatnonzero(cycles_of == 1).tolist():
            row = self.row(int(firsts[region]))
            fitting = self.fitting[row]
            corners = np.flatnonzero(fitting == 1)
            if len(corners) and (np.delete(fitting, corners) == 2).all():
                _, *parts = np.split(np.concatenate([row, row[: corners[0]]]), corners)
                found[region] = tuple(map(longs, parts))
        return found

    def row(self, side: int) -> Longs:
        """Sides of a cycle, beginning with one of them."""
        found = [side]
        while (ahead := int(self.following[found[-1]])) != side:
            found.append(ahead)
        return longs(found)

    @cached_property
    def _corners(self) -> tuple[Longs, Floats]:
        """Following side, and angle of the corner, of every side."""
        count, lines = len(self.ends), self.lines
        twins = np.full(count, -1)
        twins[self.contour :] = np.roll(np.arange(self.contour, count), lines)
        arriving = np.arange(self.contour)  # segments of the contour leave their last node without a side
        spoke_nodes = np.concatenate([self.ends[:, 0], self.ends[arriving, 1]])
        turned = np.where(self.headings[arriving] > 0, self.headings[arriving] - np.pi, self.headings[arriving] + np.pi)
        directions = np.concatenate([self.headings, turned])
        order = np.lexsort((directions, spoke_nodes))
        place = np.empty_like(order)
        place[order] = np.arange(len(order))
        starts = np.searchsorted(spoke_nodes[order], spoke_nodes[order], side="left")
        stops = np.searchsorted(spoke_nodes[order], spoke_nodes[order], side="right")
        back = np.where(twins < 0, count + np.arange(count), twins)  # spoke on which each side arrives
        at = place[back]
        before = order[np.where(at == starts[at], stops[at] - 1, at - 1)]  # clockwise from it
        leaving, coming = directions[before], self.headings + np.pi
        angles = np.empty(count)
        angles[before] = np.where(before == back, 2 * np.pi, (coming - leaving) % (2 * np.pi))
        return longs(before), floats(angles)

    @cached_property
    def _outer_cycles(self) -> Longs:
        """(C,) for each cycle the one that bounds its region from outside."""
        count = int(self.cycles.max()) + 1
        start, end = self.nodes[self.ends].transpose(1, 0, 2) - self.nodes[0]
        areas = np.bincount(self.cycles, start[:, 0] * end[:, 1] - start[:, 1] * end[:, 0], minlength=count)
        parts = connected_parts(len(self.nodes), *self.ends.T)
        part_of = np.empty(count, dtype=np.int64)
        part_of[self.cycles] = parts[self.ends[:, 0]]
        outer = np.arange(count)
        inner = [
            min(np.flatnonzero(part_of == part), key=lambda cycle: areas[cycle])
            for part in np.unique(part_of)
            if part != parts[self.ends[0, 0]]
        ]
        if inner:
            outside = np.setdiff1d(outer, inner)
            rings = [self._polygon(cycle) for cycle in outside]
            tree = shapely.STRtree(rings)
            for cycle in inner:
                point = shapely.Point(self.nodes[self.ends[np.argmax(self.cycles == cycle), 0]])
                around = [
                    int(outside[i])
                    for i in tree.query(point)
                    if part_of[outside[i]] != part_of[cycle] and shapely.contains_xy(rings[i], point.x, point.y)
                ]
                outer[cycle] = min(around, key=lambda other: areas[other])
        return longs(outer)

    def _polygon(self, cycle: int) -> shapely.Polygon:
        row = self.row(int(np.argmax(self.cycles == cycle)))
        return shapely.Polygon(self.nodes[self.ends[row, 0]]) if len(row) > 2 else shapely.Polygon()


def sides(nodes: Floats, contour: Longs, lines: Longs) -> Sides:
    """Sides of the (E, 2) segments of a contour and the (K, 2) segments of lines."""
    return Sides(nodes, np.concatenate([contour, lines, lines[:, ::-1]]), len(contour))


def fitting_elements(angles: Floats) -> Longs:
    """Number of elements that fit best into corners [rad]: to the nearest right angle, at least one."""
    return longs(np.maximum(1, np.round(angles / (np.pi / 2))))


def connected_parts(count: int, one: Longs, other: Longs) -> Longs:
    """(count,) number of the connected part of each of so many things, of which some are joined."""
    from scipy import sparse  # noqa: PLC0415  a quarter of a second, and few need it
    from scipy.sparse.csgraph import connected_components  # noqa: PLC0415

    graph = sparse.coo_array((np.ones(len(one), dtype=bool), (one, other)), shape=(count, count))
    return longs(connected_components(graph, directed=False)[1])
