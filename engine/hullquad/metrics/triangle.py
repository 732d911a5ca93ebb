"""Formulas on one triangle, compiled: raw values of edges that were brought to size 1, angles in radians.

Edges e0 = b - a, e1 = c - b, e2 = a - c; corner 0 at a, between e2 and e0.
"""

from math import atan2, inf, pi, sqrt

from hullquad.metrics.compiled import compiled
from hullquad.metrics.quad import FLAT, ratio, root_ratio
from hullquad.metrics.solvers import farthest
from hullquad.metrics.vectors import Vector, cross, difference, dot, length, scaled, square

Numbers3 = tuple[float, float, float]
Vectors3 = tuple[Vector, Vector, Vector]

IDEAL_ANGLE = pi / 3.0


@compiled
def edges(a: Vector, b: Vector, c: Vector) -> Vectors3:
    """The three edges, each from a node to the next."""
    return difference(b, a), difference(c, b), difference(a, c)


@compiled
def size(sides: Vectors3) -> float:
    """Largest component of the edges."""
    largest = 0.0
    for x, y, z in sides:
        largest = max(largest, abs(x), abs(y), abs(z))
    return largest


@compiled
def resized(sides: Vectors3, size: float) -> Vectors3:
    """The edges over `size`, so that no product of them is too small or too large for a float."""
    factor = 1.0 / size if size > 0.0 else 0.0
    return scaled(factor, sides[0]), scaled(factor, sides[1]), scaled(factor, sides[2])


@compiled
def squares(sides: Vectors3) -> Numbers3:
    """Squared lengths of the edges."""
    return square(sides[0]), square(sides[1]), square(sides[2])


@compiled
def doubled_area(sides: Vectors3, normal: Vector) -> float:
    """Twice the area; negative where the triangle runs against `normal`."""
    product = cross(sides[0], sides[1])
    return -length(product) if dot(product, normal) < 0.0 else length(product)


@compiled
def is_open(sides: Vectors3, normal: Vector) -> bool:
    """Whether the triangle has an area and does not run against `normal`."""
    return doubled_area(sides, normal) > FLAT * max(squares(sides))


@compiled
def is_valid(a: Vector, b: Vector, c: Vector, normal: Vector) -> bool:
    """Whether the triangle has an area and does not run against `normal`."""
    sides = edges(a, b, c)
    return is_open(resized(sides, size(sides)), normal)


@compiled
def angles(sides: Vectors3) -> Numbers3:
    """Interior angles [rad]."""
    e0, e1, e2 = sides
    area = length(cross(e0, e1))
    return atan2(area, -dot(e2, e0)), atan2(area, -dot(e0, e1)), atan2(area, -dot(e1, e2))


@compiled
def aspect_ratio(sides: Vectors3) -> float:
    """Longest edge over shortest; inf where an edge is a point."""
    return root_ratio(max(squares(sides)), min(squares(sides)), inf)


@compiled
def scaled_jacobian(sides: Vectors3, normal: Vector) -> float:
    """2/sqrt(3) times twice the area over the largest product of two edges."""
    l0, l1, l2 = squares(sides)
    return ratio(2.0 / sqrt(3.0) * doubled_area(sides, normal), sqrt(max(l0 * l1, l1 * l2, l2 * l0)), 0.0)


@compiled
def shape(sides: Vectors3, normal: Vector) -> float:
    """4 sqrt(3) times the area over the sum of the squared edges; 0 where that is negative."""
    l0, l1, l2 = squares(sides)
    return max(0.0, ratio(2.0 * sqrt(3.0) * doubled_area(sides, normal), l0 + l1 + l2, 0.0))


@compiled
def min_angle(sides: Vectors3) -> float:
    """Smallest angle [rad]."""
    return min(angles(sides))


@compiled
def max_angle(sides: Vectors3, normal: Vector) -> float:
    """Largest angle; seen from the other side where the triangle runs against `normal` [rad]."""
    if doubled_area(sides, normal) < 0.0:
        return 2.0 * pi - min_angle(sides)
    return max(angles(sides))


@compiled
def relative_size(sides: Vectors3, size: float, area: float) -> float:
    """Area over `area`, or its inverse: the lesser."""
    share = 0.5 * length(cross(sides[0], sides[1])) * (size * size / area)
    return min(share, ratio(1.0, share, 0.0))


@compiled
def ansys_aspect_ratio(sides: Vectors3) -> float:
    """Sides of the most stretched rectangle on a median or on the mid-line across it, over sqrt(3)."""
    l0, l1, l2 = squares(sides)
    median = 0.5 * (l0 + l1 + l2) - 0.75 * min(l0, l1, l2)
    longest = max(median, 0.25 * max(l0, l1, l2))
    return ratio(2.0 / sqrt(3.0) * longest, length(cross(sides[0], sides[1])), inf)


@compiled
def skewness(sides: Vectors3, normal: Vector) -> float:
    """Largest deviation of an angle from 60 degrees over the greatest possible one."""
    largest, least = max_angle(sides, normal), min_angle(sides)
    return max((largest - IDEAL_ANGLE) / (pi - IDEAL_ANGLE), (IDEAL_ANGLE - least) / IDEAL_ANGLE)


@compiled
def optistruct_skew(sides: Vectors3) -> float:
    """Right angle less the least angle between a median and the mid-line across it [rad]."""
    e0, e1, e2 = sides
    doubled = 2.0 * length(cross(e0, e1))
    least = min(
        atan2(doubled, abs(dot(difference(e2, e1), e0))),
        atan2(doubled, abs(dot(difference(e0, e2), e1))),
        atan2(doubled, abs(dot(difference(e1, e0), e2))),
    )
    return 0.5 * pi - least


@compiled
def patran_aspect_ratio(sides: Vectors3) -> float:
    """Largest of sqrt(3)/2 times a side over the height on it."""
    return ratio(0.5 * sqrt(3.0) * max(squares(sides)), length(cross(sides[0], sides[1])), inf)


@compiled
def verdict_aspect_ratio(sides: Vectors3) -> float:
    """Longest edge times the sum of the edges over 4 sqrt(3) times the area."""
    l0, l1, l2 = squares(sides)
    around = sqrt(l0) + sqrt(l1) + sqrt(l2)
    return ratio(sqrt(max(l0, l1, l2)) * around, 2.0 * sqrt(3.0) * length(cross(sides[0], sides[1])), inf)


@compiled
def longest_edge(sides: Vectors3, size: float) -> float:
    """Length of the longest edge [as the points]."""
    return sqrt(max(squares(sides))) * size


@compiled
def corner_angle(sides: Vectors3, normal: Vector) -> float:
    """Angle that is farthest from 60 degrees [rad]."""
    return farthest(min_angle(sides), max_angle(sides, normal), IDEAL_ANGLE)


@compiled
def abaqus_shape_factor(sides: Vectors3, normal: Vector) -> float:
    """Area over that of the equilateral triangle with the same circumscribed circle; 0 where that is negative."""
    l0, l1, l2 = squares(sides)
    doubled = max(0.0, doubled_area(sides, normal))
    return ratio(8.0 / (3.0 * sqrt(3.0)) * doubled * doubled * doubled, l0 * l1 * l2, 0.0)
