"""Long work outside the GUI thread: one job at a time of each kind, with progress and cancel."""

import threading
from collections.abc import Callable, Mapping, Sequence
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING

from PySide6.QtCore import QObject, QTimer, Signal

from hullquad import worker
from hullquad.errors import HullquadError
from hullquad.mesh import Mesh
from hullquad.metrics import Metric
from hullquad.plate import Document
from hullquad_app import work
from hullquad_app.division import Attempt, Size
from hullquad_app.mailbox import Mailbox
from hullquad_app.mesher import Mesher
from hullquad_app.scene import State
from hullquad_app.work import Progress, Work

if TYPE_CHECKING:
    from hullquad.triangulation.remedies import Remedy

WAIT = 30
"""Time between two looks at a job [ms]."""


class Job(QObject):
    """One kind of work; of two that are started the later counts.

    All signals come in the thread that owns this object.

    Parameters
    ----------
    interrupt
        Ends what the thread may be waiting for.
    completes
        Whether the work is not left half done when the program ends.
    """

    progressed = Signal(object)
    """Emitted with `Progress`, also when the job begins."""
    done = Signal(object)
    """Emitted with the result."""
    refused = Signal(object)
    """Emitted with a `HullquadError` instead."""
    broke = Signal(object)
    """Emitted with any other exception instead."""
    ended = Signal()
    """Emitted after each of the three, and after a cancellation, when nothing of this kind runs any more."""

    def __init__(
        self,
        parent: QObject | None = None,
        interrupt: Callable[[], None] = lambda: None,
        *,
        completes: bool = False,
    ) -> None:
        super().__init__(parent)
        self._interrupt, self._completes = interrupt, completes
        self._mailbox: Mailbox[Progress] | None = None
        self._left: list[Mailbox[Progress]] = []
        self._timer = QTimer(self, interval=WAIT)
        self._timer.timeout.connect(self._fetch)

    @property
    def is_running(self) -> bool:
        """Whether an answer is still to come."""
        return self._mailbox is not None

    def start(self, made: Callable[[], Work]) -> None:
        """Begin; a job of this kind that is running is left to itself, and its answer ignored."""
        self.leave()
        self._mailbox = Mailbox(made)
        self._timer.start()

    def cancel(self) -> None:
        """Give the job up; returns at once, and no answer comes."""
        if self._mailbox is not None:
            self.leave()
            self._interrupt()
            self.ended.emit()

    def stop_and_wait(self) -> None:
        """Give the job up and wait for its thread; no signal comes any more."""
        self.leave()
        for mailbox in self._left:
            while not mailbox.is_over:
                self._interrupt()  # again and again: it may just have begun with what can be interrupted
                mailbox.join(0.05)

    def leave(self) -> None:
        """Leave the job to itself; no signal comes any more."""
        self._timer.stop()
        self._left = [mailbox for mailbox in self._left if not mailbox.is_over]
        if self._mailbox is not None:
            self._left.append(self._mailbox)
            if not self._completes:
                self._mailbox.stop()
        self._mailbox = None

    def _fetch(self) -> None:
        mailbox = self._mailbox
        assert mailbox is not None  # the timer runs as long as there is one
        is_over = mailbox.is_over
        for progress in mailbox.take()[-1:]:
            self.progressed.emit(progress)
        if is_over and self._mailbox is mailbox:
            self._mailbox = None
            self._timer.stop()
            self._answer(mailbox)

    def _answer(self, mailbox: Mailbox[Progress]) -> None:
        if mailbox.problem is None:
            self.done.emit(mailbox.result)
        elif isinstance(mailbox.problem, HullquadError):
            self.refused.emit(mailbox.problem)
        else:
            self.broke.emit(mailbox.problem)
        if not self.is_running:
            self.ended.emit()


class Jobs(QObject):
    """All kinds of work that the program does outside the GUI thread, apart from the optimiser's."""

    def __init__(self, parent: QObject | None = None) -> None:
        super().__init__(parent)
        self._is_prepared = threading.Event()
        self._is_prepared.set()  # without `prepare` everybody prepares what he needs
        self.preparing = Job(self, worker.cancel)
        self.opening = Job(self, self._cancel_worker)
        """Done with a `State`."""
        self.dividing = Job(self)
        """Done with a `Division`."""
        self.editing = Job(self)
        """Done with `dividing.Redivided`."""
        self.meshing = Job(self, self._cancel_worker)
        """Done with `work.Meshed`."""
        self.saving = Job(self, completes=True)
        """Done with the list of files."""
        self.all = (self.preparing, self.opening, self.dividing, self.editing, self.meshing, self.saving)

    def prepare(self) -> None:
        """Load the compiled kernels, and start the worker that meshes."""
        self._is_prepared.clear()
        self.preparing.start(partial(work.prepared, self._is_prepared))

    def open(self, path: Path, metric: Metric) -> None:
        """Read a document or a mesh."""
        self.opening.start(partial(work.opened, path, metric))

    def divide(self, plates: Document, size: Size, *, follows_lines: bool = False) -> None:
        """Divide the contours of all plates, and their lines if elements are to follow them."""
        self.dividing.start(partial(work.divided, plates, size, follows_lines=follows_lines))

    def edit(self, plates: Document, change: "Remedy | None", size: Size) -> None:
        """Divide an edge otherwise, or None: make all contours even."""
        self.editing.start(partial(work.edited, plates, change, size))

    def mesh(
        self,
        state: State,
        keys: Sequence[str],
        size: Size,
        mesher: Mesher,
        metric: Metric,
        contours: Mapping[str, Attempt] | None,
    ) -> None:
        """Mesh plates of a document; `contours` if they are known already."""
        self.meshing.start(partial(work.meshed, state, keys, size, mesher, metric, contours, self._is_prepared))

    def save(self, files: Mapping[Path, Mesh], metric: Metric) -> None:
        """Write meshes, with the values of a metric."""
        self.saving.start(partial(work.saved, files, metric))

    def save_plates(self, plates: Document, path: Path) -> None:
        """Write plates."""
        self.saving.start(partial(work.plates_saved, plates, path))

    def stop_and_wait(self) -> None:
        """End all threads and the worker; files are written to their end. No signal comes any more."""
        for job in self.all:
            job.leave()
        self.preparing.stop_and_wait()
        self._is_prepared.set()
        for job in self.all:
            job.stop_and_wait()
        worker.stop()

    def _cancel_worker(self) -> None:
        if self._is_prepared.is_set():  # until then the worker does something else
            worker.cancel()
