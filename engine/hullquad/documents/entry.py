"""A value in a document and its place; what is wrong with it is written down, so that all faults are told at once."""

import reprlib
from collections.abc import Callable, Iterable, Iterator, Mapping
from contextlib import suppress
from difflib import get_close_matches
from typing import Any, TypeVar

import attrs

from hullquad.documents.json_text import child
from hullquad.errors import PlateError

Value = TypeVar("Value")

_LARGEST = 1e15
"""Numbers beyond are slips of the keyboard, and would overflow in areas."""


class Refused(Exception):  # noqa: N818 - it ends the reading of one value; the errors are in the entry's faults
    """The value cannot be used; the reason has been written down."""


@attrs.frozen(eq=False)
class Entry:
    """A value, its path in the document, and the list of faults that the whole document shares."""

    value: Any
    place: str
    faults: list[PlateError]

    def refused(self, code: str, case: str = "", **numbers: Any) -> Refused:
        """Write a fault down; what is returned ends the reading of this entry when raised."""
        self.faults.append(PlateError(code, self.place, case, **numbers))
        return Refused()

    def at(self, key: str | int, value: Any = None) -> "Entry":
        """Entry below this one."""
        return Entry(value, child(self.place, key), self.faults)

    @property
    def shown(self) -> str:
        """The value as a sentence may quote it."""
        kinds = {type(None): "nothing", bool: "true or false", dict: "an object", list: "a list"}
        named = (name for kind, name in kinds.items() if isinstance(self.value, kind))
        return next(named, reprlib.repr(self.value))


Read = Callable[[Entry], Any]


@attrs.frozen
class Field:
    """One row of the table of an object's keys."""

    read: Read
    missing: str = ""
    """Code of the error when the key is missing; '' for an optional key."""


def fields(entry: Entry, table: Mapping[str, Field]) -> dict[str, Any]:
    """Read the keys of an object; those that cannot be used are left out, and written down.

    Raises
    ------
    Refused
        The entry is no object.
    """
    if not isinstance(entry.value, dict):
        raise entry.refused("E_TYPE", "object", shown=entry.shown)
    for key in entry.value:
        if key not in table:
            _refuse_key(entry.at(key), key, table)
    for key, field in table.items():
        if field.missing and key not in entry.value:
            entry.at(key).refused(field.missing, "missing", key=key)
    present = {key: field for key, field in table.items() if key in entry.value}
    return dict(_sound((key, entry.at(key, entry.value[key]), field.read) for key, field in present.items()))


def whole(entry: Entry, table: Mapping[str, Field]) -> dict[str, Any]:
    """Read the keys of an object that is of no use unless all of it is sound."""
    faults = len(entry.faults)
    values = fields(entry, table)
    if len(entry.faults) > faults:
        raise Refused
    return values


def items(entry: Entry, read: Callable[[Entry], Value]) -> list[Value]:
    """Read the items of a list that is of no use unless all of them are sound."""
    if not isinstance(entry.value, list):
        raise entry.refused("E_TYPE", "list", shown=entry.shown)
    values = dict(_sound((i, entry.at(i, item), read) for i, item in enumerate(entry.value)))
    if len(values) < len(entry.value):
        raise Refused
    return list(values.values())


def number(entry: Entry) -> float:
    """Read a finite number."""
    value = entry.value
    if isinstance(value, bool) or not isinstance(value, int | float):
        raise entry.refused("E_NUMBER", "kind", shown=entry.shown)
    if not abs(value) <= _LARGEST:  # NaN too, and whole numbers that no float can hold
        raise entry.refused("E_NUMBER", "large", shown=entry.shown)
    return float(value)


def positive(code: str, scale: float = 1.0) -> Callable[[Entry], float]:
    """Reader of a number above 0, times `scale`; `code` refuses others."""

    def read(entry: Entry) -> float:
        value = number(entry) * scale
        if value <= 0:
            raise entry.refused(code, "positive", shown=entry.shown)
        return value

    return read


def text(entry: Entry) -> str:
    """Read a text that can be written to a file."""
    if not isinstance(entry.value, str):
        raise entry.refused("E_TYPE", "text", shown=entry.shown)
    if any("\ud800" <= letter <= "\udfff" for letter in entry.value):  # half a character: cannot be written
        raise entry.refused("E_TYPE", "surrogate", shown=entry.shown)
    return entry.value


def flag(entry: Entry) -> bool:
    """Read true or false."""
    if not isinstance(entry.value, bool):
        raise entry.refused("E_TYPE", "flag", shown=entry.shown)
    return entry.value


def anything(entry: Entry) -> Any:
    """Return the value, to be looked at later."""
    return entry.value


def _sound(entries: Iterable[tuple[Any, Entry, Callable[[Entry], Value]]]) -> Iterator[tuple[Any, Value]]:
    for key, entry, read in entries:
        with suppress(Refused):
            yield key, read(entry)


def _refuse_key(entry: Entry, key: str, table: Mapping[str, Field]) -> None:
    alike = get_close_matches(key, table, n=1, cutoff=0.5)
    if alike:
        entry.refused("E_KEY", "alike", alike=alike[0])
    else:
        entry.refused("E_KEY", known=", ".join(table))
