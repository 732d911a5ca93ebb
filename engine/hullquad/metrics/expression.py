"""Formulas as expressions of numbers and vectors, and the expressions of their slopes.

A formula is written once, as mathematics; its slopes follow from the chain rule, applied from the value backwards.
Quotients and roots are defined everywhere: what a number is divided by, or the root's derivative is, counts only
where it is above zero.
"""

from collections.abc import Iterable, Sequence
from enum import IntEnum
from math import nan

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
    """Of four."""
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
    TIES = 25
    """Of the four after the first, which are equal to it: 1 over how many, else 0; 0 where none is. Without slopes.

    The share of the second operand; those of the other three follow.
    """
    SHRINKING_3 = 26
    SHRINKING_4 = 27
    """1 over the largest component of the edges between so many points; 0 where there is none. Without slopes."""
    SHRUNK_EDGE = 28
    """A number times the way to the second vector from the third; what is not finite is 0. Without slopes."""
    OPENNESS_3 = 29
    OPENNESS_4 = 30
    """1 where every corner between so many edges is open and the element faces the first operand, else 0.

    The squares of the edges follow, and those of a quad's diagonals. Without slopes.
    """
    PART = 31
    """One of the numbers that follow the operand."""


@attrs.frozen(eq=False)
class Number:
    """A number of each element."""

    op: Op
    operands: tuple["Node", ...] = ()
    value: float = 0.0
    """Of a constant; which one of an input or of several numbers."""

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
        first, second = self, number(other)
        if second.op is Op.CONSTANT:
            first, second = second, first
        if first.is_one:
            return second
        if first.op is Op.CONSTANT and second.op is Op.NEGATE:
            return Number(Op.MULTIPLY, (number(-first.value), *second.operands))
        return Number(Op.MULTIPLY, (first, second))

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


_NOTHING = Number(Op.CONSTANT, value=nan)
"""What is equal to no number."""


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


def part(whole: Number, which: int) -> Number:
    """One of the numbers, counted from 1, that follow another one."""
    return Number(Op.PART, (whole,), which)


def shrinking(points: Sequence[Arrow]) -> Number:
    """1 over the largest component of the edges between three or four points; 0 where there is none."""
    return Number(Op.SHRINKING_3 if len(points) == 3 else Op.SHRINKING_4, tuple(points))


def shrunk_edge(factor: Number, start: Arrow, end: Arrow) -> Arrow:
    """A number times the way from one point to another; what is not finite is 0."""
    return Arrow(Op.SHRUNK_EDGE, (factor, end, start))


def openness(sides: Sequence[Arrow], facing: Arrow) -> Number:
    """1 where every corner is open (convex, not collapsed) and the element faces as it must, else 0."""
    return Number(Op.OPENNESS_3 if len(sides) == 3 else Op.OPENNESS_4, (facing, *sides))


def lesser(a: Number, b: Number) -> Number:
    """The lesser of two numbers; without slopes."""
    return lowest([a, b])


def lowest(numbers: Sequence[Number]) -> Number:
    """The least of up to four numbers; without slopes."""
    return Number(Op.LEAST, (*numbers, *[numbers[-1]] * (4 - len(numbers))))


def highest(numbers: Sequence[Number]) -> Number:
    """The greatest of up to four numbers; without slopes."""
    return Number(Op.GREATEST, (*numbers, *[numbers[-1]] * (4 - len(numbers))))


def ties(value: Number, items: Sequence[Number]) -> list[Number]:
    """Equal shares of those, of up to four numbers, that are a value; 0 of the others."""
    first = Number(Op.TIES, (value, *items, *[_NOTHING] * (4 - len(items))))
    return [first, *(part(first, which) for which in range(1, len(items)))]


def doubled(value: Number) -> Number:
    """Twice a number; of a product twice its first factor, which other products may have, too."""
    if value.op is Op.CONSTANT:
        return number(2.0 * value.value)
    first = value.operands[0] if value.op is Op.MULTIPLY else None
    return Number(Op.MULTIPLY, (doubled(first), *value.operands[1:])) if isinstance(first, Number) else value + value


def extreme(value: Number, items: Sequence[Number], slopes: Sequence[Number]) -> Number:
    """A value whose slopes by some items are known."""
    return Number(Op.EXTREME, (value, *items, *slopes))


def ordered(outputs: Iterable[Node], given: Iterable[Node] = ()) -> list[Node]:
    """All nodes that the outputs are made of, operands first; what is given is not made of anything."""
    ends = {id(node) for node in given}
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
            pending.extend((operand, False) for operand in reversed(operands) if id(node) not in ends)
    return order
