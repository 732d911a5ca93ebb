"""Expressions as a list of steps on rows of numbers, for the machine that works them out for many elements at once."""

from collections import Counter
from collections.abc import Sequence
from typing import NamedTuple

import numpy as np

from hullquad.arrays import Floats, Ints, floats, ints
from hullquad.metrics.expression import Arrow, Node, Number, Op, ordered

LANES = 64
"""Elements that are worked on side by side: length of a row."""

_Key = tuple[object, ...]
_JOINED = {Op.ADD: {Op.MULTIPLY: Op.MULTIPLY_ADD}, Op.ADD_VECTORS: {Op.SCALE: Op.SCALE_ADD, Op.CROSS: Op.CROSS_ADD}}
_WIDTH = 7
_LINE = 8
"""Numbers in a cache line."""
_ROWS = {Op.OPENNESS_3: 4, Op.OPENNESS_4: 7, Op.TIES: 4}
"""Of operations that give several numbers."""
_LASTING = {*_ROWS, Op.CONSTANT, Op.INPUT, Op.PART}
"""What keeps its rows."""


class Program(NamedTuple):
    """Steps that work out some expressions; a row is told by the place of its first number."""

    steps: Ints
    """(K, 7) operation, row of the result, rows of up to five operands; a vector has three rows."""
    constants: Floats
    """(C,)"""
    constant_rows: Ints
    """(C,) where they stand."""
    inputs: Ints
    """(I,) rows of the inputs, -1 of those that are not used."""
    outputs: Ints
    """(O,) rows of the results."""
    length: int
    """Numbers in all rows."""


def program(outputs: Sequence[Node], inputs: Sequence[Node], first: Sequence[Node] = ()) -> Program:
    """Steps that work out expressions of inputs; what occurs several times is worked out once.

    Of what is in `first`, used or not, the rows come first; it is given, too, whatever it is made of.
    """
    return _Assembly(outputs, inputs, first).program()


def rows_for(program: Program, reference: float) -> Floats:
    """Rows for a program of a judge to run on, with its constants and what areas are relative to in place.

    They begin where a cache line does: vectors across two lines take twice the time.
    """
    room = np.zeros(program.length + _LINE)
    first = -(room.ctypes.data // room.itemsize) % _LINE
    rows = room[first : first + program.length]
    table = rows.reshape(-1, LANES)
    table[program.constant_rows // LANES] = program.constants[:, None]
    if program.inputs[1] >= 0:
        table[program.inputs[1] // LANES] = reference
    return rows


class _Assembly:
    """Rows are used again once nothing needs them any more, but never for the result of a step that reads them."""

    def __init__(self, outputs: Sequence[Node], inputs: Sequence[Node], first: Sequence[Node]) -> None:
        self._given = {id(node) for node in (*inputs, *first)}
        self._known: dict[_Key, Node] = {}
        self._same: dict[int, Node] = {}
        self._order = [node for node in ordered(outputs, (*inputs, *first)) if self._is_new(node)]
        self._join_products_with_sums({id(self._same[id(node)]) for node in outputs})
        self._inputs = [self._same.get(id(node)) for node in inputs]
        self._outputs = [self._same[id(node)] for node in outputs]
        self._rows: dict[int, int] = {}
        self._free: dict[type, list[int]] = {Number: [], Arrow: []}
        self._length = 0
        for node in first:
            self._rows[id(node)] = self._new_row(node)

    def program(self) -> Program:
        constants = [node for node in self._order if node.op is Op.CONSTANT]
        for node in (*constants, *(node for node in self._inputs if node is not None)):
            self._rows[id(node)] = self._new_row(node)
        work = [node for node in self._order if node.op not in {Op.CONSTANT, Op.INPUT} and id(node) not in self._given]
        steps = self._steps(work)
        return Program(
            ints(np.array(steps, dtype=np.int32).reshape(-1, _WIDTH)),
            floats([node.value for node in constants]),
            ints([self._rows[id(node)] for node in constants]),
            ints([-1 if node is None else self._rows[id(node)] for node in self._inputs]),
            ints([self._rows[id(node)] for node in self._outputs]),
            self._length,
        )

    def _is_new(self, node: Node) -> bool:
        """Whether nothing alike was met before; an extreme is the same as its value."""
        if node.op is Op.EXTREME:
            self._same[id(node)] = self._same[id(node.operands[0])]
            return False
        is_given = id(node) in self._given and node.op is not Op.INPUT
        operands = (id(node),) if is_given else tuple(id(operand) for operand in self._operands(node))
        first = self._known.setdefault((type(node), node.op, node.value, operands), node)
        self._same[id(node)] = first
        return first is node

    def _join_products_with_sums(self, kept: set[int]) -> None:
        """Make one step of a product and the only sum that it is a part of."""
        uses = Counter(id(operand) for node in self._order for operand in self._operands(node))
        joined: dict[int, Node] = {}
        gone: set[int] = set()
        for node in self._order:
            for product, other in _both_ways(self._operands(node)) if node.op in _JOINED else ():
                op = _JOINED[node.op].get(product.op)
                if op is not None and uses[id(product)] == 1 and id(product) not in kept | gone:
                    joined[id(node)] = type(node)(op, (*product.operands, other))
                    gone.add(id(product))
                    break
        self._order = [joined.get(id(node), node) for node in self._order if id(node) not in gone]
        self._same = {key: joined.get(id(node), node) for key, node in self._same.items()}
        self._same |= {id(node): node for node in joined.values()}

    def _steps(self, work: list[Node]) -> list[list[int]]:
        last = {id(operand): number for number, node in enumerate(work) for operand in self._operands(node)}
        kept = {id(node) for node in self._outputs} | self._given
        steps = []
        for number, node in enumerate(work):
            operands = self._operands(node)
            rows = [self._rows[id(operand)] for operand in operands]
            if node.op is Op.PART:
                self._rows[id(node)] = rows[0] + int(node.value) * LANES
                continue
            row = self._rows[id(node)] = self._row(node)
            steps.append([int(node.op), row, *rows, *[0] * (_WIDTH - 2 - len(rows))])
            for done in {id(operand): operand for operand in operands}.values():
                if last[id(done)] == number and id(done) not in kept and done.op not in _LASTING:
                    self._free[type(done)].append(self._rows[id(done)])
        return steps

    def _operands(self, node: Node) -> list[Node]:
        return [] if id(node) in self._given else [self._same[id(operand)] for operand in node.operands]

    def _row(self, node: Node) -> int:
        free = self._free[type(node)]
        return free.pop() if free and node.op not in _ROWS else self._new_row(node)

    def _new_row(self, node: Node) -> int:
        row = self._length
        self._length += LANES * _ROWS.get(node.op, 3 if isinstance(node, Arrow) else 1)
        return row


def _both_ways(pair: list[Node]) -> tuple[tuple[Node, Node], tuple[Node, Node]]:
    first, second = pair
    return (first, second), (second, first)
