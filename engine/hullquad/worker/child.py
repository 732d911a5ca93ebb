"""The child process: answers calls until its standard input closes."""

import contextlib
import faulthandler
import importlib
import os
import pickle
import signal
import sys
import traceback
from collections.abc import Iterator
from io import FileIO
from pathlib import Path
from typing import IO, Any

from hullquad.errors import HullquadError
from hullquad.worker.messages import Outcome, receive, send

WARM_MODULES = ("numpy", "shapely", "triangle")
"""Imported before the first call, so that a spare takes over at once."""

ORPHAN_SECONDS = 5.0
"""How long after its time limit a child ends itself; its parent, if it lives, has killed it by then."""


def main() -> None:
    """Say that we are ready, then answer calls; ends when the parent closes the pipe or dies."""
    signal.signal(signal.SIGINT, signal.SIG_IGN)  # Ctrl+C is for the parent, which then ends us
    requests, replies = _private_pipes()
    for module in WARM_MODULES:
        with contextlib.suppress(ImportError):
            importlib.import_module(module)
    with contextlib.suppress(EOFError, OSError):
        send(replies, b"")
        while True:
            send(replies, _reply(receive(requests)))


def _private_pipes() -> tuple[IO[bytes], IO[bytes]]:
    """Both pipes on descriptors of their own: what a C library prints or reads cannot get between."""
    requests, replies = FileIO(os.dup(0), "rb"), FileIO(os.dup(1), "wb")
    nothing = os.open(os.devnull, os.O_RDONLY)
    os.dup2(nothing, 0)
    os.dup2(2, 1)
    os.close(nothing)
    return requests, replies


def _reply(request: bytearray) -> bytes:
    """Pickled outcome and result of a pickled call."""
    try:
        function, arguments, seconds, memory = pickle.loads(request)  # noqa: S301  # from our own parent
        with _ended_after(seconds + ORPHAN_SECONDS), _limited(memory):
            result = function(*arguments)
        return _pickled(Outcome.DONE, result)
    except HullquadError as error:
        return _pickled(Outcome.REFUSED, error)
    except MemoryError:
        return _pickled(Outcome.NO_MEMORY, None)
    except BaseException as error:  # noqa: BLE001  # whatever it was, the parent has to hear of it
        reason = traceback.format_exception_only(error)[-1].strip()
        return _pickled(Outcome.FAILED, (reason, traceback.format_exc()))


def _pickled(outcome: Outcome, value: Any) -> bytes:
    return pickle.dumps((outcome, value), protocol=pickle.HIGHEST_PROTOCOL)


@contextlib.contextmanager
def _ended_after(seconds: float) -> Iterator[None]:
    """End this process when the block takes longer, even inside C code: its parent may be dead."""
    with Path(os.devnull).open("w") as nowhere:
        faulthandler.dump_traceback_later(seconds, exit=True, file=nowhere)
        try:
            yield
        finally:
            faulthandler.cancel_dump_traceback_later()


@contextlib.contextmanager
def _limited(memory: int) -> Iterator[None]:
    """Refuse this process more than `memory` bytes on top of what it has; only Linux can."""
    if sys.platform != "linux":
        yield
        return
    import resource  # noqa: PLC0415  # not on Windows

    soft, hard = resource.getrlimit(resource.RLIMIT_AS)
    pages = int(Path("/proc/self/statm").read_text().split()[0])
    limit = pages * resource.getpagesize() + memory
    resource.setrlimit(resource.RLIMIT_AS, (limit if hard == resource.RLIM_INFINITY else min(limit, hard), hard))
    try:
        yield
    finally:
        resource.setrlimit(resource.RLIMIT_AS, (soft, hard))
