"""Loops over all elements, compiled; the metric is chosen by its row in the table.

`normals` is the direction that elements must face: (1, 3) for a plane, (E, 3) one for each element, or a zero
row where an element's own sense is all that is known. `areas` is (2,): what sizes of quads and of triangles are
relative to. Angles are in radians.
"""

from math import inf, nan, pi, sqrt

import numpy as np

from hullquad.arrays import Bools, Floats, Ints
from hullquad.metrics import METRICS, ansys, quad, solvers, table_1, triangle
from hullquad.metrics.compiled import compiled
from hullquad.metrics.quad import Vectors4
from hullquad.metrics.triangle import Vectors3
from hullquad.metrics.vectors import Vector, cross, difference, length, moved, vector

(
    STRETCH, ASPECT_RATIO, SCALED_JACOBIAN, SHAPE, SKEW, MIN_ANGLE, MAX_ANGLE, TAPER, WARPAGE, CONDITION, SHEAR,
    RELATIVE_SIZE, SHEAR_AND_SIZE, SHAPE_AND_SIZE, DISTORTION,
    ANSYS_ASPECT_RATIO, ANSYS_JACOBIAN_RATIO, ANSYS_WARPING_FACTOR, ANSYS_PARALLEL_DEVIATION, ANSYS_MAX_CORNER_ANGLE,
    ANSYS_SKEWNESS,
    NASTRAN_SKEW, NASTRAN_TAPER, NASTRAN_WARP, WARP_ANGLE, OPTISTRUCT_SKEW, PATRAN_ASPECT_RATIO, VERDICT_ASPECT_RATIO,
    CUBIT_ASPECT_RATIO, LONGEST_EDGE, CORNER_ANGLE, ABAQUS_SHAPE_FACTOR,
) = range(len(METRICS))  # fmt: skip

BY_NO_CORNER = (SHAPE, CONDITION, SHEAR, DISTORTION, NASTRAN_TAPER)
"""Metrics of corners whose form for triangles is not one."""


@compiled
def quad_raw(  # noqa: PLR0912  a table that compiled code can read
    metric: int, sides: Vectors4, size: float, normal: Vector, area: float
) -> float:
    """The metric's formula as it stands, of edges over `size`."""
    if metric == STRETCH:
        return table_1.stretch(sides)
    if metric == ASPECT_RATIO:
        return table_1.aspect_ratio(sides)
    if metric == SCALED_JACOBIAN:
        return table_1.scaled_jacobian(sides, normal)
    if metric == SHAPE:
        return table_1.shape(sides, normal)
    if metric == SKEW:
        return table_1.skew(sides, normal)
    if metric == MIN_ANGLE:
        return table_1.min_angle(sides)
    if metric in {MAX_ANGLE, ANSYS_MAX_CORNER_ANGLE}:
        return table_1.max_angle(sides, normal)
    if metric == TAPER:
        return table_1.taper(sides)
    if metric == WARPAGE:
        return table_1.warpage(sides)
    if metric == CONDITION:
        return table_1.condition(sides, normal)
    if metric == SHEAR:
        return max(0.0, table_1.scaled_jacobian(sides, normal))
    if metric == RELATIVE_SIZE:
        return table_1.relative_size(sides, size, area)
    if metric == SHEAR_AND_SIZE:
        return max(0.0, table_1.scaled_jacobian(sides, normal)) * table_1.relative_size(sides, size, area)
    if metric == SHAPE_AND_SIZE:
        return table_1.shape(sides, normal) * table_1.relative_size(sides, size, area)
    if metric == DISTORTION:
        return table_1.distortion(sides, normal)
    if metric in {ANSYS_ASPECT_RATIO, PATRAN_ASPECT_RATIO}:
        return ansys.aspect_ratio(sides)
    if metric == ANSYS_JACOBIAN_RATIO:
        return ansys.jacobian_ratio(sides, normal)
    if metric == ANSYS_WARPING_FACTOR:
        return ansys.warping_factor(sides)
    if metric == ANSYS_PARALLEL_DEVIATION:
        return ansys.parallel_deviation(sides)
    if metric == ANSYS_SKEWNESS:
        return ansys.skewness(sides, normal)
    if metric == NASTRAN_SKEW:
        return solvers.axes_angle(sides)
    if metric == NASTRAN_TAPER:
        return 1.0 - table_1.distortion(sides, normal)
    if metric == NASTRAN_WARP:
        return solvers.nastran_warp(sides)
    if metric == WARP_ANGLE:
        return solvers.warp_angle(sides)
    if metric == OPTISTRUCT_SKEW:
        return 0.5 * pi - solvers.axes_angle(sides)
    if metric == VERDICT_ASPECT_RATIO:
        return solvers.verdict_aspect_ratio(sides)
    if metric == CUBIT_ASPECT_RATIO:
        return solvers.cubit_aspect_ratio(sides)
    if metric == LONGEST_EDGE:
        return solvers.longest_edge(sides, size)
    if metric == CORNER_ANGLE:
        return solvers.corner_angle(sides, normal)
    if metric == ABAQUS_SHAPE_FACTOR:
        return 1.0
    return nan  # no row of the table is without its formula: a test sees to it


@compiled
def triangle_raw(  # noqa: PLR0912  a table that compiled code can read
    metric: int, sides: Vectors3, size: float, normal: Vector, area: float
) -> float:
    """The metric's formula for triangles, shape where it has none, of edges over `size`."""
    if metric == ASPECT_RATIO:
        return triangle.aspect_ratio(sides)
    if metric == SCALED_JACOBIAN:
        return triangle.scaled_jacobian(sides, normal)
    if metric in {MIN_ANGLE, NASTRAN_SKEW}:
        return triangle.min_angle(sides)
    if metric in {MAX_ANGLE, ANSYS_MAX_CORNER_ANGLE}:
        return triangle.max_angle(sides, normal)
    if metric == CONDITION:
        return quad.ratio(1.0, triangle.shape(sides, normal), inf)
    if metric == RELATIVE_SIZE:
        return triangle.relative_size(sides, size, area)
    if metric == SHAPE_AND_SIZE:
        return triangle.shape(sides, normal) * triangle.relative_size(sides, size, area)
    if metric == ANSYS_ASPECT_RATIO:
        return triangle.ansys_aspect_ratio(sides)
    if metric == ANSYS_SKEWNESS:
        return triangle.skewness(sides, normal)
    if metric == OPTISTRUCT_SKEW:
        return triangle.optistruct_skew(sides)
    if metric == PATRAN_ASPECT_RATIO:
        return triangle.patran_aspect_ratio(sides)
    if metric == VERDICT_ASPECT_RATIO:
        return triangle.verdict_aspect_ratio(sides)
    if metric == LONGEST_EDGE:
        return triangle.longest_edge(sides, size)
    if metric == CORNER_ANGLE:
        return triangle.corner_angle(sides, normal)
    if metric == ABAQUS_SHAPE_FACTOR:
        return triangle.abaqus_shape_factor(sides, normal)
    return triangle.shape(sides, normal)


@compiled
def kept(raw: float, least: float, most: float) -> float:
    """The value between two bounds; the upper one where it is undefined."""
    below = raw if raw < most else most
    return below if below > least else least


@compiled
def judge(
    metrics: Ints, points: Floats, elements: Ints, normals: Floats, areas: Floats, invalid: Floats,
    values: Floats, valid: Bools,
) -> None:  # fmt: skip
    """Judged values (E, M) and validity (E,) of every element by some metrics.

    `invalid` is (2, M, 2): between what the value of an invalid quad, and triangle, is kept.
    """
    each = len(normals) > 1
    for i in range(len(elements)):
        normal = vector(normals, i if each else 0)
        a, b, c = vector(points, elements[i, 0]), vector(points, elements[i, 1]), vector(points, elements[i, 2])
        if elements[i, 3] < 0:
            three = triangle.edges(a, b, c)
            size = triangle.size(three)
            three = triangle.resized(three, size)
            valid[i] = triangle.is_open(three, normal)
            for k in range(len(metrics)):
                values[i, k] = triangle_raw(metrics[k], three, size, normal, areas[1])
        else:
            four = quad.edges(a, b, c, vector(points, elements[i, 3]))
            size = quad.size(four)
            four = quad.resized(four, size)
            valid[i] = quad.is_open(four, normal)
            for k in range(len(metrics)):
                values[i, k] = quad_raw(metrics[k], four, size, normal, areas[0])
        if not valid[i]:
            kind = 1 if elements[i, 3] < 0 else 0
            for k in range(len(metrics)):
                values[i, k] = kept(values[i, k], invalid[kind, k, 0], invalid[kind, k, 1])


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
def raw(metric: int, a: Vector, b: Vector, c: Vector, d: Vector, normal: Vector, area: float) -> float:
    """The metric's formula as it stands on a quad."""
    sides = quad.edges(a, b, c, d)
    size = quad.size(sides)
    return quad_raw(metric, quad.resized(sides, size), size, normal, area)


@compiled
def raw_values(metric: int, points: Floats, quads: Ints, normals: Floats, areas: Floats, values: Floats) -> None:
    """The formula as it stands on every quad, into `values`."""
    each = len(normals) > 1
    for i in range(len(quads)):
        a, b = vector(points, quads[i, 0]), vector(points, quads[i, 1])
        c, d = vector(points, quads[i, 2]), vector(points, quads[i, 3])
        values[i] = raw(metric, a, b, c, d, vector(normals, i if each else 0), areas[0])


@compiled
def corner_values(metric: int, points: Floats, elements: Ints, normals: Floats, values: Floats) -> None:
    """What each corner has by itself (E, 4), for metrics that are the worst of their corners; else nan."""
    each = len(normals) > 1
    for i in range(len(elements)):
        normal = vector(normals, i if each else 0)
        a, b, c = vector(points, elements[i, 0]), vector(points, elements[i, 1]), vector(points, elements[i, 2])
        if elements[i, 3] < 0:
            three = triangle.edges(a, b, c)
            v0, v1, v2 = _triangle_corners(metric, triangle.resized(three, triangle.size(three)), normal)
            v3 = nan
        else:
            four = quad.edges(a, b, c, vector(points, elements[i, 3]))
            v0, v1, v2, v3 = _quad_corners(metric, quad.resized(four, quad.size(four)), normal)
        values[i, 0], values[i, 1], values[i, 2], values[i, 3] = v0, v1, v2, v3


@compiled
def _quad_corners(metric: int, sides: Vectors4, normal: Vector) -> quad.Numbers4:
    j = quad.jacobians(sides, normal)
    s = quad.squares(sides)
    t = quad.interior_angles(sides, normal)
    mean = 0.25 * length(quad.area_vector(sides))
    return (
        _corner(metric, j[0], s[3], s[0], t[0], mean),
        _corner(metric, j[1], s[0], s[1], t[1], mean),
        _corner(metric, j[2], s[1], s[2], t[2], mean),
        _corner(metric, j[3], s[2], s[3], t[3], mean),
    )


@compiled
def _corner(metric: int, jacobian: float, square_in: float, square_out: float, angle: float, area: float) -> float:
    if metric == SCALED_JACOBIAN:
        return quad.ratio(jacobian, sqrt(square_in * square_out), 0.0)
    if metric == SHEAR:
        return max(0.0, quad.ratio(jacobian, sqrt(square_in * square_out), 0.0))
    if metric == SHAPE:
        return max(0.0, quad.ratio(2.0 * jacobian, square_in + square_out, 0.0))
    if metric == CONDITION:
        return quad.ratio(square_in + square_out, 2.0 * jacobian, inf)
    if metric == DISTORTION:
        return quad.ratio(jacobian, area, 0.0)
    if metric == NASTRAN_TAPER:
        return abs(quad.ratio(jacobian, area, 0.0) - 1.0)
    if metric == ANSYS_SKEWNESS:
        return abs(angle / (0.5 * pi) - 1.0)
    return angle


@compiled
def _triangle_corners(metric: int, sides: Vectors3, normal: Vector) -> triangle.Numbers3:
    l0, l1, l2 = triangle.squares(sides)
    doubled = triangle.doubled_area(sides, normal)
    t0, t1, t2 = triangle.angles(sides)
    if metric == SCALED_JACOBIAN:
        doubled *= 2.0 / sqrt(3.0)
        return (
            quad.ratio(doubled, sqrt(l2 * l0), 0.0),
            quad.ratio(doubled, sqrt(l0 * l1), 0.0),
            quad.ratio(doubled, sqrt(l1 * l2), 0.0),
        )
    if metric in BY_NO_CORNER:
        return nan, nan, nan
    if doubled < 0.0:
        t0, t1, t2 = 2.0 * pi - t0, 2.0 * pi - t1, 2.0 * pi - t2
    if metric == ANSYS_SKEWNESS:
        return _deviation(t0), _deviation(t1), _deviation(t2)
    return t0, t1, t2


@compiled
def _deviation(angle: float) -> float:
    ideal = triangle.IDEAL_ANGLE
    return max((angle - ideal) / (pi - ideal), (ideal - angle) / ideal)


@compiled
def areas(points: Floats, elements: Ints, means: Floats) -> None:
    """Mean areas of the quads and of the triangles, into `means` (2,); 0 where there are none."""
    sums, counts = np.zeros(2), np.zeros(2)
    for i in range(len(elements)):
        a, b, c = vector(points, elements[i, 0]), vector(points, elements[i, 1]), vector(points, elements[i, 2])
        if elements[i, 3] < 0:
            kind, area = 1, 0.5 * length(cross(difference(b, a), difference(c, a)))
        else:
            kind, area = 0, 0.25 * length(quad.area_vector(quad.edges(a, b, c, vector(points, elements[i, 3]))))
        if area < inf:
            sums[kind] += area
            counts[kind] += 1.0
    for kind in range(2):
        means[kind] = sums[kind] / counts[kind] if counts[kind] > 0.0 else 0.0


@compiled
def difference_gradient(
    metric: int, points: Floats, quads: Ints, normals: Floats, areas: Floats, tangents: Floats, step: float,
    gradient: Floats,
) -> None:  # fmt: skip
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
                ahead = raw(
                    metric, moved(a, s, t), moved(b, t_b, t), moved(c, t_c, t), moved(d, t_d, t), normal, areas[0]
                )
                back = raw(
                    metric, moved(a, -s, t), moved(b, -t_b, t), moved(c, -t_c, t), moved(d, -t_d, t), normal, areas[0]
                )
                gradient[node, direction] += (ahead - back) / (2.0 * step)
