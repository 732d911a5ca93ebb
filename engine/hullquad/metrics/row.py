"""One row of the table of metrics: what a metric is called and how its values are read."""

from enum import Enum
from math import degrees, inf, isfinite

import attrs
import numpy as np

from hullquad.arrays import Bools, Floats

DEGREES = "°"
MILLIMETRES = "mm"

Band = tuple[float, float]
"""Least and greatest acceptable value; infinite on a side where nothing is too much."""


class Sense(Enum):
    """Which of two values is the better one."""

    HIGHER = "higher is better"
    LOWER = "lower is better"
    NEARER = "nearer to the ideal is better"


@attrs.frozen
class Scale:
    """How the values of quads, or of triangles, are read [the metric's unit]."""

    low: float
    """Least value of valid elements."""
    high: float
    """Greatest value of valid elements."""
    ideal: float
    acceptable: tuple[float, float]
    """Ends of the acceptable band as the source gives them."""


@attrs.frozen(kw_only=True, cache_hash=True)
class Metric:
    """One row of the table: what a metric is called, how it is read and when it is acceptable."""

    key: str
    title: str
    formula: str
    """In words and signs, for people."""
    sense: Sense
    unit: str
    quads: Scale
    triangles: Scale | None
    """None where a triangle has no such metric and is judged by its shape."""
    source: str
    group: str
    """Under which heading it is listed."""
    is_of_corners: bool
    """Whether it is the worst of values that each corner has by itself."""
    invalid: Band
    """Between what the raw value is kept where an element is not valid: no better than that of the worst valid one."""

    @property
    def higher_is_better(self) -> bool:
        """Whether the greater of two values is the better one."""
        return self.sense is Sense.HIGHER

    @property
    def band(self) -> Band:
        """What is acceptable for quads; an end that only bounds the range is left open."""
        return self.opened(self.quads.acceptable)

    @property
    def triangle_band(self) -> Band:
        """What is acceptable for triangles, by `triangle_metric`."""
        judge = self.triangle_metric
        return judge.opened(judge.triangle_scale.acceptable)

    def triangle_band_beside(self, band: Band) -> Band:
        """What is acceptable for triangles where `band` is for quads: the same if they are read on one scale."""
        return band if self.triangles == self.quads else self.triangle_band

    @property
    def triangle_metric(self) -> "Metric":
        """What triangles are judged by: this metric, or shape where it has no form for triangles."""
        if self.triangles is not None:
            return self
        from hullquad.metrics.table import SHAPE  # noqa: PLC0415  a row of the table that is made of rows

        return SHAPE

    @property
    def triangle_scale(self) -> Scale:
        """How values of triangles are read, by `triangle_metric`."""
        scale = self.triangle_metric.triangles
        assert scale is not None  # shape has one
        return scale

    @property
    def holds_triangles(self) -> bool:
        """Whether values of triangles stand on one axis with those of quads.

        Shape can stand in for a metric that is likewise 1 at its best and 0 at its worst, not for the others.
        """
        return self.triangles is not None or (self.higher_is_better and self.quads.high == 1.0)

    @property
    def is_two_sided(self) -> bool:
        """Whether values can be too small and too large."""
        return self.sense is Sense.NEARER

    def opened(self, band: tuple[float, float]) -> Band:
        """A band without the end that no value can be beyond."""
        low = -inf if self.sense is Sense.LOWER else band[0]
        return low, inf if self.sense is Sense.HIGHER else band[1]

    def limits(self, band: Band) -> tuple[float, ...]:
        """The ends of a band at which elements begin to fail: one, or two of a two-sided metric."""
        return tuple(end for end in band if isfinite(end))

    def moved(self, band: Band, limit: float) -> Band:
        """A band whose nearest end is at `limit`; the only one of a metric that has one."""
        if not self.is_two_sided:
            return self.opened((limit, limit))
        return (limit, band[1]) if abs(limit - band[0]) <= abs(limit - band[1]) else (band[0], limit)

    def is_within(self, band: Band, values: Floats) -> Bools:
        """Which values are acceptable."""
        return np.asarray((values >= band[0]) & (values <= band[1]))

    def badness(self, values: Floats, ideal: float | Floats | None = None) -> Floats:
        """How bad values are: the greater the worse, in the metric's unit."""
        if self.sense is Sense.HIGHER:
            return -values
        if self.sense is Sense.LOWER:
            return values
        return np.asarray(np.abs(values - (self.quads.ideal if ideal is None else ideal)))

    def is_worse(self, value: float, other: float) -> bool:
        """Whether a value of a quad is worse than another one."""
        first, second = self.badness(np.array([value, other]))
        return bool(first > second)

    @property
    def worst(self) -> Band:
        """Values that are drawn as the worst there are, below and above: those of elements that are only just valid."""
        return max(self.quads.low, 0.0), min(self.quads.high, 180.0) if self.unit == DEGREES else self.quads.high

    @property
    def factor(self) -> float:
        """Factor from the kernels' value to the shown one: angles are radians inside."""
        return degrees(1) if self.unit == DEGREES else 1.0
