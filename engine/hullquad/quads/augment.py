"""Edmonds' augmenting paths: leftover triangles paired by changing partners along a path, no edge changed.

J. Edmonds, "Paths, trees, and flowers", Canad. J. Math. 17:449 (1965): a pairing has as many pairs as possible
if and only if no path of alternately unpaired and paired edges leads from one leftover to another.
"""

from collections.abc import Iterator

import numpy as np

from hullquad.arrays import Bools, Bytes, Longs
from hullquad.metrics.compiled import called, uncounted, woven
from hullquad.quads.draft import ONE, ZERO
from hullquad.quads.front import Join
from hullquad.quads.pairs import Pairs


def augment(pairs: Pairs, joined: set[int]) -> Iterator[Join]:
    """Changes that pair two leftovers each, until as many triangles are paired as possible.

    `joined` are the rows of the pairs that are joined already.
    """
    count = len(pairs.triangles)
    mates = mates_of(pairs, joined)
    partners = np.where(pairs.pair_across >= 0, pairs.neighbours, -1).astype(np.int64)
    alive, kinds = np.ones(count, dtype=np.bool_), np.zeros(count, dtype=np.int8)
    forest = np.zeros((5, count + 1), dtype=np.int64)  # parents, bases, rounds, queue, vertices seen
    forest[0], forest[1] = -1, np.arange(count + 1)
    path = np.empty(count + 1, dtype=np.int64)
    for leftover in np.flatnonzero(mates < 0).tolist():
        if mates[leftover] < 0:
            length = _augmenting_path(leftover, partners, mates, alive, forest, kinds, path)
            if length:
                yield _changed(pairs, path[:length], mates)


def mates_of(pairs: Pairs, joined: set[int]) -> Longs:
    """(T,) partner of each triangle in the pairs that are joined, -1 of one that has none."""
    mates = np.full(len(pairs.triangles), -1)
    one, other = pairs.members[list(joined)].reshape(-1, 2).T
    mates[one], mates[other] = other, one
    return mates


def _changed(pairs: Pairs, path: Longs, mates: Longs) -> Join:
    """Flip the pairs along a path of triangles."""
    one, other = path[:-1], path[1:]
    is_across = (pairs.neighbours[one] == other[:, None]) & (pairs.pair_across[one] >= 0)
    rows = pairs.pair_across[one, np.argmax(is_across, axis=1)].tolist()
    mates[path[::2]], mates[path[1::2]] = path[1::2], path[::2]
    return Join(joined=tuple(rows[::2]), parted=tuple(rows[1::2]))


_UNSEEN, _OUTER, _INNER = 0, 1, 2


@called
def _base(vertex: int, bases: Longs) -> int:
    """The vertex that stands for the flower a vertex has been contracted into."""
    while bases[vertex] != vertex:
        bases[vertex] = bases[bases[vertex]]
        vertex = bases[vertex]
    return vertex


@woven
def _common_base(one: int, other: int, mates: Longs, parents: Longs, bases: Longs, rounds: Longs) -> int:
    """Where the ways of two outer vertices to the root meet; both are walked in turn."""
    rounds[-1] += 1
    one, other = _base(one, bases), _base(other, bases)
    while rounds[one] != rounds[-1]:
        rounds[one] = rounds[-1]
        one = _base(parents[mates[one]], bases) if mates[one] >= 0 else -1  # -1: past the root
        if other >= 0:
            one, other = other, one
    return one


@called
def _fold(
    vertex: int,
    child: int,
    base: int,
    mates: Longs,
    parents: Longs,
    bases: Longs,
    kinds: Bytes,
    queue: Longs,
    tail: int,
) -> int:
    """Contract the way from a vertex to its flower's base, its inner vertices becoming outer; the queue's new end."""
    while _base(vertex, bases) != base:
        parents[vertex] = child
        child = mates[vertex]
        if kinds[child] == _INNER:
            kinds[child] = _OUTER
            queue[tail] = child
            tail += 1
        for folded in (vertex, child):
            if bases[folded] == folded:
                bases[folded] = base
        vertex = parents[child]
    return tail


@woven
def _search(
    root: int,
    partners: Longs,
    mates: Longs,
    alive: Bools,
    parents: Longs,
    bases: Longs,
    rounds: Longs,
    kinds: Bytes,
    queue: Longs,
    touched: Longs,
) -> tuple[int, int]:
    """Grow a tree of alternating paths from a leftover: the other leftover it finds or -1, and the vertices seen."""
    kinds[root] = _OUTER
    queue[0] = touched[0] = root
    head, tail, seen = ZERO, ONE, ONE
    while head < tail:
        vertex = queue[head]
        head += 1
        for near in partners[vertex]:
            if near < 0 or not alive[near] or kinds[near] == _INNER or _base(near, bases) == _base(vertex, bases):
                continue
            if kinds[near] == _OUTER:
                base = _common_base(vertex, near, mates, parents, bases, rounds)
                tail = _fold(vertex, near, base, mates, parents, bases, kinds, queue, tail)
                tail = _fold(near, vertex, base, mates, parents, bases, kinds, queue, tail)
                continue
            parents[near], kinds[near] = vertex, _INNER
            touched[seen] = near
            seen += 1
            mate = mates[near]
            if mate < 0:
                return near, seen
            kinds[mate] = _OUTER
            touched[seen] = queue[tail] = mate
            seen, tail = seen + 1, tail + 1
    return -1, seen


@uncounted
def _augmenting_path(
    root: int, partners: Longs, mates: Longs, alive: Bools, forest: Longs, kinds: Bytes, path: Longs
) -> int:
    """Triangles of a path from `root` to another leftover into `path`; its length, 0 where there is none.

    The vertices of a search that failed take no part in any later one: they are no longer alive.
    """
    parents, bases, rounds, queue, touched = forest[0], forest[1], forest[2], forest[3], forest[4]
    end, seen = _search(root, partners, mates, alive, parents, bases, rounds, kinds, queue, touched)
    length = 0
    while end >= 0:
        path[length], path[length + 1] = end, parents[end]
        length, end = length + 2, mates[parents[end]]
    for vertex in touched[:seen]:
        parents[vertex], bases[vertex], kinds[vertex] = -1, vertex, _UNSEEN
        alive[vertex] = length > 0
    return length
