"""ANSYS's shape metrics on one quad, compiled: raw values of edges that were brought to size 1, angles in radians."""

from math import inf, pi

from hullquad.metrics.compiled import compiled
from hullquad.metrics.quad import (
    Vectors4,
    angle_between,
    area_vector,
    axes,
    interior_angles,
    jacobians,
    ratio,
)
from hullquad.metrics.vectors import Vector, dot, length, scaled, square

OF_DIFFERENT_SIGN = -100.0
"""Raw Jacobian ratio of a quad with both open and concave corners."""


@compiled
def aspect_ratio(sides: Vectors4) -> float:
    """Sides of the more stretched of the two rectangles through the mid-points of the edges.

    Of the four ratios of sides the largest is the longer axis over the shorter one's part across it.
    """
    x1, x2 = axes(sides)
    return ratio(max(square(x1), square(x2)), length(area_vector(sides)), inf)


@compiled
def jacobian_ratio(sides: Vectors4, normal: Vector) -> float:
    """Largest corner Jacobian over the least."""
    every = jacobians(sides, normal)
    least, largest = min(every), max(every)
    if least < 0.0 < largest:
        return OF_DIFFERENT_SIGN
    if largest <= 0.0:
        least, largest = -largest, -least
    return ratio(largest, least, inf)


@compiled
def warping_factor(sides: Vectors4) -> float:
    """Distance of the diagonals from each other over the square root of the projected area."""
    vector = area_vector(sides)
    doubled = length(vector) ** 0.5
    return ratio(2.0 * abs(dot(vector, sides[0])), doubled * doubled * doubled, inf)


@compiled
def parallel_deviation(sides: Vectors4) -> float:
    """Largest angle between two opposite edges [rad]."""
    e0, e1, e2, e3 = sides
    return max(angle_between(e0, scaled(-1.0, e2)), angle_between(e1, scaled(-1.0, e3)))


@compiled
def skewness(sides: Vectors4, normal: Vector) -> float:
    """Largest deviation of an interior angle from the right angle, over the right angle."""
    every = interior_angles(sides, normal)
    return max(max(every) / (0.5 * pi) - 1.0, 1.0 - min(every) / (0.5 * pi))
