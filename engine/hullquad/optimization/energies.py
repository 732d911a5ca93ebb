"""The energies of all modes, as expressions of an element; their slopes follow by the chain rule."""

from functools import lru_cache, reduce
from math import inf, sqrt
from operator import add

from hullquad.arrays import Floats
from hullquad.metrics import Metric, formulas
from hullquad.metrics.element import Element
from hullquad.metrics.expression import Node, Number, choice, dot, lesser, number, root
from hullquad.metrics.program import Program, program
from hullquad.metrics.slopes import slopes
from hullquad.metrics.table_1 import scaled_jacobians
from hullquad.optimization.demand import Demand
from hullquad.optimization.energy import Code, Energy, code
from hullquad.optimization.objective import Objective

LEAST_GUARD = 0.05
"""Scaled Jacobian below which no element is let fall quickly, floor or not."""
_SQUARE, _TRIANGLE = 0.25, 0.5
"""Weights in Winslow's energy: a square has 1, an equilateral triangle half of it."""
_FLOOR_WEIGHT = 2.0
"""Of the floor against an objective that counts 0.75 from its limit to its ideal."""
_BRINK = (0.1, 0.01)
"""Level and weight of the floor that a smooth objective without one has."""
_CHASED = 5
"""Doublings of the exponent of the metrics that rules are about."""
_MARGIN = 0.3
"""How far within a limit an element is to be, on the way from there to the ideal: at the limit many would be beyond."""
_ASIDE = 0.05
"""What the objective counts beside the demands."""
_KEPT = 64
_KEPT_PART = 0.4
"""What an element below the guard must keep of its openness in one step."""


def winslow(size: float, epsilon: float) -> Energy:
    """Winslow's energy with a regularised determinant: finite on folded elements, it pulls them open.

    Each corner of a quad, between edges u and v, has ``(|u|^2 + |v|^2) / (2 chi(J))`` with its Jacobian J (Eq. 1)
    seen against the direction it must face, and ``chi(J) = (J + sqrt(eps^2 + J^2)) / 2``; a triangle has the same
    for its map from the equilateral one. Lengths are in units of the element size. Source: V. Garanzha et al.,
    "Foldover-free maps in 50 lines of code", ACM Trans. Graphics 40:102 (2021), Eqs. (3) to (5).
    """
    return Energy(_winslow_code(size), -inf, epsilon, epsilon, size, guard=-inf, kept=_KEPT_PART)


def merit(objective: Objective, size: float, areas: Floats, doublings: int | None, floor: float | None) -> Energy:
    """What an objective loses, with a floor under the elements' scaled Jacobian.

    `doublings` is that of the smooth stand-in's exponent, None for the metrics themselves. Below the floor t0 each
    corner of scaled Jacobian t costs ``t0 / t + t / t0 - 2``; triangles cost nothing else. Without a floor the
    stand-in has a low and weak one: an element on the brink of folding would hold its neighbours up.
    """
    level, weight = _level(floor, None if doublings is None else _BRINK[1] * 0.5 ** (doublings / 2))
    steps = _merit_code(objective, doublings, level, weight)
    return Energy(steps, level, *_both(areas), size, max(floor or 0.0, LEAST_GUARD), _KEPT_PART)


def worst_first(metric: Metric, size: float, areas: Floats, doublings: int, power: int, floor: float | None) -> Energy:
    """Sum over all elements of their distance from the ideal, times their weight, to the power 2^power.

    The greater the power, the more it is the worst element alone that counts: its limit is max-min. Weights are to be
    those of `weight_at` the worst value. With a `floor` the sum is over the quads alone, and triangles are only held
    above the floor.
    """
    level, weight = _BRINK if floor is None else (floor, _FLOOR_WEIGHT)
    steps = _worst_code(metric, doublings, power, level, weight, is_of_all=floor is None)
    return Energy(steps, level, *_both(areas), size, max(floor or 0.0, LEAST_GUARD), _KEPT_PART)


def held_at(objective: Objective, size: float, areas: Floats, doublings: int | None, floor: float | None) -> Energy:
    """What an objective loses, while no element gets worse by its metric than the value that the weights are of.

    Weights are to be those of `weight_at` that value. With a `floor` that is for quads alone, and triangles are only
    held above the floor.
    """
    level, weight = _BRINK if floor is None else (floor, _FLOOR_WEIGHT)
    steps = _held_code(objective, doublings, level, weight, is_of_all=floor is None)
    return Energy(steps, level, *_both(areas), size, guard=0.0, kept=1.0)


def weight_at(metric: Metric, value: float) -> float:
    """1 over the distance of a value from the ideal [of the kernel]."""
    return metric.factor / (value - metric.quads.ideal)


def _both(areas: Floats) -> tuple[float, float]:
    of_quads, of_triangles = areas.tolist()
    return of_quads, of_triangles


@lru_cache(_KEPT)
def _held_code(objective: Objective, doublings: int | None, level: float, weight: float, *, is_of_all: bool) -> Code:
    quad, triangle = Element(4, doublings), Element(3, doublings)
    metric = objective.metric
    of_triangle = _room(triangle, metric) if metric.holds_triangles and is_of_all else None
    programs = _program(quad, _loss(objective, quad), _room(quad, metric)), _program(triangle, None, of_triangle)
    return code((*programs, *_low_programs(level, weight)))


def _room(element: Element, metric: Metric) -> Number:
    """How far an element is from the worst value allowed, or from folding: below 0 beyond it."""
    exact = Element(element.count)
    exact.points, exact.facing, exact.reference = element.points, element.facing, element.reference  # the same inputs
    return lesser(
        1.0 - element.weight * _distance(metric, exact), reduce(lesser, scaled_jacobians(exact)) - LEAST_GUARD
    )


def _distance(metric: Metric, element: Element) -> Number:
    """From the ideal, with its sign [of the kernel]."""
    return formulas.value(metric, element) - metric.quads.ideal / metric.factor


def chasing(
    demands: tuple[Demand, ...], objective: Objective, size: float, areas: Floats, softness: float, floor: float | None
) -> Energy:
    """What breaks demands, each element nearly alike however far it is beyond them, and little of an objective.

    An element v beyond a limit, in units of the way from there to the ideal, costs ``v^2 / (v^2 + softness^2)`` times
    its weight: the smaller the softness, the nearer to a count.
    """
    level, weight = _level(floor, _BRINK[1])
    steps = _chasing_code(demands, objective, softness, level, weight)
    return Energy(steps, level, *_both(areas), size, max(floor or 0.0, LEAST_GUARD), _KEPT_PART)


@lru_cache(_KEPT)
def _chasing_code(
    demands: tuple[Demand, ...], objective: Objective, softness: float, level: float, weight: float
) -> Code:
    quad, triangle = Element(4, _CHASED), Element(3, _CHASED)
    of_quads = [_cost(quad, demand, softness) for demand in demands if demand.is_of_quads]
    of_triangles = [_cost(triangle, demand, softness) for demand in demands if demand.is_of_triangles]
    programs = (
        _program(quad, reduce(add, of_quads, _ASIDE * _loss(objective, quad))),
        _program(triangle, reduce(add, of_triangles) if of_triangles else None),
    )
    return code((*programs, *_low_programs(level, weight)))


def _cost(element: Element, demand: Demand, softness: float) -> Number:
    value = formulas.value(demand.metric, element)
    beyond = _MARGIN + demand.scale * ((value - demand.limit) if demand.is_upper else (demand.limit - value))
    square = beyond * beyond
    return choice(beyond, demand.weight * element.weight * (square / (square + softness**2)), 0.0)


@lru_cache(_KEPT)
def _worst_code(metric: Metric, doublings: int, power: int, level: float, weight: float, *, is_of_all: bool) -> Code:
    quad, triangle = Element(4, doublings), Element(3, doublings)

    def loss(element: Element) -> Number:
        distance = element.weight * _distance(metric, element)
        for _ in range(power):
            distance = distance * distance
        return distance

    of_triangle = loss(triangle) if metric.holds_triangles and is_of_all else None
    return code((_program(quad, loss(quad)), _program(triangle, of_triangle), *_low_programs(level, weight)))


@lru_cache(_KEPT)
def _winslow_code(size: float) -> Code:
    quad, triangle = Element(4), Element(3)
    programs = _program(quad, _winslow(quad, size)), _program(triangle, _winslow(triangle, size))
    return code((*programs, *_low_programs(0.0, 0.0)))


@lru_cache(_KEPT)
def _merit_code(objective: Objective, doublings: int | None, level: float, weight: float) -> Code:
    quad = Element(4, doublings)
    return code((_program(quad, _loss(objective, quad)), _program(Element(3), None), *_low_programs(level, weight)))


def _level(floor: float | None, brink: float | None) -> tuple[float, float]:
    """Below what corners cost something, and its weight: the floor's; without one the brink's, if it counts."""
    if floor is not None:
        return floor, _FLOOR_WEIGHT
    return (-inf, 0.0) if brink is None else (_BRINK[0], brink)


@lru_cache(_KEPT)
def _low_programs(level: float, weight: float) -> tuple[Program, Program]:
    """What corners of quads and of triangles below a level cost."""
    quad, triangle = Element(4), Element(3)
    if weight == 0.0:
        return _program(quad, None), _program(triangle, None)
    return _program(quad, _below(quad, level, weight)), _program(triangle, _below(triangle, level, weight))


def _loss(objective: Objective, element: Element) -> Number:
    gains = zip(objective.terms, objective.gains.tolist(), strict=True)
    losses: list[Number] = [-gain * formulas.value(term.metric, element) for term, gain in gains]
    return reduce(add, losses)


def _below(element: Element, level: float, weight: float) -> Number:
    """What corners below a level cost."""
    costs = [
        choice(level - corner, weight * (level / corner + (1.0 / level) * corner - 2.0), 0.0)
        for corner in scaled_jacobians(element)
    ]
    return reduce(add, costs)


def _winslow(element: Element, size: float) -> Number:
    scale = (1.0 / size) * element.size
    area = scale * scale
    if element.count == 3:
        spread = (0.5 / sqrt(3.0)) * area * reduce(add, element.squares)
        return _TRIANGLE * spread / _chi(area * dot(element.facing, element.normals[0]), element.reference)
    corners = zip(element.normals, element.squares_before, element.squares, strict=True)
    costs = [
        (0.5 * _SQUARE) * area * (before + after) / _chi(area * dot(element.facing, normal), element.reference)
        for normal, before, after in corners
    ]
    return reduce(add, costs)


def _chi(jacobian: Number, epsilon: Number) -> Number:
    """The Jacobian made positive: itself where it is large, close to 0 where it is negative."""
    square = epsilon * epsilon
    length = root(square + jacobian * jacobian)
    return choice(jacobian, 0.5 * (jacobian + length), 0.5 * square / (length - jacobian))


def _program(element: Element, value: Number | None, openness: Number | None = None) -> Program:
    """Value, openness (least scaled Jacobian of the corners if nothing else) and slopes by the nodes if it has any."""
    if openness is None:
        openness = reduce(lesser, scaled_jacobians(element))
    inputs: list[Node] = [*element.points, element.facing, element.reference, element.weight]
    if value is None:
        return program([number(0.0), openness], inputs)
    by_sides = slopes(value, element.sides)
    by_nodes = [element.shrinking * (by_sides[node - 1] - by_sides[node]) for node in range(element.count)]
    return program([value, openness, *by_nodes], inputs)
