"""What the program remembers from one day to the next; whatever cannot be read is forgotten."""

import base64
import json
from collections.abc import Callable, Mapping
from math import isfinite
from pathlib import Path
from typing import Any, TypeVar

import attrs
from PySide6.QtCore import QByteArray, QSettings

from hullquad.errors import HullquadError
from hullquad.metrics import METRICS, Band, Metric, metric
from hullquad.optimization.objective import objective
from hullquad.optimization.settings import PaperSettings
from hullquad.optimizers import OPTIMIZERS
from hullquad.quads.settings import LARGEST_GRADING, LEAST_GRADING
from hullquad_app.mesher import MESHERS, PREFERENCES, Mesher
from hullquad_app.search import FLOORS, MOST_ITERATIONS, MOST_RINGS, MOST_SECONDS, Search

MOST_RECENT = 10
THEMES = ("system", "light", "dark")

_KEYS = frozenset(row.key for row in METRICS)
_OPTIMIZERS = frozenset(row.key for row in OPTIMIZERS)
_LEAST = {"step": 0.0, "iterations": 1, "tolerance": 0.0, "window": 1}

Kept = TypeVar("Kept")


class Settings:
    """Values by name in an ini file, each written as JSON."""

    def __init__(self, store: QSettings | None = None) -> None:
        scope = QSettings.Scope.UserScope
        self._store = store or QSettings(QSettings.Format.IniFormat, scope, "hullquad", "hullquad")

    @property
    def geometry(self) -> QByteArray:
        """Where the window was; empty when it was nowhere."""
        return self._read("geometry", _bytes, QByteArray())

    @geometry.setter
    def geometry(self, geometry: QByteArray) -> None:
        self._write("geometry", _text(geometry))

    @property
    def layout(self) -> QByteArray:
        """Where the docks were; empty when they were nowhere."""
        return self._read("layout", _bytes, QByteArray())

    @layout.setter
    def layout(self, layout: QByteArray) -> None:
        self._write("layout", _text(layout))

    @property
    def theme(self) -> str:
        """One of `THEMES`."""
        return self._read("theme", lambda value: value if value in THEMES else "system", "system")

    @theme.setter
    def theme(self, theme: str) -> None:
        self._write("theme", theme)

    @property
    def recent(self) -> list[Path]:
        """Files that were opened and are still there, the last one first."""
        return self._read("recent", _files, [])

    def add_recent(self, path: Path) -> None:
        """Remember a file that was opened."""
        path = path.absolute()
        others = (other for other in self.recent if other != path)
        self._write("recent", [str(file) for file in (path, *others)][:MOST_RECENT])

    @property
    def bands(self) -> dict[str, Band]:
        """What the user accepts by metric key."""
        return self._read("bands", _bands, {})

    @bands.setter
    def bands(self, bands: Mapping[str, Band]) -> None:
        self._write("bands", {key: metric(key).limits(band) for key, band in bands.items()})

    @property
    def rules(self) -> str:
        """Key of the rule set by which elements were judged last, or its file; empty: by the metric."""
        return self._read("rules", str, "")

    @rules.setter
    def rules(self, name: str) -> None:
        self._write("rules", name)

    @property
    def rule_files(self) -> list[Path]:
        """Files of rules that were read and are still there, the last one first."""
        return self._read("rule_files", _files, [])

    def add_rule_file(self, path: Path) -> None:
        """Remember a file of rules."""
        others = (other for other in self.rule_files if other != path)
        self._write("rule_files", [str(file) for file in (path, *others)][:MOST_RECENT])

    @property
    def metric(self) -> str:
        """Key of the metric that was shown last."""
        return self._read("metric", lambda value: value if value in _KEYS else "stretch", "stretch")

    @metric.setter
    def metric(self, key: str) -> None:
        self._write("metric", key)

    @property
    def objective(self) -> str | None:
        """What to optimise by, ``KEY[=WEIGHT][,KEY…]``; None for the metric that is shown."""
        return self._read("objective", _objective, None)

    @objective.setter
    def objective(self, written: str | None) -> None:
        self._write("objective", written)

    @property
    def mesher(self) -> Mesher:
        """The mesher and its options."""
        return self._read("mesher", _mesher, Mesher())

    @mesher.setter
    def mesher(self, mesher: Mesher) -> None:
        self._write("mesher", attrs.asdict(mesher))

    @property
    def paper(self) -> PaperSettings:
        """Parameters of the paper's method."""
        return self._read("paper", _paper, PaperSettings())

    @paper.setter
    def paper(self, paper: PaperSettings) -> None:
        self._write("paper", attrs.asdict(paper))

    @property
    def search(self) -> Search:
        """The optimiser and its options."""
        return self._read("search", _search, Search())

    @search.setter
    def search(self, search: Search) -> None:
        self._write("search", attrs.asdict(search))

    def _read(self, name: str, meant: Callable[[Any], Kept], otherwise: Kept) -> Kept:
        try:
            return meant(json.loads(str(self._store.value(name))))
        except (ValueError, TypeError, KeyError, AttributeError, OSError, RecursionError, OverflowError):
            return otherwise

    def _write(self, name: str, value: Any) -> None:
        self._store.setValue(name, json.dumps(value))


def _bytes(value: str) -> QByteArray:
    return QByteArray(base64.b64decode(value, validate=True))


def _text(value: QByteArray) -> str:
    return base64.b64encode(value.data()).decode("ascii")


def _files(names: list[str]) -> list[Path]:
    paths = [Path(name) for name in dict.fromkeys(names)]
    return [path for path in paths if path.is_file()][:MOST_RECENT]


def _bands(value: dict[str, list[float]]) -> dict[str, Band]:
    rows = ((metric(key), limits) for key, limits in value.items() if key in _KEYS)
    return {row.key: row.opened((limits[0], limits[-1])) for row, limits in rows if _is_band(row, limits)}


def _is_band(row: Metric, limits: list[float]) -> bool:
    is_whole = len(limits) == len(row.limits(row.band)) and all(map(isfinite, limits))
    return is_whole and limits == sorted(limits)


def _objective(value: str | None) -> str | None:
    if value is None:
        return None
    try:
        objective(value)
    except HullquadError:
        return None
    return value


_MESHER: dict[str, Callable[[Any], bool]] = {
    "name": lambda value: value in MESHERS,
    "prefer": lambda value: value in PREFERENCES,
    "grading": lambda value: _is_number(value) and LEAST_GRADING <= value <= LARGEST_GRADING,
    "follows_lines": lambda value: isinstance(value, bool),
}
_SEARCH: dict[str, Callable[[Any], bool]] = {
    "optimizer": lambda value: value in _OPTIMIZERS,
    "floor": lambda value: any(value is floor or (_is_number(value) and value == floor) for floor in FLOORS),
    "iterations": lambda value: _is_whole(value, 1, MOST_ITERATIONS),
    "seconds": lambda value: _is_whole(value, 0, MOST_SECONDS),
    "is_local": lambda value: isinstance(value, bool),
    "rings": lambda value: _is_whole(value, 0, MOST_RINGS),
}
"""Which values of their fields are sound."""


def _mesher(value: dict[str, Any]) -> Mesher:
    return Mesher(**_sound(value, _MESHER))


def _search(value: dict[str, Any]) -> Search:
    return Search(**_sound(value, _SEARCH))


def _sound(value: dict[str, Any], table: Mapping[str, Callable[[Any], bool]]) -> dict[str, Any]:
    return {name: given for name, given in value.items() if name in table and table[name](given)}


def _is_number(value: Any) -> bool:
    return isinstance(value, int | float) and not isinstance(value, bool)


def _is_whole(value: Any, least: int, most: int) -> bool:
    return isinstance(value, int) and not isinstance(value, bool) and least <= value <= most


def _paper(value: dict[str, Any]) -> PaperSettings:
    known = attrs.asdict(PaperSettings())
    sound = {name: given for name, given in value.items() if name in known and _is_sound(name, given, known[name])}
    return PaperSettings(**sound)


def _is_sound(name: str, given: Any, usual: Any) -> bool:
    if isinstance(usual, bool) or isinstance(given, bool):
        return isinstance(given, bool) and isinstance(usual, bool)
    kinds = (int, float) if isinstance(usual, float) else (int,)
    return isinstance(given, kinds) and isfinite(given) and given >= _LEAST[name]
