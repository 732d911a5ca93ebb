"""A change of a few elements, judged by what it does after the nodes around have been smoothed, or taken back.

Every repair is such a change: elements that go, elements that come, nodes that are put somewhere. The gain is the
energy that the elements around lose; nothing that would make an element invalid is ever kept.
"""

from typing import NamedTuple

import numpy as np

from hullquad.arrays import Floats, Longs
from hullquad.metrics.compiled import called, plain, woven
from hullquad.quads.draft import ELEMENTS, NODES, ONE, ZERO, Draft, attach, corner_count, detach, new_stamp
from hullquad.quads.energy import INVALID, element_energy
from hullquad.quads.settling import settle
from hullquad.quads.smoothing import relax

REMOVED, ADDED, PLACED = range(3)
"""Rows of `Change.tallies`."""

_MOST = 64
"""Elements of a change."""

ELEMENT = 0.06
"""What an element costs beside its energy: of two equally good meshes the one with fewer elements is better."""

ONE_RING, TWO_RINGS = plain(1), plain(2)
"""Elements around a change that are smoothed with it."""

ROUGHLY, FAIRLY, WELL, FULLY = plain(2), plain(3), plain(4), plain(8)
"""Sweeps of that smoothing."""

_HOPE = 4.0
"""Energy that smoothing may still win after its first sweep, where a change is not worth more by then."""

NEVER = -1e12
"""Gain of a change that cannot be."""


class Change(NamedTuple):
    """Elements that go and come, and nodes that are put somewhere; the numbers of each are in `tallies`."""

    removed: Longs
    """(64,) rows of elements."""
    added: Longs
    """(64, 4) nodes."""
    placed: Longs
    """(64,) nodes that are put somewhere; those that are not in use yet come into use."""
    places: Floats
    """(64, 2) [mm]"""
    tallies: Longs


class Ground(NamedTuple):
    """What a trial touches, with room to remember how it was."""

    region: Longs
    """(C,) nodes that are smoothed."""
    places: Floats
    """(C, 2) where the nodes of the region were."""
    rows: Longs
    """(64,) rows that the added elements took."""
    old: Longs
    """(64, 4) elements that went."""
    size: Longs
    """(1,) number of nodes in the region of the last trial."""
    settling: Longs
    """(1,) sweeps by which nodes settle before a change is judged (`quads.settling`), 0 for those that do not."""
    price: Floats
    """(1,) what an element costs beside its energy."""
    search: Longs
    """(4, max(C, M)) room for what a search along edges or over elements has to remember."""


def change() -> Change:
    """Room for one change."""
    return Change(
        np.zeros(_MOST, dtype=np.int64),
        np.zeros((_MOST, 4), dtype=np.int64),
        np.zeros(_MOST, dtype=np.int64),
        np.zeros((_MOST, 2)),
        np.zeros(3, dtype=np.int64),
    )


def ground(made: Draft) -> Ground:
    """Room for trials on a draft."""
    return Ground(
        np.zeros(len(made.nodes), dtype=np.int64),
        np.zeros_like(made.nodes),
        np.zeros(_MOST, dtype=np.int64),
        np.zeros((_MOST, 4), dtype=np.int64),
        np.zeros(1, dtype=np.int64),
        np.zeros(1, dtype=np.int64),
        np.array([ELEMENT]),
        np.zeros((4, max(len(made.nodes), len(made.elements))), dtype=np.int64),
    )


def touched(wish: Change, floor: Ground) -> tuple[Longs, Longs]:
    """Rows of elements, and nodes, that the change tried last may have altered."""
    rows = np.concatenate([wish.removed[: wish.tallies[REMOVED]], floor.rows[: wish.tallies[ADDED]]])
    return np.unique(rows), floor.region[: floor.size[0]]


@called
def clear(wish: Change) -> None:
    """Make a change empty."""
    wish.tallies[:] = 0


@called
def remove(wish: Change, element: int) -> None:
    """An element goes."""
    wish.removed[wish.tallies[REMOVED]] = element
    wish.tallies[REMOVED] += 1


@called
def add(wish: Change, a: int, b: int, c: int, d: int) -> None:
    """An element comes; a triangle has -1 as its last node."""
    row = wish.added[wish.tallies[ADDED]]
    row[0], row[1], row[2], row[3] = a, b, c, d
    wish.tallies[ADDED] += 1


@called
def place(wish: Change, node: int, x: float, y: float) -> None:
    """A node is put somewhere."""
    number = wish.tallies[PLACED]
    wish.placed[number] = node
    wish.places[number, 0], wish.places[number, 1] = x, y
    wish.tallies[PLACED] += 1


@woven
def is_possible(made: Draft, wish: Change) -> bool:
    """Whether there is room for a change, and no element of it has a node twice."""
    added, removed = wish.tallies[ADDED], wish.tallies[REMOVED]
    if made.tallies[ELEMENTS] + max(0, added - removed) > len(made.elements):
        return False
    for number in range(wish.tallies[PLACED]):
        if wish.placed[number] >= len(made.nodes):
            return False
    for number in range(added):
        a, b, c, d = wish.added[number, 0], wish.added[number, 1], wish.added[number, 2], wish.added[number, 3]
        if a == b or a == c or a == d or b == c or b == d or c == d:  # noqa: PLR1714, SIM109  compiles sooner than `in`
            return False
        for corner in range(4):
            node = wish.added[number, corner]
            if node >= 0 and made.counts[node] + 3 >= made.around.shape[1]:
                return False
    return True


@woven
def _grow(made: Draft, region: Longs, count: int, rings: int, stamp: int) -> int:
    """Add the nodes within so many rings of elements to a region of stamped nodes; its new number of nodes."""
    start = 0
    for _ in range(rings):
        end = count
        for i in range(start, end):
            node = region[i]
            for slot in range(made.counts[node]):
                element = made.around[node, slot]
                for corner in range(corner_count(made.elements, element)):
                    near = made.elements[element, corner]
                    if made.node_stamps[near] != stamp:
                        made.node_stamps[near] = stamp
                        region[count] = near
                        count += 1
        start = end
    return count


@woven
def _region(made: Draft, wish: Change, floor: Ground, rings: int) -> int:
    """Nodes of a change and those around it; their number."""
    stamp, count = new_stamp(made), ZERO
    for number in range(wish.tallies[REMOVED]):
        element = wish.removed[number]
        for corner in range(corner_count(made.elements, element)):
            node = made.elements[element, corner]
            if made.node_stamps[node] != stamp:
                made.node_stamps[node] = stamp
                floor.region[count] = node
                count += 1
    count = _grow(made, floor.region, count, rings, stamp)
    for number in range(wish.tallies[PLACED]):
        node = wish.placed[number]
        if made.node_stamps[node] != stamp:
            made.node_stamps[node] = stamp
            floor.region[count] = node
            count += 1
    return count


@called
def _energy_around(made: Draft, floor: Ground, nodes: int) -> tuple[float, bool]:
    """Energy of all elements at the region's nodes, and whether all are valid."""
    stamp, total, valid = new_stamp(made), 0.0, True
    for i in range(nodes):
        node = floor.region[i]
        for slot in range(made.counts[node]):
            element = made.around[node, slot]
            if made.element_stamps[element] != stamp:
                made.element_stamps[element] = stamp
                energy = element_energy(made.nodes, made.elements, element)
                valid = valid and energy < INVALID
                total += energy + floor.price[0]
    return total, valid


@woven
def _applied(made: Draft, wish: Change, floor: Ground) -> None:
    """Carry out a change, remembering the elements that go."""
    removed, added = wish.tallies[REMOVED], wish.tallies[ADDED]
    for number in range(removed):
        element = wish.removed[number]
        for corner in range(4):
            floor.old[number, corner] = made.elements[element, corner]
        detach(made, element)
        made.elements[element, 0] = -1
    for number in range(added):
        row = wish.removed[number] if number < removed else made.tallies[ELEMENTS]
        if number >= removed:
            made.tallies[ELEMENTS] += 1
        floor.rows[number] = row
        for corner in range(4):
            made.elements[row, corner] = wish.added[number, corner]
        attach(made, row)
    for number in range(wish.tallies[PLACED]):
        node = wish.placed[number]
        made.tallies[NODES] = max(made.tallies[NODES], node + 1)
        made.nodes[node, 0], made.nodes[node, 1] = wish.places[number, 0], wish.places[number, 1]


@woven
def _taken_back(made: Draft, wish: Change, floor: Ground, nodes: int, node_rows: int, element_rows: int) -> None:
    """Undo a change and the smoothing after it."""
    for number in range(wish.tallies[ADDED]):
        detach(made, floor.rows[number])
        made.elements[floor.rows[number], 0] = -1
    for number in range(wish.tallies[REMOVED]):
        for corner in range(4):
            made.elements[wish.removed[number], corner] = floor.old[number, corner]
        attach(made, wish.removed[number])
    for i in range(nodes):
        node = floor.region[i]
        made.nodes[node, 0], made.nodes[node, 1] = floor.places[i, 0], floor.places[i, 1]
    made.tallies[NODES], made.tallies[ELEMENTS] = node_rows, element_rows


@woven
def _gain(made: Draft, floor: Ground, nodes: int, sweeps: int, before: float, least: float) -> float:
    """Energy that the elements at the region's nodes lose by smoothing, or by settling then, if that may be enough."""
    settling = floor.settling[0]
    relax(made, floor.region, nodes, sweeps if settling == 0 else ONE, 0.0)
    after, valid = _energy_around(made, floor, nodes)
    if settling > 0 and valid and before - after > least - _HOPE:
        relax(made, floor.region, nodes, sweeps - 1, 0.0)
        after, valid = _energy_around(made, floor, nodes)
        if valid and before - after > least:
            settle(made, floor.region, nodes, settling)
            after, valid = _energy_around(made, floor, nodes)
    return before - after if valid else NEVER


@called
def attempt(made: Draft, wish: Change, floor: Ground, rings: int, sweeps: int, least: float) -> float:
    """Gain of a change after smoothing; it is kept if that is above the least, with `inf` never."""
    if not is_possible(made, wish):
        return NEVER
    node_rows, element_rows = made.tallies[NODES], made.tallies[ELEMENTS]
    count = _region(made, wish, floor, rings)
    floor.size[0] = count
    for i in range(count):
        floor.places[i, 0], floor.places[i, 1] = made.nodes[floor.region[i], 0], made.nodes[floor.region[i], 1]
    before, _ = _energy_around(made, floor, count)
    _applied(made, wish, floor)
    gain = _gain(made, floor, count, sweeps, before, least)
    if gain <= least:
        _taken_back(made, wish, floor, count, node_rows, element_rows)
    return gain
