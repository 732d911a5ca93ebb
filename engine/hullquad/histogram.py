"""How the values of a mesh are spread: elements counted in bins, apart by what becomes of them."""

from functools import cached_property
from math import floor, inf, isfinite, log10

import attrs
import numpy as np

from hullquad.arrays import Floats, Longs, floats, longs
from hullquad.metrics import Band, Metric
from hullquad.quality import Quality

PORTIONS = ("invalid", "failing", "passing")
"""Rows of `Histogram.counts`; those that are not valid are not counted again as failing."""
OPEN_END = 2.5
"""Where the axis of a metric without upper bound ends, over its own limit, unless the user's is beyond."""
_MOST_BINS = 40
_STEPS = (1.0, 1.25, 2.0, 2.5, 3.0, 5.0)


@attrs.frozen(eq=False, kw_only=True)
class Histogram:
    """Elements of a mesh in bins of their value; the first and the last bin hold what lies beyond the axis too."""

    edges: Floats = attrs.field(converter=floats)
    """(B + 1,) ends of the bins, from the least to the greatest [the metric's unit]."""
    bins: Longs = attrs.field(converter=longs)
    """(E,) bin of each element; -1 for triangles that are judged by another measure, which are in none."""
    counts: Longs = attrs.field(converter=longs)
    """(3, B) elements that are not valid, that fail and that pass."""
    grades: Floats = attrs.field(converter=floats)
    """(3, B) mean grade of those; -1, 0 and 0 where there are none."""
    is_open_below: bool
    """Whether the first bin holds values below its lower end."""
    is_open_above: bool

    @cached_property
    def totals(self) -> Longs:
        """(B,) elements in each bin."""
        return longs(self.counts.sum(axis=0))

    def rows(self, number: int) -> Longs:
        """Rows of the elements in one bin."""
        return longs(np.flatnonzero(self.bins == number))

    def bounds(self, number: int) -> tuple[float, float]:
        """Ends of one bin; infinite where it is open."""
        low, high = float(self.edges[number]), float(self.edges[number + 1])
        is_last = number == len(self.edges) - 2
        return -inf if number == 0 and self.is_open_below else low, inf if is_last and self.is_open_above else high


def histogram(judged: Quality, edges: Floats | None = None) -> Histogram:
    """Elements of a mesh counted by value, in the bins of its metric or in other ones of equal width."""
    edges = axis_edges(judged.metric, judged.band) if edges is None else edges
    count = len(edges) - 1
    width = (edges[-1] - edges[0]) / count
    # a value on an edge belongs to the upper bin, though its quotient may be rounded down
    places = np.clip((judged.values - edges[0]) / width + 1e-9, 0, count - 1).astype(np.int64)
    portions = np.where(judged.valid, np.where(judged.failing, 1, 2), 0) * count + places
    shown = judged.is_on_scale
    counts = np.bincount(portions[shown], minlength=3 * count)
    sums = np.bincount(portions[shown], weights=judged.grades[shown], minlength=3 * count)
    grades = np.where(counts > 0, sums / np.maximum(counts, 1), np.repeat([-1.0, 0.0, 0.0], count))
    return Histogram(
        edges=edges,
        bins=np.where(shown, places, -1),
        counts=counts.reshape(3, count),
        grades=grades.reshape(3, count),
        is_open_below=bool((judged.values[shown] < edges[0]).any()),
        is_open_above=bool((judged.values[shown] > edges[-1]).any()),
    )


def axis_edges(metric: Metric, band: Band) -> Floats:
    """(B + 1,) ends of bins that show the values of a metric and the ends of its band.

    They do not depend on the values, so that bars of two meshes can be compared and none moves in a run.
    """
    low, high = _axis(metric, band)
    return np.linspace(low, high, _bin_count(low, high, metric.limits(metric.band)) + 1)


def _axis(metric: Metric, band: Band) -> tuple[float, float]:
    limits = metric.limits(band)
    low = metric.quads.low if metric.triangles is None else min(metric.quads.low, metric.triangles.low)
    if low < 0 <= min(limits):
        low = 0.0  # elements below are not valid: the first bin shows them
    if not isfinite(low):
        low = -_rounded_up(-1.25 * min(limits))
    high = metric.quads.high if metric.higher_is_better else min(metric.quads.high, metric.worst[1])
    if not isfinite(high):
        high = _rounded_up(OPEN_END * max(metric.limits(metric.band)))
    high = high if max(limits) <= high else _rounded_up(1.25 * max(limits))
    return 0.0 if 0.0 < low < high / _MOST_BINS else low, high


def _rounded_up(value: float) -> float:
    power = 10.0 ** floor(log10(value))
    return next(step * power for step in (1, 1.5, 2, 3, 4, 5, 6, 8, 10) if step * power >= value)


def _bin_count(low: float, high: float, limits: tuple[float, ...]) -> int:
    """As many bins as fit, with ends that are round numbers, the limits among them."""
    span = high - low
    power = 10.0 ** floor(log10(span / _MOST_BINS))
    for width in (step * power * scale for scale in (1, 10) for step in _STEPS):
        count = round(span / width)
        shares = np.array([span, *(limit - low for limit in limits)]) / width
        if count <= _MOST_BINS and (np.abs(shares - np.round(shares)) < 1e-9 * count).all():
            return count
    return _MOST_BINS
