"""The machine that works out programs, compiled: each step for a whole row of elements at once."""

from math import inf, pi, sqrt

import numpy as np

from hullquad.arrays import Floats, Ints
from hullquad.metrics.compiled import compiled, inlined
from hullquad.metrics.expression import Op
from hullquad.metrics.program import LANES
from hullquad.metrics.vectors import Vector, cross, difference, dot, length, scaled, square, total

FLAT = 1e-12
"""A corner's Jacobian over the square of the longest edge from which on a corner counts as open."""

_ADD, _SUBTRACT, _MULTIPLY, _MULTIPLY_ADD = map(int, (Op.ADD, Op.SUBTRACT, Op.MULTIPLY, Op.MULTIPLY_ADD))
_DIVIDE, _ROOT, _NEGATE, _ABSOLUTE = map(int, (Op.DIVIDE, Op.ROOT, Op.NEGATE, Op.ABSOLUTE))
_LEAST, _GREATEST, _CHOOSE, _ARC = map(int, (Op.LEAST, Op.GREATEST, Op.CHOOSE, Op.ARC))
_ADD_VECTORS, _SUBTRACT_VECTORS, _NEGATE_VECTOR = map(int, (Op.ADD_VECTORS, Op.SUBTRACT_VECTORS, Op.NEGATE_VECTOR))
_SCALE, _SCALE_ADD, _DOT, _CROSS = map(int, (Op.SCALE, Op.SCALE_ADD, Op.DOT, Op.CROSS))
_SQUARE, _LENGTH, _CROSS_ADD, _TIES = map(int, (Op.SQUARE, Op.LENGTH, Op.CROSS_ADD, Op.TIES))
_SHRUNK_EDGE = int(Op.SHRUNK_EDGE)
_SHRINKING_3, _SHRINKING_4 = int(Op.SHRINKING_3), int(Op.SHRINKING_4)
_OPENNESS_3, _OPENNESS_4 = int(Op.OPENNESS_3), int(Op.OPENNESS_4)

_ROW, _TWO_ROWS, _VECTOR = np.uint64(LANES), np.uint64(2 * LANES), np.uint64(3 * LANES)  # places are never below 0
_TAN_PI_8 = sqrt(2.0) - 1.0


@compiled
def run(steps: Ints, r: Floats) -> None:  # noqa: PLR0912, PLR0915  a table that compiled code can read
    """Work out all steps on the rows of `r`."""
    for k in range(len(steps)):
        op = steps[k, 0]
        o, a, b, c = np.uint64(steps[k, 1]), np.uint64(steps[k, 2]), np.uint64(steps[k, 3]), np.uint64(steps[k, 4])
        d, e = np.uint64(steps[k, 5]), np.uint64(steps[k, 6])
        if op == _ADD:
            for i in range(_ROW):
                r[o + i] = r[a + i] + r[b + i]
        elif op == _SUBTRACT:
            for i in range(_ROW):
                r[o + i] = r[a + i] - r[b + i]
        elif op == _MULTIPLY:
            for i in range(_ROW):
                r[o + i] = r[a + i] * r[b + i]
        elif op == _MULTIPLY_ADD:
            for i in range(_ROW):
                r[o + i] = r[a + i] * r[b + i] + r[c + i]
        elif op == _DIVIDE:
            for i in range(_ROW):
                r[o + i] = r[a + i] / r[b + i] if r[b + i] > 0.0 else r[c + i]
        elif op == _ROOT:
            for i in range(_ROW):
                r[o + i] = sqrt(r[a + i])
        elif op == _NEGATE:
            for i in range(_ROW):
                r[o + i] = -r[a + i]
        elif op == _ABSOLUTE:
            for i in range(_ROW):
                r[o + i] = abs(r[a + i])
        elif op == _LEAST:
            for i in range(_ROW):
                r[o + i] = min(r[a + i], r[b + i], r[c + i], r[d + i])
        elif op == _GREATEST:
            for i in range(_ROW):
                r[o + i] = max(r[a + i], r[b + i], r[c + i], r[d + i])
        elif op == _CHOOSE:
            for i in range(_ROW):
                positive, otherwise = r[b + i], r[c + i]
                r[o + i] = positive if r[a + i] > 0.0 else otherwise
        elif op == _TIES:
            _ties(r, o, a, b, c, d, e)
        elif op == _ARC:
            _arc(r, o, a, b)
        elif op == _ADD_VECTORS:
            for i in range(_VECTOR):
                r[o + i] = r[a + i] + r[b + i]
        elif op == _SUBTRACT_VECTORS:
            for i in range(_VECTOR):
                r[o + i] = r[a + i] - r[b + i]
        elif op == _NEGATE_VECTOR:
            for i in range(_VECTOR):
                r[o + i] = -r[a + i]
        elif op == _SCALE:
            for i in range(_ROW):
                put(r, o + i, scaled(r[a + i], at(r, b + i)))
        elif op == _SCALE_ADD:
            for i in range(_ROW):
                put(r, o + i, total(scaled(r[a + i], at(r, b + i)), at(r, c + i)))
        elif op == _DOT:
            for i in range(_ROW):
                r[o + i] = dot(at(r, a + i), at(r, b + i))
        elif op == _SQUARE:
            for i in range(_ROW):
                r[o + i] = square(at(r, a + i))
        elif op == _LENGTH:
            for i in range(_ROW):
                r[o + i] = length(at(r, a + i))
        elif op == _CROSS:
            for i in range(_ROW):
                put(r, o + i, cross(at(r, a + i), at(r, b + i)))
        elif op == _CROSS_ADD:
            for i in range(_ROW):
                put(r, o + i, total(cross(at(r, a + i), at(r, b + i)), at(r, c + i)))
        elif op == _SHRUNK_EDGE:
            for i in range(_ROW):
                x, y, z = scaled(r[a + i], difference(at(r, b + i), at(r, c + i)))
                put(r, o + i, (_finite(x), _finite(y), _finite(z)))
        elif op == _SHRINKING_3:
            _shrinking(r, o, a, b, c, a)
        elif op == _SHRINKING_4:
            _shrinking(r, o, a, b, c, d)
        elif op == _OPENNESS_3:
            _triangle_openness(r, o, a, b, c, d)
        elif op == _OPENNESS_4:
            _quad_openness(r, o, a, b, c, d, e)


@inlined
def at(r: Floats, place: np.uint64) -> Vector:
    """Vector of one element."""
    return r[place], r[place + _ROW], r[place + _TWO_ROWS]


@inlined
def put(r: Floats, place: np.uint64, value: Vector) -> None:
    """Set a vector of one element."""
    r[place], r[place + _ROW], r[place + _TWO_ROWS] = value


@inlined
def _arc(r: Floats, o: np.uint64, a: np.uint64, b: np.uint64) -> None:
    """Angle of a sine and a cosine.

    A turn by 90° and then by 45° leaves a tangent up to tan(pi / 8), whose arc is a polynomial: the Chebyshev
    interpolation of atan(√z) / √z on [0, tan(pi / 8)²], right to the last digits. It is exact near 0 and near pi,
    and unlike a library's function it is worked out for many at once.
    """
    for i in range(_ROW):
        sine, across = r[a + i], abs(r[b + i])
        low, high = min(sine, across), max(sine, across)
        tangent = low / high if high > 0.0 else 0.0
        is_wide = tangent > _TAN_PI_8
        reduced = (low - high) / (low + high) if is_wide else tangent
        z = reduced * reduced
        arc = -0.03338782450121195 + z * 0.015113765096600925
        arc = 0.04499500728984032 + z * arc
        arc = -0.05217312574061591 + z * arc
        arc = 0.05876834004614161 + z * arc
        arc = -0.06666205259976526 + z * arc
        arc = 0.07692281099937744 + z * arc
        arc = -0.09090908059031191 + z * arc
        arc = 0.11111111085322109 + z * arc
        arc = -0.1428571428532971 + z * arc
        arc = 0.19999999999997015 + z * arc
        arc = -0.33333333333333326 + z * arc
        arc = reduced + reduced * z * arc + (0.25 * pi if is_wide else 0.0)
        arc = 0.5 * pi - arc if sine > across else arc
        r[o + i] = pi - arc if r[b + i] < 0.0 else arc


@inlined
def _shrinking(r: Floats, o: np.uint64, a: np.uint64, b: np.uint64, c: np.uint64, d: np.uint64) -> None:
    for i in range(_ROW):
        pa, pb, pc, pd = at(r, a + i), at(r, b + i), at(r, c + i), at(r, d + i)
        first, second = _largest(difference(pb, pa)), _largest(difference(pc, pb))
        third, fourth = _largest(difference(pd, pc)), _largest(difference(pa, pd))
        size = max(first, second, third, fourth)
        r[o + i] = 1.0 / size if size > 0.0 else 0.0


@inlined
def _largest(a: Vector) -> float:
    return max(abs(a[0]), abs(a[1]), abs(a[2]))


@inlined
def _finite(value: float) -> float:
    return value if abs(value) < inf else 0.0


@inlined
def _ties(r: Floats, o: np.uint64, a: np.uint64, b: np.uint64, c: np.uint64, d: np.uint64, e: np.uint64) -> None:
    for i in range(_ROW):
        value, b_i, c_i, d_i, e_i = r[a + i], r[b + i], r[c + i], r[d + i], r[e + i]
        first, second = 1.0 if b_i == value else 0.0, 1.0 if c_i == value else 0.0
        third, fourth = 1.0 if d_i == value else 0.0, 1.0 if e_i == value else 0.0
        count = first + second + third + fourth
        share = 1.0 / count if count > 0.0 else 0.0
        r[o + i] = first * share
        put(r, o + i + _ROW, (second * share, third * share, fourth * share))


@inlined
def _quad_openness(
    r: Floats, o: np.uint64, f: np.uint64, a: np.uint64, b: np.uint64, c: np.uint64, d: np.uint64
) -> None:
    """Openness, the squares of the sides and those of the diagonals."""
    for i in range(_ROW):
        e0, e1, e2, e3 = at(r, a + i), at(r, b + i), at(r, c + i), at(r, d + i)
        across, along = total(e0, e1), total(e1, e2)  # the diagonals
        normal = cross(across, along)
        doubled, turned = square(normal), cross(normal, e0)
        first, second = dot(turned, along), dot(turned, across)  # Jacobians of the corners at a and b
        least = min(first, second, doubled - first, doubled - second)  # opposite corners make up the quad
        s0, s1, s2, s3 = square(e0), square(e1), square(e2), square(e3)
        is_open = least > FLAT * max(s0, s1, s2, s3) * sqrt(doubled)
        r[o + i] = 1.0 if is_open and not dot(normal, at(r, f + i)) < 0.0 else 0.0
        put(r, o + i + _ROW, (s0, s1, s2))
        put(r, o + i + _ROW + _VECTOR, (s3, square(across), square(along)))


@inlined
def _triangle_openness(r: Floats, o: np.uint64, f: np.uint64, a: np.uint64, b: np.uint64, c: np.uint64) -> None:
    """Openness and the squares of the sides."""
    for i in range(_ROW):
        e0, e1, e2 = at(r, a + i), at(r, b + i), at(r, c + i)
        normal = cross(e0, e1)
        s0, s1, s2 = square(e0), square(e1), square(e2)
        is_open = length(normal) > FLAT * max(s0, s1, s2)
        r[o + i] = 1.0 if is_open and not dot(normal, at(r, f + i)) < 0.0 else 0.0
        put(r, o + i + _ROW, (s0, s1, s2))
