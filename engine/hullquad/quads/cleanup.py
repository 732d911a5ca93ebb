"""Clean-up: around every node that is not regular the change that gains most, until nothing gains any more."""

from collections.abc import Iterator
from math import inf

import numpy as np

from hullquad.arrays import Longs
from hullquad.metrics.compiled import uncounted, woven
from hullquad.quads.changes import PROPOSALS, defect_change, propose
from hullquad.quads.draft import NODES, NONE, Draft, corner_count
from hullquad.quads.energy import element_energy
from hullquad.quads.log import Log
from hullquad.quads.stages import States, Step
from hullquad.quads.trial import ADDED, ONE_RING, ROUGHLY, TWO_RINGS, WELL, Change, Ground, attempt, touched

LEAST_GAIN = 0.02
POOR = 0.5
"""Energy from which on an element is poor: changes beside it are tried even where they make nodes less regular."""


PASS, NODE, END, CHANGES = range(4)
"""Rows of where one is: the pass, the next node, where the pass ends, and the changes that it has made."""
EVERY = 1_000_000_000
"""So many changes, or nodes, as there are."""
_CHANGES = 50
_LOOKS = 200
"""Changes that are made, and nodes that are looked at, before somebody may lose interest: some hundredths of a second.
"""


@woven
def _is_suspect(made: Draft, node: int) -> tuple[bool, bool]:
    """Whether a node is worth looking at, and whether an element around it is poor."""
    poor = False
    for slot in range(made.counts[node]):
        poor = poor or element_energy(made.nodes, made.elements, made.around[node, slot]) > POOR
    return poor or made.counts[node] != made.ideal[node], poor


@woven
def _best_change(made: Draft, wish: Change, floor: Ground, node: int, allowance: int) -> tuple[int, float]:
    """The proposal around a node that gains most, -1 where none gains, and its gain."""
    best, most = NONE, LEAST_GAIN
    for number in range(PROPOSALS * made.counts[node]):
        if propose(made, wish, node, number) and defect_change(made, wish) <= allowance:
            gain = attempt(made, wish, floor, ONE_RING, ROUGHLY, inf)
            if gain > most:
                best, most = number, gain
    return best, most


def cleaned(made: Draft, wish: Change, floor: Ground, passes: int, log: Log) -> Iterator[States | None]:
    """Change what gains, everywhere, in so many passes at most; the state after each change."""
    due, at = np.ones(len(made.nodes), dtype=np.int64), np.zeros(4, dtype=np.int64)
    while at[PASS] < passes:
        changes = clean_up(made, wish, floor, passes, due, at, 1 if log.is_watched else _CHANGES, _LOOKS)
        yield log.changed(Step.CLEANED, made, *touched(wish, floor)) if changes else None


@uncounted
def clean_up(
    made: Draft, wish: Change, floor: Ground, passes: int, due: Longs, at: Longs, changes: int, looks: int
) -> int:
    """Change what gains, in so many passes at most; the number of changes.

    `due` (C,) is 1 for nodes that are to be looked at, and is kept up to date. `at` (4,), zeros in the beginning, is
    where one is when so many changes have been made or so many nodes been looked at, to go on from there.
    """
    made_changes = 0
    while at[PASS] < passes and made_changes < changes and looks > 0:
        if at[NODE] == 0:
            at[END], at[CHANGES] = made.tallies[NODES], 0
        node = at[NODE]
        at[NODE] += 1
        if due[node] != 0 and made.counts[node] > 0:
            due[node] = 0
            suspect, poor = _is_suspect(made, node)
            best = NONE
            if suspect:
                looks -= 1
                best, _ = _best_change(made, wish, floor, node, 0 if poor else -1)
            if best >= 0:
                propose(made, wish, node, best)
                attempt(made, wish, floor, TWO_RINGS, WELL, 0.0)
                made_changes, at[CHANGES] = made_changes + 1, at[CHANGES] + 1
                for number in range(wish.tallies[ADDED]):
                    for corner in range(corner_count(made.elements, floor.rows[number])):
                        due[made.elements[floor.rows[number], corner]] = 1
        if at[NODE] == at[END]:
            at[NODE], at[PASS] = 0, (at[PASS] + 1 if at[CHANGES] > 0 else passes)
    return made_changes
