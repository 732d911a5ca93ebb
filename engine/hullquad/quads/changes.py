r"""The changes that may make a mesh better, each as a proposal around one node.

::

    rotate        the edge between two quads, either way within their hexagon
    collapse      a quad along a diagonal: its two ends become one node
    split         a node into two, with a quad between; a node of two quads goes instead, and the two become one
    divide        the pentagon of a triangle and a quad anew; two triangles become one quad
    centre        the hexagon of two quads, or the pentagon of a triangle and a quad, around a new node inside
"""

from hullquad.metrics.compiled import called, woven
from hullquad.quads.draft import NODES, Draft, corner_count, corner_of, element_across, new_stamp, node_after
from hullquad.quads.trial import ADDED, REMOVED, Change, add, clear, place, remove

PROPOSALS = 17
"""Proposals for every element around a node."""

_APART = 0.2
"""How far the two halves of a split node move, over the mean length of its edges."""


Ring = tuple[int, int, int, int, int, int]
"""Nodes around the two elements of a change, counter-clockwise."""


@called
def propose(made: Draft, wish: Change, node: int, number: int) -> bool:
    """Write a proposal around a node into `wish`; False where there is no such."""
    clear(wish)
    element, kind = made.around[node, number // PROPOSALS], number % PROPOSALS
    if kind <= 1:
        return _refill(made, wish, element, node, 1 + kind)
    if kind <= 3:
        return _collapse(made, wish, element, node if kind == 2 else node_after(made.elements, element, node, 1))
    if kind == 4:
        return _merge(made, wish, node) if made.counts[node] == 2 else _split(made, wish, element, node)
    if kind <= 9:
        return divide(made, wish, element, node, kind - 5)
    if kind <= 11:
        return _refill(made, wish, element, node, kind - 7)
    return centre_pentagon(made, wish, element, node, kind - 12)


@called
def _hexagon(made: Draft, wish: Change, element: int, node: int) -> tuple[bool, Ring]:
    """Ring of the two quads beside the edge that leaves a node, which go; whether there are two."""
    elements = made.elements
    end = node_after(elements, element, node, 1)
    other = element_across(made, element, node, end)
    if other < 0 or corner_count(elements, element) == 3 or corner_count(elements, other) == 3:
        return False, (0, 0, 0, 0, 0, 0)
    remove(wish, element)
    remove(wish, other)
    return True, (
        end,
        node_after(elements, element, end, 1),
        node_after(elements, element, end, 2),
        node,
        node_after(elements, other, node, 1),
        node_after(elements, other, node, 2),
    )


@called
def _refill(made: Draft, wish: Change, element: int, node: int, number: int) -> bool:
    """Fill the hexagon of the two quads beside the edge that leaves a node otherwise."""
    found, ring = _hexagon(made, wish, element, node)
    return found and fill_hexagon(made, wish, ring, number)


@called
def fill_hexagon(made: Draft, wish: Change, ring: Ring, number: int) -> bool:
    """Two quads with an edge from a node (0, 1, 2) of a ring to the one opposite, or three (3, 4) around a new node."""
    if number < 3:
        add(wish, ring[number], ring[number + 1], ring[number + 2], ring[(number + 3) % 6])
        add(wish, ring[(number + 3) % 6], ring[(number + 4) % 6], ring[(number + 5) % 6], ring[number])
        return True
    centre = made.tallies[NODES]
    if centre >= len(made.nodes):
        return False
    x, y = 0.0, 0.0
    for i in range(6):
        x, y = x + made.nodes[ring[i], 0] / 6.0, y + made.nodes[ring[i], 1] / 6.0
    for i in range(number - 3, 6, 2):
        add(wish, ring[i], ring[(i + 1) % 6], ring[(i + 2) % 6], centre)
    place(wish, centre, x, y)
    return True


@woven
def _collapse(made: Draft, wish: Change, element: int, node: int) -> bool:
    """Bring a corner of a quad and the one opposite together."""
    elements = made.elements
    if corner_count(elements, element) == 3:
        return False
    goes, stays = node, node_after(elements, element, node, 2)
    if made.held[goes]:
        goes, stays = stays, goes
    if made.held[goes] or made.counts[goes] > 12:
        return False
    for side in (1, 3):
        beside = node_after(elements, element, node, side)
        if made.counts[beside] < (2 if made.on_rim[beside] else 4):
            return False
    remove(wish, element)
    for slot in range(made.counts[goes]):
        near = made.around[goes, slot]
        if near != element:
            remove(wish, near)
            _add_with(made, wish, near, goes, stays)
    if not made.held[stays]:
        x = 0.5 * (made.nodes[goes, 0] + made.nodes[stays, 0])
        place(wish, stays, x, 0.5 * (made.nodes[goes, 1] + made.nodes[stays, 1]))
    return True


@called
def _add_with(made: Draft, wish: Change, element: int, old: int, new: int) -> None:
    """An element comes that is another one with one node exchanged."""
    row = made.elements[element]
    a, b, c, d = row[0], row[1], row[2], row[3]
    add(wish, new if a == old else a, new if b == old else b, new if c == old else c, new if d == old else d)


@woven
def _merge(made: Draft, wish: Change, node: int) -> bool:
    """Take a node out that only two quads have, which become one."""
    one, other = made.around[node, 0], made.around[node, 1]
    elements = made.elements
    if made.held[node] or corner_count(elements, one) == 3 or corner_count(elements, other) == 3:
        return False
    remove(wish, one)
    remove(wish, other)
    start = node_after(elements, one, node, 1)
    add(
        wish,
        start,
        node_after(elements, one, node, 2),
        node_after(elements, one, node, 3),
        node_after(elements, other, node, 2),
    )
    return True


@woven
def _split(made: Draft, wish: Change, first: int, node: int) -> bool:
    """Split a node along the edge that leaves it in an element and the edge most opposite."""
    count, elements = made.counts[node], made.elements
    if made.held[node] or count < 5 or count > 12:
        return False
    new, start = made.tallies[NODES], node_after(elements, first, node, 1)
    element, end, length, mean_x, mean_y = first, start, 0.0, 0.0, 0.0
    for _ in range(count // 2):
        if element < 0:
            return False
        remove(wish, element)
        _add_with(made, wish, element, node, new)
        end = node_after(elements, element, node, corner_count(elements, element) - 1)
        mean_x += made.nodes[end, 0] + made.nodes[node_after(elements, element, node, 1), 0]
        mean_y += made.nodes[end, 1] + made.nodes[node_after(elements, element, node, 1), 1]
        element = element_across(made, element, end, node)
    add(wish, node, start, new, end)
    x, y, share = made.nodes[node, 0], made.nodes[node, 1], 1.0 / (2 * (count // 2))
    away_x, away_y = mean_x * share - x, mean_y * share - y
    length = _APART
    if new < len(made.nodes):
        place(wish, new, x + length * away_x, y + length * away_y)
    else:
        return False
    place(wish, node, x - length * away_x, y - length * away_y)
    return True


@called
def _pentagon(made: Draft, element: int, node: int) -> tuple[int, int, Ring]:
    """Triangle and other element beside the edge that leaves a node, and their ring from the triangle's tip on.

    The triangle is -1 where there is none; where both are triangles the last of the ring's five nodes is -1.
    """
    elements = made.elements
    end = node_after(elements, element, node, 1)
    other = element_across(made, element, node, end)
    if other >= 0 and corner_count(elements, element) == 4:
        element, other, node, end = other, element, end, node
    if other < 0 or corner_count(elements, element) == 4:
        return -1, -1, (0, 0, 0, 0, 0, 0)
    tip, far = node_after(elements, element, end, 1), node_after(elements, other, node, 1)
    if corner_count(elements, other) == 3:
        return element, other, (tip, node, far, end, -1, -1)
    return element, other, (tip, node, far, node_after(elements, other, node, 2), end, -1)


@called
def divide(made: Draft, wish: Change, element: int, node: int, corner: int) -> bool:
    """Join the elements beside the edge that leaves a node and divide them anew, a triangle at a corner of the ring.

    The new triangle has the ring's node `corner`, from 1 on, and the two beside it. Two triangles become a quad:
    `corner` 0.
    """
    clear(wish)
    triangle, other, ring = _pentagon(made, element, node)
    if triangle < 0 or (ring[4] < 0) != (corner == 0):
        return False
    remove(wish, triangle)
    remove(wish, other)
    if corner == 0:
        add(wish, ring[0], ring[1], ring[2], ring[3])
        return True
    before, after = ring[(corner + 4) % 5], ring[(corner + 1) % 5]
    add(wish, before, ring[corner], after, -1)
    add(wish, after, ring[(corner + 2) % 5], ring[(corner + 3) % 5], before)
    return True


@called
def centre_pentagon(made: Draft, wish: Change, element: int, node: int, corner: int) -> bool:
    """Two quads and a triangle around a new node in the place of a quad and a triangle.

    The triangle is at the side of the ring that begins with the node `corner`.
    """
    clear(wish)
    triangle, other, ring = _pentagon(made, element, node)
    centre = made.tallies[NODES]
    if triangle < 0 or ring[4] < 0 or centre >= len(made.nodes):
        return False
    remove(wish, triangle)
    remove(wish, other)
    x, y = 0.0, 0.0
    for i in range(5):
        x, y = x + made.nodes[ring[i], 0] / 5.0, y + made.nodes[ring[i], 1] / 5.0
    a, b, c = ring[(corner + 1) % 5], ring[(corner + 2) % 5], ring[(corner + 3) % 5]
    add(wish, ring[corner], a, centre, -1)
    add(wish, a, b, c, centre)
    add(wish, c, ring[(corner + 4) % 5], ring[corner], centre)
    place(wish, centre, x, y)
    return True


@woven
def defect_change(made: Draft, wish: Change) -> int:
    """By how much a change alters the sum over the nodes of (elements around - ideal number) squared."""
    total, stamp, removed = 0, new_stamp(made), wish.tallies[REMOVED]
    for number in range(removed + wish.tallies[ADDED]):
        for corner in range(4):
            node = (
                made.elements[wish.removed[number], corner]
                if number < removed
                else wish.added[number - removed, corner]
            )
            if node < 0 or made.node_stamps[node] == stamp:
                continue
            made.node_stamps[node] = stamp
            after = made.counts[node] + _net(made, wish, node)
            if after > 0:
                total += (after - made.ideal[node]) ** 2
            if made.counts[node] > 0:
                total -= (made.counts[node] - made.ideal[node]) ** 2
    return total


@woven
def _net(made: Draft, wish: Change, node: int) -> int:
    """Elements that a node gains or loses by a change."""
    net = 0
    for number in range(wish.tallies[ADDED]):
        for corner in range(4):
            net += wish.added[number, corner] == node
    for number in range(wish.tallies[REMOVED]):
        net -= corner_of(made.elements, wish.removed[number], node) >= 0
    return net
