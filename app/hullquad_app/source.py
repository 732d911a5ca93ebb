"""Where the iterates of a run come from, and how long they have taken to make."""

from collections.abc import Generator
from math import inf
from time import perf_counter

import attrs

from hullquad.optimization.iterate import Iterate
from hullquad.optimization.stops import TIME


class Source:
    """The iterates of one run, made as they are asked for, by one thread at a time: a pause is not asking.

    Parameters
    ----------
    iterates
        Of the run, the mesh that it begins with first.
    seconds
        Most time that may be spent on making them; pauses do not count.
    """

    def __init__(self, iterates: Generator[Iterate, None, None], seconds: float = inf) -> None:
        self.seconds = 0.0
        """Spent so far."""
        self._iterates, self._most = iterates, seconds

    def __iter__(self) -> "Source":
        return self

    def __next__(self) -> Iterate:
        started = perf_counter()
        iterate = next(self._iterates)
        _ = iterate.quality.worst_element  # found here and kept, so that no window has to
        self.seconds += perf_counter() - started
        if self.seconds < self._most or iterate.stop is not None or iterate.number == 0:
            return iterate
        self.close()
        return attrs.evolve(iterate, stop=TIME)

    def close(self) -> None:
        """Give the run up; it makes no further iterate."""
        self._iterates.close()
