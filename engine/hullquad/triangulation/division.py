"""A part of an edge, from one fixed node to the next, divided into equal segments."""

import heapq
from collections.abc import Sequence
from typing import Protocol

import numpy as np

from hullquad.arrays import Floats
from hullquad.curves import Curve, Straight

_MOST_TURN = np.radians(60)
"""An arc may turn so much in a segment."""
_ROUNDING = 1e-6
_DIGITS = 9


class End(Protocol):
    """A fixed node at an end of a part."""

    @property
    def length(self) -> float:
        """From the start of the edge's canonical curve [mm]."""

    @property
    def own(self) -> Floats:
        """(2,) in the plate's plane."""


def nodes(curve: Curve, first: End, last: End, number: int) -> Floats:
    """(number + 1, 2) nodes of a part of an edge; its ends keep their bits."""
    if isinstance(curve, Straight):
        row = first.own + (np.arange(number + 1) / number)[:, None] * (last.own - first.own)
    else:
        row = curve.points(_stations(first.length, last.length, number))
    row[0], row[-1] = first.own, last.own
    return row


def equal(length: float, size: float) -> int:
    """Number of equal segments that are nearest to a size.

    The last digits of a length are rounding, and must not decide between two numbers that are equally near.
    """
    return max(1, round(round(length / size, _DIGITS)))


def turning_little(curve: Curve, start: float, end: float, number: int) -> int:
    """Number of equal segments, from `number` on, none of which turns too much."""
    while not isinstance(curve, Straight):
        turns = np.abs(np.diff(curve.headings(_stations(start, end, number))))
        excess = float(turns.max()) / _MOST_TURN
        if excess <= 1 + _ROUNDING:
            break
        number = max(number + 1, int(number * min(excess, 1.5)))
    return number


def shared_out(wished: int, lengths: Sequence[float]) -> list[int]:
    """Share out segments among the parts of an edge: one each, every further one where they are longest."""
    numbers = [1] * len(lengths)
    longest = [(-length, i) for i, length in enumerate(lengths)]
    heapq.heapify(longest)
    for _ in range(wished - len(lengths)):
        _, i = longest[0]
        numbers[i] += 1
        heapq.heapreplace(longest, (-lengths[i] / numbers[i], i))
    return numbers


def _stations(start: float, end: float, number: int) -> Floats:
    return start + (end - start) * (np.arange(number + 1) / number)
