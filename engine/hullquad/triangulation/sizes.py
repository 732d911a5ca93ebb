"""Element sizes: which one a plate has, which ones it cannot have."""

import numpy as np

from hullquad.errors import PlateError
from hullquad.plate import Plate

MOST_ELEMENTS = 5_000_000
"""Per plate."""
_LARGEST_SIZE = 1e9
"""Elements as large as the largest coordinate are longer than any plate; squares of the size do not overflow [mm]."""
_ROUNDING = 1e-9
"""Relative; the last digits must not make 49.9 of 50."""


def element_size(plate: Plate, size: float | str | None) -> float:
    """Element size of a plate, when `size` is asked for all [mm]."""
    if size is None:
        return plate.target_size
    return float(getattr(plate.sizes, size)) if isinstance(size, str) else size


def elements_needed(plate: Plate, size: float) -> float:
    """Estimate of the number of elements of a size: of the area, and of those that the contour's segments ask for."""
    count, length = _segments_asked_for(plate)
    return float(plate.region.area) / size / size + (count + length / size) / 2


def refuse_size(plate: Plate, size: float, place: str) -> None:
    """Refuse what is no size, and a size that would make more elements than can be handled.

    Raises
    ------
    PlateError
        E_SIZE, E_TOO_BIG
    """
    if not size > 0:
        raise PlateError("E_SIZE", place, "positive", shown=f"{size:g}")
    if size > _LARGEST_SIZE:
        raise PlateError("E_SIZE", place, "large", size=size, most=_LARGEST_SIZE)
    if elements_needed(plate, size) > MOST_ELEMENTS:
        raise _too_big(plate, size, place)


def _too_big(plate: Plate, size: float, place: str) -> PlateError:
    """Error that says which size would do."""
    count, length = _segments_asked_for(plate)
    left = MOST_ELEMENTS - count / 2  # left x**2 - length x / 2 - area = 0 is solved by the least size
    if left <= 0:
        return PlateError("E_TOO_BIG", f"{plate.place}/divisions", "divisions", count=count, most=MOST_ELEMENTS)
    root = np.sqrt((length / 4) ** 2 + left * plate.region.area)
    least = _rounded_up(float((length / 4 + root) / left))
    return PlateError("E_TOO_BIG", place, size=size, most=MOST_ELEMENTS, least=least)


def _segments_asked_for(plate: Plate) -> tuple[int, float]:
    """Number of segments whatever the size is, and length of the edges that are divided by it [mm]."""
    count, length = 0, 0.0
    for i, loop in enumerate(plate.loops):
        wishes = plate.divisions[i] if plate.divisions else ()
        numbers = [wishes[edge] if wishes else 0 for edge in loop.edges]
        count += sum(number or 1 for number in numbers)
        length += sum(curve.length for curve, number in zip(loop.curves, numbers, strict=True) if not number)
    return count, length


def _rounded_up(size: float) -> float:
    """A size in three digits, not below."""
    digit = 10.0 ** (np.floor(np.log10(size)) - 2)
    return float(np.ceil(size / digit) * digit)


def rounded_down(size: float) -> float:
    """A size in three digits, not above: what is quoted of it, and asked for then, helps too."""
    digit = 10.0 ** (np.floor(np.log10(size)) - 2)
    return float(np.floor(size / digit * (1 + _ROUNDING)) * digit)
