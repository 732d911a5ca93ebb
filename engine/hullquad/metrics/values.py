"""Values of a metric on the elements of a mesh: the kernels behind plain functions on arrays.

A kernel is compiled once, for read-only arrays; what can be written to is copied first.
"""

import numpy as np

from hullquad.arrays import Bools, Floats, Ints, floats, ints
from hullquad.metrics import METRICS, Metric, kernels

ANY_SENSE = floats(np.zeros((1, 3)))
"""Normals for elements of which only their own sense is known."""


def judged_values(metric: Metric, points: Floats, elements: Ints, normals: Floats = ANY_SENSE) -> tuple[Floats, Bools]:
    """Judged value and validity of every element.

    Parameters
    ----------
    points : (N, 3) float array
        [mm]
    elements : (E, 4) int array
        Nodes in order; a triangle ends with -1.
    normals : (1, 3) or (E, 3) float array
        Direction that elements must face; zero where only their own sense is known.

    Returns
    -------
    values : (E,) float array
        The raw value where the element is valid; else the worst value (0, inf, or the signed value of the scaled
        Jacobian and the reflex angle). Triangles by the metric's triangle form, or by shape. Angles in degrees.
    valid : (E,) bool array
    """
    values, valid = np.empty(len(elements)), np.empty(len(elements), dtype=bool)
    kernels.judge(_row(metric), floats(points), ints(elements), floats(normals), values, valid)
    return values * metric.factor, valid


def raw_values(metric: Metric, points: Floats, quads: Ints, normals: Floats = ANY_SENSE) -> Floats:
    """(Q,) values of the formula as it stands, on any quad; angles in degrees."""
    values = np.empty(len(quads))
    kernels.raw_values(_row(metric), floats(points), ints(quads), floats(normals), values)
    return values * metric.factor


def difference_gradient(
    metric: Metric, points: Floats, quads: Ints, tangents: Floats, step: float, normals: Floats = ANY_SENSE
) -> Floats:
    """(N, 2) central differences of the sum of raw values by the nodes' parameters; angles in radians.

    Parameters
    ----------
    tangents : (N, 2, 3) float array
        Change of a node's point with its two parameters.
    step : float
        By which a parameter is changed either way [mm].
    """
    gradient = np.zeros((len(points), 2))
    kernels.difference_gradient(
        _row(metric), floats(points), ints(quads), floats(normals), floats(tangents), step, gradient
    )
    return gradient


def valid_elements(points: Floats, elements: Ints, normals: Floats = ANY_SENSE) -> Bools:
    """(E,) which elements are convex, not collapsed and not against their normal."""
    valid = np.empty(len(elements), dtype=bool)
    kernels.validity(floats(points), ints(elements), floats(normals), valid)
    return valid


def _row(metric: Metric) -> int:
    return METRICS.index(metric)
