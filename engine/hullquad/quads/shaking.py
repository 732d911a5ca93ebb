"""A small mesh shaken: a change that costs something is made, and stays if cleaning up around it gains more.

So clean-up gets out of states that no single change makes better. The changes are chosen by a generator of random
numbers with a fixed seed: the same mesh is always shaken alike.
"""

from collections.abc import Iterator

import numpy as np

from hullquad.arrays import Longs
from hullquad.metrics.compiled import compiled
from hullquad.quads.changes import PROPOSALS, propose
from hullquad.quads.cleanup import EVERY, clean_up
from hullquad.quads.draft import ELEMENTS, Draft, corner_count
from hullquad.quads.energy import element_energies, element_energy
from hullquad.quads.log import Log
from hullquad.quads.stages import States, Step
from hullquad.quads.trial import ADDED, ELEMENT, TWO_RINGS, WELL, Change, Ground, attempt

DEAREST = -3.0
"""Least gain of a change that is tried."""
_PASSES = 3
_SHAKES = 20
"""Changes that are tried before somebody may lose interest."""
_SEED = 20
_DRAWS = 5
"""Random numbers for a change: three elements, of which the worst is taken, its node, and what to do there."""


def shaken(made: Draft, wish: Change, floor: Ground, times: int, log: Log) -> Iterator[States | None]:
    """Try so many changes, one after the other; the state after each that stays."""
    draws = np.random.default_rng(_SEED).integers(0, 2**31, (times, _DRAWS))
    saved = made.copied()
    due, at = np.zeros(len(made.nodes), dtype=np.int64), np.zeros(4, dtype=np.int64)
    lowest = _price(made)
    for number, draw in enumerate(draws):
        if number % _SHAKES == 0:
            yield None
        if not _kicked(made, wish, floor, draw, due):
            continue
        at[:] = 0
        clean_up(made, wish, floor, _PASSES, due, at, EVERY, EVERY)
        price = _price(made)
        if price < lowest - 1e-6:
            lowest = price
            saved.restore(made)
            yield log.compared(Step.SHAKEN, made)
        else:
            made.restore(saved)


@compiled
def _kicked(made: Draft, wish: Change, floor: Ground, draw: Longs, due: Longs) -> bool:
    """Make a change that was drawn, if it is one that can be; the nodes of the new elements are due for clean-up."""
    element, most = -1, -1.0
    for i in range(3):
        drawn = draw[i] % made.tallies[ELEMENTS]
        if made.elements[drawn, 0] >= 0:
            energy = element_energy(made.nodes, made.elements, drawn)
            if energy > most:
                element, most = drawn, energy
    if element < 0:
        return False
    node = made.elements[element, draw[3] % corner_count(made.elements, element)]
    if not propose(made, wish, node, draw[4] % (PROPOSALS * made.counts[node])):
        return False
    if attempt(made, wish, floor, TWO_RINGS, WELL, DEAREST) <= DEAREST:
        return False
    due[:] = 0
    for row in range(wish.tallies[ADDED]):
        for corner in range(corner_count(made.elements, floor.rows[row])):
            due[made.elements[floor.rows[row], corner]] = 1
    return True


def _price(made: Draft) -> float:
    """Energy of all elements, and what they cost by their number."""
    energies = element_energies(made.nodes, made.element_rows)
    return float(energies.sum()) + ELEMENT * len(energies)
