"""Ctrl+C while a program is still loading its libraries: there is nothing to tidy up, and nothing to tell."""

import os
import signal
import threading
from collections.abc import Iterator
from contextlib import contextmanager

INTERRUPTED = 130
"""The exit code."""


@contextmanager
def ending_at_once() -> Iterator[None]:
    """While this lasts, Ctrl+C ends the process at once, for libraries that are half loaded complain or swallow it."""
    usual = signal.default_int_handler
    if threading.current_thread() is not threading.main_thread() or signal.getsignal(signal.SIGINT) is not usual:
        yield
        return
    signal.signal(signal.SIGINT, lambda *_: os._exit(INTERRUPTED))
    try:
        yield
    finally:
        signal.signal(signal.SIGINT, usual)
