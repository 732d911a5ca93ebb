"""The paper's pairing as a whole, and the elements it leaves."""

from collections.abc import Iterable, Iterator, Sequence

import numpy as np

from hullquad.arrays import Ints, ints
from hullquad.quads.augment import augment
from hullquad.quads.front import Join, front
from hullquad.quads.pairs import Pairs


def joins(pairs: Pairs) -> Iterator[Join]:
    """The front from the contour inwards, then every change of partners that pairs two leftovers more."""
    joined: set[int] = set()
    for join in front(pairs):
        joined.update(join.joined)
        yield join
    yield from augment(pairs, joined)


def elements(pairs: Pairs, steps: Iterable[Join]) -> Ints:
    """(E, 4) quads in the order in which they were joined, then the triangles left, ending with -1."""
    joined: dict[int, None] = {}
    for join in steps:
        for pair in join.parted:
            del joined[pair]
        joined.update(dict.fromkeys(join.joined))
    return joined_elements(pairs, list(joined))


def joined_elements(pairs: Pairs, joined: Sequence[int]) -> Ints:
    """(E, 4) quads of the pairs in these rows, then the triangles left, ending with -1."""
    rows = np.asarray(joined, dtype=np.int64)
    left = np.ones(len(pairs.triangles), dtype=bool)
    left[pairs.members[rows]] = False
    triangles = pairs.triangles[left]
    padded = np.concatenate([triangles, np.full((len(triangles), 1), -1, dtype=np.int32)], axis=1)
    return ints(np.concatenate([pairs.quads[rows], padded]))
