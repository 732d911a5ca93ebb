"""Where nodes come to rest when the sum of the shape metric over the elements is made as large as can be.

That is what an optimiser makes of a mesh (Kniat's, with metric shape): such a sum gives an element up where those
beside it gain more. So a mesh is judged by where its nodes will be, not by where smoothing leaves them.
"""

from math import sqrt

import numpy as np

from hullquad.arrays import Floats, Longs
from hullquad.metrics.compiled import called, plain, uncounted
from hullquad.quads.draft import NODES, Draft, nodes_beside
from hullquad.quads.energy import FLAT, QUAD_SCALE, TRIANGLE_SCALE, corner_eta

_REACH = 0.25
"""How far a node goes in the first sweep, over the mean length of its edges."""
_SHORTER = 0.3
"""Of that, if it may not go so far."""
_NEARER = 0.02
"""How far in the last one, over how far in the first."""
FROM_AFAR, AGAIN = plain(24), plain(6)
"""Sweeps for nodes that have been smoothed, and for nodes that have settled before something was changed."""

Rise = tuple[float, float, float, float]
"""Sum of shape with its gradient (2), and the mean square of the edges [mm2]."""


@called
def _star_shape(nodes: Floats, elements: Longs, near: Longs, node: int, x: float, y: float) -> Rise:
    """Sum of the shape of the elements around a node if it were at (x, y); negative where one of them is not valid."""
    total, gx, gy, square = 0.0, 0.0, 0.0, 0.0
    for element in near:
        b, c, d = nodes_beside(elements, element, node)
        bx, by, cx, cy, dx, dy = nodes[b, 0], nodes[b, 1], nodes[c, 0], nodes[c, 1], nodes[d, 0], nodes[d, 1]
        square += (bx - x) ** 2 + (by - y) ** 2
        squares, jacobian = corner_eta(dx, dy, x, y, bx, by)
        sx, sy, jx, jy = 2.0 * (x - bx + x - dx), 2.0 * (y - by + y - dy), by - dy, dx - bx
        scale = QUAD_SCALE
        if c == d:
            squares += (cx - bx) ** 2 + (cy - by) ** 2
            scale = TRIANGLE_SCALE
        least = jacobian / squares
        if c != d:
            after, jacobian_after = corner_eta(x, y, bx, by, cx, cy)
            before, jacobian_before = corner_eta(cx, cy, dx, dy, x, y)
            opposite, jacobian_opposite = corner_eta(bx, by, cx, cy, dx, dy)
            if jacobian_after < least * after:
                least, squares = jacobian_after / after, after
                sx, sy, jx, jy = 2.0 * (x - bx), 2.0 * (y - by), by - cy, cx - bx
            if jacobian_before < least * before:
                least, squares = jacobian_before / before, before
                sx, sy, jx, jy = 2.0 * (x - dx), 2.0 * (y - dy), cy - dy, dx - cx
            if jacobian_opposite < least * opposite:
                least, sx, sy, jx, jy = jacobian_opposite / opposite, 0.0, 0.0, 0.0, 0.0
        if least <= FLAT:
            return -1.0, 0.0, 0.0, 0.0
        total += scale * least
        gx, gy = gx + scale * (jx - least * sx) / squares, gy + scale * (jy - least * sy) / squares
    return total, gx, gy, square / len(near)


@called
def _settle_node(nodes: Floats, elements: Longs, near: Longs, node: int, reach: float) -> None:
    """Move a free node along the gradient, if that is better there."""
    x, y = nodes[node, 0], nodes[node, 1]
    value, gx, gy, square = _star_shape(nodes, elements, near, node, x, y)
    steepness = sqrt(gx * gx + gy * gy)
    if steepness == 0.0:
        return
    step = reach * sqrt(square) / steepness
    for _ in range(2):
        there, _, _, _ = _star_shape(nodes, elements, near, node, x + step * gx, y + step * gy)
        if there > value:
            nodes[node, 0], nodes[node, 1] = x + step * gx, y + step * gy
            break
        step *= _SHORTER


@called
def settle(made: Draft, chosen: Longs, count: int, sweeps: int) -> None:
    """Move the first `count` of the chosen nodes, there and back, each time less far."""
    reach, shrinking = _REACH, _NEARER ** (1.0 / sweeps)
    for sweep in range(sweeps):
        for i in range(count):
            node = chosen[i if sweep % 2 == 0 else count - 1 - i]
            if not made.held[node] and made.counts[node] > 0:
                _settle_node(made.nodes, made.elements, made.around[node, : made.counts[node]], node, reach)
        reach *= shrinking


def settled(made: Draft, sweeps: int = FROM_AFAR) -> None:
    """Move all free nodes of a mesh without invalid elements in so many sweeps."""
    _settle_all(made, np.arange(made.tallies[NODES]), sweeps)


@uncounted
def _settle_all(made: Draft, chosen: Longs, sweeps: int) -> None:
    settle(made, chosen, len(chosen), sweeps)
