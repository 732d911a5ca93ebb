"""The course of a plate's mesh: its track as rows of numbers, and as lines of not too many points."""

from collections.abc import Iterator

import attrs
import numpy as np

from hullquad.arrays import Bools, Floats, Longs, floats
from hullquad.metrics import Metric
from hullquad.optimization.objective import Objective
from hullquad_app.stage_words import stage_words
from hullquad_app.track import Track


@attrs.frozen(eq=False, kw_only=True)
class Part:
    """Consecutive iterates whose numbers can be compared."""

    start: int
    end: int
    """Position after the last."""
    by: Metric
    """By which they were judged."""
    weighted: Objective | None = None
    """What their objective is made of where it is not the sum of that metric."""

    @property
    def rises(self) -> bool:
        """Whether their objective rises as it becomes better."""
        return self.weighted is not None or self.by.higher_is_better

    def is_like(self, other: "Part") -> bool:
        """Whether the iterates of both can be compared."""
        return self.by is other.by and self.weighted == other.weighted


@attrs.frozen(kw_only=True)
class Stage:
    """Where a run went over to something else."""

    start: int
    """Position of the first iterate."""
    words: str


@attrs.frozen(eq=False, kw_only=True)
class Course:
    """Numbers of every iterate of a track."""

    numbers: Floats = attrs.field(converter=floats)
    objectives: Floats = attrs.field(converter=floats)
    worsts: Floats = attrs.field(converter=floats)
    parts: tuple[Part, ...]
    best: int
    """Position of the best iterate of the last run."""
    stages: tuple[Stage, ...] = ()
    """Of all runs that had some."""

    def part_at(self, position: int) -> Part:
        """The part that an iterate belongs to."""
        return next(part for part in self.parts if position < part.end)

    def nearest(self, number: float) -> int:
        """Position of the iterate whose number is nearest."""
        after = int(np.searchsorted(self.numbers, number))
        around = [position for position in (after - 1, after) if 0 <= position < len(self.numbers)]
        return min(around, key=lambda position: abs(self.numbers[position] - number))

    def alike(self, other: Part) -> Bools:
        """(I,) which iterates can be compared with those of a part."""
        mask = np.zeros(len(self.numbers), dtype=bool)
        for part in self.parts:
            mask[part.start : part.end] = part.is_like(other)
        return mask


def course(track: Track) -> Course:
    """The numbers of a track's iterates."""
    return Course(
        numbers=[iterate.number for iterate in track.iterates],
        objectives=[iterate.objective for iterate in track.iterates],
        worsts=[iterate.quality.worst for iterate in track.iterates],
        parts=tuple(_parts(track)),
        best=max((row for row, iterate in enumerate(track.iterates) if iterate.is_best), default=0),
        stages=tuple(_stages(track)),
    )


def _stages(track: Track) -> Iterator[Stage]:
    before = ""
    for row, iterate in enumerate(track.iterates):
        if iterate.stage and iterate.stage != before:
            yield Stage(start=row, words=stage_words(iterate.stage))
        before = iterate.stage


def _parts(track: Track) -> Iterator[Part]:
    is_weighted = any(len(passage.objective.terms) > 1 for passage in track.passages)
    kinds = [
        (iterate.quality.metric, track.weighted_at(iterate.number) if is_weighted else None)
        for iterate in track.iterates
    ]
    starts = [row for row, kind in enumerate(kinds) if row == 0 or kind != kinds[row - 1]]
    for start, end in zip(starts, [*starts[1:], len(kinds)], strict=True):
        by, weighted = kinds[start]
        yield Part(start=start, end=end, by=by, weighted=weighted)


def thinned(places: Floats, values: Floats, width: float = 1.0) -> Longs:
    """Rows of the points that a line of some width needs: the ends, and the least and greatest of each column.

    Parameters
    ----------
    places : (P,) float array
        Where the points are drawn, from left to right [px].
    values : (P,) float array
    width
        Of the columns [px].
    """
    columns = np.floor(places / width).astype(np.int64)
    starts = np.flatnonzero(np.r_[True, columns[1:] != columns[:-1]])
    if len(starts) * 2 > len(places):
        return np.arange(len(places))
    ends = np.r_[starts[1:], len(places)] - 1
    order = np.lexsort((values, columns))  # within a column from the least value to the greatest
    return np.unique(np.concatenate([[0], order[starts], order[ends], [len(places) - 1]]))
