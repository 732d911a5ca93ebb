r"""Two triangles made quads by opening the path of nodes between them: every node of it becomes two.

::

     a1          b2                a1            b2
      |\        /|                  |\          /|
      | p0 -- p1 |        ->        | p0 ---- p1 |
      |/        \|                  | |        | |
     a2          b1                 | q0 ---- q1 |
                                    |/          \|
                                   a2            b1

The elements to the right of the path get the new nodes. One element more for each edge of the path.
"""

from math import hypot

from hullquad.arrays import Longs
from hullquad.metrics.compiled import called, woven
from hullquad.quads.draft import NODES, Draft, corner_count, corner_of, element_across, node_after
from hullquad.quads.trial import (
    ADDED,
    FULLY,
    NEVER,
    REMOVED,
    TWO_RINGS,
    Change,
    Ground,
    add,
    attempt,
    clear,
    place,
    remove,
)

LONGEST = 5
"""Nodes of a path."""
_APART = 0.22
"""How far old and new node go to either side, over the mean length of the edges there."""


@woven
def opened(made: Draft, wish: Change, floor: Ground, one: int, other: int, least: float) -> float:
    """Gain of opening the shortest path between two triangles, kept if above the least; below `NEVER` without one."""
    path = floor.search[3]
    count = _path(made, floor, one, other, path)
    if count == 0 or not _propose(made, wish, one, other, path, count):
        return 2.0 * NEVER
    return attempt(made, wish, floor, TWO_RINGS, FULLY, least)


@woven
def _path(made: Draft, floor: Ground, one: int, other: int, path: Longs) -> int:
    """Free nodes from one triangle to another along edges; their number, 0 if there is no short way."""
    parents, queue, depths = floor.search[0], floor.search[1], floor.search[2]
    parents[:] = -2
    head, tail = 0, 0
    for corner in range(3):
        node = made.elements[one, corner]
        if not made.held[node]:
            parents[node], depths[node], queue[tail] = -1, 0, node
            tail += 1
    while head < tail:
        node = queue[head]
        head += 1
        if corner_of(made.elements, other, node) >= 0:
            count = int(depths[node]) + 1
            for i in range(count - 1, -1, -1):
                path[i], node = node, parents[node]
            return count
        if depths[node] + 1 == LONGEST:
            continue
        for slot in range(made.counts[node]):
            element = made.around[node, slot]
            near = node_after(made.elements, element, node, 1)
            if parents[near] == -2 and not made.held[near]:
                parents[near], depths[near], queue[tail] = node, depths[node] + 1, near
                tail += 1
    return 0


@woven
def _propose(made: Draft, wish: Change, one: int, other: int, path: Longs, count: int) -> bool:
    """Write the opening of a path into `wish`; False where the path touches itself."""
    clear(wish)
    elements, first = made.elements, made.tallies[NODES]
    remove(wish, one)
    start, new = path[0], first
    add(wish, start, node_after(elements, one, start, 1), node_after(elements, one, start, 2), new)
    remove(wish, other)
    end = path[count - 1]
    new = first + count - 1
    add(wish, new, node_after(elements, other, end, 1), node_after(elements, other, end, 2), end)
    for i in range(count):
        if not _rename_right(made, wish, one, other, path, count, i, first + i):
            return False
        _spread(made, wish, path, count, i, first + i, one, other)
    for i in range(count - 1):
        if wish.tallies[ADDED] >= len(wish.added):
            return False
        add(wish, first + i, first + i + 1, path[i + 1], path[i])
    return True


@woven
def _rename_right(made: Draft, wish: Change, one: int, other: int, path: Longs, count: int, i: int, new: int) -> bool:
    """Give the new node to the elements on the right of the path at its i-th node."""
    node, elements = path[i], made.elements
    if i == 0:
        element = _next_around(made, one, node)
    else:
        element = -1
        for slot in range(made.counts[node]):
            if node_after(elements, made.around[node, slot], node, 1) == path[i - 1]:
                element = made.around[node, slot]
    for _ in range(made.counts[node] + 1):
        if element < 0 or element == one:
            return False
        if i == count - 1 and element == other:
            return True
        if i < count - 1 and node_after(elements, element, node, 1) == path[i + 1]:
            return True
        if element == other or not _renamed(made, wish, element, node, new):
            return False
        element = _next_around(made, element, node)
    return False


@called
def _next_around(made: Draft, element: int, node: int) -> int:
    """The next element counter-clockwise around a node."""
    last = node_after(made.elements, element, node, corner_count(made.elements, element) - 1)
    return element_across(made, element, last, node)


@woven
def _renamed(made: Draft, wish: Change, element: int, old: int, new: int) -> bool:
    """Exchange a node of an element, which may have been changed by this proposal before."""
    row = -1
    for number in range(2, wish.tallies[REMOVED]):
        if wish.removed[number] == element:
            row = number
    if row < 0:
        row = wish.tallies[REMOVED]
        if row >= len(wish.removed) - LONGEST:
            return False
        remove(wish, element)
        nodes = made.elements[element]
        add(wish, nodes[0], nodes[1], nodes[2], nodes[3])
    for corner in range(4):
        if wish.added[row, corner] == old:
            wish.added[row, corner] = new
    return True


@woven
def _spread(made: Draft, wish: Change, path: Longs, count: int, i: int, new: int, one: int, other: int) -> None:
    """Put the i-th node of the path to its left and its new twin to its right."""
    node = path[i]
    back_x, back_y = _before(made, path[i - 1] if i > 0 else -1, one)
    on_x, on_y = _before(made, path[i + 1] if i < count - 1 else -1, other)
    x, y = made.nodes[node, 0], made.nodes[node, 1]
    way_x, way_y, reach = on_x - back_x, on_y - back_y, 0.0
    for slot in range(made.counts[node]):
        near = node_after(made.elements, made.around[node, slot], node, 1)
        reach += hypot(made.nodes[near, 0] - x, made.nodes[near, 1] - y) / made.counts[node]
    share = _APART * reach / max(hypot(way_x, way_y), 1e-12 * reach)
    place(wish, node, x - share * way_y, y + share * way_x)
    place(wish, new, x + share * way_y, y - share * way_x)


@called
def _before(made: Draft, node: int, triangle: int) -> tuple[float, float]:
    """Where a node is, or the middle of a triangle at the end of a path."""
    if node >= 0:
        return made.nodes[node, 0], made.nodes[node, 1]
    x, y = 0.0, 0.0
    for corner in range(3):
        x += made.nodes[made.elements[triangle, corner], 0] / 3.0
        y += made.nodes[made.elements[triangle, corner], 1] / 3.0
    return x, y
