"""Axes of charts: where a value is drawn, and which values are written beside it."""

from itertools import pairwise
from math import ceil, floor, isfinite, log10

import attrs

from hullquad_app.panels.figures import signed


@attrs.frozen
class Axis:
    """Values from `low` to `high` on pixels from `start` to `end`."""

    low: float
    high: float
    start: float
    end: float

    def at(self, value: float) -> float:
        """Pixel of a value; values beyond the axis are drawn on its end."""
        if self.high == self.low:
            return (self.start + self.end) / 2
        share = (min(max(value, self.low), self.high) - self.low) / (self.high - self.low)
        return self.start + share * (self.end - self.start)

    def value(self, at: float) -> float:
        """Value at a pixel, on the axis."""
        share = (at - self.start) / (self.end - self.start) if self.end != self.start else 0.0
        return self.low + min(max(share, 0.0), 1.0) * (self.high - self.low)


def ticks(low: float, high: float, most: int, *, whole: bool = False) -> list[float]:
    """Round values between two others, at most so many; with `whole` only whole numbers."""
    step = _round_step((high - low) / max(most - 1, 1), least=1.0 if whole else 0.0)
    first, last = ceil(low / step - 1e-9), floor(high / step + 1e-9)
    while last - first + 1 > most:
        step = _round_step(step * 1.01, least=0.0)
        first, last = ceil(low / step - 1e-9), floor(high / step + 1e-9)
    return [number * step for number in range(first, last + 1)]


def labels(values: list[float]) -> list[str]:
    """Values with as many decimals as their step needs."""
    step = min((after - before for before, after in pairwise(values)), default=0.0)
    if step == 0.0:
        return [signed(f"{value:.4g}") for value in values]
    decimals = max(0, -floor(log10(step) + 1e-9))
    if round(step * 10**decimals, 6) % 1:
        decimals += 1
    return [signed(f"{value:.{decimals}f}") if round(value, 9) else "0" for value in values]


def top(most: int) -> int:
    """Even round number at which an axis of counts ends; 1 where there is one thing at most."""
    power = int(10 ** (len(str(most)) - 1))
    rounds = (factor * power // 10 for factor in (10, 20, 30, 40, 60, 80, 100))
    return next(value for value in (1, 2, 4, 6, 8, *rounds, 12 * power) if value >= most)


def padded(values: list[float], share: float = 0.08) -> tuple[float, float]:
    """Range of the finite values with some room around them; never empty."""
    finite = [value for value in values if isfinite(value)] or [0.0]
    low, high = min(finite), max(finite)
    room = max(share * (high - low), 1e-3 * max(abs(low), abs(high)) if high - low < 1e-9 * abs(high) else 0.0, 1e-9)
    return low - room, high + room


def _round_step(least_step: float, least: float) -> float:
    wanted = max(least_step, least, 1e-12)
    return next(value for value in _rounds(wanted) if value >= wanted * (1 - 1e-9))


def _rounds(value: float) -> list[float]:
    power = 10.0 ** floor(log10(value))
    return [power, 2 * power, 2.5 * power, 5 * power, 10 * power, 20 * power]
