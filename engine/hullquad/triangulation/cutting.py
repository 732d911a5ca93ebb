"""A plate cut along its followed lines: there every region has nodes of its own, so that nothing can join across.

What is made of the cut plate, triangles or elements, is glued together again afterwards: lines are then rows of element
edges. A plate without lines is cut nowhere, and keeps the numbers of its nodes.
"""

from functools import cached_property

import attrs
import numpy as np

from hullquad.arrays import Floats, Ints, Longs, floats, ints, longs
from hullquad.topology import paired_sides
from hullquad.triangulation.sides import Sides, connected_parts


@attrs.frozen(eq=False)
class Cut:
    """Nodes that are given, once for each corner that they have at the sides of regions."""

    around: Sides
    given: int
    """Number of nodes that are given; further ones are free."""

    @cached_property
    def originals(self) -> Longs:
        """(C,) given node of each cut one: of the node from which each side leaves, then of those on no side."""
        return longs(np.concatenate([self.around.ends[:, 0], self._alone]))

    @cached_property
    def nodes(self) -> Floats:
        """(C, 2) places of the cut nodes [mm]."""
        return floats(self.around.nodes[self.originals])

    @cached_property
    def segments(self) -> Longs:
        """(S, 2) cut nodes of each side, with its region on the left."""
        return longs(np.stack([np.arange(len(self.around.ends)), self.around.following], axis=1))

    def cut(self, nodes: Floats, triangles: Ints) -> tuple[Floats, Ints]:
        """Nodes and triangles of the cut plate: cut nodes, then the free ones."""
        if not self.around.lines:
            return nodes, triangles
        corners, corner_sides = self._corners(triangles)
        count, free = len(self.originals), len(nodes) - self.given
        numbers = np.concatenate([np.full(self.given, -1), count + np.arange(free)])
        numbers[self._alone] = len(self.around.ends) + np.arange(len(self._alone))
        labels = np.full(corners.max() + 1, -1)
        labels[corners[corner_sides >= 0]] = corner_sides[corner_sides >= 0]
        found = np.where(numbers[triangles.ravel()] >= 0, numbers[triangles.ravel()], labels[corners])
        return floats(np.concatenate([self.nodes, nodes[self.given :]])), ints(found.reshape(-1, 3))

    def glued(self, nodes: Floats, elements: Ints) -> tuple[Floats, Ints]:
        """Nodes and elements of the whole plate from those of the cut one."""
        count = len(self.originals)
        numbers = np.concatenate([self.originals, self.given + np.arange(len(nodes) - count), [-1]])
        return floats(np.concatenate([self.around.nodes[: self.given], nodes[count:]])), ints(numbers[elements])

    def regions(self, elements: Ints) -> Longs:
        """(E,) region of each element of the cut plate."""
        if not self.around.lines:
            return longs(np.full(len(elements), self.around.regions[0]))
        real = elements >= 0
        first = np.broadcast_to(elements[:, :1], elements.shape)[real]
        nodes = int(elements.max(initial=0)) + 1
        parts = connected_parts(max(nodes, len(self.originals)), longs(first), longs(elements[real]))
        of_part = np.full(int(parts.max()) + 1, -1)
        of_part[parts[: len(self.around.ends)]] = self.around.regions
        return longs(of_part[parts[elements[:, 0]]])

    @cached_property
    def _alone(self) -> Longs:
        """Given nodes on no side."""
        return longs(np.setdiff1d(np.arange(self.given), self.around.ends))

    def _corners(self, triangles: Ints) -> tuple[Longs, Longs]:
        """(3T,) part that each corner of a triangle belongs to, and the side that leaves its node there or -1.

        The corners at a node that follow one another with no side between them are one part.
        """
        rims = np.stack([triangles, np.roll(triangles, -1, axis=1)], axis=2).reshape(-1, 2).astype(np.int64)
        ahead = np.arange(len(rims)) - np.arange(len(rims)) % 3 + (np.arange(len(rims)) + 1) % 3
        ends = self.around.ends
        width = int(max(triangles.max(), ends.max())) + 1
        keys, order = ends @ [width, 1], np.argsort(ends @ [width, 1])
        sought = rims @ [width, 1]
        place = np.minimum(np.searchsorted(keys[order], sought), len(keys) - 1)
        sides = np.where(keys[order[place]] == sought, order[place], -1)
        one, other = paired_sides(ints(rims))
        within = sides[one] < 0
        one, other = one[within], other[within]
        both = np.concatenate([one, ahead[one]]), np.concatenate([ahead[other], other])
        return connected_parts(len(rims), longs(both[0]), longs(both[1])), longs(sides)
