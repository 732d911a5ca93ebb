"""Clean-up: around every node that is not regular the change that gains most, until nothing gains any more."""

from math import inf

from hullquad.arrays import Longs
from hullquad.metrics.compiled import compiled
from hullquad.quads.changes import PROPOSALS, defect_change, propose
from hullquad.quads.draft import NODES, Draft, corner_count
from hullquad.quads.energy import element_energy
from hullquad.quads.trial import ADDED, RINGS, SWEEPS, Change, Ground, attempt

LEAST_GAIN = 0.02
POOR = 0.5
"""Energy from which on an element is poor: changes beside it are tried even where they make nodes less regular."""


@compiled
def _is_suspect(made: Draft, node: int) -> tuple[bool, bool]:
    """Whether a node is worth looking at, and whether an element around it is poor."""
    poor = False
    for slot in range(made.counts[node]):
        poor = poor or element_energy(made.nodes, made.elements, made.around[node, slot]) > POOR
    return poor or made.counts[node] != made.ideal[node], poor


@compiled
def _best_change(made: Draft, wish: Change, floor: Ground, node: int, allowance: int) -> tuple[int, float]:
    """The proposal around a node that gains most, -1 where none gains, and its gain."""
    best, most = -1, LEAST_GAIN
    for number in range(PROPOSALS * made.counts[node]):
        if propose(made, wish, node, number) and defect_change(made, wish) <= allowance:
            gain = attempt(made, wish, floor, 1, 2, inf)
            if gain > most:
                best, most = number, gain
    return best, most


@compiled
def clean_up(made: Draft, wish: Change, floor: Ground, passes: int, due: Longs) -> int:
    """Change what gains, in so many passes at most; the number of changes.

    `due` (C,) is 1 for nodes that are to be looked at, and is kept up to date.
    """
    total = 0
    for _ in range(passes):
        changes = 0
        for node in range(made.tallies[NODES]):
            if due[node] == 0 or made.counts[node] == 0:
                continue
            due[node] = 0
            suspect, poor = _is_suspect(made, node)
            if not suspect:
                continue
            best, _ = _best_change(made, wish, floor, node, 0 if poor else -1)
            if best < 0:
                continue
            propose(made, wish, node, best)
            attempt(made, wish, floor, RINGS, SWEEPS, 0.0)
            changes += 1
            for number in range(wish.tallies[ADDED]):
                for corner in range(corner_count(made.elements, floor.rows[number])):
                    due[made.elements[floor.rows[number], corner]] = 1
        total += changes
        if changes == 0:
            break
    return total
