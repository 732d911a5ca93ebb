"""Numbers of segments of the pieces of lines: near the element size, with as few odd regions as can be.

Opposite sides of regions with four sides get the same number where they may be chosen, so that these regions become
grids: such pieces are a *row* that is changed together. Sides of regions with three sides get two at least, for the
three quads that meet inside such a region need them. Then rows are changed by one segment wherever that leaves fewer
regions with an odd contour (`parity`), those first whose segments stay nearest to the element size.
"""

from collections.abc import Iterator, Mapping
from math import log, sqrt

import numpy as np

from hullquad.arrays import Longs, longs
from hullquad.triangulation import division, parity
from hullquad.triangulation.arrangement import Arrangement
from hullquad.triangulation.sides import Sides

_TAPER = 1.6
"""Longest over shortest piece of a row; and how many times longer or shorter than the size its segments may be."""
_SHORTER = 2.5
"""How many times shorter than the size segments of a side of three may be."""
_GRID_LOST = 1.0
"""Weight of a change that makes a region no grid any more; a segment twice too long or too short weighs 0.7."""
_LEAST = 1e-3


def numbers(found: Arrangement, around: Sides, size: float, given: Mapping[int, int]) -> Longs:
    """(P,) number of segments of each piece of an arrangement.

    Parameters
    ----------
    found : Arrangement
    around : Sides
        Of the contour's segments and of the pieces as they are.
    size : float
        Element size [mm].
    given : mapping
        Numbers that cannot be chosen, by piece.
    """
    work = _Rows(found, around, size, given)
    for one, other in work.opposite():
        work.unite(one, other)
    for one, other in work.opposite():
        work.match(one, other)
    work.widen()
    work.even()
    return work.numbers


class _Rows:
    """Pieces that are divided alike, and their numbers."""

    def __init__(self, found: Arrangement, around: Sides, size: float, given: Mapping[int, int]) -> None:
        self._around, self._size, self._lengths = around, size, found.lengths
        self.numbers = longs([given.get(i) or division.equal(x, size) for i, x in enumerate(self._lengths)]).copy()
        self._row = np.arange(len(self.numbers))
        self._row[list(given)] = -1
        self._settled = np.zeros(len(self.numbers), dtype=bool)
        whole = {**around.three_sided, **around.four_sided}
        self._parts = {region: tuple(map(self._pieces, parts)) for region, parts in whole.items()}

    def opposite(self) -> Iterator[tuple[Longs, Longs]]:
        """Opposite sides of the regions that have four, as pieces; -1 is a segment of the contour."""
        for region in self._around.four_sided:
            a, b, c, d = self._parts[region]
            yield a, c
            yield b, d

    def unite(self, one: Longs, other: Longs) -> None:
        """Make rows of pieces that face each other and are about as long."""
        if len(one) == len(other):
            for first, second in zip(one.tolist(), other.tolist()[::-1], strict=True):
                self._unite(first, second)

    def _unite(self, one: int, other: int) -> None:
        first, second = self._row_of(one), self._row_of(other)
        if min(first, second) < 0 or first == second:
            return
        members = np.flatnonzero((self._row == first) | (self._row == second))
        lengths = self._lengths[members]
        if lengths.max() <= _TAPER * lengths.min():
            self._row[members] = min(first, second)
            self.numbers[members] = division.equal(sqrt(lengths.min() * lengths.max()), self._size)

    def match(self, one: Longs, other: Longs) -> None:
        """Give a single piece, with its row, the number of segments that are opposite."""
        for single, opposite in ((one, other), (other, one)):
            row = self._row_of(single[0]) if len(single) == 1 else -1
            if row < 0 or self._settled[row] or any(self._row_of(piece) == row for piece in opposite):
                continue
            members, number = self._members(row), self._count(opposite)
            if max(self._misfit(members, number)) <= log(_TAPER):
                self.numbers[members] = number
                self._settled[row] = True

    def widen(self) -> None:
        """Divide sides of regions with three of them in two, if that makes no segment too short."""
        for region in self._around.three_sided:
            for pieces in self._parts[region]:
                row = self._row_of(pieces[0]) if len(pieces) == 1 else -1
                if row >= 0 and self.numbers[row] == 1 and max(self._misfit(self._members(row), 2)) <= log(_SHORTER):
                    self.numbers[self._members(row)] = 2

    def even(self) -> None:
        """Change rows, or single pieces of them, by one segment wherever that leaves fewer odd regions."""
        regions = int(self._around.regions.max()) + 1
        counts = np.bincount(self._around.regions, self._of_sides(self.numbers), minlength=regions).astype(np.int64)
        rows = [self._members(row) for row in np.unique(self._row[self._row >= 0]).tolist()]
        singles = [longs([piece]) for members in rows if len(members) > 1 for piece in members.tolist()]
        choices = [choice for members in (*rows, *singles) if (choice := self._choice(members)) is not None]
        ways = [(one, other, weight) for (one, other), weight, _, _ in choices]
        reluctance = dict.fromkeys(self._parts, _GRID_LOST)
        for way in sorted(parity.changes(regions, np.flatnonzero(counts % 2).tolist(), ways, reluctance)):
            _, _, members, step = choices[way]
            self.numbers[members] += step if (self.numbers[members] + step > 0).all() else -step

    def _choice(self, members: Longs) -> tuple[tuple[int, int], float, Longs, int] | None:
        """The two regions that one segment more or fewer of pieces makes odd or even, its weight, and the step."""
        sides = np.concatenate([members, members + len(self.numbers)]) + self._around.contour
        flipped = np.flatnonzero(np.bincount(self._around.regions[sides]) % 2)
        if len(flipped) != 2:
            return None
        before = int(self.numbers[members[0]])
        weight, step = min((sum(self._misfit(members, before + step)), step) for step in (1, -1) if before + step)
        lost = sum(self._loses_grid(region, members, before + step) for region in flipped.tolist())
        return (int(flipped[0]), int(flipped[1])), weight + _GRID_LOST * lost + _LEAST, members, step

    def _loses_grid(self, region: int, members: Longs, number: int) -> bool:
        """Whether the sides of a region agree, but would not with another number of segments of some pieces."""
        if region not in self._parts:
            return False
        kept, agreed = self.numbers.copy(), self._agrees(region)
        self.numbers[members] = number
        agrees = self._agrees(region)
        self.numbers = kept
        return agreed and not agrees

    def _agrees(self, region: int) -> bool:
        """Whether opposite ones of four sides have as many segments, or none of three as many as the others or more."""
        counts = [self._count(part) for part in self._parts[region]]
        if len(counts) == 3:
            return 2 * max(counts) < sum(counts)
        return counts[:2] == counts[2:]

    def _misfit(self, members: Longs, number: int) -> list[float]:
        return [abs(log(length / number / self._size)) for length in self._lengths[members].tolist()]

    def _pieces(self, sides: Longs) -> Longs:
        """Piece of each side, -1 for those of the contour."""
        rank = sides - self._around.contour
        return longs(np.where(rank < 0, -1, rank % max(1, len(self.numbers))))

    def _row_of(self, piece: int) -> int:
        return int(self._row[piece]) if piece >= 0 else -1

    def _members(self, row: int) -> Longs:
        return longs(np.flatnonzero(self._row == row))

    def _count(self, pieces: Longs) -> int:
        """Number of segments of a side."""
        return int(np.where(pieces < 0, 1, self.numbers[pieces]).sum())

    def _of_sides(self, numbers: Longs) -> Longs:
        """(S,) number of segments of each side."""
        return longs(np.concatenate([np.ones(self._around.contour, dtype=np.int64), numbers, numbers]))
