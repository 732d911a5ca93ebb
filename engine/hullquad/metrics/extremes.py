"""The least and the greatest of some positive numbers, exact or smooth, with their slopes.

The smooth ones are power means with the exponent p = 2^doublings::

    least_p = (mean of q^-p)^(-1/p)      min <= least_p <= n^(1/p) min
    greatest_p = (mean of q^p)^(1/p)     n^(-1/p) max <= greatest_p <= max

and tend to the exact ones as p grows. All powers are of ratios to the extreme itself, so that none overflows.
Where several numbers share the extreme, the exact slope is the mean of theirs: one of those between the one-sided
ones. Numbers whose extreme is not positive have no power mean: they get their exact extreme.
"""

from collections.abc import Sequence

from hullquad.metrics.expression import Number, choice, extreme, highest, lowest, root, ties


def least(items: Sequence[Number], doublings: int | None) -> Number:
    """The least of some numbers, or their power mean with exponent -2^doublings."""
    low = lowest(items)
    shares = [low.over(item, 1.0) for item in items]
    if doublings is None:
        return extreme(low, items, ties(low, items))
    powers, total, mean_root = _powers(shares, doublings)
    factor = 1.0 / (total * mean_root)
    smooth = [power * share * factor for power, share in zip(powers, shares, strict=True)]
    return _where_positive(low, low / mean_root, items, ties(low, items), smooth)


def greatest(items: Sequence[Number], doublings: int | None) -> Number:
    """The greatest of some numbers, or their power mean with exponent 2^doublings."""
    high = highest(items)
    if doublings is None:
        return extreme(high, items, ties(high, items))
    shares = [item.over(high, 1.0) for item in items]
    powers, total, mean_root = _powers(shares, doublings)
    factor = mean_root / total
    smooth = [power / share * factor for power, share in zip(powers, shares, strict=True)]
    return _where_positive(high, high * mean_root, items, ties(high, items), smooth)


def _powers(shares: Sequence[Number], doublings: int) -> tuple[list[Number], Number, Number]:
    """Powers of the shares, their sum, and the root of their mean."""
    powers = list(shares)
    for _ in range(doublings):
        powers = [power * power for power in powers]
    total = sum(powers[1:], powers[0])
    mean_root = (1.0 / len(powers)) * total
    for _ in range(doublings):
        mean_root = root(mean_root)
    return powers, total, mean_root


def _where_positive(
    exact: Number, mean: Number, items: Sequence[Number], ties: Sequence[Number], smooth: Sequence[Number]
) -> Number:
    slopes = [choice(exact, slope, tie) for slope, tie in zip(smooth, ties, strict=True)]
    return extreme(choice(exact, mean, exact), items, slopes)
