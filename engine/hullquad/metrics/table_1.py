"""Kniat's Table 1 on one quad, compiled: raw values of edges that were brought to size 1, angles in radians."""

from math import inf, sqrt

from hullquad.metrics.compiled import compiled
from hullquad.metrics.quad import (
    Vectors4,
    angles,
    area_vector,
    axes,
    corner_normals,
    diagonals,
    interior_angles,
    is_open,
    jacobians,
    ratio,
    root_ratio,
    squares,
)
from hullquad.metrics.vectors import Vector, dot, length, square, total


@compiled
def stretch(sides: Vectors4) -> float:
    """sqrt(2) times the shortest edge over the longest diagonal; 0 where both diagonals are points."""
    d0, d1 = diagonals(sides)
    return root_ratio(2.0 * min(squares(sides)), max(square(d0), square(d1)), 0.0)


@compiled
def aspect_ratio(sides: Vectors4) -> float:
    """Longest edge over shortest; inf where an edge is a point."""
    return root_ratio(max(squares(sides)), min(squares(sides)), inf)


@compiled
def scaled_jacobian(sides: Vectors4, normal: Vector) -> float:
    """Least corner Jacobian over the lengths of the edges there; 0 at an edge that is a point."""
    j0, j1, j2, j3 = jacobians(sides, normal)
    l0, l1, l2, l3 = squares(sides)
    return min(
        ratio(j0, sqrt(l3 * l0), 0.0),
        ratio(j1, sqrt(l0 * l1), 0.0),
        ratio(j2, sqrt(l1 * l2), 0.0),
        ratio(j3, sqrt(l2 * l3), 0.0),
    )


@compiled
def shape(sides: Vectors4, normal: Vector) -> float:
    """Least of twice a corner's Jacobian over the squares of the edges there; 0 where that is negative."""
    j0, j1, j2, j3 = jacobians(sides, normal)
    l0, l1, l2, l3 = squares(sides)
    least = min(
        ratio(2.0 * j0, l3 + l0, 0.0),
        ratio(2.0 * j1, l0 + l1, 0.0),
        ratio(2.0 * j2, l1 + l2, 0.0),
        ratio(2.0 * j3, l2 + l3, 0.0),
    )
    return max(0.0, least)


@compiled
def condition(sides: Vectors4, normal: Vector) -> float:
    """Inverse of shape; inf where that is 0."""
    return ratio(1.0, shape(sides, normal), inf)


@compiled
def skew(sides: Vectors4, normal: Vector) -> float:
    """4 over the sum of 1 / sin(angle) of the corners; 0 for an invalid quad."""
    if not is_open(sides, normal):
        return 0.0
    n0, n1, n2, n3 = corner_normals(sides)
    l0, l1, l2, l3 = length(sides[0]), length(sides[1]), length(sides[2]), length(sides[3])
    return 4.0 / (l3 * l0 / length(n0) + l0 * l1 / length(n1) + l1 * l2 / length(n2) + l2 * l3 / length(n3))


@compiled
def min_angle(sides: Vectors4) -> float:
    """Smallest interior angle [rad]."""
    return min(angles(sides))


@compiled
def max_angle(sides: Vectors4, normal: Vector) -> float:
    """Largest interior angle; above pi at a concave corner [rad]."""
    return max(interior_angles(sides, normal))


@compiled
def taper(sides: Vectors4) -> float:
    """Cross term over the shorter principal axis; inf where that is a point."""
    x1, x2 = axes(sides)
    return root_ratio(square(total(sides[0], sides[2])), min(square(x1), square(x2)), inf)


@compiled
def warpage(sides: Vectors4) -> float:
    """Cosine of the larger fold along a diagonal; 0 where a triangle beside it has no area."""
    n0, n1, n2, n3 = corner_normals(sides)
    along_bd = dot(n0, n2)
    along_ac = dot(n1, n3)
    flat_bd, flat_ac = length(n0) * length(n2), length(n1) * length(n3)
    return min(ratio(along_bd, flat_bd, 0.0), ratio(along_ac, flat_ac, 0.0))


@compiled
def relative_size(sides: Vectors4, size: float, area: float) -> float:
    """Area over `area`, or its inverse: the lesser."""
    share = 0.25 * length(area_vector(sides)) * (size * size / area)
    return min(share, ratio(1.0, share, 0.0))


@compiled
def distortion(sides: Vectors4, normal: Vector) -> float:
    """Least corner Jacobian over the projected area; 0 where that is 0."""
    return ratio(4.0 * min(jacobians(sides, normal)), length(area_vector(sides)), 0.0)
