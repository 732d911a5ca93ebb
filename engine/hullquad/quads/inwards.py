"""The order of a front that goes from the contour inwards, and along the contour on each level."""

from collections import deque
from collections.abc import Generator, Iterable

import numpy as np

from hullquad.quads.pairs import Pairs

_TRIANGLES = 5000
"""Triangles that are looked at before somebody may lose interest: some hundredths of a second."""


def inwards(pairs: Pairs, joined: Iterable[int]) -> Generator[None, None, list[int]]:
    """Rows of the joined pairs, those at the contour first: neighbours of a pair are one level further in.

    It yields from time to time, to be dropped perhaps.
    """
    pair_of = np.full(len(pairs.triangles), -1)
    rows = np.fromiter(joined, dtype=np.int64)
    pair_of[pairs.members[rows]] = rows[:, None]
    at_rim, sides = np.nonzero(pairs.neighbours < 0)
    along = np.argsort(pairs.triangles[at_rim, sides], kind="stable")
    queue = deque(at_rim[along].tolist())
    members, neighbours = pairs.members.tolist(), pairs.neighbours.tolist()
    order, seen = [], [False] * len(neighbours)
    while queue:
        triangle = queue.popleft()
        if seen[triangle]:
            continue
        pair = int(pair_of[triangle])
        unit = [triangle] if pair < 0 else members[pair]
        if pair >= 0:
            order.append(pair)
        for member in unit:
            seen[member] = True
            queue.extend(near for near in neighbours[member] if near >= 0 and not seen[near])
        if len(order) % _TRIANGLES == 0:
            yield
    return order
