"""Steps shortened where they would spoil elements, compiled."""

from math import sqrt

from hullquad.arrays import Floats
from hullquad.metrics.compiled import compiled
from hullquad.metrics.quad import edges
from hullquad.metrics.vectors import Vector, cross, difference, dot, square, vector
from hullquad.optimization.energy import Elements

_LEAST_KEPT = 0.4
"""Part of its quality that an element below the floor must keep in one step."""
HALVINGS = 4
_ROUNDS = 12
_EQUILATERAL = 2.0 / sqrt(3.0)


@compiled
def held_back(points: Floats, trial: Floats, elements: Elements, floor: float, halvings: int, shares: Floats) -> bool:
    """Shorten the moves from `points` to `trial` of the nodes of elements that would lose too much; whether any was.

    An element may become worse down to `floor` (of its scaled Jacobian); below, it must keep a part of what it has,
    so that none is ever turned inside out. Moves are halved up to so many times, then taken back.
    """
    is_any = False
    for round_ in range(_ROUNDS):
        shares[:] = 1.0
        if not _shorten(points, trial, elements, floor, shares, 0.5 if round_ < halvings else 0.0):
            break
        is_any = True
        for node in range(len(shares)):
            if shares[node] < 1.0:
                for axis in range(3):
                    move = trial[node, axis] - points[node, axis]
                    trial[node, axis] = points[node, axis] + shares[node] * move
    return is_any


@compiled
def _shorten(points: Floats, trial: Floats, elements: Elements, floor: float, shares: Floats, share: float) -> bool:
    """Mark the nodes of spoilt elements with the share of their move that they keep; whether there are any."""
    is_any = False
    for i in range(len(elements.quads)):
        after = _openness(trial, elements, i)
        if after < floor and not after >= _LEAST_KEPT * min(_openness(points, elements, i), floor):
            is_any = True
            for corner in range(4):
                _mark(shares, elements.quads[i, corner], share)
    for i in range(len(elements.triangles)):
        after = _triangle_openness(trial, elements, i)
        if after < floor and not after >= _LEAST_KEPT * min(_triangle_openness(points, elements, i), floor):
            is_any = True
            for corner in range(3):
                _mark(shares, elements.triangles[i, corner], share)
    return is_any


@compiled
def _mark(shares: Floats, node: int, share: float) -> None:
    if node < len(shares):
        shares[node] = share


@compiled
def _openness(points: Floats, elements: Elements, row: int) -> float:
    """Least sine of a quad's corners as seen against its normal: its scaled Jacobian where it is flat."""
    corners = elements.quads[row]
    normal = vector(elements.normals, row if len(elements.normals) > 1 else 0)
    a, b, c, d = (
        vector(points, corners[0]), vector(points, corners[1]), vector(points, corners[2]), vector(points, corners[3])
    )  # fmt: skip
    e0, e1, e2, e3 = edges(a, b, c, d)
    return min(_sine(e3, e0, normal), _sine(e0, e1, normal), _sine(e1, e2, normal), _sine(e2, e3, normal))


@compiled
def _triangle_openness(points: Floats, elements: Elements, row: int) -> float:
    """The same of a triangle; 1 where it is equilateral."""
    corners = elements.triangles[row]
    normal = vector(elements.normals, len(elements.quads) + row if len(elements.normals) > 1 else 0)
    a, b, c = vector(points, corners[0]), vector(points, corners[1]), vector(points, corners[2])
    e0, e1, e2 = difference(b, a), difference(c, b), difference(a, c)
    return _EQUILATERAL * min(_sine(e2, e0, normal), _sine(e0, e1, normal), _sine(e1, e2, normal))


@compiled
def _sine(before: Vector, after: Vector, normal: Vector) -> float:
    product = square(before) * square(after)
    return dot(normal, cross(before, after)) / sqrt(product) if product > 0.0 else 0.0
