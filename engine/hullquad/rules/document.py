"""What files of rules and of criteria have in common: how they open, their limits, and how faults are told."""

from collections.abc import Callable, Sequence
from difflib import get_close_matches
from math import inf
from pathlib import Path
from typing import TypeVar

from hullquad.documents.entry import Entry, Refused, number, text
from hullquad.documents.json_text import decode
from hullquad.errors import PlateError, RuleError
from hullquad.metrics import Band

Value = TypeVar("Value")

VERSION = 1
MOST_BYTES = 1 << 20
"""A larger file is none of rules."""


def content(path: Path) -> bytes:
    """Everything in a file of rules; raises FileError."""
    from hullquad.formats import source  # noqa: PLC0415  brings SciPy and Shapely

    return source.content(path, most=MOST_BYTES)


def opened(data: bytes, place: str, kind: str, read: Callable[[Entry], Value]) -> Value:
    """What `read` makes of the object in a file, if the file is of that format.

    Raises
    ------
    FileError
        It is not UTF-8.
    RuleError
        The first fault, at ``FILE#/path/in/it``; `others` tells how many more there are.
    """
    faults: list[PlateError] = []
    try:
        top = Entry(decode(data, place), "", faults)
        _refuse_others(top, kind)
        return read(top)
    except PlateError as fault:
        raise _told([fault], place) from fault
    except Refused as end:
        raise _told(faults, place) from end


def band(entry: Entry) -> Band:
    """Read the least and the greatest acceptable value; null, and infinite, where nothing is too much."""
    value = entry.value
    if not isinstance(value, list) or len(value) != 2:
        raise entry.refused("E_BAND", "count", shown=entry.shown)
    low, high = (
        _end(entry.at(i, end), nothing) for i, (end, nothing) in enumerate(zip(value, (-inf, inf), strict=True))
    )
    if low == -inf and high == inf:
        raise entry.refused("E_BAND", "open")
    if low > high:
        raise entry.refused("E_BAND", "reversed", low=low, high=high)
    return low, high


def written(limits: Band) -> list[float | None]:
    """A band as it stands in a file."""
    return [None if end in (-inf, inf) else end for end in limits]


def name(entry: Entry) -> str:
    """Read a text that is not empty."""
    if not text(entry).strip():
        raise entry.refused("E_RULE", "name")
    return str(entry.value)


def choice(entry: Entry, known: Sequence[str], code: str) -> str:
    """Read one of the known words; `code` refuses others, and names the nearest one."""
    if isinstance(entry.value, str) and entry.value in known:
        return entry.value
    alike = get_close_matches(str(entry.value), known, n=1, cutoff=0.6)
    if alike:
        raise entry.refused(code, "alike", shown=entry.shown, alike=alike[0])
    raise entry.refused(code, shown=entry.shown, known=", ".join(known))


def _end(entry: Entry, nothing: float) -> float:
    return nothing if entry.value is None else number(entry)


def _refuse_others(top: Entry, kind: str) -> None:
    """Refuse what is no file of that kind, before looking at what is in it."""
    if not isinstance(top.value, dict):
        raise top.refused("E_TYPE", "object", shown=top.shown)
    found, version = (top.at(key, top.value.get(key)) for key in ("format", "version"))
    if found.value != kind:
        raise found.refused("E_FORMAT", "other", shown=found.shown, known=kind)
    if isinstance(version.value, bool) or version.value != VERSION:
        is_newer = isinstance(version.value, int) and version.value > VERSION
        raise version.refused("E_VERSION", "newer" if is_newer else "", shown=version.shown, known=VERSION)


def _told(faults: Sequence[PlateError], place: str) -> RuleError:
    first, *others = faults
    at = f"{place}#{first.place}" if first.place[:1] in ("", "/") else f"{place} {first.place}"
    return RuleError(first.code, at, first.case, **first.numbers).among(len(others))
