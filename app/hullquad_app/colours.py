"""Every colour of the program: palettes of the themes, and maps from quality to colour, broken at the limit."""

from enum import StrEnum
from functools import cached_property

import attrs
import numpy as np
import numpy.typing as npt

from hullquad.arrays import Longs
from hullquad.quality import Quality

Colours = npt.NDArray[np.uint8]

INVERTED = "#C800C8"
"""Elements that are not valid, in every map."""
UNJUDGED = "#C9CED4"
"""Elements without a value."""


class Theme(StrEnum):
    """Which palette the user wants."""

    SYSTEM = "system"
    LIGHT = "light"
    DARK = "dark"


@attrs.frozen(kw_only=True)
class Palette:
    """Colours of one theme, as ``#RRGGBB``: the same for widgets, view and plots."""

    is_dark: bool
    background: str
    panel: str
    view: str
    """Ground of the plate."""
    text: str
    dim: str
    """Text that stands back: captions, units."""
    rule: str
    """Lines that part."""
    frame: str
    """Of boxes and buttons; Qt's style draws it darker by two fifths."""
    accent: str
    edge: str
    """Edges of elements."""
    contour: str
    line: str
    """Stiffeners and seams."""
    fail: str
    """The word FAIL and figures beyond the limit, on panels."""
    failing: str
    """Outline of failing elements."""
    worst: str
    """The same around elements as dark as `failing` itself."""
    selection: str
    hover: str


LIGHT = Palette(
    is_dark=False,
    background="#F4F6F8",
    panel="#FFFFFF",
    view="#FFFFFF",
    text="#1B2430",
    dim="#5B6776",
    rule="#D5DBE1",
    frame="#D5DBE1",
    accent="#0B62A4",
    edge="#3A444F",
    contour="#0E1620",
    line="#0E1620",
    fail="#B2182B",
    failing="#6E0A1E",
    worst="#FFD166",
    selection="#000000",
    hover="#0B62A4",
)
DARK = Palette(
    is_dark=True,
    background="#1E2227",
    panel="#23282E",
    view="#262B31",
    text="#E6EAEE",
    dim="#98A3AE",
    rule="#3A424B",
    frame="#8A97A5",
    accent="#4FA3E0",
    edge="#12161A",
    contour="#F2F4F6",
    line="#F2F4F6",
    fail="#FF6B57",
    failing="#FF6B57",
    worst="#FFD166",
    selection="#FFFFFF",
    hover="#4FA3E0",
)

_STEPS = 256
"""Of a half map; a multiple of the intervals between its stops, so that each stop is met exactly."""
_INVERTED_ROW, _UNJUDGED_ROW = 2 * _STEPS + 2, 2 * _STEPS + 3


@attrs.frozen(eq=False)
class ColourMap:
    """Colours by grade: two rows of stops that do not meet at the limit."""

    key: str
    title: str
    failing: tuple[str, ...]
    """From as bad as can be to the limit."""
    passing: tuple[str, ...]
    """From the limit to the ideal."""

    @cached_property
    def _table(self) -> Colours:
        return np.concatenate([_ramp(self.failing), _ramp(self.passing), [_rgb(INVERTED)], [_rgb(UNJUDGED)]])

    def element_colours(self, quality: Quality) -> Colours:
        """(E, 3) colour of each element: failing ones from the failing stops, never from the others."""
        unjudged = np.isnan(quality.grades)
        grades = np.where(unjudged, 0.0, quality.grades)
        rows = np.where(quality.failing, _failing_rows(grades), _passing_rows(grades))
        rows = np.where(unjudged, _UNJUDGED_ROW, rows)
        return self._table[np.where(quality.valid, rows, _INVERTED_ROW)]

    def colour(self, grade: float, *, valid: bool = True) -> str:
        """Colour of one grade; of the limit itself that of an element that just passes."""
        if not valid:
            return INVERTED
        if np.isnan(grade):
            return UNJUDGED
        rows = _failing_rows if grade < 0 else _passing_rows
        return _hex(self._table[rows(np.array(grade))])


BROKEN = ColourMap(
    "broken",
    "Broken at the limit",
    ("#6E0A1E", "#B2182B", "#E34A33", "#FC8D59", "#FDBB84"),
    ("#E3EDF3", "#CBDFEB", "#ADCDE1", "#86B7D5", "#5E9DC4"),
)
VIRIDIS = ColourMap(
    "viridis",
    "Viridis",
    ("#440154", "#482878", "#3E4A89", "#30698E", "#25848E"),
    ("#1E9C89", "#34B679", "#6CCD5A", "#B5DE2B", "#FDE725"),
)
CIVIDIS = ColourMap(
    "cividis",
    "Cividis",
    ("#00224E", "#123570", "#3C4A6C", "#585E6D", "#727274"),
    ("#888578", "#A49B74", "#C2B369", "#E1CC55", "#FEE838"),
)
PASS_FAIL = ColourMap("pass_fail", "Pass or fail", ("#E34A33",), ("#ADCDE1",))

COLOUR_MAPS = (BROKEN, VIRIDIS, CIVIDIS, PASS_FAIL)
"""All there are; the first is the one to begin with."""


def colour_map(key: str) -> ColourMap:
    """Map of that key; the first where there is none, as after an update."""
    return next((row for row in COLOUR_MAPS if row.key == key), COLOUR_MAPS[0])


def palette(theme: Theme, *, system_is_dark: bool = False) -> Palette:
    """Palette of a theme."""
    return DARK if theme is Theme.DARK or (theme is Theme.SYSTEM and system_is_dark) else LIGHT


def element_colours(quality: Quality, chosen: ColourMap = BROKEN) -> Colours:
    """(E, 3) colour of each element."""
    return chosen.element_colours(quality)


def colour(grade: float, *, valid: bool = True, chosen: ColourMap = BROKEN) -> str:
    """Colour of a grade of `Quality.grades` as ``#RRGGBB``: for bars, swatches and legend strips."""
    return chosen.colour(grade, valid=valid)


def rgb(colour: str) -> tuple[int, int, int]:
    """Red, green and blue of ``#RRGGBB``, each from 0 to 255."""
    red, green, blue = (int(value) for value in _rgb(colour))
    return red, green, blue


def _rgb(colour: str) -> Colours:
    return np.frombuffer(bytes.fromhex(colour.removeprefix("#")), dtype=np.uint8)


def _hex(colour: Colours) -> str:
    return "#" + colour.tobytes().hex().upper()


def _ramp(stops: tuple[str, ...]) -> Colours:
    """(_STEPS + 1, 3) colours in equal steps from the first stop to the last."""
    channels = np.array([_rgb(stop) for stop in stops]).T
    at = np.linspace(0, 1, _STEPS + 1)
    return np.rint([np.interp(at, np.linspace(0, 1, len(stops)), row) for row in channels]).T.astype(np.uint8)


def _failing_rows(grades: npt.NDArray[np.float64]) -> Longs:
    return np.rint((grades + 1) * _STEPS).astype(np.int64)


def _passing_rows(grades: npt.NDArray[np.float64]) -> Longs:
    return np.rint(grades * _STEPS).astype(np.int64) + _STEPS + 1
