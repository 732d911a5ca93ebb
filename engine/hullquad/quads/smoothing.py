"""Nodes moved to where the sum of eta^2 of the elements around them is least, one after another (see `energy`).

While all elements around a node are valid its energy is convex, and a guarded Newton step cannot fail; a node
with an invalid element goes where the worst corner around it becomes best.
"""

from collections.abc import Iterator
from math import cos, inf, pi, sin, sqrt

import numpy as np

from hullquad.arrays import Floats, Longs
from hullquad.metrics.compiled import called, uncounted, woven
from hullquad.quads.draft import NODES, Draft, nodes_beside
from hullquad.quads.energy import FLAT, QUAD_SCALE, TRIANGLE_SCALE, corner_eta
from hullquad.quads.log import Log
from hullquad.quads.stages import States, Step

_HALVINGS = 5
_WAYS = np.array([[cos(0.25 * pi * i), sin(0.25 * pi * i)] for i in range(8)])
"""Directions in which a node is tried, (8, 2)."""
_TRIES = 12
_OPEN = 0.1
"""Least J over squared edges (0.5 in a square) from which on Newton's steps take over."""
_VISITS = 50_000
"""Nodes that are moved before somebody may lose interest: some hundredths of a second."""
_ENDED = 1_000_000_000
"""Sweeps that are never made."""

Terms = tuple[float, float, float, float, float, float]
"""Energy, its gradient (2) and its second derivatives (xx, xy, yy)."""

_NOWHERE = (inf, 0.0, 0.0, 0.0, 0.0, 0.0)


@called
def _term(squares: float, sx: float, sy: float, curvature: float, jacobian: float, jx: float, jy: float) -> Terms:
    """(squares / J)^2 with half its derivatives: `squares` has the gradient (sx, sy) and is curved alike everywhere."""
    factor = 1.0 / jacobian
    eta = squares * factor
    ex, ey = (sx - eta * jx) * factor, (sy - eta * jy) * factor
    bend, twice = curvature * factor, 2.0 * factor
    xx = bend - twice * ex * jx
    yy = bend - twice * ey * jy
    xy = -factor * (ex * jy + ey * jx)
    return eta * eta, eta * ex, eta * ey, eta * xx + ex * ex, eta * xy + ex * ey, eta * yy + ey * ey


@called
def _triangle_term(squares: float, sx: float, sy: float, jacobian: float, jx: float, jy: float) -> Terms:
    """Eta squared of a triangle with half its derivatives."""
    factor = 1.0 / (TRIANGLE_SCALE * jacobian)
    eta = squares * factor
    ex, ey = (sx - TRIANGLE_SCALE * eta * jx) * factor, (sy - TRIANGLE_SCALE * eta * jy) * factor
    bend, twice = 4.0 * factor, 2.0 * TRIANGLE_SCALE * factor
    xx = bend - twice * ex * jx
    yy = bend - twice * ey * jy
    xy = -0.5 * twice * (ex * jy + ey * jx)
    return eta * eta, eta * ex, eta * ey, eta * xx + ex * ex, eta * xy + ex * ey, eta * yy + ey * ey


@called
def _star_energy(nodes: Floats, elements: Longs, near: Longs, node: int, x: float, y: float) -> float:
    """Energy of the elements around a node if it were at (x, y); infinite where one of them is not valid."""
    total = 0.0
    for element in near:
        b, c, d = nodes_beside(elements, element, node)
        bx, by, cx, cy, dx, dy = nodes[b, 0], nodes[b, 1], nodes[c, 0], nodes[c, 1], nodes[d, 0], nodes[d, 1]
        squares, jacobian = corner_eta(dx, dy, x, y, bx, by)
        if c == d:
            squares += (cx - bx) ** 2 + (cy - by) ** 2
            if jacobian <= FLAT * squares:
                return inf
            total += (squares / (TRIANGLE_SCALE * jacobian)) ** 2
            continue
        after, jacobian_after = corner_eta(x, y, bx, by, cx, cy)
        before, jacobian_before = corner_eta(cx, cy, dx, dy, x, y)
        if jacobian <= FLAT * squares or jacobian_after <= FLAT * after or jacobian_before <= FLAT * before:
            return inf
        own, next_one, last = squares / jacobian, after / jacobian_after, before / jacobian_before
        total += 0.25 * (own * own + next_one * next_one + last * last) / (QUAD_SCALE * QUAD_SCALE)
    return total


@called
def _derivatives(nodes: Floats, elements: Longs, near: Longs, node: int) -> Terms:
    """Energy of the elements around a node where it is, with its derivatives; infinite where one is not valid.

    The energy is 16 times, the derivatives are 8 times as much as they should be, which no rounding changes.
    """
    f, gx, gy, xx, xy, yy = 0.0, 0.0, 0.0, 0.0, 0.0, 0.0
    x, y = nodes[node, 0], nodes[node, 1]
    for element in near:
        b, c, d = nodes_beside(elements, element, node)
        bx, by, cx, cy, dx, dy = nodes[b, 0], nodes[b, 1], nodes[c, 0], nodes[c, 1], nodes[d, 0], nodes[d, 1]
        squares, jacobian = corner_eta(dx, dy, x, y, bx, by)
        sx, sy = -2.0 * (bx - x + dx - x), -2.0 * (by - y + dy - y)
        if c == d:
            squares += (cx - bx) ** 2 + (cy - by) ** 2
            if jacobian <= FLAT * squares:
                return _NOWHERE
            t = _triangle_term(squares, sx, sy, jacobian, by - dy, dx - bx)
            f, gx, gy = f + 16.0 * t[0], gx + 16.0 * t[1], gy + 16.0 * t[2]
            xx, xy, yy = xx + 16.0 * t[3], xy + 16.0 * t[4], yy + 16.0 * t[5]
            continue
        after, jacobian_after = corner_eta(x, y, bx, by, cx, cy)
        before, jacobian_before = corner_eta(cx, cy, dx, dy, x, y)
        if jacobian <= FLAT * squares or jacobian_after <= FLAT * after or jacobian_before <= FLAT * before:
            return _NOWHERE
        t = _term(squares, sx, sy, 4.0, jacobian, by - dy, dx - bx)
        f, gx, gy, xx, xy, yy = f + t[0], gx + t[1], gy + t[2], xx + t[3], xy + t[4], yy + t[5]
        t = _term(after, 2.0 * (x - bx), 2.0 * (y - by), 2.0, jacobian_after, by - cy, cx - bx)
        f, gx, gy, xx, xy, yy = f + t[0], gx + t[1], gy + t[2], xx + t[3], xy + t[4], yy + t[5]
        t = _term(before, 2.0 * (x - dx), 2.0 * (y - dy), 2.0, jacobian_before, cy - dy, dx - cx)
        f, gx, gy, xx, xy, yy = f + t[0], gx + t[1], gy + t[2], xx + t[3], xy + t[4], yy + t[5]
    return f, gx, gy, xx, xy, yy


@called
def _worst_corner(nodes: Floats, elements: Longs, near: Longs, node: int, x: float, y: float, enough: float) -> float:
    """Least J over squared edges of the corners that move with a node, if it were at (x, y).

    Once it is no more than `enough`, it may be anything that is not more.
    """
    least = 1.0
    for element in near:
        b, c, d = nodes_beside(elements, element, node)
        bx, by, cx, cy, dx, dy = nodes[b, 0], nodes[b, 1], nodes[c, 0], nodes[c, 1], nodes[d, 0], nodes[d, 1]
        squares, jacobian = corner_eta(dx, dy, x, y, bx, by)
        least = min(least, jacobian / max(squares, 1e-300))
        if c != d:
            squares, jacobian = corner_eta(x, y, bx, by, cx, cy)
            least = min(least, jacobian / max(squares, 1e-300))
            squares, jacobian = corner_eta(cx, cy, dx, dy, x, y)
            least = min(least, jacobian / max(squares, 1e-300))
        if least <= enough:
            break
    return least


@called
def _untangle(nodes: Floats, elements: Longs, near: Longs, node: int) -> float:
    """Move a node to where the worst corner around it is best, by a search in eight directions; how far it went."""
    start_x, start_y, mean_x, mean_y, reach = nodes[node, 0], nodes[node, 1], 0.0, 0.0, 0.0
    count = len(near)
    for element in near:
        after, _, _ = nodes_beside(elements, element, node)
        mean_x, mean_y = mean_x + nodes[after, 0] / count, mean_y + nodes[after, 1] / count
        reach += sqrt((nodes[after, 0] - start_x) ** 2 + (nodes[after, 1] - start_y) ** 2) / count
    x, y, best = start_x, start_y, _worst_corner(nodes, elements, near, node, start_x, start_y, -inf)
    value = _worst_corner(nodes, elements, near, node, mean_x, mean_y, best)
    if value > best:
        x, y, best = mean_x, mean_y, value
    step = 0.5 * reach
    for _ in range(_TRIES):
        from_x, from_y = x, y
        for direction in range(len(_WAYS)):
            to_x, to_y = from_x + step * _WAYS[direction, 0], from_y + step * _WAYS[direction, 1]
            value = _worst_corner(nodes, elements, near, node, to_x, to_y, best)
            if value > best:
                x, y, best = to_x, to_y, value
        if best > _OPEN:
            break
        if x == from_x and y == from_y:
            step *= 0.5
    nodes[node, 0], nodes[node, 1] = x, y
    return sqrt((x - start_x) ** 2 + (y - start_y) ** 2)


@called
def _relax_node(nodes: Floats, elements: Longs, near: Longs, node: int) -> float:
    """Move a free node to where the energy of the elements around it is less; how far it went [mm]."""
    moved = 0.0
    energy, gx, gy, xx, xy, yy = _derivatives(nodes, elements, near, node)
    if energy == inf:
        moved = _untangle(nodes, elements, near, node)
        energy, gx, gy, xx, xy, yy = _derivatives(nodes, elements, near, node)
        if energy == inf:
            return moved
    x, y, energy = nodes[node, 0], nodes[node, 1], energy / 16.0
    determinant = xx * yy - xy * xy
    if determinant <= 0.0:
        return 0.0
    step_x, step_y = -(yy * gx - xy * gy) / determinant, -(xx * gy - xy * gx) / determinant
    for _ in range(_HALVINGS):
        if _star_energy(nodes, elements, near, node, x + step_x, y + step_y) < energy:
            nodes[node, 0], nodes[node, 1] = x + step_x, y + step_y
            return sqrt(step_x * step_x + step_y * step_y)
        step_x, step_y = 0.5 * step_x, 0.5 * step_y
    return 0.0


@called
def relax_node(made: Draft, node: int) -> float:
    """Move a free node to where the energy around it is less; how far it went [mm]."""
    return _relax_node(made.nodes, made.elements, made.around[node, : made.counts[node]], node)


@woven
def relax(made: Draft, chosen: Longs, count: int, sweeps: int, tolerance: float) -> None:
    """Move the first `count` of the chosen nodes, there and back, until none goes farther than the tolerance [mm]."""
    for sweep in range(sweeps):
        farthest = 0.0
        for i in range(count):
            node = chosen[i if sweep % 2 == 0 else count - 1 - i]
            if not made.held[node] and made.counts[node] > 0:
                farthest = max(farthest, relax_node(made, node))
        if farthest < tolerance:
            break


def relaxed(made: Draft, sweeps: int, tolerance: float, log: Log) -> Iterator[States | None]:
    """Move all free nodes, there and back, until none goes farther than the tolerance [mm]; states on the way.

    From one state to the next are twice as many sweeps as to the last, for nodes move less and less.
    """
    at, stop = np.zeros(3), 1 if log.is_watched else sweeps
    while at[0] < sweeps:
        is_there = _relax_on(made, min(stop, sweeps), tolerance, at, _VISITS)
        if at[0] < sweeps:
            yield log.compared(Step.SMOOTHED, made) if is_there else None
        if is_there:
            stop *= 2


@uncounted
def _relax_on(made: Draft, sweeps: int, tolerance: float, at: Floats, visits: int) -> bool:
    """Go on moving all free nodes from where one is, which is kept in `at`; whether so many sweeps are done."""
    count = made.tallies[NODES]
    sweep, place, farthest = int(at[0]), int(at[1]), at[2]
    while sweep < sweeps:
        if visits == 0:
            at[0], at[1], at[2] = sweep, place, farthest
            return False
        node = place if sweep % 2 == 0 else count - 1 - place
        if not made.held[node] and made.counts[node] > 0:
            farthest = max(farthest, relax_node(made, node))
        visits, place = visits - 1, place + 1
        if place == count:
            sweep, place = (sweep + 1 if farthest >= tolerance else _ENDED), 0
            farthest = 0.0
    at[0], at[1], at[2] = sweep, place, farthest
    return True
