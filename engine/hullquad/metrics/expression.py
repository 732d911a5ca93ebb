"""Formulas as expressions of numbers and vectors, and the expressions of their slopes.

A formula is written once, as mathematics; its slopes follow from the chain rule, applied from the value backwards.
Quotients and roots are defined everywhere: what a number is divided by, or the root's derivative is, counts only
where it is above zero.
"""

from collections.abc import Iterable, Sequence
from enum import IntEnum

import attrs


class Op(IntEnum):
    """What a node does with its operands."""

    INPUT = 0
    CONSTANT = 1
    ADD = 2
    SUBTRACT = 3
    MULTIPLY = 4
    DIVIDE = 5
    """First over second where that is above zero, else third."""
    ROOT = 6
    LEAST = 7
    GREATEST = 8
    ABSOLUTE = 9
    CHOOSE = 10
    """Second where the first is above zero, else third."""
    ARC = 11
    """Angle from 0 to pi of a sine and a cosine, both times any length [rad]."""
    ADD_VECTORS = 12
    SUBTRACT_VECTORS = 13
    SCALE = 14
    DOT = 15
    CROSS = 16
    LARGEST_COMPONENT = 17
    EXTREME = 18
    """First; its slopes by the following n are given as the n after them."""


@attrs.frozen(eq=False)
class Number:
    """A number of each element."""

    op: Op
    operands: tuple["Node", ...] = ()
    value: float = 0.0
    """Of a constant; which one of an input."""

    def __add__(self, other: "Number | float") -> "Number":
        return Number(Op.ADD, (self, number(other)))

    __radd__ = __add__

    def __sub__(self, other: "Number | float") -> "Number":
        return Number(Op.SUBTRACT, (self, number(other)))

    def __rsub__(self, other: float) -> "Number":
        return number(other) - self

    def __mul__(self, other: "Number | float") -> "Number":
        if isinstance(other, Arrow):  # which knows how to be multiplied
            return NotImplemented
        return Number(Op.MULTIPLY, (self, number(other)))

    __rmul__ = __mul__

    def __truediv__(self, other: "Number | float") -> "Number":
        return self.over(number(other), 0.0)

    def __rtruediv__(self, other: float) -> "Number":
        return number(other) / self

    def __neg__(self) -> "Number":
        return number(-1.0) * self

    def __abs__(self) -> "Number":
        return Number(Op.ABSOLUTE, (self,))

    def over(self, divisor: "Number", otherwise: float) -> "Number":
        """The quotient; `otherwise` where the divisor is not above zero."""
        return Number(Op.DIVIDE, (self, divisor, number(otherwise)))


@attrs.frozen(eq=False)
class Arrow:
    """A vector of each element."""

    op: Op
    operands: tuple["Node", ...] = ()
    value: float = 0.0

    def __add__(self, other: "Arrow") -> "Arrow":
        return Arrow(Op.ADD_VECTORS, (self, other))

    def __sub__(self, other: "Arrow") -> "Arrow":
        return Arrow(Op.SUBTRACT_VECTORS, (self, other))

    def __rmul__(self, factor: "Number | float") -> "Arrow":
        return Arrow(Op.SCALE, (number(factor), self))

    def __neg__(self) -> "Arrow":
        return -1.0 * self

    @property
    def square(self) -> Number:
        """Squared length."""
        return dot(self, self)

    @property
    def length(self) -> Number:
        """Length."""
        return root(self.square)


Node = Number | Arrow


def number(value: Number | float) -> Number:
    """A constant as a number; a number as it is."""
    return value if isinstance(value, Number) else Number(Op.CONSTANT, value=float(value))


def root(square: Number) -> Number:
    """Square root."""
    return Number(Op.ROOT, (square,))


def dot(a: Arrow, b: Arrow) -> Number:
    """Scalar product."""
    return Number(Op.DOT, (a, b))


def cross(a: Arrow, b: Arrow) -> Arrow:
    """Vector product."""
    return Arrow(Op.CROSS, (a, b))


def arc(sine: Number, cosine: Number) -> Number:
    """Angle from 0 to pi [rad] of a sine that is not negative and a cosine, both times any length."""
    return Number(Op.ARC, (sine, cosine))


def choice(condition: Number, positive: Number | float, otherwise: Number | float) -> Number:
    """One of two numbers, by whether a condition is above zero."""
    return Number(Op.CHOOSE, (condition, number(positive), number(otherwise)))


def largest_component(vector: Arrow) -> Number:
    """Largest of the three components, without their signs; without slopes."""
    return Number(Op.LARGEST_COMPONENT, (vector,))


def lesser(a: Number, b: Number) -> Number:
    """The lesser of two numbers; without slopes."""
    return Number(Op.LEAST, (a, b))


def greater(a: Number, b: Number) -> Number:
    """The greater of two numbers; without slopes."""
    return Number(Op.GREATEST, (a, b))


def extreme(value: Number, items: Sequence[Number], slopes: Sequence[Number]) -> Number:
    """A value whose slopes by some items are known."""
    return Number(Op.EXTREME, (value, *items, *slopes))


def ordered(outputs: Iterable[Node]) -> list[Node]:
    """All nodes that the outputs are made of, operands first."""
    seen: set[int] = set()
    order: list[Node] = []
    pending = [(node, False) for node in reversed(list(outputs))]
    while pending:
        node, is_complete = pending.pop()
        if is_complete:
            order.append(node)
        elif id(node) not in seen:
            seen.add(id(node))
            pending.append((node, True))
            operands = node.operands[:1] if node.op is Op.EXTREME else node.operands
            pending.extend((operand, False) for operand in reversed(operands))
    return order
