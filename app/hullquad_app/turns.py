"""Work that is done piece by piece, so that the window answers in between."""

from collections.abc import Callable

from PySide6.QtCore import QElapsedTimer, QObject, Qt, QTimer

TICK = 10
"""Between the beginnings of two pieces, at least [ms]."""
_IDLE = 500
"""Time without work after which the clock stops [ms]."""


class Turns(QObject):
    """Calls one thing at a time, in the order in which they were asked for.

    A piece of work is what cannot be parted: a picture, a panel. One that is asked for again before its turn is done
    once. Between two of them whatever waits gets its turn: keys, the mouse, timers, and what the first has left to be
    painted.
    """

    def __init__(self, parent: QObject | None = None) -> None:
        super().__init__(parent)
        self._pieces: dict[Callable[[], None], None] = {}
        self._asked, self._since = QElapsedTimer(), QElapsedTimer()
        self._waits = False
        self._clock = QTimer(self, interval=TICK, timerType=Qt.TimerType.PreciseTimer)
        self._clock.timeout.connect(self._tick)

    def ask(self, piece: Callable[[], None]) -> None:
        """Have something done soon."""
        self._pieces.setdefault(piece)
        self._asked.start()
        if not self._clock.isActive():
            self._since.start()
            self._clock.start()

    def stop(self) -> None:
        """Forget what has not been done."""
        self._pieces.clear()
        self._clock.stop()

    def _tick(self) -> None:
        was_busy = self._since.restart() > TICK
        if not self._pieces:
            if self._asked.hasExpired(_IDLE):
                self._clock.stop()
        elif was_busy and not self._waits:
            self._waits = True  # what the window was busy with may not be through yet
        else:
            self._waits = False
            self._do(next(iter(self._pieces)))

    def _do(self, piece: Callable[[], None]) -> None:
        del self._pieces[piece]
        piece()
        self._since.start()
