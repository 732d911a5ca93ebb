"""What a finished mesh costs: by this the best of several is chosen.

The cost is the mean energy of the elements (`quads.energy`: 0 for a square), plus `WORST` times that of the worst one
up to `MOST`, plus `NUMBER` times the number of elements over the number of squares of the element size that the plate
has room for. A triangle that could have been avoided costs `TRIANGLE`.
"""

from hullquad.arrays import Floats
from hullquad.quads.draft import Draft
from hullquad.quads.energy import element_energies
from hullquad.quads.settings import Preference

WORST = 0.03
MOST = 25.0
NUMBER = 0.1
TRIANGLE = 100.0
"""More than anything else can cost."""


def cost(made: Draft, unavoidable: int, squares: float, prefer: Preference) -> float:
    """Cost of a mesh, of whose triangles so many are unavoidable, on a plate with room for so many elements."""
    energies = element_energies(made.nodes, made.element_rows)
    return price(energies, max(0, len(made.triangles) - unavoidable), squares, prefer)


def price(energies: Floats, avoidable: int, squares: float, prefer: Preference) -> float:
    """Cost of elements of these energies, among them so many triangles that could have been avoided."""
    worst, mean = min(float(energies.max()), MOST), float(energies.mean())
    if prefer is Preference.QUALITY:
        return worst + WORST * (mean + NUMBER * len(energies) / squares + avoidable / len(energies))
    return TRIANGLE * avoidable + mean + WORST * worst + NUMBER * len(energies) / squares


def least_cost(prefer: Preference) -> float:
    """Cost of a mesh of nothing but squares of the element size."""
    return WORST * NUMBER if prefer is Preference.QUALITY else NUMBER
