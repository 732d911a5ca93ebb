"""Work that is done piece by piece, so that the window answers in between."""

from collections.abc import Callable
from time import perf_counter, thread_time

from PySide6.QtCore import QObject, Qt, QTimer

_LEAST, _MOST = 1, 3
"""Rest after a piece: as long as it took, within these bounds [ms]."""
_OTHERS = 0.001
"""Computing time of other things during a rest, from which on the rest is begun again [s]."""
_PATIENCE = 3
"""How often it is at most."""


class Turns(QObject):
    """Calls one thing at a time, in the order in which they were asked for.

    A piece of work is what cannot be parted: a picture, a panel. One that is asked for again before its turn is done
    once. Between two of them whatever waits gets its turn: keys, the mouse, timers, and what the first has left to be
    painted.
    """

    def __init__(self, parent: QObject | None = None) -> None:
        super().__init__(parent)
        self._pieces: dict[Callable[[], None], None] = {}
        self._rested_from = 0.0
        self._waited = 0
        self._clock = QTimer(self, singleShot=True, timerType=Qt.TimerType.PreciseTimer)
        self._clock.timeout.connect(self._tick)

    def ask(self, piece: Callable[[], None]) -> None:
        """Have something done soon."""
        self._pieces.setdefault(piece)
        if not self._clock.isActive():
            self._rest(_LEAST)

    def stop(self) -> None:
        """Forget what has not been done."""
        self._pieces.clear()
        self._clock.stop()

    def _rest(self, milliseconds: int) -> None:
        self._rested_from = thread_time()
        self._clock.start(milliseconds)

    def _tick(self) -> None:
        if not self._pieces:
            return
        was_busy = thread_time() - self._rested_from > _OTHERS
        if was_busy and self._waited < _PATIENCE:
            self._waited += 1  # what the window was busy with may not be through yet
            self._rest(_LEAST)
        else:
            self._waited = 0
            self._do(next(iter(self._pieces)))

    def _do(self, piece: Callable[[], None]) -> None:
        del self._pieces[piece]
        started = perf_counter()
        piece()
        took = round(1000 * (perf_counter() - started))
        self._rest(min(max(took, _LEAST), _MOST))
