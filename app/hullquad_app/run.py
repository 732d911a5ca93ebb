"""A run of the optimiser: it iterates in a thread, and the window gets the iterates when it has time for them."""

from collections.abc import Iterator
from functools import partial
from itertools import islice
from math import ceil
from time import perf_counter

from PySide6.QtCore import QObject, Qt, QTimer, Signal

from hullquad.optimization.iterate import Iterate
from hullquad.optimization.stops import Stop
from hullquad_app.mailbox import Mailbox
from hullquad_app.track import thinned

BUDGET = 128 * 2**20
"""Bytes of iterates that may wait for a slow window; beyond, some are left out."""
LEAST_WAIT = 1 / 30
"""Time between two looks into the mailbox [s]."""
FIRST_WAIT = 0.005
"""Time until the first one: a single step is shown at once [s]."""


class Run(QObject):
    """The optimiser at work; starts again after every end.

    All signals come in the thread that owns this object, `advanced` before `ended` or `failed`.
    """

    advanced = Signal(object)
    """Emitted with the list of new iterates."""
    ended = Signal(object)
    """Emitted with the `Stop` of a run that ended by itself, None after a pause or when so many were made."""
    failed = Signal(object)
    """Emitted instead with the exception that ended the run."""

    def __init__(self, parent: QObject | None = None, budget: int = BUDGET) -> None:
        super().__init__(parent)
        self._thinned = partial(thinned, budget=budget)
        self._mailbox: Mailbox[Iterate] | None = None
        self._stop: Stop | None = None
        self._painting = 0.0
        self._timer = QTimer(self, singleShot=True, timerType=Qt.TimerType.PreciseTimer)
        self._timer.timeout.connect(self._fetch)

    @property
    def is_running(self) -> bool:
        """Whether `ended` or `failed` is still to come."""
        return self._mailbox is not None

    def start(self, iterates: Iterator[Iterate], count: int | None = None) -> None:
        """Have iterates made until they end by themselves, `count` of them are there, or a pause.

        Nobody else may ask for them meanwhile; afterwards another start goes on with the next one.
        """
        if self._mailbox is not None:
            raise RuntimeError("a run goes on")
        self._stop = None
        self._mailbox = Mailbox(lambda: islice(iterates, count), self._thinned)
        self._wait(FIRST_WAIT)

    def pause(self) -> None:
        """End the run after the iterate in the making; returns at once."""
        if self._mailbox is not None:
            self._mailbox.stop()

    def finish(self) -> None:
        """Pause, and hand over what is left: `ended` or `failed` comes before this returns."""
        if self._mailbox is not None:
            self._mailbox.stop()
            self._mailbox.join()
            self._fetch()

    def stop_and_wait(self) -> None:
        """End the run and its thread; no signal comes any more."""
        mailbox, self._mailbox = self._mailbox, None
        self._timer.stop()
        if mailbox is not None:
            mailbox.stop()
            mailbox.join()

    def painted(self, seconds: float) -> None:
        """Tell how long the window has last painted: it will be left as much time for other things."""
        self._painting = seconds

    def _wait(self, seconds: float) -> None:
        self._timer.start(ceil(seconds * 1000))

    def _fetch(self) -> None:
        mailbox = self._mailbox
        if mailbox is None:
            return
        is_over = mailbox.is_over  # asked before: an over mailbox gets no letter after it was emptied
        started = perf_counter()
        self._hand_over(mailbox.take())
        if self._mailbox is not mailbox:  # whoever got the iterates has ended the run
            return
        if is_over:
            self._end(mailbox.problem)
        else:
            self._wait(max(LEAST_WAIT, perf_counter() - started, self._painting))

    def _hand_over(self, iterates: list[Iterate]) -> None:
        if iterates:
            self._stop = iterates[-1].stop
            self.advanced.emit(iterates)

    def _end(self, problem: Exception | None) -> None:
        self._mailbox = None
        self._timer.stop()
        if problem is None:
            self.ended.emit(self._stop)
        else:
            self.failed.emit(problem)
