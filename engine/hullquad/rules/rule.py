"""What a class society or a solver asks of a mesh, as values: rules and sets of them."""

from enum import Enum, IntEnum
from math import inf, isfinite

import attrs
import numpy as np

from hullquad.arrays import Bools, Bytes, Floats, small_ints
from hullquad.metrics import Band

TOLERANCE = 1e-9
"""Part of a limit by which a value may be beyond it: a square of 50 mm anywhere in space is one of 50 mm."""


class Level(IntEnum):
    """What a rule says of an element."""

    OK = 0
    WARN = 1
    ERROR = 2


class Elements(Enum):
    """What a rule is for."""

    ALL = "all"
    QUADS = "quads"
    TRIANGLES = "triangles"

    def chosen(self, is_triangle: Bools) -> Bools:
        """(E,) which elements a rule is for."""
        if self is Elements.ALL:
            return np.ones_like(is_triangle)
        return is_triangle if self is Elements.TRIANGLES else ~is_triangle


class Status(Enum):
    """Where a limit comes from."""

    READ = "read"
    """It stands so in the source."""
    UNVERIFIED = "unverified"
    """From experience: to be checked against the current edition before it is called the rule."""


@attrs.frozen(kw_only=True)
class Rule:
    """One demand on a mesh: a measure, and what of it is acceptable."""

    measure: str
    """Key of a metric or of `measures.MEASURES`; empty where no mesh can tell."""
    title: str
    """Names the definition too: ``Skew (Nastran)``."""
    elements: Elements = Elements.ALL
    warn: Band | None = None
    """Values outside are warned of [the measure's unit]; None where the rule does not warn."""
    error: Band | None = None
    """Values outside are errors."""
    text: str
    """The rule in words."""
    source: str
    status: Status
    not_evaluated: str = ""
    """Why no mesh can tell whether the rule is kept."""

    @property
    def limits(self) -> Band | None:
        """The narrower of the two bands; None where the rule has no limits."""
        return self.error if self.warn is None else self.warn

    def levels(self, values: Floats) -> Bytes:
        """(E,) `Level` of each value."""
        warned, refused = _is_beyond(self.warn, values), _is_beyond(self.error, values)
        return small_ints(np.where(refused, Level.ERROR, np.where(warned, Level.WARN, Level.OK)))

    def excess(self, values: Floats) -> Floats:
        """(E,) how far each value is beyond the narrower band, below 0 within [the measure's unit]."""
        found = np.full(len(values), -inf)
        low, high = self.limits or (-inf, inf)
        if isfinite(low):
            found = np.maximum(found, low - values)
        if isfinite(high):
            found = np.maximum(found, values - high)
        return found


@attrs.frozen(kw_only=True)
class RuleSet:
    """The rules by which one society or solver judges a mesh."""

    key: str
    title: str
    edition: str
    source: str
    note: str = ""
    rules: tuple[Rule, ...]


def widened(band: Band) -> Band:
    """The band with ends moved outwards by a rounding error."""
    low, high = band
    return (
        low - TOLERANCE * abs(low) if isfinite(low) else low,
        high + TOLERANCE * abs(high) if isfinite(high) else high,
    )


def _is_beyond(band: Band | None, values: Floats) -> Bools:
    """Which values are outside a band by more than a rounding error."""
    low, high = (-inf, inf) if band is None else widened(band)
    return np.asarray((values < low) | (values > high))
