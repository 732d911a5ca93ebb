"""A small mesh shaken: changes are drawn at random, and those that cost something stay the more rarely the dearer.

That is simulated annealing (S. Kirkpatrick, C. D. Gelatt, M. P. Vecchi, "Optimization by simulated annealing", Science
220:671, 1983): so a mesh gets out of states that no single change makes better. The random numbers come from a
generator with a fixed seed: the same mesh is always shaken alike.
"""

from collections.abc import Callable, Iterator
from typing import NamedTuple

import numpy as np

from hullquad.arrays import Floats, Longs
from hullquad.metrics.compiled import uncounted
from hullquad.quads.changes import PROPOSALS, propose
from hullquad.quads.cleanup import cleaned
from hullquad.quads.draft import ELEMENTS, Draft, compacted, corner_count
from hullquad.quads.energy import element_energy
from hullquad.quads.log import Log
from hullquad.quads.stages import States, Step
from hullquad.quads.trial import ONE_RING, WELL, Change, Ground, attempt

HOT, COLD = 6.0, 0.03
"""Energy that a change may cost with a probability of 1/e, in the beginning and in the end."""
_PASSES = 8
_SHAKES = 100
"""Changes that are drawn before somebody may lose interest."""
_SEED = 20
_DRAWS = 5
"""Random numbers for a change: three elements, of which the worst is taken, its node, and what to do there."""


class Costs(NamedTuple):
    """What a mesh costs as a whole, and what one element more would cost beside its energy."""

    of_all: Callable[[Draft], float]
    of_another: Callable[[Draft], float]


def shaken(made: Draft, wish: Change, floor: Ground, times: int, costs: Costs, log: Log) -> Iterator[States | None]:
    """Draw so many changes, one after the other, and end with the best state; those that were the best so far."""
    chance = np.random.default_rng(_SEED)
    draws = chance.integers(0, 2**31, (times, _DRAWS))
    leasts = HOT * (COLD / HOT) ** (np.arange(times) / max(times, 1)) * np.log(1.0 - chance.random(times))
    saved, lowest = made.copied(), costs.of_all(made)
    for start in range(0, times, _SHAKES):
        yield None
        floor.price[0] = costs.of_another(made)
        chosen = slice(start, start + _SHAKES)
        _change_at_random(made, wish, floor, draws[chosen], leasts[chosen])
        compacted(made)
        if start + _SHAKES >= times:
            yield from cleaned(made, wish, floor, _PASSES, log)
        price = costs.of_all(made)
        if price < lowest:
            lowest = price
            saved.restore(made)
            yield log.compared(Step.SHAKEN, made)
    made.restore(saved)


@uncounted
def _change_at_random(made: Draft, wish: Change, floor: Ground, draws: Longs, leasts: Floats) -> None:
    """Try the changes that were drawn; each stays if it gains more than its least."""
    for number in range(len(draws)):
        element, most = -1, -1.0
        for i in range(3):
            drawn = draws[number, i] % made.tallies[ELEMENTS]
            if made.elements[drawn, 0] >= 0:
                energy = element_energy(made.nodes, made.elements, drawn)
                if energy > most:
                    element, most = drawn, energy
        if element >= 0:
            node = made.elements[element, draws[number, 3] % corner_count(made.elements, element)]
            if propose(made, wish, node, draws[number, 4] % (PROPOSALS * made.counts[node])):
                attempt(made, wish, floor, ONE_RING, WELL, leasts[number])
