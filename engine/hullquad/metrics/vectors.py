"""Vectors in space as triples of floats, for compiled code."""

from math import sqrt

from hullquad.arrays import Floats
from hullquad.metrics.compiled import compiled

Vector = tuple[float, float, float]


@compiled
def vector(points: Floats, row: int) -> Vector:
    """Row of an (N, 3) array."""
    return points[row, 0], points[row, 1], points[row, 2]


@compiled
def difference(a: Vector, b: Vector) -> Vector:
    """From b to a."""
    return a[0] - b[0], a[1] - b[1], a[2] - b[2]


@compiled
def moved(a: Vector, length: float, along: Vector) -> Vector:
    """The point `length` times `along` away from a."""
    return a[0] + length * along[0], a[1] + length * along[1], a[2] + length * along[2]


@compiled
def dot(a: Vector, b: Vector) -> float:
    """Scalar product."""
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]


@compiled
def cross(a: Vector, b: Vector) -> Vector:
    """Vector product."""
    return a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]


@compiled
def square(a: Vector) -> float:
    """Squared length."""
    return a[0] * a[0] + a[1] * a[1] + a[2] * a[2]


@compiled
def length(a: Vector) -> float:
    """Length."""
    return sqrt(a[0] * a[0] + a[1] * a[1] + a[2] * a[2])


@compiled
def unit(a: Vector) -> Vector:
    """The vector over its length; the zero vector stays zero."""
    size = length(a)
    if size == 0.0:
        return 0.0, 0.0, 0.0
    return a[0] / size, a[1] / size, a[2] / size
