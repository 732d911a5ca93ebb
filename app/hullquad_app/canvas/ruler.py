"""Lengths for scale bars: 1, 2 or 5 times a power of ten."""

from math import floor, log10


def nice_length(most: float) -> float:
    """The greatest length of the row 1, 2, 5, 10… that is not above `most` [same unit]."""
    decade = 10.0 ** floor(log10(most))
    return next(factor * decade for factor in (5.0, 2.0, 1.0) if factor * decade <= most * (1 + 1e-9))


def written(length: float) -> str:
    """A length with its unit; long ones in groups of three digits."""
    return f"{length:,.0f} mm".replace(",", "\N{NARROW NO-BREAK SPACE}") if length >= 1 else f"{length:g} mm"
