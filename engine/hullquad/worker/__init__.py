"""A supervised process for what may crash, hang or eat memory: Triangle, foreign files.

It is a plain Python process with pickles on its pipes, not `multiprocessing`: that one runs the main script
a second time, which breaks scripts without a guard, scripts from standard input, and programs that embed Python.
"""

import atexit
import contextlib
import os
from collections.abc import Callable
from typing import Any, TypeVar

from hullquad.worker.supervisor import Supervisor, WorkerError

__all__ = ["MEMORY", "WorkerError", "call", "cancel", "start", "stop"]

Result = TypeVar("Result")

MEMORY = 2 * 1024**3
"""Bytes that a call may take on top of what the child has, unless it is told otherwise."""

_supervisor = Supervisor()


def _stop_at_exit() -> None:
    with contextlib.suppress(KeyboardInterrupt):  # pressed again while the program ends
        _supervisor.stop()


atexit.register(_stop_at_exit)
if hasattr(os, "register_at_fork"):
    os.register_at_fork(after_in_child=_supervisor.forget)


def call(function: Callable[..., Result], *arguments: Any, seconds: float, memory: int = MEMORY, place: str) -> Result:
    """What ``function(*arguments)`` returns in the child process; it may die there, and only there.

    Calls from several threads run one after the other. After every error the next call works.

    Parameters
    ----------
    function
        Of a module, not of the main script: the child imports it by its name.
    arguments
        Anything that can be pickled; they arrive as copies.
    seconds
        Time limit, from the moment the child is ready.
    memory
        Bytes that the call may take on top of what the child has (Linux only).
    place
        What the error names: ``plate H1``.

    Raises
    ------
    HullquadError
        The function's own, as itself.
    WorkerError
        E_WORKER after any other exception, E_CRASH, E_TIME, E_MEMORY, E_CANCELLED.
    """
    result: Result = _supervisor.result((function, arguments), seconds, memory, place)
    return result


def cancel() -> None:
    """End the running call, from another thread: it raises E_CANCELLED. Without one, nothing happens."""
    _supervisor.cancel()


def start() -> None:
    """Warm up: start the child and its spare without waiting for them."""
    _supervisor.start()


def stop() -> None:
    """End the child and its spare, and a running call with them; the next call starts new ones."""
    _supervisor.stop()
