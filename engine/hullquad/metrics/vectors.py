"""Vectors in space as triples of floats, for compiled code."""

from math import sqrt

import numpy as np

from hullquad.arrays import Floats
from hullquad.metrics.compiled import inlined

Vector = tuple[float, float, float]


@inlined
def vector(points: Floats, row: int | np.uint64) -> Vector:
    """Row of an (N, 3) array."""
    return points[row, 0], points[row, 1], points[row, 2]


@inlined
def difference(a: Vector, b: Vector) -> Vector:
    """From b to a."""
    return a[0] - b[0], a[1] - b[1], a[2] - b[2]


@inlined
def moved(a: Vector, length: float, along: Vector) -> Vector:
    """The point `length` times `along` away from a."""
    return a[0] + length * along[0], a[1] + length * along[1], a[2] + length * along[2]


@inlined
def dot(a: Vector, b: Vector) -> float:
    """Scalar product."""
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]


@inlined
def cross(a: Vector, b: Vector) -> Vector:
    """Vector product."""
    return a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]


@inlined
def square(a: Vector) -> float:
    """Squared length."""
    return a[0] * a[0] + a[1] * a[1] + a[2] * a[2]


@inlined
def length(a: Vector) -> float:
    """Length."""
    return sqrt(a[0] * a[0] + a[1] * a[1] + a[2] * a[2])


@inlined
def unit(a: Vector) -> Vector:
    """The vector over its length; the zero vector stays zero."""
    size = length(a)
    if size == 0.0:
        return 0.0, 0.0, 0.0
    return a[0] / size, a[1] / size, a[2] / size


@inlined
def total(a: Vector, b: Vector) -> Vector:
    """Sum of two vectors."""
    return a[0] + b[0], a[1] + b[1], a[2] + b[2]


@inlined
def scaled(factor: float, a: Vector) -> Vector:
    """A multiple of a vector."""
    return factor * a[0], factor * a[1], factor * a[2]
