"""Loops over all elements, compiled; the metric is chosen by its row in the table.

`normals` is the direction that elements must face: (1, 3) for a plane, (E, 3) one for each element, or a zero
row where an element's own sense is all that is known.
"""

from math import inf, nan, pi

from hullquad.arrays import Bools, Floats, Ints
from hullquad.metrics import METRICS, quad, triangle
from hullquad.metrics.compiled import compiled
from hullquad.metrics.vectors import Vector, moved, vector

_ROW = {metric.key: row for row, metric in enumerate(METRICS)}
STRETCH = _ROW["stretch"]
ASPECT_RATIO = _ROW["aspect_ratio"]
SCALED_JACOBIAN = _ROW["scaled_jacobian"]
SHAPE = _ROW["shape"]
SKEW = _ROW["skew"]
MIN_ANGLE = _ROW["min_angle"]
MAX_ANGLE = _ROW["max_angle"]
BY_SHAPE = tuple(row for row, metric in enumerate(METRICS) if metric.triangles is None)
"""Metrics without a form for triangles."""


@compiled
def quad_raw(metric: int, a: Vector, b: Vector, c: Vector, d: Vector, normal: Vector) -> float:
    """The metric's formula as it stands; angles in radians."""
    if metric == STRETCH:
        return quad.stretch(a, b, c, d)
    if metric == ASPECT_RATIO:
        return quad.aspect_ratio(a, b, c, d)
    if metric == SCALED_JACOBIAN:
        return quad.scaled_jacobian(a, b, c, d, normal)
    if metric == SHAPE:
        return quad.shape(a, b, c, d, normal)
    if metric == SKEW:
        return quad.skew(a, b, c, d, normal)
    if metric == MIN_ANGLE:
        return quad.min_angle(a, b, c, d)
    if metric == MAX_ANGLE:
        return quad.max_angle(a, b, c, d, normal)
    return nan  # no row of the table is without its formula: a test sees to it


@compiled
def triangle_raw(metric: int, a: Vector, b: Vector, c: Vector, normal: Vector) -> float:
    """The metric's formula for triangles, shape where it has none; angles in radians."""
    if metric == ASPECT_RATIO:
        return triangle.aspect_ratio(a, b, c)
    if metric == SCALED_JACOBIAN:
        return triangle.scaled_jacobian(a, b, c, normal)
    if metric == MIN_ANGLE:
        return triangle.min_angle(a, b, c)
    if metric == MAX_ANGLE:
        return triangle.max_angle(a, b, c, normal)
    return triangle.shape(a, b, c, normal)


@compiled
def invalid_value(metric: int, raw: float) -> float:
    """How an invalid element is judged: never better than the worst valid one."""
    if metric == SCALED_JACOBIAN:
        return min(raw, 0.0)
    if metric == MAX_ANGLE:
        return max(raw, pi)
    if metric == ASPECT_RATIO:
        return inf
    return 0.0


@compiled
def judge(metric: int, points: Floats, elements: Ints, normals: Floats, values: Floats, valid: Bools) -> None:
    """Judged value and validity of every element, quads and triangles, into `values` and `valid`."""
    each = len(normals) > 1
    for i in range(len(elements)):
        normal = vector(normals, i if each else 0)
        a, b, c = vector(points, elements[i, 0]), vector(points, elements[i, 1]), vector(points, elements[i, 2])
        if elements[i, 3] < 0:
            raw = triangle_raw(metric, a, b, c, normal)
            valid[i] = triangle.is_valid(a, b, c, normal)
            values[i] = raw if valid[i] else invalid_value(SHAPE if metric in BY_SHAPE else metric, raw)
        else:
            d = vector(points, elements[i, 3])
            raw = quad_raw(metric, a, b, c, d, normal)
            valid[i] = quad.is_valid(a, b, c, d, normal)
            values[i] = raw if valid[i] else invalid_value(metric, raw)


@compiled
def validity(points: Floats, elements: Ints, normals: Floats, valid: Bools) -> None:
    """Which elements are valid, into `valid`."""
    each = len(normals) > 1
    for i in range(len(elements)):
        normal = vector(normals, i if each else 0)
        a, b, c = vector(points, elements[i, 0]), vector(points, elements[i, 1]), vector(points, elements[i, 2])
        if elements[i, 3] < 0:
            valid[i] = triangle.is_valid(a, b, c, normal)
        else:
            valid[i] = quad.is_valid(a, b, c, vector(points, elements[i, 3]), normal)


@compiled
def raw_values(metric: int, points: Floats, quads: Ints, normals: Floats, values: Floats) -> None:
    """The formula as it stands on every quad, into `values`; angles in radians."""
    each = len(normals) > 1
    for i in range(len(quads)):
        a, b = vector(points, quads[i, 0]), vector(points, quads[i, 1])
        c, d = vector(points, quads[i, 2]), vector(points, quads[i, 3])
        values[i] = quad_raw(metric, a, b, c, d, vector(normals, i if each else 0))


@compiled
def difference_gradient(
    metric: int, points: Floats, quads: Ints, normals: Floats, tangents: Floats, step: float, gradient: Floats
) -> None:
    """Central differences of the sum of raw values by the nodes' parameters, added to `gradient` (N, 2).

    Every corner of every quad is moved by `step` either way along its two tangents (N, 2, 3): eight pairs of
    evaluations of the whole mesh, whatever the number of nodes.
    """
    each = len(normals) > 1
    for i in range(len(quads)):
        normal = vector(normals, i if each else 0)
        a, b = vector(points, quads[i, 0]), vector(points, quads[i, 1])
        c, d = vector(points, quads[i, 2]), vector(points, quads[i, 3])
        for corner in range(4):
            node = quads[i, corner]
            for direction in range(2):
                t = vector(tangents[node], direction)
                s = step if corner == 0 else 0.0
                t_b = step if corner == 1 else 0.0
                t_c = step if corner == 2 else 0.0
                t_d = step if corner == 3 else 0.0
                ahead = quad_raw(metric, moved(a, s, t), moved(b, t_b, t), moved(c, t_c, t), moved(d, t_d, t), normal)
                back = quad_raw(
                    metric, moved(a, -s, t), moved(b, -t_b, t), moved(c, -t_c, t), moved(d, -t_d, t), normal
                )
                gradient[node, direction] += (ahead - back) / (2.0 * step)
