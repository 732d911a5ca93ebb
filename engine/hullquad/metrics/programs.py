"""Programs of metrics: for values, for values with slopes, for the values of corners."""

from collections.abc import Sequence
from functools import lru_cache

from hullquad.arrays import ints
from hullquad.metrics import formulas
from hullquad.metrics.element import Element
from hullquad.metrics.expression import Arrow, Node, Number, Op, number, shrunk_edge
from hullquad.metrics.program import LANES, Program, program
from hullquad.metrics.row import Metric
from hullquad.metrics.slopes import slopes

_KEPT = 512
_ALWAYS = number(1.0)
"""Openness for those who ask for the formula as it stands."""
_NO_SIDE = Arrow(Op.INPUT, value=-1.0)
"""In the place of a triangle's fourth side."""


@lru_cache(_KEPT)
def values_program(metrics: tuple[Metric, ...], count: int) -> Program:
    """Values by some metrics, then openness."""
    element = Element(count, is_judged=True)
    return _program(element, [*(formulas.value(metric, element) for metric in metrics), element.openness])


@lru_cache(_KEPT)
def corners_program(metric: Metric, count: int) -> Program:
    """What each corner has by itself, then openness."""
    element = Element(count, is_judged=True)
    return _program(element, [*formulas.corner_values(metric, element), element.openness])


@lru_cache(_KEPT)
def raw_program(metric: Metric) -> Program:
    """The value of any quad."""
    element = Element(4)
    return _program(element, [formulas.value(metric, element), _ALWAYS])


@lru_cache(_KEPT)
def slopes_program(metric: Metric, count: int, doublings: int | None = None) -> Program:
    """The value of any element, exact or smooth, then slopes by each node's three coordinates."""
    element = Element(count, doublings)
    value = formulas.value(metric, element)
    return _program(element, [value, *slopes_by_nodes(value, element), _ALWAYS])


def slopes_by_nodes(value: Number, element: Element) -> list[Arrow]:
    """Derivatives of a value by the element's nodes; what is not finite is 0."""
    by_sides = slopes(value, element.sides)
    return [shrunk_edge(element.shrinking, by_sides[node], by_sides[node - 1]) for node in range(element.count)]


def _program(element: Element, outputs: Sequence[Node]) -> Program:
    """A program that begins with the sides, as `layout.lay_out` puts them; of vectors it has three outputs each."""
    sides = [*element.sides, _NO_SIDE][:4]
    made = program(outputs, [element.facing, element.reference], [*sides, element.shrinking])
    rows = [
        row + axis * LANES
        for row, node in zip(made.outputs, outputs, strict=True)
        for axis in range(3 if isinstance(node, Arrow) else 1)
    ]
    return made._replace(outputs=ints(rows))
