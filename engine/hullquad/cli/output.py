"""What commands print: results on standard output, refusals, warnings and progress on standard error."""

import json
import sys
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from math import isfinite
from time import perf_counter
from typing import Any

from hullquad.errors import HullquadError
from hullquad.optimization.iterate import Iterate

_BAR = 30
_PAUSE = 0.2
"""Time between two words about the same work [s]."""
_USUAL = 1000
"""Iterations of the paper's method when no number is given."""


def say(text: str = "") -> None:
    """Print a line of the result."""
    print(text, flush=True)  # noqa: T201  printing is what a command line does


def complain(error: HullquadError) -> None:
    """Print a refusal: ``error CODE at PLACE: text``."""
    _remark(f"error {error}")


def warn(notice: object) -> None:
    """Print a warning: ``warning CODE at PLACE: text``."""
    _remark(f"warning {notice}")


def say_json(value: Any) -> None:
    """Print a value as JSON; what is not finite is null."""
    say(json.dumps(finite(value), indent=1, ensure_ascii=False, allow_nan=False))


def finite(value: Any) -> Any:
    """The same value with None for every number that JSON cannot hold."""
    if isinstance(value, dict):
        return {key: finite(item) for key, item in value.items()}
    if isinstance(value, list):
        return [finite(item) for item in value]
    return None if isinstance(value, float) and not isfinite(value) else value


class Progress:
    """One line on a terminal that tells how far a run is; nothing elsewhere."""

    is_watched = True

    def __init__(self, title: str, total: int | None) -> None:
        self._title = title
        self._total = total

    def show(self, iterate: Iterate) -> None:
        """Tell of an iterate."""
        if iterate.stage:
            self._say(f"{iterate.stage:<20} iteration {iterate.number}", iterate)
        elif iterate.number % max(1, (self._total or _USUAL) // 200) == 0:
            total = self._total or _USUAL
            bar = ("#" * int(_BAR * iterate.number / max(total, 1))).ljust(_BAR, ".")
            self._say(f"[{bar}] iteration {iterate.number} / {total}", iterate)

    def _say(self, text: str, iterate: Iterate) -> None:
        numbers = f"{iterate.objective:.4f}   worst {iterate.quality.worst:.3f}"
        print(f"\r{self._title} {text}   {numbers}\x1b[K", end="", file=sys.stderr, flush=True)  # noqa: T201


class Activity:
    """One line on a terminal that tells what is being done, and for how long."""

    def __init__(self, title: str) -> None:
        self._title, self._began, self._told = title, perf_counter(), 0.0
        self._say(f"{title} …")

    def tell(self, number: int, count: int) -> None:
        """Tell that it goes on, with a candidate of several."""
        since = perf_counter() - self._began
        if since - self._told >= _PAUSE:
            self._told = since
            candidate = f", candidate {number + 1} of {count}" if count > 1 else ""
            self._say(f"{self._title}{candidate}, {since:.0f} s")

    def _say(self, text: str) -> None:
        print(f"\r{text}\x1b[K", end="", file=sys.stderr, flush=True)  # noqa: T201


@contextmanager
def activity(title: str) -> Iterator[Callable[[int, int], None]]:
    """A line on a terminal for as long as the work takes; gives what is called while it goes on."""
    if not sys.stderr.isatty():
        yield lambda *_: None
        return
    try:
        yield Activity(title).tell
    finally:
        print("\r\x1b[K", end="", file=sys.stderr, flush=True)  # noqa: T201


class _Silence:
    is_watched = False

    def show(self, iterate: Iterate) -> None:
        """Tell nothing."""


@contextmanager
def progress(title: str, total: int | None) -> Iterator[Progress | _Silence]:
    """A progress line for as long as the work takes."""
    if not sys.stderr.isatty():
        yield _Silence()
        return
    try:
        yield Progress(title, total)
    finally:
        print("\r\x1b[K", end="", file=sys.stderr, flush=True)  # noqa: T201


def _remark(text: str) -> None:
    print(text, file=sys.stderr, flush=True)  # noqa: T201
