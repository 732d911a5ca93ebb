"""Winslow's energy with a regularised determinant, compiled: finite on folded elements, it pulls them open.

Each corner of a quad, between edges u and v, has ``(|u|^2 + |v|^2) / (2 chi(J))`` with its Jacobian J (Eq. 1) and
``chi(J) = (J + sqrt(eps^2 + J^2)) / 2``; a triangle has the same for its map from the equilateral one. Lengths are
in units of the element size. Source: V. Garanzha, I. Kaporin, L. Kudryavtseva, F. Protais, N. Ray, D. Sokolov,
"Foldover-free maps in 50 lines of code", ACM Trans. Graphics 40:102 (2021), Eqs. (3) to (5).
"""

from math import sqrt

from hullquad.arrays import Floats, Ints
from hullquad.metrics.compiled import compiled
from hullquad.metrics.vectors import Vector, cross, difference, dot, square, vector

_SQUARE = 0.25
"""Weight of a corner of a quad: a square's energy is 1."""
_SIDE = 1.0 / sqrt(3.0)
_TRIANGLE = 0.5
"""Weight of a triangle: half a quad."""


@compiled
def chi(jacobian: float, epsilon: float) -> float:
    """The Jacobian made positive: itself where it is large, close to 0 where it is negative."""
    root = sqrt(epsilon * epsilon + jacobian * jacobian)
    return 0.5 * (jacobian + root) if jacobian > 0.0 else 0.5 * epsilon * epsilon / (root - jacobian)


@compiled
def winslow_energy(
    points: Floats, quads: Ints, triangles: Ints, normals: Floats, size: float, epsilon: float, gradient: Floats
) -> float:
    """Sum over all elements; its gradient by the points [per element size] is added to `gradient` (N, 3)."""
    each, total = len(normals) > 1, 0.0
    for i in range(len(quads)):
        normal = vector(normals, i if each else 0)
        for corner in range(4):
            a, b, d = quads[i, corner], quads[i, (corner + 1) & 3], quads[i, (corner + 3) & 3]
            total += _corner(points, a, b, d, normal, size, epsilon, gradient)
    for i in range(len(triangles)):
        normal = vector(normals, len(quads) + i if each else 0)
        total += _triangle(points, triangles[i, 0], triangles[i, 1], triangles[i, 2], normal, size, epsilon, gradient)
    return total


@compiled
def _corner(
    points: Floats, a: int, b: int, d: int, normal: Vector, size: float, epsilon: float, gradient: Floats
) -> float:
    """Energy of the corner at node a, between the edges to b and d."""
    u, v = _scaled(points, b, a, size), _scaled(points, d, a, size)
    jacobian, spread = dot(normal, cross(u, v)), 0.5 * (square(u) + square(v))
    chi_here = chi(jacobian, epsilon)
    energy = _SQUARE * spread / chi_here
    by_length = _SQUARE / chi_here
    by_jacobian = -energy / sqrt(epsilon * epsilon + jacobian * jacobian)
    _add_moves(gradient, a, b, d, u, v, normal, by_length, 0.0, by_jacobian, size)
    return energy


@compiled
def _triangle(
    points: Floats, a: int, b: int, d: int, normal: Vector, size: float, epsilon: float, gradient: Floats
) -> float:
    """Energy of the triangle a, b, d."""
    u, v = _scaled(points, b, a, size), _scaled(points, d, a, size)
    jacobian, spread = dot(normal, cross(u, v)), _SIDE * (square(u) + square(v) - dot(u, v))
    chi_here = chi(jacobian, epsilon)
    energy = _TRIANGLE * spread / chi_here
    by_length = _TRIANGLE * _SIDE / chi_here
    by_jacobian = -energy / sqrt(epsilon * epsilon + jacobian * jacobian)
    _add_moves(gradient, a, b, d, u, v, normal, 2.0 * by_length, -by_length, by_jacobian, size)
    return energy


@compiled
def _add_moves(
    gradient: Floats,
    a: int,
    b: int,
    d: int,
    u: Vector,
    v: Vector,
    normal: Vector,
    along: float,
    across: float,
    turning: float,
    size: float,
) -> None:
    """Add what an energy changes by when b and d move: `along` their own edge, `across` the other one, or turning."""
    by_b, by_d = cross(v, normal), cross(normal, u)
    for axis in range(3):
        at_b = (along * u[axis] + across * v[axis] + turning * by_b[axis]) / size
        at_d = (along * v[axis] + across * u[axis] + turning * by_d[axis]) / size
        gradient[b, axis] += at_b
        gradient[d, axis] += at_d
        gradient[a, axis] -= at_b + at_d


@compiled
def _scaled(points: Floats, to: int, start: int, size: float) -> Vector:
    step = difference(vector(points, to), vector(points, start))
    return step[0] / size, step[1] / size, step[2] / size


@compiled
def folding(points: Floats, quads: Ints, triangles: Ints, normals: Floats, size: float) -> tuple[int, float]:
    """Number of elements with a corner that is not open, and the least Jacobian of all corners [size squared]."""
    each, count, least = len(normals) > 1, 0, 1e300
    for i in range(len(quads)):
        normal, worst = vector(normals, i if each else 0), 1e300
        for corner in range(4):
            start, after, before = quads[i, corner], quads[i, (corner + 1) & 3], quads[i, (corner + 3) & 3]
            u, v = _scaled(points, after, start, size), _scaled(points, before, start, size)
            worst = min(worst, dot(normal, cross(u, v)))
        count += worst <= 0.0
        least = min(least, worst)
    for i in range(len(triangles)):
        normal = vector(normals, len(quads) + i if each else 0)
        u, v = (
            _scaled(points, triangles[i, 1], triangles[i, 0], size),
            _scaled(points, triangles[i, 2], triangles[i, 0], size),
        )
        worst = dot(normal, cross(u, v))
        count += worst <= 0.0
        least = min(least, worst)
    return count, least
