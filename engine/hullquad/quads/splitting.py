r"""Two triangles made quads by splitting every edge on a way between them: there is always room for that.

::

      .-------.-------.                 .-------.-------.
     /|       |       |\               / \      |      / \
    < |       |       | >      ->     <   >-----+-----<   >
     \|       |       |/               \ /      |      \ /
      '-------'-------'                 '-------'-------'

A quad on the way becomes two, or three around a new node where the way turns. The new node on a triangle's side goes a
little way into the quad beside it, so that both ends are convex.

One element more for each quad on a straight way. Where all elements are valid before, they are so afterwards.
"""

from collections import deque

import numpy as np

from hullquad.arrays import Floats, Ints, Longs, floats, ints
from hullquad.topology import paired_sides

_INTO = 0.2
"""How far the new node on a triangle's side goes into the quad beside it, over the way to the next new node."""

_STRAIGHT_ON = 2

Step = tuple[int, int, int]
"""An element, the side over which the way comes, and the one over which it goes; -1 at the ends of the way."""


def split(nodes: Floats, elements: Ints, kept: Ints) -> tuple[Floats, Ints] | None:
    """Nodes and elements with two triangles fewer; None where no way leads from one to another.

    Parameters
    ----------
    nodes : (N, 2) float array
        [mm]
    elements : (E, 4) int array
        Counter-clockwise; a triangle ends with -1.
    kept : (K, 2) int array
        Edges that must stay though elements are all around them.
    """
    across = _across(elements, kept)
    way = _shortest_way(elements, across)
    if way is None:
        is_triangle = np.append(elements[:, 3] < 0, False)
        beside = np.flatnonzero(is_triangle[:-1] & is_triangle[np.where(across < 0, -1, across // 4)].any(axis=1))
        if not len(beside):
            return None
        return split(*_framed(int(beside[0]), nodes, elements), kept)
    return _split_along(way, nodes, elements)


def _framed(row: int, nodes: Floats, elements: Ints) -> tuple[Floats, Ints]:
    """Three quads around a smaller triangle in the place of a triangle, so that there is a way to the one beside it."""
    outer, inner = elements[row, :3], len(nodes) + np.arange(3)
    places = (nodes[outer] + nodes[outer].mean(axis=0)) / 2
    frame = np.stack([outer, np.roll(outer, -1), np.roll(inner, -1), inner], axis=1)
    stay = np.delete(elements, row, axis=0)
    return floats(np.concatenate([nodes, places])), ints(np.concatenate([stay, frame, [[*inner, -1]]]))


def _across(elements: Ints, kept: Ints) -> Longs:
    """(E, 4) what is across each side: four times the row of an element plus its own side there; -1 where none is."""
    corners = np.where(elements[:, 3] < 0, 3, 4)
    owner = np.repeat(np.arange(len(elements)), corners)
    side = np.arange(len(owner)) - np.repeat(np.cumsum(corners) - corners, corners)
    ends = np.stack([elements[owner, side], elements[owner, (side + 1) % corners[owner]]], axis=1)
    one, other = paired_sides(ints(ends))
    weights = [int(elements.max()) + 1, 1]
    stays = np.isin(np.sort(ends[one], axis=1) @ weights, np.sort(kept, axis=1) @ weights)
    one, other = one[~stays], other[~stays]
    across = np.full((len(elements), 4), -1, dtype=np.int64)
    across[owner[one], side[one]] = 4 * owner[other] + side[other]
    across[owner[other], side[other]] = 4 * owner[one] + side[one]
    return across


def _shortest_way(elements: Ints, across: Longs) -> list[Step] | None:
    """The shortest way through quads from a triangle to another one that is not beside it."""
    is_triangle = elements[:, 3] < 0
    queue = deque(np.flatnonzero(is_triangle).tolist())
    origins, entries = {triangle: triangle for triangle in queue}, dict.fromkeys(queue, -1)
    while queue:
        here = queue.popleft()
        for side, there in enumerate(across[here].tolist()):
            element = there // 4
            if there < 0 or (is_triangle[element] and is_triangle[here]):
                continue
            if element not in origins:
                origins[element], entries[element] = origins[here], there % 4
                queue.append(element)
            elif origins[element] != origins[here]:
                ahead = reversed(_way_back(here, side, across, entries))
                return [
                    *((row, leaving, coming) for row, coming, leaving in ahead),
                    *_way_back(element, there % 4, across, entries),
                ]
    return None


def _way_back(element: int, coming: int, across: Longs, entries: dict[int, int]) -> list[Step]:
    """The way from an element, which is entered over a side, to the triangle from which it was reached."""
    way = [(element, coming, entries[element])]
    while way[-1][2] >= 0:
        element, coming = divmod(int(across[way[-1][0], way[-1][2]]), 4)
        way.append((element, coming, entries[element]))
    return way


def _split_along(way: list[Step], nodes: Floats, elements: Ints) -> tuple[Floats, Ints]:
    """Split every edge that a way crosses."""
    places = [_middle(nodes, elements[row], leaving) for row, _, leaving in way[:-1]]
    rows, aims = list[tuple[int, ...]](), list[Floats]()
    for number, (row, coming, leaving) in enumerate(way[1:-1]):
        before, after, centre = np.array([number, number + 1, len(places)]) + len(nodes)
        a, b, c, d = np.roll(elements[row], -coming)
        turn = (leaving - coming) % 4
        if turn == _STRAIGHT_ON:
            rows += [(a, before, after, d), (before, b, c, after)]
            aims.append((places[number] + places[number + 1]) / 2)
            continue
        if turn == 1:
            rows += [(before, b, after, centre), (after, c, d, centre), (d, a, before, centre)]
        else:
            rows += [(after, a, before, centre), (before, b, c, centre), (c, d, after, centre)]
        places.append((places[number] + places[number + 1] + nodes[d if turn == 1 else c]) / 3)
        aims.append(places[-1])
    last = len(way) - 2
    for end, leaving, number in ((way[0][0], way[0][2], 0), (way[-1][0], way[-1][1], last)):
        a, b, c = np.roll(elements[end, :3], -leaving)
        rows.append((a, len(nodes) + number, b, c))
    places[0] = places[0] + _INTO * (aims[0] - places[0])
    places[last] = places[last] + _INTO * (aims[-1] - places[last])
    stay = np.delete(elements, [row for row, _, _ in way], axis=0)
    return floats(np.concatenate([nodes, places])), ints(np.concatenate([stay, rows]))


def _middle(nodes: Floats, element: Ints, side: int) -> Floats:
    """The middle of a side."""
    corners = element[element >= 0]
    return floats((nodes[corners[side]] + nodes[corners[(side + 1) % len(corners)]]) / 2)
