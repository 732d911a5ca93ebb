"""Decoding JSON strictly: a repeated key, a syntax error and a bomb are refused with their place."""

import json
import math
from typing import Any, NoReturn

from hullquad.errors import FileError, PlateError


class _Object(dict[str, Any]):
    """An object of the text that knows which of its keys came twice."""

    def __init__(self, pairs: list[tuple[str, Any]]) -> None:
        super().__init__(pairs)
        seen: set[str] = set()
        self.repeated = [key for key, _ in pairs if key in seen or seen.add(key)]  # type: ignore[func-returns-value]


def decode(content: bytes, name: str) -> Any:
    """Value of the JSON text in a file; numbers too large for a float become infinite.

    Raises
    ------
    FileError
        It is not UTF-8.
    PlateError
        E_JSON: it is not JSON, is nested too deeply, or an object has a key twice.
    """
    try:
        text = content.decode("utf-8-sig")
    except UnicodeDecodeError as error:
        raise FileError("E_FILE", name, "encoding", byte=error.start) from error
    try:
        value = json.loads(text, object_pairs_hook=_Object, parse_int=_integer)
    except json.JSONDecodeError as error:
        case = "syntax" if text.strip() else "empty"
        place = f"line {error.lineno} column {error.colno}"
        raise PlateError("E_JSON", place, case, reason=error.msg) from error
    except RecursionError as error:
        raise PlateError("E_JSON", "line 1 column 1", "deep") from error
    _refuse_repeated_keys(value)
    return value


def child(place: str, key: str | int) -> str:
    """Path of a key or an item below a path (RFC 6901)."""
    name = str(key).encode("utf-8", "backslashreplace").decode()
    return f"{place}/{name.replace('~', '~0').replace('/', '~1')}"


class Positions:
    """Where paths stand in a document; what is known of an object is kept, for thousands of paths may lead to it."""

    def __init__(self, document: Any) -> None:
        self._document = document
        self._known: dict[int, dict[str, tuple[int, Any]]] = {}

    def __call__(self, place: str) -> tuple[int, ...]:
        """Key for sorting; a missing key stands at the end of its object."""
        numbers = []
        value = self._document
        for step in place.split("/")[1:]:
            if isinstance(value, dict):
                number, value = self._items(value).get(step, (len(value), None))
                numbers.append(number)
            elif isinstance(value, list) and step.isdecimal() and int(step) < len(value):
                numbers.append(int(step))
                value = value[int(step)]
        return tuple(numbers)

    def _items(self, value: dict[str, Any]) -> dict[str, tuple[int, Any]]:
        """Number and value of each key of an object, by the name that paths have for it."""
        if id(value) not in self._known:
            rows = enumerate(value.items())
            self._known[id(value)] = {child("", key)[1:]: (number, item) for number, (key, item) in rows}
        return self._known[id(value)]


def _integer(digits: str) -> int | float:
    try:
        return int(digits)
    except ValueError:  # thousands of digits
        return math.copysign(math.inf, -1 if digits.startswith("-") else 1)


def _refuse_repeated_keys(value: Any) -> None:
    """Refuse the first repeated key; without recursion, because texts may be nested deeply."""
    waiting = [(value, "")]
    while waiting:
        value, place = waiting.pop()
        if isinstance(value, _Object) and value.repeated:
            _refuse(child(place, value.repeated[0]), value.repeated[0])
        entries = value.items() if isinstance(value, dict) else enumerate(value) if isinstance(value, list) else ()
        waiting.extend(reversed([(item, child(place, key)) for key, item in entries if isinstance(item, dict | list)]))


def _refuse(place: str, key: str) -> NoReturn:
    raise PlateError("E_JSON", place, "repeated", key=child("", key)[1:])
