"""Grades: values of any metric on one scale from -1 (as bad as can be) over 0 (the band's end) to 1 (ideal)."""

from math import inf, isfinite

import numpy as np

from hullquad.arrays import Floats
from hullquad.metrics import Band, Metric


def graded(metric: Metric, values: Floats, band: Band, *, ideal: float | None = None) -> Floats:
    """Grade of each value: from -1 (as bad as can be) over 0 (an end of the band) to 1 (ideal).

    A value beyond its band has a grade of 0 at the most, one inside of 0 at the least.
    """
    ideal = metric.quads.ideal if ideal is None else ideal
    grades = np.where(np.isnan(values), np.nan, 1.0)
    for side, limit in enumerate(band):
        if isfinite(limit):
            is_here = values <= max(ideal, limit) if side == 0 else values >= min(ideal, limit)
            one_sided = _one_sided(values, limit, metric.worst[side], ideal, is_least=side == 0)
            grades = np.where(is_here, np.minimum(grades, one_sided), grades)
    return grades


def value_of_grade(metric: Metric, grades: Floats, band: Band) -> Floats:
    """Values of quads that have these grades by a metric whose band has one end."""
    (limit,) = metric.limits(band)
    worst, ideal = metric.worst[0 if metric.higher_is_better else 1], metric.quads.ideal
    failing = limit - grades * (worst - limit) if isfinite(worst) else _quotient(limit, grades + 1.0)
    return np.where(grades < 0, failing, limit + grades * (ideal - limit))


def _one_sided(values: Floats, limit: float, worst: float, ideal: float, *, is_least: bool) -> Floats:
    """Grades on one side of the ideal: linear from the worst value to the limit and on to the ideal."""
    if isfinite(worst):
        failing = (limit - values) / (worst - limit) if worst != limit else -np.ones_like(values)
    else:
        failing = _quotient(limit, np.maximum(values, limit)) - 1.0
    passing = (values - limit) / (ideal - limit) if ideal != limit else np.ones_like(values)
    beyond = values < limit if is_least else values > limit
    return np.where(beyond, np.clip(failing, -1.0, 0.0), np.clip(passing, 0.0, 1.0))


def _quotient(dividend: float, divisors: Floats) -> Floats:
    """The quotient; 0 where the divisor is infinite, infinite where it is 0."""
    with np.errstate(divide="ignore", invalid="ignore"):
        quotient = np.asarray(dividend / divisors)
    return np.where(np.isnan(quotient), inf, quotient)
