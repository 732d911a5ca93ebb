"""Triangles that need not be there taken out, two at a time."""

import numpy as np

from hullquad.arrays import Longs
from hullquad.metrics.compiled import compiled
from hullquad.quads.draft import ELEMENTS, Draft
from hullquad.quads.energy import element_energy
from hullquad.quads.opening import opened
from hullquad.quads.trial import NEVER, Change, Ground
from hullquad.quads.walk import distances_to, walk

_LONGEST_WALK = 400
_WALK, _WALK_BACK, _OPEN = range(3)


def repair(made: Draft, wish: Change, floor: Ground, unavoidable: int) -> bool:
    """Take triangles out, the nearest two first, until only the unavoidable ones are left; whether that was possible.

    Two triangles are taken out by the way that costs least: one walks to the other, the other to the one, or the path
    of nodes between them is opened.
    """
    tried: set[tuple[int, int]] = set()
    while True:
        triangles = made.triangles
        if len(triangles) <= unavoidable:
            return True
        found = zip(_partners(made, triangles).tolist(), triangles.tolist(), strict=True)
        ways = sorted((distance, one, other) for (other, distance), one in found if other >= 0)
        pair = next(((one, other) for _, one, other in ways if (one, other) not in tried), None)
        if pair is None:
            return False
        if _unite(made, wish, floor, *pair):
            tried.clear()
        else:
            tried.add(pair)


def _unite(made: Draft, wish: Change, floor: Ground, one: int, other: int) -> bool:
    """Take two triangles out the way that costs least; whether there was one."""
    before = made.copied()
    best, lowest = None, np.inf
    for way in (_WALK, _WALK_BACK, _OPEN):
        if _united(made, wish, floor, one, other, way):
            energy = _total_energy(made)
            if energy < lowest:
                best, lowest = made.copied(), energy
        made.restore(before)
    if best is not None:
        made.restore(best)
    return best is not None


def _united(made: Draft, wish: Change, floor: Ground, one: int, other: int, way: int) -> bool:
    if way == _OPEN:
        return opened(made, wish, floor, one, other, NEVER) > NEVER
    start, end = (one, other) if way == _WALK else (other, one)
    return walk(made, wish, floor, start, end, _LONGEST_WALK)


@compiled
def _total_energy(made: Draft) -> float:
    """Energy of all elements."""
    total = 0.0
    for element in range(made.tallies[ELEMENTS]):
        if made.elements[element, 0] >= 0:
            total += element_energy(made.nodes, made.elements, element)
    return total


@compiled
def _partners(made: Draft, triangles: Longs) -> Longs:
    """(T, 2) nearest other triangle of each triangle and its distance, -1 where there is none in reach."""
    found = np.full((len(triangles), 2), -1)
    distances, queue = np.empty(len(made.elements), dtype=np.int64), np.empty(len(made.elements), dtype=np.int64)
    for i in range(len(triangles)):
        nearest = distances_to(made, triangles[i], distances, queue, 1)
        if nearest >= 0:
            found[i, 0], found[i, 1] = nearest, distances[nearest]
    return found
