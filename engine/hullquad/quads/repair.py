"""Triangles that need not be there taken out, two at a time."""

from collections.abc import Generator, Iterator

import numpy as np

from hullquad.arrays import Longs
from hullquad.metrics.compiled import uncounted
from hullquad.quads.draft import ONE, Draft
from hullquad.quads.energy import element_energies
from hullquad.quads.log import Log
from hullquad.quads.opening import opened
from hullquad.quads.stages import States, Step
from hullquad.quads.trial import NEVER, Change, Ground
from hullquad.quads.walk import DETOURS, GOING_ON, JOINED, LOST, distances_to, walk

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
        found = zip(_partners(made, floor, triangles).tolist(), triangles.tolist(), strict=True)
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
            energy = float(element_energies(made.nodes, made.element_rows).sum())
            if energy < lowest:
                best, lowest = made.copied(), energy
        made.restore(before)
    if best is not None:
        made.restore(best)
    return best is not None


def _walked(made: Draft, wish: Change, floor: Ground, one: int, other: int) -> Generator[None, None, bool]:
    at = np.array([one, other, DETOURS])
    for _ in range(_LONGEST_WALK // _STEPS):
        outcome = _go_on(made, wish, floor, at, _STEPS)
        if outcome != GOING_ON:
            return bool(outcome == JOINED)
        yield
    return False


def _opened(made: Draft, wish: Change, floor: Ground, one: int, other: int) -> Generator[None, None, bool]:
    is_open = bool(_go_on(made, wish, floor, np.array([one, other, 0]), 0) == JOINED)
    yield
    return is_open


@uncounted
def _go_on(made: Draft, wish: Change, floor: Ground, at: Longs, steps: int) -> int:
    """Let a triangle walk on towards another one; without steps the path between them is opened."""
    if steps > 0:
        return walk(made, wish, floor, at, steps)
    return JOINED if opened(made, wish, floor, at[0], at[1], NEVER) > NEVER else LOST


def _partners(made: Draft, floor: Ground, triangles: Longs) -> Longs:
    """(T, 2) nearest other triangle of each triangle and its distance, -1 where there is none in reach."""
    found = np.full((len(triangles), 2), -1)
    _find_partners(made, triangles, found, floor.search[0], floor.search[1])
    return found


@uncounted
def _find_partners(made: Draft, triangles: Longs, found: Longs, distances: Longs, queue: Longs) -> None:
    for i in range(len(triangles)):
        nearest = distances_to(made, triangles[i], distances, queue, ONE)
        if nearest >= 0:
            found[i, 0], found[i, 1] = nearest, distances[nearest]
