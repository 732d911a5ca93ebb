"""A mesh shaken near its poor elements.

Changes are drawn at random, and those that cost something stay the more rarely the dearer.

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
from hullquad.quads.cleanup import POOR
from hullquad.quads.draft import ELEMENTS, Draft, compacted, corner_count
from hullquad.quads.energy import element_energies, element_energy
from hullquad.quads.log import Log
from hullquad.quads.settling import AGAIN, settled
from hullquad.quads.stages import States, Step
from hullquad.quads.trial import ONE_RING, WELL, Change, Ground, attempt

HOT, WARM, COLD = 6.0, 1.0, 0.03
"""Energy that a change may cost with a probability of 1/e: at the start of the first round and of the second, and at
the end of each."""
MOST = 20_000
_LEAST, _ALL, _EACH = 4000, 2_000_000, 400
"""Changes of a round: at most, at least, times elements, and at most for each element that may be drawn."""
_PAUSES, _FEWEST_PAUSES, _VISITS = 100, 4, 16_000
"""Looks at the whole mesh in a round: at most, at least, and times elements. Somebody may lose interest then."""
_ENOUGH = 50
"""Changes for each element that may be drawn, with which a round begins at its full heat: fewer would only spoil it."""
_SHORTEST = 100
"""Changes from one look to the next, at least."""
_SEED = 20
_DRAWS = 5
"""Random numbers for a change: three elements, of which the worst is taken, its node, and what to do there."""


class Costs(NamedTuple):
    """What a mesh costs as a whole, and what one element more would cost beside its energy."""

    of_all: Callable[[Draft], float]
    of_another: Callable[[Draft], float]


def shaken(
    made: Draft, wish: Change, floor: Ground, costs: Costs, log: Log, most: int = MOST
) -> Iterator[States | None]:
    """Draw changes, one after the other, near poor elements, and end with the best state; those that were the best.

    In the first round nodes are where smoothing leaves them, which is the quicker way out of poor states. In the second
    one they are where they settle (`quads.settling`): a change is worth what stays of it.
    """
    chance = np.random.default_rng(_SEED)
    yield from _round(made, wish, floor, costs, log, _drawn(chance, made, most, HOT))
    settled(made)
    floor.settling[0] = AGAIN
    yield from _round(made, wish, floor, costs, log, _drawn(chance, made, most, WARM))


class _Drawn(NamedTuple):
    """What chance has brought for the changes of a round."""

    draws: Longs
    """(T, 5)"""
    leasts: Floats
    """(T,) energy that a change must gain to stay: less than nothing, and ever nearer to it."""


def _drawn(chance: np.random.Generator, made: Draft, most: int, hot: float) -> _Drawn:
    size, near = len(made.element_rows), len(_near_poor(made))
    times = min(most, max(_LEAST, _ALL // size), _EACH * near)
    hot = max(COLD, hot * min(1.0, times / max(1, _ENOUGH * near)))
    cooling = hot * (COLD / hot) ** (np.arange(times) / max(times, 1))
    return _Drawn(chance.integers(0, 2**31, (times, _DRAWS)), cooling * np.log(1.0 - chance.random(times)))


def _round(made: Draft, wish: Change, floor: Ground, costs: Costs, log: Log, drawn: _Drawn) -> Iterator[States | None]:
    times, size = len(drawn.leasts), len(made.element_rows)
    step = max(_SHORTEST, -(-times // max(_FEWEST_PAUSES, min(_PAUSES, _VISITS // size))))
    saved, lowest = made.copied(), costs.of_all(made)
    for start in range(0, times, step):
        yield None
        near = _near_poor(made)
        if not len(near):
            break
        floor.price[0] = costs.of_another(made)
        chosen = slice(start, start + step)
        _change_at_random(made, wish, floor, near, drawn.draws[chosen], drawn.leasts[chosen])
        compacted(made)
        if floor.settling[0]:
            settled(made, AGAIN)
        price = costs.of_all(made)
        if price < lowest:
            lowest = price
            saved.restore(made)
            yield log.compared(Step.SHAKEN, made)
    made.restore(saved)


def _near_poor(made: Draft) -> Longs:
    """Rows of the elements that are poor or touch one that is."""
    rows = np.flatnonzero(made.elements[: made.tallies[ELEMENTS], 0] >= 0)
    elements = made.elements[rows]
    is_at_poor = np.zeros(len(made.nodes) + 1, dtype=bool)  # the last one stands for the corner a triangle has not
    is_at_poor[elements[element_energies(made.nodes, elements) > POOR]] = True
    is_at_poor[-1] = False
    return rows[is_at_poor[elements].any(axis=1)]


@uncounted
def _change_at_random(made: Draft, wish: Change, floor: Ground, near: Longs, draws: Longs, leasts: Floats) -> None:
    """Try the changes that were drawn; each stays if it gains more than its least."""
    for number in range(len(draws)):
        element, most = -1, -1.0
        for i in range(3):
            drawn = near[draws[number, i] % len(near)]
            if made.elements[drawn, 0] >= 0:
                energy = element_energy(made.nodes, made.elements, drawn)
                if energy > most:
                    element, most = drawn, energy
        if element >= 0:
            node = made.elements[element, draws[number, 3] % corner_count(made.elements, element)]
            if propose(made, wish, node, draws[number, 4] % (PROPOSALS * made.counts[node])):
                attempt(made, wish, floor, ONE_RING, WELL, leasts[number])
