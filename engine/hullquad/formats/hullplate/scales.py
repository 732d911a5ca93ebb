"""Units of a plate document: what a number in it is in millimetres and radians, and back without losing a bit."""

import numpy as np

LENGTHS = {"mm": 1.0, "m": 1000.0}
"""[mm]"""
ANGLES = {"deg": np.pi / 180, "rad": 1.0}
"""[rad]"""
TONNES_PER_M3 = 1e-9
"""[t/mm3]; densities are in it when lengths are in metres."""
_STEPS = 4


def density(length: float) -> float:
    """[t/mm3] that a density of 1 is, with so many millimetres per unit of length."""
    return 1.0 if length == 1 else TONNES_PER_M3


def unscaled(value: float, scale: float) -> float:
    """Number that times the scale gives the value, bit for bit where there is one; else the nearest."""
    number = float(value) / scale
    below = above = number
    for _ in range(_STEPS):
        for candidate in (below, above):
            if candidate * scale == value:
                return candidate
        below, above = float(np.nextafter(below, -np.inf)), float(np.nextafter(above, np.inf))
    return number
