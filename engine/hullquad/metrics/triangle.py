"""Formulas on one triangle a, b, c, compiled; angles in radians."""

from math import atan2, inf, pi, sqrt

from hullquad.metrics.compiled import compiled
from hullquad.metrics.quad import FLAT
from hullquad.metrics.vectors import Vector, cross, difference, dot, length, square


@compiled
def doubled_area(a: Vector, b: Vector, c: Vector, normal: Vector) -> float:
    """Twice the area; negative where the triangle runs against `normal`."""
    product = cross(difference(b, a), difference(c, a))
    return -length(product) if dot(product, normal) < 0.0 else length(product)


@compiled
def _squares(a: Vector, b: Vector, c: Vector) -> tuple[float, float, float]:
    return square(difference(b, a)), square(difference(c, b)), square(difference(a, c))


@compiled
def is_valid(a: Vector, b: Vector, c: Vector, normal: Vector) -> bool:
    """Whether the triangle has an area and does not run against `normal`."""
    return doubled_area(a, b, c, normal) > FLAT * max(_squares(a, b, c))


@compiled
def aspect_ratio(a: Vector, b: Vector, c: Vector) -> float:
    """Longest edge over shortest; inf where an edge is a point."""
    lengths = _squares(a, b, c)
    return sqrt(max(lengths) / min(lengths)) if min(lengths) > 0.0 else inf


@compiled
def scaled_jacobian(a: Vector, b: Vector, c: Vector, normal: Vector) -> float:
    """2/sqrt(3) times twice the area over the largest product of two edges."""
    l0, l1, l2 = _squares(a, b, c)
    largest = sqrt(max(l0 * l1, l1 * l2, l2 * l0))
    return 2.0 / sqrt(3.0) * doubled_area(a, b, c, normal) / largest if largest > 0.0 else 0.0


@compiled
def shape(a: Vector, b: Vector, c: Vector, normal: Vector) -> float:
    """4 sqrt(3) times the area over the sum of the squared edges; 0 where that is negative."""
    l0, l1, l2 = _squares(a, b, c)
    total = l0 + l1 + l2
    return max(0.0, 2.0 * sqrt(3.0) * doubled_area(a, b, c, normal) / total) if total > 0.0 else 0.0


@compiled
def _angles(a: Vector, b: Vector, c: Vector) -> tuple[float, float, float]:
    e0, e1, e2 = difference(b, a), difference(c, b), difference(a, c)
    area = length(cross(e0, e1))
    return atan2(area, -dot(e2, e0)), atan2(area, -dot(e0, e1)), atan2(area, -dot(e1, e2))


@compiled
def min_angle(a: Vector, b: Vector, c: Vector) -> float:
    """Smallest angle [rad]."""
    return min(_angles(a, b, c))


@compiled
def max_angle(a: Vector, b: Vector, c: Vector, normal: Vector) -> float:
    """Largest angle; seen from the other side where the triangle runs against `normal` [rad]."""
    if doubled_area(a, b, c, normal) < 0.0:
        return 2.0 * pi - min_angle(a, b, c)
    return max(_angles(a, b, c))
