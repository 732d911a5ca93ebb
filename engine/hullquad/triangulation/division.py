"""An edge divided into segments between its fixed nodes."""

import heapq
from itertools import pairwise

import numpy as np

from hullquad.arrays import Floats
from hullquad.curves import Curve, Straight
from hullquad.triangulation.anchors import Anchor

_MOST_TURN = np.radians(60)
"""An arc may turn so much in a segment."""
_ROUNDING = 1e-6


def counts(curve: Curve, anchors: list[Anchor], size: float, wished: int | None) -> list[int]:
    """Number of segments of each part of an edge, between its fixed nodes.

    Parameters
    ----------
    curve : Curve
        The edge, in its canonical direction.
    anchors : list of Anchor
        Fixed nodes on it, in order.
    size : float
        Length that a segment should have [mm].
    wished : int or None
        Number of segments of the whole edge, instead of `size`.
    """
    breaks = [0.0, *(anchor.length for anchor in anchors), curve.length]
    lengths = [end - start for start, end in pairwise(breaks)]
    numbers = _shared_out(wished, lengths) if wished else [max(1, round(length / size)) for length in lengths]
    return [_turning_little(curve, start, end, n) for (start, end), n in zip(pairwise(breaks), numbers, strict=True)]


def nodes(curve: Curve, anchors: list[Anchor], numbers: list[int]) -> Floats:
    """(N, 2) nodes from the start of the edge to its end; the ends and the anchors keep their bits."""
    stops = [Anchor(0.0, curve.start), *anchors, Anchor(curve.length, curve.end)]
    parts = [_part(curve, first, last, n) for (first, last), n in zip(pairwise(stops), numbers, strict=True)]
    return np.concatenate([*parts, curve.end[None]])


def _part(curve: Curve, first: Anchor, last: Anchor, number: int) -> Floats:
    """Nodes of a part of an edge, without its last."""
    if isinstance(curve, Straight):
        return first.point + (np.arange(number) / number)[:, None] * (last.point - first.point)
    part = curve.points(_stations(first.length, last.length, number)[:-1])
    part[0] = first.point
    return part


def _stations(start: float, end: float, number: int) -> Floats:
    return start + (end - start) * (np.arange(number + 1) / number)


def _turning_little(curve: Curve, start: float, end: float, number: int) -> int:
    """Number of equal segments, from `number` on, none of which turns too much."""
    while not isinstance(curve, Straight):
        turns = np.abs(np.diff(curve.headings(_stations(start, end, number))))
        excess = float(turns.max()) / _MOST_TURN
        if excess <= 1 + _ROUNDING:
            break
        number = max(number + 1, int(number * min(excess, 1.5)))
    return number


def _shared_out(wished: int, lengths: list[float]) -> list[int]:
    """Share out segments among the parts of an edge: one each, every further one where they are longest."""
    numbers = [1] * len(lengths)
    longest = [(-length, i) for i, length in enumerate(lengths)]
    heapq.heapify(longest)
    for _ in range(wished - len(lengths)):
        _, i = longest[0]
        numbers[i] += 1
        heapq.heapreplace(longest, (-lengths[i] / numbers[i], i))
    return numbers
