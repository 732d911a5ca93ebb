"""A mesh that is still being changed: the one mutable structure of the mesher, private to this package.

Elements are rows that come and go; every node knows the elements around it. All of it is plain arrays, for
compiled code; what is done with them is in the modules beside this one.
"""

from typing import NamedTuple

import numpy as np

from hullquad.arrays import Bools, Floats, Ints, Longs
from hullquad.metrics.compiled import called, plain, uncounted, woven
from hullquad.quads.stages import compact

NODES, ELEMENTS, STAMP = range(3)
"""Rows of `Draft.tallies`."""

NONE, ZERO, ONE = plain(-1), plain(0), plain(1)
"""What kernels begin with where a row or a number is still to be found."""

_SPARE = 8
"""Elements that may be added around a node beyond the most that any node has in the beginning."""
_GROWTH = 0.25


class Draft(NamedTuple):
    """Nodes in the plate's plane, elements, and who is around whom."""

    nodes: Floats
    """(C, 2) [mm]; rows beyond those in use are spare."""
    held: Bools
    """(C,) nodes that stay where they are."""
    on_rim: Bools
    """(C,) nodes of the contour."""
    ideal: Longs
    """(C,) number of elements that would fit best around a node."""
    bound: Longs
    """(C,) the other end of a line of one segment that nothing else holds, -1 where a node is none."""
    elements: Longs
    """(M, 4) nodes in order, a triangle ends with -1; a row that is not in use begins with -1."""
    around: Longs
    """(C, K) elements around a node, in no order."""
    counts: Longs
    """(C,) their number."""
    tallies: Longs
    """Rows of nodes and of elements in use, and the stamp that was given last."""
    node_stamps: Longs
    """(C,) the stamp that a node has been given last: marks without a set."""
    element_stamps: Longs
    """(M,)"""

    @property
    def element_rows(self) -> Longs:
        """(E, 4) elements in use."""
        rows = self.elements[: self.tallies[ELEMENTS]]
        return rows[rows[:, 0] >= 0]

    @property
    def triangles(self) -> Longs:
        """Rows of the triangles."""
        rows = self.elements[: self.tallies[ELEMENTS]]
        return np.flatnonzero((rows[:, 0] >= 0) & (rows[:, 3] < 0))

    def copied(self) -> "Draft":
        """A draft of its own with the same content."""
        return Draft._make(array.copy() for array in self)

    def restore(self, other: "Draft") -> None:
        """Take over the content of a copy."""
        for own, saved in zip(self, other, strict=True):
            own[...] = saved


def draft(nodes: Floats, elements: Ints, held: int, rim_ideal: Longs, bound: Ints | None = None) -> Draft:
    """Draft of a mesh.

    Parameters
    ----------
    nodes : (N, 2) float array
        [mm]
    elements : (E, 4) int array
        Counter-clockwise; a triangle ends with -1.
    held : int
        So many nodes, the first ones, stay where they are.
    rim_ideal : (R,) int array
        Number of elements that fit best around each contour node; they are the first nodes.
    bound : (K, 2) int array, optional
        Edges that stay though elements are all around them.
    """
    count, rows = len(nodes), len(elements)
    node_room, element_room = _with_spare(count), _with_spare(rows)
    most = int(np.bincount(elements[elements >= 0], minlength=1).max())
    made = Draft(
        nodes=np.zeros((node_room, 2)),
        held=np.arange(node_room) < held,
        on_rim=np.arange(node_room) < len(rim_ideal),
        ideal=np.full(node_room, 4),
        bound=np.full(node_room, -1),
        elements=np.full((element_room, 4), -1, dtype=np.int64),
        around=np.full((node_room, most + _SPARE), -1, dtype=np.int64),
        counts=np.zeros(node_room, dtype=np.int64),
        tallies=np.array([count, rows, 0]),
        node_stamps=np.zeros(node_room, dtype=np.int64),
        element_stamps=np.zeros(element_room, dtype=np.int64),
    )
    made.nodes[:count], made.elements[:rows] = nodes, elements
    made.ideal[: len(rim_ideal)] = rim_ideal
    if bound is not None:
        made.bound[bound[:, 0]], made.bound[bound[:, 1]] = bound[:, 1], bound[:, 0]
    _tell_nodes(made.elements[:rows], made.around, made.counts)
    return made


def _with_spare(count: int) -> int:
    return int(count * (1 + _GROWTH)) + 64


def finished(made: Draft, given: int) -> tuple[Floats, Ints]:
    """Nodes and elements in use: quads in their order, then the triangles; the first `given` nodes all stay."""
    return compact(made.nodes, made.element_rows, given)


@uncounted
def _tell_nodes(elements: Longs, around: Longs, counts: Longs) -> None:
    """Tell every node the elements around it, in order."""
    counts[:] = 0
    for element in range(len(elements)):
        for corner in range(4):
            node = elements[element, corner]
            if node >= 0:
                around[node, counts[node]] = element
                counts[node] += 1


def compacted(made: Draft) -> None:
    """Close the gaps between the nodes and elements in use."""
    used = made.counts > 0
    used[: int(np.count_nonzero(made.held))] = True
    rows = np.append(np.cumsum(used) - 1, -1)[made.element_rows]
    nodes = made.nodes[used]
    made.nodes[: len(nodes)] = nodes
    made.elements[:] = -1
    made.elements[: len(rows)] = rows
    made.tallies[NODES], made.tallies[ELEMENTS] = len(nodes), len(rows)
    _tell_nodes(made.elements[: len(rows)], made.around, made.counts)


@called
def corner_count(elements: Longs, element: int) -> int:
    """3 or 4."""
    return 3 if elements[element, 3] < 0 else 4


@called
def attach(made: Draft, element: int) -> None:
    """Tell the nodes of an element of it."""
    for corner in range(corner_count(made.elements, element)):
        node = made.elements[element, corner]
        made.around[node, made.counts[node]] = element
        made.counts[node] += 1


@called
def detach(made: Draft, element: int) -> None:
    """Take an element from its nodes."""
    for corner in range(corner_count(made.elements, element)):
        node = made.elements[element, corner]
        last = made.counts[node] - 1
        for place in range(last):
            if made.around[node, place] == element:
                made.around[node, place] = made.around[node, last]
                break
        made.counts[node] = last


@called
def corner_of(elements: Longs, element: int, node: int) -> int:
    """At which place an element has a node, -1 where it has not."""
    for corner in range(corner_count(elements, element)):
        if elements[element, corner] == node:
            return corner
    return -1


@called
def nodes_beside(elements: Longs, element: int, node: int) -> tuple[int, int, int]:
    """The other nodes of an element, counter-clockwise from one on; a triangle has its last one twice."""
    is_second, is_third = elements[element, 1] == node, elements[element, 2] == node
    if elements[element, 3] < 0:
        after = 2 if is_second else (0 if is_third else 1)
        last = 0 if is_second else (1 if is_third else 2)
        return elements[element, after], elements[element, last], elements[element, last]
    corner = 1 * is_second + 2 * is_third + 3 * (elements[element, 3] == node)
    return elements[element, (corner + 1) & 3], elements[element, (corner + 2) & 3], elements[element, (corner + 3) & 3]


@called
def node_after(elements: Longs, element: int, node: int, steps: int) -> int:
    """The node so many places after one, counter-clockwise around an element."""
    corners = corner_count(elements, element)
    return int(elements[element, (corner_of(elements, element, node) + steps) % corners])


@called
def element_across(made: Draft, element: int, start: int, end: int) -> int:
    """The element on the other side of an edge that `element` runs from `start` to `end`, -1 on the rim."""
    if made.bound[start] == end:
        return -1
    for place in range(made.counts[end]):
        other = made.around[end, place]
        if other != element and node_after(made.elements, other, end, 1) == start:
            return int(other)
    return -1


@woven
def element_with_side(made: Draft, start: int, end: int) -> int:
    """The element that runs an edge from `start` to `end`, -1 where there is none."""
    for place in range(made.counts[start]):
        element = made.around[start, place]
        if node_after(made.elements, element, start, 1) == end:
            return int(element)
    return -1


@called
def new_stamp(made: Draft) -> int:
    """A stamp that nothing has yet."""
    made.tallies[STAMP] += 1
    return int(made.tallies[STAMP])
