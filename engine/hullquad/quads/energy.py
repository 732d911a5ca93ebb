r"""How bad an element is, and where a node should be: one convex energy for smoothing and for every decision.

A corner at x between the edges u (to the next node) and w (to the previous one) has

    eta = (|u|^2 + |w|^2) / (2 J),   J = u x w,

the reciprocal of the shape metric at that corner: 1 for a right angle between edges of equal length, infinite for
a flat corner; a triangle has one eta = (sum of squared edges) / (2 sqrt(3) J). J is linear and the numerator quadratic
in the place of one node, so that every power of eta is convex in that place as long as the corner is open.

Smoothing minimises the mean of eta^2 over the corners, summed over the elements. Decisions are made by the mean of
eta^4, minus 1, which weighs bad corners more: that is the energy of an element. A quad that breaks what most rules ask
for costs more, `OUTSIDE`, and a triangle, too.
"""

from math import inf, sqrt

import numpy as np

from hullquad.arrays import Floats, Longs
from hullquad.metrics.compiled import called, uncounted

INVALID = 1e6
"""Energy of an element without area; more where it is inverted."""

MOST = 0.5 * INVALID
"""No valid element has more."""

TRIANGLE = 1.0
"""Added for a triangle."""

FLAT = 1e-4
"""A corner whose J over its squared edges is below this is not open."""

OUTSIDE = 5.0
"""Added for a quad outside the limits that most rules ask for: angles from 45 to 135 degrees, aspect ratio up to 3."""

_COTANGENT, _ASPECT = 1.0, 3.0

QUAD_SCALE = 2.0
TRIANGLE_SCALE = 2.0 * sqrt(3.0)


@called
def corner_eta(
    before_x: float, before_y: float, x: float, y: float, after_x: float, after_y: float
) -> tuple[float, float]:
    """Sum of the squares of the two edges, and J, of a corner."""
    ux, uy, wx, wy = after_x - x, after_y - y, before_x - x, before_y - y
    return ux * ux + uy * uy + wx * wx + wy * wy, ux * wy - uy * wx


def element_energies(nodes: Floats, elements: Longs) -> Floats:
    """(E,) energies of elements."""
    energies = np.empty(len(elements))
    _measure(nodes, elements, energies)
    return energies


@uncounted
def _measure(nodes: Floats, elements: Longs, energies: Floats) -> None:
    for element in range(len(energies)):
        energies[element] = element_energy(nodes, elements, element)


@called
def element_energy(nodes: Floats, elements: Longs, element: int) -> float:
    """Energy of an element; at least `INVALID` where it is not valid."""
    if elements[element, 3] < 0:
        return _triangle_energy(nodes, elements[element, 0], elements[element, 1], elements[element, 2])
    return quad_energy(nodes, elements[element, 0], elements[element, 1], elements[element, 2], elements[element, 3])


@called
def _triangle_energy(nodes: Floats, a: int, b: int, c: int) -> float:
    """Energy of the triangle a, b, c."""
    squares, jacobian = corner_eta(nodes[c, 0], nodes[c, 1], nodes[a, 0], nodes[a, 1], nodes[b, 0], nodes[b, 1])
    squares += float((nodes[c, 0] - nodes[b, 0]) ** 2 + (nodes[c, 1] - nodes[b, 1]) ** 2)
    if jacobian <= FLAT * squares:
        return INVALID * (2.0 - jacobian / squares) if squares > 0.0 else 2.0 * INVALID
    eta = squares / (TRIANGLE_SCALE * jacobian)
    return min((eta * eta) ** 2 - 1.0 + TRIANGLE, MOST)


@called
def quad_energy(nodes: Floats, a: int, b: int, c: int, d: int) -> float:
    """Energy of the quad a, b, c, d."""
    total, least, skewest, longest, shortest = 0.0, 1.0, 0.0, 0.0, inf
    before, here, after = d, a, b
    for corner in range(4):
        ux, uy = nodes[after, 0] - nodes[here, 0], nodes[after, 1] - nodes[here, 1]
        wx, wy = nodes[before, 0] - nodes[here, 0], nodes[before, 1] - nodes[here, 1]
        edge, jacobian = ux * ux + uy * uy, ux * wy - uy * wx
        squares = edge + wx * wx + wy * wy
        if squares <= 0.0:
            return 2.0 * INVALID
        if jacobian > FLAT * squares:
            eta = squares / (QUAD_SCALE * jacobian)
            total += (eta * eta) ** 2
            skewest = max(skewest, abs(ux * wx + uy * wy) / jacobian)
        least = min(least, jacobian / squares)
        longest, shortest = max(longest, edge), min(shortest, edge)
        before, here = here, after
        after = c if corner == 0 else (d if corner == 1 else a)
    if least <= FLAT:
        return INVALID * (2.0 - least)
    if skewest > _COTANGENT or longest > _ASPECT * _ASPECT * shortest:
        total += 4.0 * OUTSIDE
    return min(0.25 * total - 1.0, MOST)
