"""What a plate's mesh has gone through: iterates kept within a budget of bytes, so that each can be shown."""

from bisect import bisect_right
from collections.abc import Iterable, Sequence

import attrs

from hullquad.optimization.iterate import Iterate
from hullquad.optimization.objective import Objective
from hullquad_app.making import Making
from hullquad_app.passage import Passage

BUDGET = 512 * 2**20
"""Bytes that the iterates of one plate may take."""


@attrs.frozen(eq=False)
class Track:
    """Iterates in order; the first is the mesh as it was made or loaded.

    `Iterate.number` counts through all runs; where iterates were dropped for want of room, numbers are missing.
    """

    iterates: tuple[Iterate, ...]
    passages: tuple[Passage, ...] = ()
    """The runs that they came of, as far as that is known."""
    making: Making = attrs.field(factory=Making)
    """What the first one was made from, step by step: triangles, quads and what was done to them."""

    @property
    def first(self) -> Iterate:
        """The mesh as it was made or loaded."""
        return self.iterates[0]

    @property
    def last(self) -> Iterate:
        """The newest iterate."""
        return self.iterates[-1]

    def until(self, position: int) -> "Track":
        """The track up to that iterate: what a run that starts there goes on from."""
        kept = self.iterates[: position + 1]
        passages = tuple(passage for passage in self.passages if passage.start < kept[-1].number)
        return attrs.evolve(self, iterates=kept, passages=passages)

    @property
    def as_made(self) -> "Track":
        """The track without all that was done to the mesh after it was made or loaded."""
        return attrs.evolve(self, iterates=(self.first,), passages=())

    def with_passage(self, passage: Passage) -> "Track":
        """The track with what is known of its last run; what was known of it before is out of date."""
        others = (other for other in self.passages if other.start != passage.start)
        return attrs.evolve(self, passages=(*others, passage))

    def passage_at(self, number: int) -> Passage | None:
        """The run that an iterate came of; the first iterate came of none."""
        return next((passage for passage in reversed(self.passages) if passage.start < number), None)

    def with_run(self, run: Iterable[Iterate], budget: int = BUDGET) -> "Track":
        """The track with the iterates of a run that began with its last one, thinned to the budget."""
        began, *later = run
        again = attrs.evolve(began, number=self.last.number)
        return attrs.evolve(self, iterates=(*self.iterates[:-1], again)).with_more(later, self.last.number, budget)

    def with_more(self, later: Iterable[Iterate], offset: int, budget: int = BUDGET) -> "Track":
        """The track with further iterates of a run that began at the number `offset`."""
        numbered = (attrs.evolve(iterate, number=iterate.number + offset) for iterate in later)
        return attrs.evolve(self, iterates=tuple(thinned((*self.iterates, *numbered), budget)))

    def weighted_at(self, number: int) -> Objective | None:
        """The metrics and weights of that iterate's objective; None where it is the sum of one metric."""
        by = next((passage.objective for passage in reversed(self.passages) if passage.start <= number), None)
        return by if by is not None and len(by.terms) > 1 else None

    def row(self, number: int) -> int:
        """Position of the iterate of that number, or of the one kept before it."""
        return max(bisect_right(self.iterates, number, key=lambda iterate: iterate.number) - 1, 0)

    def best_of_run(self, start: int) -> int:
        """Position of the best iterate from position `start` on."""
        rows = range(start, len(self.iterates))
        return max(row for row in rows if row == start or self.iterates[row].is_best)


def thinned(iterates: Sequence[Iterate], budget: int) -> Sequence[Iterate]:
    """Every second iterate left out, again and again, until they fit; the first, last and best always stay."""
    while len(iterates) > 4 and len(iterates) * _bytes(iterates[-1]) > budget:
        best = max((row for row, iterate in enumerate(iterates) if iterate.is_best), default=0)
        kept = {*range(0, len(iterates), 2), best, len(iterates) - 1}
        iterates = [iterates[row] for row in sorted(kept)]
    return iterates


def _bytes(iterate: Iterate) -> int:
    mesh, quality = iterate.mesh, iterate.quality
    parameters = 0 if mesh.parameters is None else mesh.parameters.nbytes
    return mesh.points.nbytes + parameters + quality.values.nbytes + quality.valid.nbytes + quality.failing.nbytes
