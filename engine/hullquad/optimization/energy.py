"""What a minimiser makes smaller, compiled: one function for every kind of energy."""

from typing import NamedTuple

import numpy as np

from hullquad.arrays import Floats, Ints
from hullquad.metrics.compiled import compiled
from hullquad.optimization.winslow import winslow_energy

WINSLOW, METRIC = 0, 1


class Elements(NamedTuple):
    """The elements of a problem."""

    quads: Ints
    """(Q, 4)"""
    triangles: Ints
    """(T, 3)"""
    normals: Floats
    """(1, 3) or (Q + T, 3) directions that quads, then triangles must face."""


class Energy(NamedTuple):
    """An energy with its parameters."""

    kind: int
    size: float
    """Element size [mm]."""
    keeps_valid: bool
    """Whether no step may turn an element inside out: until all are valid, it may."""
    epsilon: float
    """How far Winslow's energy is regularised [element size squared]."""
    floor: float
    """Scaled Jacobian below which elements must keep most of what they have."""


@compiled
def energy_at(points: Floats, elements: Elements, energy: Energy, gradient: Floats) -> float:
    """The energy; its gradient by the points is written to `gradient` (K, 3)."""
    gradient[:] = 0.0
    value = winslow_energy(
        points, elements.quads, elements.triangles, elements.normals, energy.size, energy.epsilon, gradient
    )
    return value if np.isfinite(value) else np.inf
