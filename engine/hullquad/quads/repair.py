"""Triangles that need not be there taken out, two at a time."""

from collections.abc import Generator, Iterator

import numpy as np

from hullquad.arrays import Longs
from hullquad.metrics.compiled import compiled
from hullquad.quads.draft import ELEMENTS, Draft
from hullquad.quads.energy import element_energy
from hullquad.quads.log import Log
from hullquad.quads.opening import opened
from hullquad.quads.stages import States, Step
from hullquad.quads.trial import NEVER, Change, Ground
from hullquad.quads.walk import DETOURS, GOING_ON, JOINED, distances_to, walk

_LONGEST_WALK = 400
_STEPS = 20
"""Of a walk, before somebody may lose interest: some hundredths of a second."""


def repaired(made: Draft, wish: Change, floor: Ground, unavoidable: int, log: Log) -> Iterator[States | None]:
    """Take triangles out, the nearest two first, until only the unavoidable ones are left or there is no way.

    Two triangles are taken out by the way that costs least: one walks to the other, the other to the one, or the path
    of nodes between them is opened. The state after each repair.
    """
    tried: set[tuple[int, int]] = set()
    while len(triangles := made.triangles) > unavoidable:
        found = zip(_partners(made, triangles).tolist(), triangles.tolist(), strict=True)
        ways = sorted((distance, one, other) for (other, distance), one in found if other >= 0)
        pair = next(((one, other) for _, one, other in ways if (one, other) not in tried), None)
        if pair is None:
            break
        if (yield from _united(made, wish, floor, *pair)):
            tried.clear()
            yield log.compared(Step.REPAIRED, made)
        else:
            tried.add(pair)


def _united(made: Draft, wish: Change, floor: Ground, one: int, other: int) -> Generator[None, None, bool]:
    """Take two triangles out the way that costs least; whether there was one."""
    before = made.copied()
    best, lowest = None, np.inf
    ways = (
        _walked(made, wish, floor, one, other),
        _walked(made, wish, floor, other, one),
        _opened(made, wish, floor, one, other),
    )
    for way in ways:
        if (yield from way):
            energy = _total_energy(made)
            if energy < lowest:
                best, lowest = made.copied(), energy
        made.restore(before)
    if best is not None:
        made.restore(best)
    return best is not None


def _walked(made: Draft, wish: Change, floor: Ground, one: int, other: int) -> Generator[None, None, bool]:
    at = np.array([one, other, DETOURS])
    for _ in range(_LONGEST_WALK // _STEPS):
        outcome = walk(made, wish, floor, at, _STEPS)
        if outcome != GOING_ON:
            return bool(outcome == JOINED)
        yield
    return False


def _opened(made: Draft, wish: Change, floor: Ground, one: int, other: int) -> Generator[None, None, bool]:
    is_open = opened(made, wish, floor, one, other, NEVER) > NEVER
    yield
    return is_open


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
