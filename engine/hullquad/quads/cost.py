"""What a finished mesh costs: by this the best of several is chosen.

The cost is the mean energy of the elements (`quads.energy`: 0 for a square), plus `WORST` times that of the worst one,
each up to `MOST`, plus `NUMBER` times the number of elements over the usual number: an element that cannot be mended
does not outweigh all others. A triangle that could have been avoided costs `TRIANGLE`, and an element that is not valid
more than any number of them.
"""

import numpy as np

from hullquad.arrays import Floats, Ints
from hullquad.quads.draft import Draft, draft
from hullquad.quads.energy import INVALID, element_energies
from hullquad.quads.settings import Preference
from hullquad.quads.settling import settled

WORST = 0.03
MOST = 25.0
NUMBER = 0.42
POOR = 4.0
"""No element counts as worse where others are weighed against it."""
TRIANGLE = INVALID
"""More than anything else that is valid can cost."""


def cost(made: Draft, unavoidable: int, usual: float, prefer: Preference) -> float:
    """Cost of a mesh, of whose triangles so many are unavoidable, where so many elements are usual."""
    energies = element_energies(made.nodes, made.element_rows)
    return price(energies, max(0, len(made.triangles) - unavoidable), usual, prefer)


def price(energies: Floats, avoidable: int, usual: float, prefer: Preference) -> float:
    """Cost of elements of these energies, among them so many triangles that could have been avoided."""
    worst, mean = min(float(energies.max()), MOST), float(np.minimum(energies, MOST).mean())
    if energies.max() >= INVALID:
        return INVALID * float(energies.max())
    if prefer is Preference.QUALITY:
        return worst + WORST * (mean + NUMBER * len(energies) / usual + avoidable / len(energies))
    return TRIANGLE * avoidable + mean + WORST * worst + NUMBER * len(energies) / usual


def judged(nodes: Floats, elements: Ints, given: int, *, settles: bool) -> Floats:
    """(E,) energies of elements by which a mesh is judged: with its free nodes where they settle, or as they are."""
    if not settles or not len(elements):
        return element_energies(nodes.copy(), elements.astype(np.int64))
    made = draft(nodes, elements, given, np.empty(0, dtype=np.int64))
    settled(made)
    return element_energies(made.nodes, made.element_rows)


def element_price(made: Draft, usual: float) -> float:
    """What one element more costs in all, beside its own energy: the more of them, the less does each of them weigh."""
    energies = element_energies(made.nodes, made.element_rows)
    return NUMBER * len(energies) / usual - float(np.minimum(energies, POOR).mean())


def least_cost(prefer: Preference) -> float:
    """Cost of a mesh of nothing but squares of the element size."""
    return WORST * NUMBER if prefer is Preference.QUALITY else NUMBER
