"""A child process as its parent sees it."""

import os
import queue
import signal
import subprocess
import sys
import threading
import time
from pathlib import Path

from hullquad.worker.messages import receive, send

# sys.path is handed over as it is: hullquad may be importable only because a script has extended it
BOOT = "import sys; sys.path[:] = sys.argv[1:]; from hullquad.worker.child import main; main()"

START_SECONDS = 60.0
"""Time to import the child's modules, on a slow disk behind a virus scanner."""

GLANCE_SECONDS = 0.2
"""Windows delivers Ctrl+C only between two waits, so no wait is longer."""


class Child:
    """A process that answers one call after the other, until it is closed or dies.

    A thread writes the calls and reads the answers, so that a time limit holds for both.
    """

    def __init__(self) -> None:
        self._process = _process()
        self._ready = False
        self._requests: queue.SimpleQueue[bytes | None] = queue.SimpleQueue()
        self._replies: queue.SimpleQueue[bytearray | None] = queue.SimpleQueue()
        self._thread = threading.Thread(target=self._converse, name="hullquad worker pipe", daemon=True)
        self._thread.start()

    @property
    def is_alive(self) -> bool:
        """Whether the process runs."""
        return self._process.poll() is None

    def wait_until_ready(self) -> None:
        """Return when the child has imported what it needs; TimeoutError or EOFError like `answer`."""
        if not self._ready:
            self._reply(START_SECONDS)
            self._ready = True

    def answer(self, request: bytes, seconds: float) -> bytearray:
        """Reply to a call.

        Raises
        ------
        TimeoutError
            There is none within `seconds`.
        EOFError
            The process died.
        """
        self._requests.put(request)
        return self._reply(seconds)

    def kill(self) -> None:
        """End the process now; a waiting `answer` raises EOFError."""
        self._process.kill()

    def close(self) -> str:
        """End the process and everything it holds; says how it ended, if it had by itself."""
        try:
            self._process.wait(0 if self._thread.is_alive() else GLANCE_SECONDS)  # a closed pipe announces its end
        except subprocess.TimeoutExpired:
            self._process.kill()
        status = self._process.wait()
        self._requests.put(None)
        self._thread.join()
        for pipe in (self._process.stdin, self._process.stdout):
            if pipe is not None:
                pipe.close()
        return _description(status)

    def _reply(self, seconds: float) -> bytearray:
        deadline = time.monotonic() + seconds
        while (rest := deadline - time.monotonic()) > 0:
            try:
                reply = self._replies.get(timeout=min(rest, GLANCE_SECONDS))
            except queue.Empty:
                continue
            if reply is None:
                self._thread.join()
                raise EOFError
            return reply
        raise TimeoutError

    def _converse(self) -> None:
        """Body of the thread: the ready message, then call and reply in turn."""
        requests, replies = self._process.stdin, self._process.stdout
        assert requests is not None  # both are pipes
        assert replies is not None
        try:
            self._replies.put(receive(replies))
            while (request := self._requests.get()) is not None:
                send(requests, request)
                self._replies.put(receive(replies))
        except (EOFError, OSError):
            self._replies.put(None)


def _process() -> subprocess.Popen[bytes]:
    """Python with our modules, out of the reach of the terminal's Ctrl+C."""
    path = [entry or str(Path.cwd()) for entry in sys.path]
    return subprocess.Popen(  # noqa: S603  # our own interpreter and our own line
        [sys.executable, "-c", BOOT, *path],
        stdin=subprocess.PIPE,
        stdout=subprocess.PIPE,
        stderr=subprocess.DEVNULL,
        bufsize=0,
        env={**os.environ, "OPENBLAS_NUM_THREADS": "1", "OMP_NUM_THREADS": "1"},
        start_new_session=True,
        creationflags=_WINDOWS_FLAGS,
    )


def _windows_flags() -> int:
    if sys.platform == "win32":
        return subprocess.CREATE_NO_WINDOW | subprocess.CREATE_NEW_PROCESS_GROUP
    return 0


_WINDOWS_FLAGS = _windows_flags()


def _description(status: int) -> str:
    """How a process with this return code ended: ``signal SIGSEGV`` or ``exit status 0xC0000005``."""
    if status >= 0:
        return f"exit status {status}" if status < 256 else f"exit status {status:#X}"
    try:
        return f"signal {signal.Signals(-status).name}"
    except ValueError:
        return f"signal {-status}"
