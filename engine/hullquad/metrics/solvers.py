"""Measures of solvers and class rules on one quad, compiled: of edges brought to size 1, angles in radians."""

from math import atan2, inf, pi, sqrt

from hullquad.metrics.compiled import compiled
from hullquad.metrics.quad import (
    Vectors4,
    angle_between,
    area_vector,
    axes,
    corner_normals,
    diagonals,
    interior_angles,
    ratio,
    root_ratio,
    squares,
)
from hullquad.metrics.vectors import Vector, cross, dot, length, square


@compiled
def axes_angle(sides: Vectors4) -> float:
    """Angle between the lines of mid-points of opposite edges, from 0 to pi / 2 [rad]."""
    x1, x2 = axes(sides)
    return atan2(length(cross(x1, x2)), abs(dot(x1, x2)))


@compiled
def nastran_warp(sides: Vectors4) -> float:
    """Distance of a node from the mean plane over the mean length of the diagonals."""
    d0, d1 = diagonals(sides)
    vector = area_vector(sides)
    return ratio(abs(dot(vector, sides[0])), length(vector) * (length(d0) + length(d1)), inf)


@compiled
def warp_angle(sides: Vectors4) -> float:
    """Larger angle between the two triangles that either diagonal makes [rad]."""
    n0, n1, n2, n3 = corner_normals(sides)
    return max(angle_between(n0, n2), angle_between(n1, n3))


@compiled
def verdict_aspect_ratio(sides: Vectors4) -> float:
    """Longest edge times the sum of the edges over four times the projected area."""
    l0, l1, l2, l3 = squares(sides)
    around = sqrt(l0) + sqrt(l1) + sqrt(l2) + sqrt(l3)
    return ratio(sqrt(max(l0, l1, l2, l3)) * around, length(area_vector(sides)), inf)


@compiled
def cubit_aspect_ratio(sides: Vectors4) -> float:
    """Longer principal axis over the shorter one."""
    x1, x2 = axes(sides)
    return root_ratio(max(square(x1), square(x2)), min(square(x1), square(x2)), inf)


@compiled
def longest_edge(sides: Vectors4, size: float) -> float:
    """Length of the longest edge [as the points]."""
    return sqrt(max(squares(sides))) * size


@compiled
def corner_angle(sides: Vectors4, normal: Vector) -> float:
    """Interior angle that is farthest from the right angle [rad]."""
    every = interior_angles(sides, normal)
    return farthest(min(every), max(every), 0.5 * pi)


@compiled
def farthest(least: float, largest: float, ideal: float) -> float:
    """The one of two values that is farther from the ideal one."""
    return largest if largest - ideal >= ideal - least else least
