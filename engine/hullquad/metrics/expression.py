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
    SQUARE = 17
    LENGTH = 18
    NEGATE = 19
    NEGATE_VECTOR = 20
    EXTREME = 21
    """First; its slopes by the following n are given as the n after them."""
    MULTIPLY_ADD = 22
    """First times second, plus third."""
    SCALE_ADD = 23
    """The same of a number and two vectors."""
    CROSS_ADD = 24
    """Vector product of the first two, plus third."""
    EQUAL = 25
    """1 where two numbers are equal, else 0. Without slopes."""
    SHRINKING_3 = 26
    SHRINKING_4 = 27
    """1 over the largest component of the edges between so many points; 0 where there is none. Without slopes."""
    SHRUNK_EDGE = 28
    """A number times the way to the second vector from the third. Without slopes."""
    OPENNESS_3 = 29
    OPENNESS_4 = 30
    """1 where every corner between so many edges is open and the element faces the first operand, else 0."""


@attrs.frozen(eq=False)
class Number:
    """A number of each element."""

    op: Op
    operands: tuple["Node", ...] = ()
    value: float = 0.0
    """Of a constant; which one of an input."""

    def __add__(self, other: "Number | float") -> "Number":
        other = number(other)
        if other.op is Op.NEGATE:
            return Number(Op.SUBTRACT, (self, *other.operands))
        return Number(Op.ADD, (self, other))

    __radd__ = __add__

    def __sub__(self, other: "Number | float") -> "Number":
        return Number(Op.SUBTRACT, (self, number(other)))

    def __rsub__(self, other: float) -> "Number":
        return number(other) - self

    def __mul__(self, other: "Number | float") -> "Number":
        if isinstance(other, Arrow):  # which knows how to be multiplied
            return NotImplemented
        other = number(other)
        if self.is_one:
            return other
        return self if other.is_one else Number(Op.MULTIPLY, (self, other))

    __rmul__ = __mul__

    def __truediv__(self, other: "Number | float") -> "Number":
        return self.over(number(other), 0.0)

    def __rtruediv__(self, other: float) -> "Number":
        return number(other) / self

    def __neg__(self) -> "Number":
        return Number(Op.NEGATE, (self,))

    @property
    def is_one(self) -> bool:
        """Whether it is the constant 1."""
        return self.op is Op.CONSTANT and self.value == 1.0

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
        if other.op is Op.NEGATE_VECTOR:
            return Arrow(Op.SUBTRACT_VECTORS, (self, *other.operands))
        return Arrow(Op.ADD_VECTORS, (self, other))

    def __sub__(self, other: "Arrow") -> "Arrow":
        return Arrow(Op.SUBTRACT_VECTORS, (self, other))

    def __rmul__(self, factor: "Number | float") -> "Arrow":
        factor = number(factor)
        return self if factor.is_one else Arrow(Op.SCALE, (factor, self))

    def __neg__(self) -> "Arrow":
        return Arrow(Op.NEGATE_VECTOR, (self,))

    @property
    def square(self) -> Number:
        """Squared length."""
        return Number(Op.SQUARE, (self,))

    @property
    def length(self) -> Number:
        """Length."""
        return Number(Op.LENGTH, (self,))


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


def shrinking(points: Sequence[Arrow]) -> Number:
    """1 over the largest component of the edges between three or four points; 0 where there is none."""
    return Number(Op.SHRINKING_3 if len(points) == 3 else Op.SHRINKING_4, tuple(points))


def shrunk_edge(factor: Number, start: Arrow, end: Arrow) -> Arrow:
    """A number times the way from one point to another."""
    return Arrow(Op.SHRUNK_EDGE, (factor, end, start))


def openness(sides: Sequence[Arrow], facing: Arrow) -> Number:
    """1 where every corner is open (convex, not collapsed) and the element faces as it must, else 0."""
    return Number(Op.OPENNESS_3 if len(sides) == 3 else Op.OPENNESS_4, (facing, *sides))


def lesser(a: Number, b: Number) -> Number:
    """The lesser of two numbers; without slopes."""
    return Number(Op.LEAST, (a, b))


def greater(a: Number, b: Number) -> Number:
    """The greater of two numbers; without slopes."""
    return Number(Op.GREATEST, (a, b))


def equal(a: Number, b: Number) -> Number:
    """1 where two numbers are equal, else 0."""
    return Number(Op.EQUAL, (a, b))


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
