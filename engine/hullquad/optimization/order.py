"""An order of points in which neighbours stay near each other: Morton's curve."""

import numpy as np
import numpy.typing as npt

from hullquad.arrays import Floats, Longs

_BITS = 16
FEW = 2000
"""So many are near each other in memory whatever their order."""
_SPREAD = ((8, 0x00FF00FF), (4, 0x0F0F0F0F), (2, 0x33333333), (1, 0x55555555))


def along_a_curve(points: Floats) -> Longs:
    """(N,) rows of points (N, 2 or 3) in the order of Morton's curve across their two longest extents.

    Few points are near each other in memory whatever their order, and keep it.
    """
    if len(points) <= FEW:
        return np.arange(len(points))
    low, extent = points.min(axis=0), np.ptp(points, axis=0)
    axes = np.argsort(-extent, kind="stable")[:2]
    cells = (points[:, axes] - low[axes]) * ((2**_BITS - 1) / max(float(extent.max()), 1e-300))
    across, up = (_spread(cells[:, axis].astype(np.uint32)) for axis in range(2))
    return np.argsort(across | (up << np.uint32(1)), kind="stable")


def _spread(numbers: npt.NDArray[np.uint32]) -> npt.NDArray[np.uint32]:
    """The numbers' bits with a gap after each."""
    for shift, mask in _SPREAD:
        numbers = (numbers | (numbers << np.uint32(shift))) & np.uint32(mask)
    return numbers
