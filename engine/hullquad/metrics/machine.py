"""The machine that works out programs, compiled: each step for a whole row of elements at once."""

from math import pi, sqrt

import numpy as np

from hullquad.arrays import Floats, Ints
from hullquad.metrics.compiled import compiled
from hullquad.metrics.expression import Op
from hullquad.metrics.program import LANES

_ADD, _SUBTRACT, _MULTIPLY, _DIVIDE, _ROOT = map(int, (Op.ADD, Op.SUBTRACT, Op.MULTIPLY, Op.DIVIDE, Op.ROOT))
_LEAST, _GREATEST, _ABSOLUTE, _CHOOSE, _ARC = map(int, (Op.LEAST, Op.GREATEST, Op.ABSOLUTE, Op.CHOOSE, Op.ARC))
_ADD_VECTORS, _SUBTRACT_VECTORS, _SCALE = map(int, (Op.ADD_VECTORS, Op.SUBTRACT_VECTORS, Op.SCALE))
_DOT, _CROSS, _LARGEST_COMPONENT = map(int, (Op.DOT, Op.CROSS, Op.LARGEST_COMPONENT))
_ROW, _Y, _Z = np.uint64(LANES), np.uint64(LANES), np.uint64(2 * LANES)
_TAN_PI_8 = 2.0**0.5 - 1.0


@compiled
def run(steps: Ints, r: Floats) -> None:  # noqa: PLR0912, PLR0915  a table that compiled code can read
    """Work out all steps on the rows of `r`."""
    for k in range(len(steps)):
        op = steps[k, 0]
        o, a, b, c = np.uint64(steps[k, 1]), np.uint64(steps[k, 2]), np.uint64(steps[k, 3]), np.uint64(steps[k, 4])
        if op == _ADD:
            for i in range(_ROW):
                r[o + i] = r[a + i] + r[b + i]
        elif op == _MULTIPLY:
            for i in range(_ROW):
                r[o + i] = r[a + i] * r[b + i]
        elif op == _SCALE:
            for i in range(_ROW):
                factor = r[a + i]
                r[o + i] = factor * r[b + i]
                r[o + _Y + i] = factor * r[b + _Y + i]
                r[o + _Z + i] = factor * r[b + _Z + i]
        elif op == _DOT:
            for i in range(_ROW):
                r[o + i] = r[a + i] * r[b + i] + r[a + _Y + i] * r[b + _Y + i] + r[a + _Z + i] * r[b + _Z + i]
        elif op == _CROSS:
            for i in range(_ROW):
                ax, ay, az = r[a + i], r[a + _Y + i], r[a + _Z + i]
                bx, by, bz = r[b + i], r[b + _Y + i], r[b + _Z + i]
                r[o + i] = ay * bz - az * by
                r[o + _Y + i] = az * bx - ax * bz
                r[o + _Z + i] = ax * by - ay * bx
        elif op == _ADD_VECTORS:
            for i in range(_ROW):
                r[o + i] = r[a + i] + r[b + i]
                r[o + _Y + i] = r[a + _Y + i] + r[b + _Y + i]
                r[o + _Z + i] = r[a + _Z + i] + r[b + _Z + i]
        elif op == _SUBTRACT_VECTORS:
            for i in range(_ROW):
                r[o + i] = r[a + i] - r[b + i]
                r[o + _Y + i] = r[a + _Y + i] - r[b + _Y + i]
                r[o + _Z + i] = r[a + _Z + i] - r[b + _Z + i]
        elif op == _SUBTRACT:
            for i in range(_ROW):
                r[o + i] = r[a + i] - r[b + i]
        elif op == _DIVIDE:
            for i in range(_ROW):
                r[o + i] = r[a + i] / r[b + i] if r[b + i] > 0.0 else r[c + i]
        elif op == _ROOT:
            for i in range(_ROW):
                r[o + i] = sqrt(r[a + i])
        elif op == _LEAST:
            for i in range(_ROW):
                r[o + i] = min(r[a + i], r[b + i])
        elif op == _GREATEST:
            for i in range(_ROW):
                r[o + i] = max(r[a + i], r[b + i])
        elif op == _CHOOSE:
            for i in range(_ROW):
                r[o + i] = r[b + i] if r[a + i] > 0.0 else r[c + i]
        elif op == _ABSOLUTE:
            for i in range(_ROW):
                r[o + i] = abs(r[a + i])
        elif op == _LARGEST_COMPONENT:
            for i in range(_ROW):
                r[o + i] = max(abs(r[a + i]), abs(r[a + _Y + i]), abs(r[a + _Z + i]))
        elif op == _ARC:
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
