"""The limits of a metric as the user moves and reads them: which end, by what steps, with how many decimals."""

from math import floor, isfinite, log10

from hullquad.metrics import DEGREES, Band, Metric
from hullquad_app.panels.figures import plain

MILLIMETRES = "mm"
_PARTS = 12
"""Steps that lead from nothing to the limit of a metric without an upper end."""


def with_limit(by: Metric, band: Band, end: int, limit: float) -> Band:
    """The band with its limit number `end` elsewhere; of two limits neither passes the other."""
    if not by.is_two_sided:
        return by.opened((limit, limit))
    low, high = band
    return (min(limit, high), high) if end == 0 else (low, max(limit, low))


def step(by: Metric) -> float:
    """By how much a press of an arrow moves a limit: 1 of angles and lengths, 0.05 of what ends at 1."""
    if by.unit:
        return 1.0
    if isfinite(by.quads.high):
        return 0.05
    wanted = max(by.limits(by.band)) / _PARTS
    decade = 10.0 ** floor(log10(wanted))
    return next(factor * decade for factor in (5.0, 2.0, 1.0) if factor * decade <= wanted)


def decimals(by: Metric, limits: tuple[float, ...]) -> int:
    """Decimals of limits in their boxes: those of the metric, and more where a limit needs them."""
    least = 1 if by.unit in (DEGREES, MILLIMETRES) or step(by) >= 1 else 2
    return max(least, *(_needed(limit) for limit in limits))


def _needed(limit: float) -> int:
    _, _, behind = f"{limit:.4f}".rstrip("0").partition(".")
    return len(behind)


def limit_words(by: Metric, band: Band) -> str:
    """The limits with their unit: one, or two of a two-sided metric."""
    return " – ".join(plain(limit, by) for limit in by.limits(band))
