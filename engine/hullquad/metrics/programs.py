"""Programs of metrics: for values, for values with slopes, for the values of corners."""

from collections.abc import Sequence
from functools import lru_cache

from hullquad.metrics import formulas
from hullquad.metrics.element import Element
from hullquad.metrics.expression import Node, shrunk_edge
from hullquad.metrics.program import Program, program
from hullquad.metrics.row import Metric
from hullquad.metrics.slopes import slopes

_KEPT = 512


@lru_cache(_KEPT)
def values_program(metrics: tuple[Metric, ...], count: int) -> Program:
    """Values by some metrics, then openness."""
    element = Element(count)
    return _program(element, [*(formulas.value(metric, element) for metric in metrics), element.openness])


@lru_cache(_KEPT)
def corners_program(metric: Metric, count: int) -> Program:
    """What each corner has by itself, then openness."""
    element = Element(count)
    return _program(element, [*formulas.corner_values(metric, element), element.openness])


@lru_cache(_KEPT)
def slopes_program(metric: Metric, count: int, doublings: int | None = None) -> Program:
    """The value, exact or smooth, then slopes by each node's three coordinates."""
    element = Element(count, doublings)
    value = formulas.value(metric, element)
    by_sides = slopes(value, element.sides)
    by_nodes = [shrunk_edge(element.shrinking, by_sides[node], by_sides[node - 1]) for node in range(count)]
    return _program(element, [value, *by_nodes])


def _program(element: Element, outputs: Sequence[Node]) -> Program:
    return program(outputs, [*element.points, element.facing, element.reference])
