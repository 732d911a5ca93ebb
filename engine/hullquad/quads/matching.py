"""The pairing of triangles with the most pairs, and among those with the greatest weight.

Of up to `EXACT` triangles that is found exactly, by Edmonds' blossom method. Of more it is found nearly: the joins of
the advancing front, augmented to the greatest number of pairs, whose partners are then changed along alternating
circles (and paths from a triangle that is left) of up to `DEPTH` pairs, wherever that gains.
"""

from collections.abc import Generator

import numpy as np

from hullquad.arrays import Bools, Floats, Longs, longs
from hullquad.metrics.compiled import called, uncounted, woven
from hullquad.quads.augment import augment, mates_of
from hullquad.quads.front import front_pairs
from hullquad.quads.pairs import Pairs

EXACT = 1000
"""Triangles up to which the exact method takes no longer than some hundredths of a second."""
DEPTH = 6
"""Pairs that a circle may have."""
_STARTS = 8000
"""Triangles from which ways are tried before somebody may lose interest: some hundredths of a second."""
_LEAST = 1e-9
_DIGITS = 1_000_000
"""Weights are rounded to whole numbers for the exact method: rounding must not send it in circles."""


def matching(pairs: Pairs, weights: Floats, single_weights: Floats) -> Generator[None, None, set[int]]:
    """Rows of the pairs that are to be joined, when it is done; it yields from time to time, to be dropped perhaps.

    Parameters
    ----------
    pairs : Pairs
    weights : (P,) float array
        How good each pair is, from 0 to 1.
    single_weights : (T,) float array
        How good a triangle is that is left without a partner, from 0 to 1.
    """
    if len(pairs.triangles) <= EXACT:
        return _exact(pairs, weights, single_weights)
    joined = set(front_pairs(pairs)[:, 0].tolist())
    for change in augment(pairs, joined):
        joined.difference_update(change.parted)
        joined.update(change.joined)
        yield
    return (yield from improved(pairs, joined, weights, single_weights))


def _exact(pairs: Pairs, weights: Floats, single_weights: Floats) -> set[int]:
    """The best pairing; a pair weighs what it adds to the weight of its triangles left alone."""
    import rustworkx  # noqa: PLC0415  only this needs it

    members = pairs.members
    gains = np.rint(_DIGITS * (2 + weights - single_weights[members].sum(axis=1))).astype(np.int64)
    graph = rustworkx.PyGraph()
    graph.add_nodes_from(range(len(pairs.triangles)))
    graph.add_edges_from([(*ends, gain) for ends, gain in zip(members.tolist(), gains.tolist(), strict=True)])
    found = rustworkx.max_weight_matching(graph, max_cardinality=True, weight_fn=int)
    rows = {(min(ends), max(ends)): row for row, ends in enumerate(map(tuple, members.tolist()))}
    return {rows[min(ends), max(ends)] for ends in found}


def improved(
    pairs: Pairs, joined: set[int], weights: Floats, single_weights: Floats
) -> Generator[None, None, set[int]]:
    """Rows of a pairing of as many pairs and a weight that is not less; yields from time to time."""
    mates = mates_of(pairs, joined)
    neighbours, across = longs(pairs.neighbours), longs(pairs.pair_across)
    visited, sums = np.zeros(len(mates), dtype=np.bool_), np.zeros(DEPTH + 1)
    ways = np.zeros((3, 2 * DEPTH + 3), dtype=np.int64)
    gains = True
    while gains:
        gains = False
        for start in range(0, len(mates), _STARTS):
            end = min(start + _STARTS, len(mates))
            gains |= _improve(neighbours, across, weights, single_weights, mates, visited, sums, ways, start, end)
            yield
    triangle, side = np.nonzero((pairs.neighbours == mates[:, None]) & (pairs.pair_across >= 0))
    return set(across[triangle, side].tolist())


@called
def _pair_weight(one: int, other: int, neighbours: Longs, across: Longs, weights: Floats) -> float:
    for side in range(3):
        if neighbours[one, side] == other and across[one, side] >= 0:
            return float(weights[across[one, side]])
    return -1.0


@woven
def _better_way(
    start: int,
    neighbours: Longs,
    across: Longs,
    weights: Floats,
    single_weights: Floats,
    mates: Longs,
    visited: Bools,
    gains: Floats,
    sides: Longs,
    path: Longs,
    best_path: Longs,
) -> int:
    """Triangles of the alternating circle or path from `start` that gains most, into `best_path`; 0 if none gains.

    Depth first: from a triangle over an unpaired edge to the next, and to the mate of that one. A way from a paired
    triangle must come back to its mate; a way from a single one may end anywhere, leaving another one single.
    """
    mate, length, best, depth = mates[start], 0, _LEAST, 0
    single = mate < 0
    sides[0] = 0
    gains[0] = -single_weights[start] if single else -_pair_weight(start, mate, neighbours, across, weights)
    path[0] = start
    visited[start] = True
    while depth >= 0:
        here = path[2 * depth]
        if sides[depth] == 3 or depth == DEPTH:
            visited[here] = False
            if depth > 0:
                visited[path[2 * depth - 1]] = False
            depth -= 1
            continue
        side = sides[depth]
        sides[depth] += 1
        near = neighbours[here, side]
        if across[here, side] < 0 or near == mates[here] or visited[near]:
            continue
        gain = gains[depth] + weights[across[here, side]]
        if gain <= _LEAST and not single:
            continue  # from one of its triangles every circle that gains has gained at every step
        if near == mate:
            if gain > best:
                best, length = gain, 2 * depth + 2
                path[2 * depth + 1] = near
                for place in range(length):
                    best_path[place] = path[place]
            continue
        far = mates[near]
        if far < 0 or visited[far]:
            continue
        gain -= _pair_weight(near, far, neighbours, across, weights)
        path[2 * depth + 1], path[2 * depth + 2] = near, far
        if single and gain + single_weights[far] > best:
            best, length = gain + single_weights[far], 2 * depth + 3
            for place in range(length):
                best_path[place] = path[place]
        depth += 1
        visited[near] = visited[far] = True
        gains[depth], sides[depth] = gain, 0
    return length


@uncounted
def _improve(
    neighbours: Longs,
    across: Longs,
    weights: Floats,
    single_weights: Floats,
    mates: Longs,
    visited: Bools,
    gains: Floats,
    ways: Longs,
    first: int,
    end: int,
) -> bool:
    """Change partners along circles and paths that start at some of the triangles; whether any gained."""
    sides, path, best_path = ways[0], ways[1], ways[2]
    gained = False
    for start in range(first, end):
        length = _better_way(
            start, neighbours, across, weights, single_weights, mates, visited, gains, sides, path, best_path
        )
        for place in range(0, length - 1, 2):
            one, other = best_path[place], best_path[place + 1]
            mates[one], mates[other] = other, one
        if length % 2 == 1:
            mates[best_path[length - 1]] = -1
        gained = gained or length > 0
    return gained
