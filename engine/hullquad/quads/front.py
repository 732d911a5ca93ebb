"""The paper's advancing front: triangles are joined to quads from the contour inwards.

Which triangle is next, and with whom, is fixed by three rules:

1. The front takes the triangle with the lowest level (0 along the contour), among those the one with the
   fewest free partners, among those the one whose best quad is best.
2. It is joined with the partner of the highest score; a partner no further in than itself counts 0.25 more,
   and each neighbour that would lose its last partner costs 0.5.
3. The neighbours of the two (or of a triangle that finds no partner) are then at most one level further in.
"""

from collections.abc import Iterator
from heapq import heappop, heappush

import attrs
import numpy as np

from hullquad.arrays import Bools, Floats, Longs, longs
from hullquad.metrics.compiled import called, compiled, woven
from hullquad.quads.draft import ZERO
from hullquad.quads.pairs import Pairs

_SAME_LEVEL_BONUS = 0.25
_ISOLATION_PENALTY = 0.5
_UNREACHED = 1_000_000_000
_NO_PARTNER = 9


@attrs.frozen
class Join:
    """One step of the pairing: pairs of triangles joined, and pairs taken apart for it."""

    joined: tuple[int, ...]
    """Rows of `Pairs`."""
    parted: tuple[int, ...] = ()
    level: int = -1
    """How far from the contour the front was; -1 after the front."""


def front(pairs: Pairs) -> Iterator[Join]:
    """Joins of the advancing front, one pair each, in order."""
    for pair, level in front_pairs(pairs).tolist():
        yield Join(joined=(pair,), level=level)


def front_pairs(pairs: Pairs) -> Longs:
    """(J, 2) pairs that the advancing front joins, in order, and the level where it does."""
    if len(pairs.triangles) == 0:
        return np.empty((0, 2), dtype=np.int64)
    log = np.empty((len(pairs.triangles) // 2, 2), dtype=np.int64)
    levels, free = np.where(pairs.at_rim, 0, _UNREACHED), np.ones(len(pairs.triangles), dtype=np.bool_)
    count = _advance(longs(pairs.neighbours), longs(pairs.pair_across), pairs.scores, levels, free, log)
    return log[:count]


@called
def _partners(triangle: int, neighbours: Longs, pair_across: Longs, free: Bools) -> int:
    """Number of free triangles that this one could be joined with."""
    count = 0
    for side in range(3):
        if pair_across[triangle, side] >= 0 and free[neighbours[triangle, side]]:
            count += 1
    return count


@called
def _key(
    triangle: int, levels: Longs, neighbours: Longs, pair_across: Longs, scores: Floats, free: Bools
) -> tuple[int, int, float, int]:
    """Order in which the front takes triangles: the least first."""
    best = 0.0
    for side in range(3):
        pair = pair_across[triangle, side]
        if pair >= 0 and free[neighbours[triangle, side]]:
            best = max(best, scores[pair])
    count = _partners(triangle, neighbours, pair_across, free)
    return levels[triangle], count if count > 0 else _NO_PARTNER, -best, triangle


@woven
def _isolated(one: int, other: int, neighbours: Longs, pair_across: Longs, free: Bools) -> int:
    """How many free neighbours of the two would have no partner left if these two were joined."""
    count = 0
    free[one] = free[other] = False
    for member in (one, other):
        for side in range(3):
            near = neighbours[member, side]
            if pair_across[member, side] >= 0 and free[near]:
                count += _partners(near, neighbours, pair_across, free) == 0
    free[one] = free[other] = True
    return count


@woven
def _chosen_side(
    triangle: int, levels: Longs, neighbours: Longs, pair_across: Longs, scores: Floats, free: Bools
) -> int:
    """Side across which the best partner lies, -1 without any."""
    chosen, best = -1, -np.inf
    for side in range(3):
        pair, partner = pair_across[triangle, side], neighbours[triangle, side]
        if pair < 0 or not free[partner]:
            continue
        value = scores[pair] - _ISOLATION_PENALTY * _isolated(triangle, partner, neighbours, pair_across, free)
        if levels[partner] <= levels[triangle]:
            value += _SAME_LEVEL_BONUS
        if value > best:
            chosen, best = side, value
    return chosen


@compiled
def _advance(neighbours: Longs, pair_across: Longs, scores: Floats, levels: Longs, free: Bools, log: Longs) -> int:
    """Pair and level of every join into `log`; the number of joins."""
    count = 0
    heap = [_key(ZERO, levels, neighbours, pair_across, scores, free)]
    for triangle in range(1, len(neighbours)):
        if levels[triangle] == 0:
            heappush(heap, _key(triangle, levels, neighbours, pair_across, scores, free))
    while len(heap) > 0:
        taken = heappop(heap)
        triangle = taken[3]
        if not free[triangle]:
            continue
        current = _key(triangle, levels, neighbours, pair_across, scores, free)
        if current != taken:
            heappush(heap, current)
            continue
        side = _chosen_side(triangle, levels, neighbours, pair_across, scores, free)
        partner = neighbours[triangle, side] if side >= 0 else triangle
        if side >= 0:
            log[count, 0], log[count, 1] = pair_across[triangle, side], levels[triangle]
            count += 1
        free[triangle] = free[partner] = False
        for member in (triangle, partner):
            for near in neighbours[member]:
                if near >= 0 and free[near]:
                    levels[near] = min(levels[near], levels[triangle] + 1)
                    heappush(heap, _key(near, levels, neighbours, pair_across, scores, free))
    return count
