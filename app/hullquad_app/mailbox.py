"""A thread that pulls from a generator, and the mailbox where the window finds what it yielded."""

import threading
from collections.abc import Callable, Iterator, Sequence
from typing import Any, Generic, TypeVar

Letter = TypeVar("Letter")


class Mailbox(Generic[Letter]):
    """What a generator yields in a thread of its own, until somebody takes it.

    The thread knows nothing of Qt: whoever waits for letters looks into the box from time to time.

    Parameters
    ----------
    letters
        Starts the generator, in the thread.
    thinned
        Those of the waiting letters for which there is room: the same object when there is for all.
    """

    def __init__(
        self,
        letters: Callable[[], Iterator[Letter]],
        thinned: Callable[[Sequence[Letter]], Sequence[Letter]] = lambda waiting: waiting,
    ) -> None:
        self.result: Any = None
        """What the generator returned."""
        self.problem: Exception | None = None
        """What it raised."""
        self.is_complete = False
        """Whether it came to its end by itself."""
        self._letters, self._thinned = letters, thinned
        self._waiting: list[Letter] = []
        self._lock = threading.Lock()
        self._stopped = threading.Event()
        self._thread = threading.Thread(target=self._pull, name="hullquad mailbox", daemon=True)
        self._thread.start()

    @property
    def is_over(self) -> bool:
        """Whether no letter will come any more; those in the box can still be taken."""
        return not self._thread.is_alive()

    def take(self) -> list[Letter]:
        """Every letter in the box."""
        with self._lock:
            taken, self._waiting = self._waiting, []
        return taken

    def stop(self) -> None:
        """Pull no further; the letter in the making still comes."""
        self._stopped.set()

    def join(self, seconds: float | None = None) -> None:
        """Wait for the end of the thread."""
        self._thread.join(seconds)

    def _pull(self) -> None:
        try:
            letters = self._letters()
            while not self._stopped.is_set():
                self._leave(next(letters))
        except StopIteration as end:
            self.result, self.is_complete = end.value, True
        except Exception as problem:  # noqa: BLE001  # whatever it was, the window has to hear of it
            self.problem = problem

    def _leave(self, letter: Letter) -> None:
        with self._lock:
            self._waiting.append(letter)
            kept = self._thinned(self._waiting)
            if kept is not self._waiting:
                self._waiting = list(kept)
