"""Values of metrics on the elements of a mesh: the kernels behind plain functions on arrays.

A kernel is compiled once, for read-only arrays; what can be written to is copied first. In all of them:

points : (N, 3) float array
    [mm]
elements : (E, 4) int array
    Nodes in order; a triangle ends with -1.
normals : (1, 3) or (E, 3) float array
    Direction that elements must face; zero where only their own sense is known.
areas : (2,) float array
    What the sizes of quads and of triangles are relative to; None for their own means.
"""

from collections.abc import Sequence

import numpy as np

from hullquad.arrays import Bools, Floats, Ints, floats, ints
from hullquad.metrics import METRICS, Metric, kernels

ANY_SENSE = floats(np.zeros((1, 3)))
"""Normals for elements of which only their own sense is known."""


def judged_values(
    metric: Metric, points: Floats, elements: Ints, normals: Floats = ANY_SENSE, areas: Floats | None = None
) -> tuple[Floats, Bools]:
    """Judged value and validity of every element.

    Returns
    -------
    values : (E,) float array
        The raw value where the element is valid; else the worst value (0, inf, or a signed value below 0 and a reflex
        angle, as `Metric.invalid` tells). Triangles by the metric's triangle form, or by shape. Angles in degrees.
    valid : (E,) bool array
    """
    values, valid = all_judged(points, elements, normals, areas, (metric,))
    return np.ravel(values), valid


def all_judged(
    points: Floats,
    elements: Ints,
    normals: Floats = ANY_SENSE,
    areas: Floats | None = None,
    metrics: Sequence[Metric] = METRICS,
) -> tuple[Floats, Bools]:
    """(E, M) judged values of every element by several metrics, and (E,) validity, as of `judged_values`."""
    points, elements = floats(points), ints(elements)
    areas = reference_areas(points, elements) if areas is None else floats(areas)
    values, valid = np.empty((len(elements), len(metrics))), np.empty(len(elements), dtype=bool)
    rows = ints([_row(metric) for metric in metrics])
    invalid = floats([[row.invalid for row in metrics], [row.triangle_metric.invalid for row in metrics]])
    factors = np.array([metric.factor for metric in metrics])
    kernels.judge(rows, points, elements, floats(normals), areas, floats(invalid / factors[:, None]), values, valid)
    return values * factors, valid


def raw_values(
    metric: Metric, points: Floats, quads: Ints, normals: Floats = ANY_SENSE, areas: Floats | None = None
) -> Floats:
    """(Q,) values of the formula as it stands, on any quad; angles in degrees."""
    values = np.empty(len(quads))
    points, quads = floats(points), ints(quads)
    areas = reference_areas(points, quads) if areas is None else floats(areas)
    kernels.raw_values(_row(metric), points, quads, floats(normals), areas, values)
    return values * metric.factor


def corner_values(metric: Metric, points: Floats, elements: Ints, normals: Floats = ANY_SENSE) -> Floats:
    """(E, 4) raw value of each corner by itself, for metrics that are the worst of them (`Metric.is_of_corners`).

    Not a number where there is none: the fourth corner of triangles, and all corners of triangles under a metric
    whose form for them is not of corners. Angles in degrees.
    """
    if not metric.is_of_corners:
        raise ValueError(f"{metric.key} is not of corners")
    values = np.empty((len(elements), 4))
    kernels.corner_values(_row(metric), floats(points), ints(elements), floats(normals), values)
    return values * metric.factor


def difference_gradient(
    metric: Metric,
    points: Floats,
    quads: Ints,
    tangents: Floats,
    step: float,
    normals: Floats = ANY_SENSE,
    areas: Floats | None = None,
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
    points, quads = floats(points), ints(quads)
    areas = reference_areas(points, quads) if areas is None else floats(areas)
    kernels.difference_gradient(_row(metric), points, quads, floats(normals), areas, floats(tangents), step, gradient)
    return gradient


def valid_elements(points: Floats, elements: Ints, normals: Floats = ANY_SENSE) -> Bools:
    """(E,) which elements are convex, not collapsed and not against their normal."""
    valid = np.empty(len(elements), dtype=bool)
    kernels.validity(floats(points), ints(elements), floats(normals), valid)
    return valid


def reference_areas(points: Floats, elements: Ints) -> Floats:
    """(2,) mean areas of the quads and of the triangles; 0 where there are none."""
    means = np.empty(2)
    kernels.areas(floats(points), ints(elements), means)
    return floats(means)


def _row(metric: Metric) -> int:
    return METRICS.index(metric)
