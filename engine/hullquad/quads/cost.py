"""What a finished mesh costs: by this the best of several is chosen.

The cost is the mean energy of the elements (`quads.energy`: 0 for a square), plus `WORST` times that of the worst one
up to `MOST`, plus `NUMBER` times the number of elements over the number of squares of the element size that the plate
has room for. A triangle that could have been avoided costs `TRIANGLE`.
"""

import numpy as np

from hullquad.arrays import Floats
from hullquad.metrics.compiled import compiled
from hullquad.quads.draft import ELEMENTS, Draft
from hullquad.quads.energy import element_energy
from hullquad.quads.settings import Preference

WORST = 0.03
MOST = 25.0
NUMBER = 0.1
TRIANGLE = 100.0
"""More than anything else can cost."""


def cost(made: Draft, unavoidable: int, squares: float, prefer: Preference) -> float:
    """Cost of a mesh, of whose triangles so many are unavoidable, on a plate with room for so many elements."""
    energies = _energies(made)
    worst, mean = min(float(energies.max()), MOST), float(energies.mean())
    avoidable = max(0, len(made.triangles) - unavoidable)
    if prefer is Preference.QUALITY:
        return worst + WORST * (mean + NUMBER * len(energies) / squares + avoidable / len(energies))
    return TRIANGLE * avoidable + mean + WORST * worst + NUMBER * len(energies) / squares


def least_cost(prefer: Preference) -> float:
    """Cost of a mesh of nothing but squares of the element size."""
    return WORST * NUMBER if prefer is Preference.QUALITY else NUMBER


def _energies(made: Draft) -> Floats:
    energies = np.empty(made.tallies[ELEMENTS])
    _measure(made, energies)
    return energies[made.elements[: len(energies), 0] >= 0]


@compiled
def _measure(made: Draft, energies: Floats) -> None:
    for element in range(len(energies)):
        if made.elements[element, 0] >= 0:
            energies[element] = element_energy(made.nodes, made.elements, element)
