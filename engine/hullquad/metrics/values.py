"""Values of metrics on the elements of a mesh, and their slopes: the kernels behind plain functions on arrays.

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
from math import inf, log2

import numpy as np

from hullquad.arrays import Bools, Floats, Ints, floats, ints
from hullquad.mesh import mean_areas
from hullquad.metrics import METRICS, Metric, kernels
from hullquad.metrics.program import Program, rows_for
from hullquad.metrics.programs import corners_program, raw_program, slopes_program, values_program

ANY_SENSE = floats(np.zeros((1, 3)))
"""Normals for elements of which only their own sense is known."""
_NO_AREAS = floats(np.zeros(2))


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
    return values[:, 0], valid


def all_judged(
    points: Floats,
    elements: Ints,
    normals: Floats = ANY_SENSE,
    areas: Floats | None = None,
    metrics: Sequence[Metric] = METRICS,
) -> tuple[Floats, Bools]:
    """(E, M) judged values of every element by several metrics, and (E,) validity, as of `judged_values`."""
    invalid = np.array([[row.invalid for row in metrics], [row.triangle_metric.invalid for row in metrics]])
    programs = values_program(tuple(metrics), 4), values_program(tuple(metrics), 3)
    return _judged(programs, metrics, points, elements, normals, areas, invalid)


def raw_values(
    metric: Metric, points: Floats, quads: Ints, normals: Floats = ANY_SENSE, areas: Floats | None = None
) -> Floats:
    """(Q,) values of the formula as it stands, on any quad; angles in degrees."""
    programs = values_program((metric,), 4), values_program((metric,), 3)
    values, _ = _judged(programs, (metric,), points, quads, normals, areas, np.full((2, 1, 2), (-inf, inf)))
    return values[:, 0]


def corner_values(metric: Metric, points: Floats, elements: Ints, normals: Floats = ANY_SENSE) -> Floats:
    """(E, 4) raw value of each corner by itself, for metrics that are the worst of them (`Metric.is_of_corners`).

    Not a number where there is none: the fourth corner of triangles, and all corners of triangles under a metric
    whose form for them is not of corners. Angles in degrees.
    """
    programs = corners_program(metric, 4), corners_program(metric, 3)
    values, _ = _judged(programs, [metric] * 4, points, elements, normals, None, np.full((2, 4, 2), (-inf, inf)))
    return values


def valid_elements(points: Floats, elements: Ints, normals: Floats = ANY_SENSE) -> Bools:
    """(E,) which elements are convex, not collapsed and not against their normal."""
    return all_judged(points, elements, normals, None, ())[1]


def value_gradients(
    metric: Metric, points: Floats, elements: Ints, normals: Floats = ANY_SENSE, areas: Floats | None = None
) -> tuple[Floats, Floats]:
    """Raw values of quads, or of triangles, and their gradients by each node.

    Exact, the moving centre normal included. Where a metric has a kink (several corners or edges share the extreme,
    an angle of 0, a flat quad under a measure of warp), the gradient is the mean of the one-sided ones or 0: one
    of the subgradients. Where it has none (a degenerate element), it is 0.

    Parameters
    ----------
    elements : (E, 4) or (E, 3) int array
        Quads, or triangles.

    Returns
    -------
    values : (E,) float array
        Angles in degrees.
    gradients : (E, 4, 3) or (E, 3, 3) float array
        [metric's unit per mm]
    """
    return smooth_gradients(metric, inf, points, elements, normals, areas)


def smooth_gradients(
    metric: Metric,
    exponent: float,
    points: Floats,
    elements: Ints,
    normals: Floats = ANY_SENSE,
    areas: Floats | None = None,
) -> tuple[Floats, Floats]:
    """The same as `value_gradients` of a smooth stand-in, which tends to the metric as `exponent` grows.

    Every least and greatest over corners, edges, diagonals and axes is a power mean (`extremes`); lengths count as
    squares. `exponent` is a power of 2 from 1 to 1024, or infinite for the metric itself. Of valid elements;
    where a number that is to be raised is not positive, the exact extreme is taken.
    A corner angle has no stand-in.
    """
    doublings = None if exponent == inf else int(log2(exponent))
    if doublings is not None and (doublings < 0 or 2.0**doublings != exponent):
        raise ValueError(f"{exponent} is not a power of 2")
    count = elements.shape[1]
    program = slopes_program(metric, count, doublings)
    padded = np.pad(elements, ((0, 0), (0, 4 - count)), constant_values=-1) if count < 4 else elements
    found = _unjudged(program, 4 - count, metric.factor, points, padded, normals, areas)
    return found[0], np.moveaxis(found[1:].reshape(count, 3, -1), 2, 0)


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
    points, quads, program = floats(points), ints(quads), raw_program(metric)
    gradient, rows = np.zeros((len(points), 2)), rows_for(program, float(_areas(areas, [program], points, quads)[0]))
    kernels.differences(program, rows, points, quads, floats(normals), floats(tangents), step, gradient)
    return gradient


def _judged(
    programs: tuple[Program, Program],
    metrics: Sequence[Metric],
    points: Floats,
    elements: Ints,
    normals: Floats,
    areas: Floats | None,
    invalid: Floats,
) -> tuple[Floats, Bools]:
    """(E, M) values of elements of both kinds and (E,) their validity."""
    points, elements, normals = floats(points), ints(elements), floats(normals)
    values, valid = np.empty((len(metrics), len(elements))), np.empty(len(elements), dtype=bool)
    if any(len(program.outputs) <= len(metrics) for program in programs):  # some have no such value
        values[:] = np.nan
    judges = metrics, [metric.triangle_metric for metric in metrics]
    bounds = floats(invalid.reshape(2, len(metrics), 2))
    known, done = _areas(areas, programs, points, elements), 0
    for kind, program in enumerate(programs):
        if done < len(elements):
            factors = floats([metric.factor for metric in judges[kind]])
            rows = rows_for(program, float(known[kind]))
            done += kernels.judge(
                program, rows, kind == 1, points, elements, normals, factors, bounds[kind], values, valid
            )
    return values.T, valid


def _unjudged(
    program: Program, kind: int, factor: float, points: Floats, elements: Ints, normals: Floats, areas: Floats | None
) -> Floats:
    """(M, E) what a program gives of elements of one kind, times a factor."""
    points, elements, normals = floats(points), ints(elements), floats(normals)
    count = len(program.outputs) - 1
    values, valid = np.empty((count, len(elements))), np.empty(len(elements), dtype=bool)
    rows = rows_for(program, float(_areas(areas, [program], points, elements)[kind]))
    factors, bounds = floats(np.full(count, factor)), floats(np.full((count, 2), (-inf, inf)))
    kernels.judge(program, rows, kind == 1, points, elements, normals, factors, bounds, values, valid)
    return values


def _areas(areas: Floats | None, programs: Sequence[Program], points: Floats, elements: Ints) -> Floats:
    """What sizes are relative to; zeros where no size is asked for."""
    if areas is not None:
        return floats(areas)
    return mean_areas(points, elements) if any(program.inputs[1] >= 0 for program in programs) else _NO_AREAS
