"""The limits of a metric as the user moves and reads them: which end, by what steps, with how many decimals."""

from math import floor, isfinite, log10

from hullquad.metrics import DEGREES, Band, Metric
from hullquad.metrics.row import MILLIMETRES
from hullquad_app.panels.figures import plain

_PARTS = 5
"""Steps that lead from nothing to the limit of a metric without an upper end."""


def with_limit(by: Metric, band: Band, end: int, limit: float) -> Band:
    """The band with its limit number `end` elsewhere; of two limits neither passes the other."""
    if not by.is_two_sided:
        return by.opened((limit, limit))
    low, high = band
    return (min(limit, high), high) if end == 0 else (low, max(limit, low))


def step(by: Metric) -> float:
    """By how much a press of an arrow moves a limit: 1 of angles and lengths, 0.05 of what ends at 1."""
    wanted = max(by.limits(by.band)) / _PARTS
    if by.unit or (isfinite(by.quads.high) and wanted > 0.01):
        return 1.0 if by.unit else 0.05
    decade = 10.0 ** floor(log10(wanted))
    return next(factor * decade for factor in (5.0, 2.0, 1.0) if factor * decade <= wanted)


def decimals(by: Metric, limits: tuple[float, ...]) -> int:
    """Decimals of limits in their boxes: those of the metric, and more where a limit needs them."""
    least = 1 if by.unit in (DEGREES, MILLIMETRES) or step(by) >= 1 else 2
    return max(least, *(_needed(number) for number in (step(by), *limits)))


def _needed(limit: float) -> int:
    _, _, behind = f"{limit:.4f}".rstrip("0").partition(".")
    return len(behind)


def limit_words(by: Metric, band: Band) -> str:
    """The limits with their unit: one, or two of a two-sided metric."""
    return " – ".join(plain(limit, by) for limit in by.limits(band))
