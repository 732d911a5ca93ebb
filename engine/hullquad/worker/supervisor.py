"""The supervisor: a child at work, another in waiting."""

import contextlib
import pickle
import threading
from collections.abc import Iterator
from typing import Any

from hullquad.errors import HullquadError
from hullquad.worker.messages import Outcome
from hullquad.worker.process import Child


class WorkerError(HullquadError):
    """A call that broke down, took too long, took too much memory or was cancelled."""


class Supervisor:
    """Runs one call at a time in a child process; what goes wrong costs a child, never the program."""

    def __init__(self) -> None:
        self.forget()

    def forget(self) -> None:
        """Begin anew without the children: in a forked process they belong to the parent."""
        self._turn = threading.Lock()
        self._guard = threading.Lock()
        self._worker: Child | None = None
        self._spare: Child | None = None
        self._busy: Child | None = None
        self._cancelled = False

    def start(self) -> None:
        """Start the children unless they run, without waiting until they are ready."""
        if self._turn.acquire(blocking=False):  # else a call is running, and so are they
            try:
                self._started_worker()
                self._keep_spare()
            finally:
                self._turn.release()

    def stop(self) -> None:
        """End the children; a running call is cancelled."""
        self.cancel()
        with self._turn:
            for child in (self._worker, self._spare):
                if child is not None:
                    child.kill()
                    child.close()
            self._worker = self._spare = None

    def cancel(self) -> None:
        """End the running call, if there is one."""
        with self._guard:
            if self._busy is not None:
                self._cancelled = True
                self._busy.kill()

    def result(self, work: tuple[Any, ...], seconds: float, memory: int, place: str) -> Any:
        """What a call (function and arguments) returns; see `hullquad.worker.call`."""
        request = pickle.dumps((*work, seconds, memory), protocol=pickle.HIGHEST_PROTOCOL)
        with self._turn:
            child = self._started_worker()
            try:
                with self._cancellable(child, place):
                    outcome, value = self._reply(child, request, seconds, place)
                if outcome is Outcome.NO_MEMORY:
                    raise WorkerError("E_MEMORY", place, memory=memory / 1024**3)
                if outcome is Outcome.FAILED:
                    raise _failure(place, *value)
            except BaseException:  # Ctrl+C too: the child may be anywhere in its work
                self._drop_worker()
                raise
            finally:
                self._keep_spare()
        if outcome is Outcome.REFUSED:
            raise value
        return value

    def _reply(self, child: Child, request: bytes, seconds: float, place: str) -> Any:
        """Outcome and value."""
        try:
            child.wait_until_ready()
            return pickle.loads(child.answer(request, seconds))  # noqa: S301  # from our own child
        except TimeoutError:
            raise WorkerError("E_TIME", place, seconds=seconds) from None
        except EOFError:
            raise WorkerError("E_CRASH", place, ending=child.close()) from None

    @contextlib.contextmanager
    def _cancellable(self, child: Child, place: str) -> Iterator[None]:
        with self._guard:
            self._busy, self._cancelled = child, False
        try:
            yield
        finally:
            with self._guard:
                self._busy = None
            if self._cancelled:
                raise WorkerError("E_CANCELLED", place) from None

    def _started_worker(self) -> Child:
        """The child for the next call: the last one, else the spare, else a new one."""
        if self._worker is not None and not self._worker.is_alive:
            self._drop_worker()
        if self._worker is None:
            self._worker, self._spare = self._spare or Child(), None
        return self._worker

    def _drop_worker(self) -> None:
        if self._worker is not None:
            self._worker.kill()
            self._worker.close()
        self._worker, self._spare = self._spare, None

    def _keep_spare(self) -> None:
        if self._spare is None:
            self._spare = Child()


def _failure(place: str, reason: str, trace: str) -> WorkerError:
    error = WorkerError("E_WORKER", place, reason=reason)
    error.add_note(trace)
    return error
