"""Slopes of expressions by the chain rule, from the value backwards."""

from collections.abc import Iterator, Sequence
from typing import Any

from hullquad.metrics.expression import Arrow, Node, Number, Op, choice, cross, dot, doubled, number, ordered


def slopes(value: Number, inputs: Sequence[Arrow]) -> list[Arrow]:
    """Derivatives of a value by some vectors that it is made of."""
    order = ordered([value])
    varies = _depending(order, inputs)
    found: dict[int, Any] = {id(value): number(1.0)}
    ends = {id(node) for node in inputs}
    for node in reversed(order):
        if id(node) in found and id(node) not in ends:
            for operand, part in _parts(node, found[id(node)]):
                if id(operand) in varies:
                    found[id(operand)] = found[id(operand)] + part if id(operand) in found else part
    return [found.get(id(node), 0.0 * node) for node in inputs]


def _depending(order: list[Node], inputs: Sequence[Arrow]) -> set[int]:
    """Nodes that change with the inputs."""
    varies = {id(node) for node in inputs}
    for node in order:
        if any(id(operand) in varies for operand in node.operands):
            varies.add(id(node))
    return varies


def _parts(node: Any, slope: Any) -> Iterator[tuple[Node, Any]]:  # noqa: PLR0912  a table of rules
    """Operands of a node, and what its slope adds to theirs."""
    match node.op, node.operands:
        case Op.ADD | Op.ADD_VECTORS, (a, b):
            yield from ((a, slope), (b, slope))
        case Op.SUBTRACT | Op.SUBTRACT_VECTORS, (a, b):
            yield from ((a, slope), (b, -slope))
        case Op.MULTIPLY, (a, b):
            yield from ((a, slope * b), (b, slope * a))
        case Op.DIVIDE, (a, b, otherwise):
            part = slope / b
            yield a, part
            yield b, -(part * node if otherwise.value == 0.0 else slope * node / b)  # infinite where b is not above 0
        case Op.ROOT, (a,):
            yield a, 0.5 * slope / node
        case Op.ABSOLUTE, (a,):
            yield a, slope * (a / node)
        case Op.CHOOSE, (condition, a, b):
            yield from ((a, choice(condition, slope, 0.0)), (b, choice(condition, 0.0, slope)))
        case Op.NEGATE | Op.NEGATE_VECTOR, (a,):
            yield a, -slope
        case Op.SQUARE, (a,):
            yield a, doubled(slope) * a
        case Op.LENGTH, (a,):
            yield a, (slope / node) * a
        case Op.ARC, (sine, cosine):
            square = sine * sine + cosine * cosine
            yield from ((sine, slope * (cosine / square)), (cosine, -(slope * (sine / square))))
        case Op.SCALE, (factor, a):
            yield from ((factor, dot(slope, a)), (a, factor * slope))
        case Op.DOT, (a, b):
            yield from ((a, slope * b), (b, slope * a))
        case Op.CROSS, (a, b):
            yield from ((a, cross(b, slope)), (b, cross(slope, a)))
        case Op.EXTREME, (_, *rest):
            weights = rest[len(rest) // 2 :]
            yield from ((item, slope * weight) for item, weight in zip(rest, weights, strict=False))
