"""How long the parts of a command take, by the clock on the wall."""

from collections.abc import Iterator
from contextlib import contextmanager
from time import perf_counter


class Clock:
    """Seconds spent on each named part."""

    def __init__(self, *parts: str) -> None:
        self.seconds = dict.fromkeys(parts, 0.0)

    @contextmanager
    def running(self, part: str) -> Iterator[None]:
        """Count what is done meanwhile to that part."""
        start = perf_counter()
        try:
            yield
        finally:
            self.seconds[part] += perf_counter() - start

    def taken(self) -> dict[str, float]:
        """Seconds to the tenth of a millisecond since they were asked for the last time."""
        taken = {part: round(seconds, 4) for part, seconds in self.seconds.items()}
        self.seconds = dict.fromkeys(taken, 0.0)
        return taken
