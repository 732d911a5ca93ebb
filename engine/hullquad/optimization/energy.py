"""What a minimiser makes smaller, compiled: a sum over all elements of a program's value, whatever the program is."""

from typing import NamedTuple

import numpy as np

from hullquad.arrays import Floats, Ints, floats, ints
from hullquad.metrics.compiled import compiled, inlined
from hullquad.metrics.machine import run
from hullquad.metrics.program import LANES, Program

_LINE = 8
"""Numbers in a cache line."""
_FACING, _REFERENCE, _WEIGHT, _VALUE, _OPENNESS, _SLOPES = 4, 5, 6, 7, 8, 9
"""Columns of `Code.ports` after those of the nodes."""


class Elements(NamedTuple):
    """The elements of a problem, and the directions that they must face."""

    nodes: Ints
    """(E, 4) quads first; a triangle ends with -1."""
    quads: int
    """How many are quads."""
    facing: Floats
    """(1, 3), or (E, 3) one for each."""
    weights: Floats
    """(E,) last input of the programs: how much each element counts in some energies."""


class Code(NamedTuple):
    """Four programs in one: for quads, for triangles, and for those of either that have little openness.

    Each gives value, openness, and slopes by the nodes if it has any.
    """

    steps: Ints
    """(S, 7) of all programs."""
    firsts: Ints
    """(5,) where those of each begin, and the end."""
    ports: Ints
    """(4, 13) rows of each program's inputs (four nodes, facing, reference, weight) and outputs; -1 for none."""
    constants: Floats
    """(C,)"""
    constant_rows: Ints
    """(C,)"""
    length: int
    """Numbers in all rows."""


class Energy(NamedTuple):
    """What elements cost."""

    code: Code
    low: float
    """Openness from which on elements cost nothing by the programs for little openness."""
    of_quads: float
    """Reference input of the programs for quads."""
    of_triangles: float
    size: float
    """Element size [mm]."""
    guard: float
    """Openness below which elements must keep most of what they have; -inf: elements may even be folded."""
    kept: float
    """Part of its openness that an element below the guard must keep in one step."""


def code(programs: tuple[Program, Program, Program, Program]) -> Code:
    """Four programs in one, on rows of their own."""
    shifts = np.cumsum([0, *(program.length for program in programs)])
    pairs = list(zip(programs, shifts.tolist(), strict=False))
    return Code(
        ints(np.concatenate([program.steps + np.array([0, *[shift] * 6]) for program, shift in pairs])),
        ints(np.cumsum([0, *(len(program.steps) for program in programs)])),
        ints([_ports(program, shift) for program, shift in pairs]),
        floats(np.concatenate([program.constants for program in programs])),
        ints(np.concatenate([program.constant_rows + shift for program, shift in pairs])),
        int(shifts[-1]),
    )


def _ports(program: Program, shift: int) -> list[int]:
    *nodes, facing, reference, weight = program.inputs.tolist()
    value, openness, *by_nodes = program.outputs.tolist()
    rows = [*_padded(nodes), facing, reference, weight, value, openness, *_padded(by_nodes)]
    return [row + shift if row >= 0 else -1 for row in rows]


def _padded(rows: list[int]) -> list[int]:
    return [*rows, *[-1] * (4 - len(rows))]


@inlined
def rows_for(energy: Energy) -> Floats:
    """Rows for the programs to work on, constants and references in place, beginning where a cache line does."""
    code = energy.code
    room = np.empty(code.length + _LINE)
    first = -(room.ctypes.data // room.itemsize) % _LINE
    rows = room[first : first + code.length]
    for program in range(4):
        for port in range(_VALUE):
            if code.ports[program, port] >= 0:
                value = 0.0  # lanes without an element work on it
                if port == _REFERENCE:
                    value = energy.of_quads if program % 2 == 0 else energy.of_triangles
                for i in range(LANES if port > _FACING else 3 * LANES):
                    rows[code.ports[program, port] + i] = value
    for k in range(len(code.constants)):
        for i in range(LANES):
            rows[code.constant_rows[k] + i] = code.constants[k]
    return rows


@compiled
def total_at(
    points: Floats, elements: Elements, energy: Energy, rows: Floats, before: Floats, openness: Floats, gradient: Floats
) -> tuple[float, bool]:
    """The energy, and whether a step to here would spoil an element.

    `before` and `openness` (E,) are the elements' openness where the step began, and here; the gradient by the points
    is written to `gradient` (K, 3).
    """
    for node in range(len(gradient)):
        gradient[node, 0] = gradient[node, 1] = gradient[node, 2] = 0.0
    total, spoils = 0.0, False
    for kind in range(2):
        first, end = (0, elements.quads) if kind == 0 else (elements.quads, len(elements.nodes))
        for start in range(first, end, LANES):
            filled, is_low = min(LANES, end - start), False
            for program in range(kind, 4, 2):
                if program < 2 or is_low:
                    _lay_out(points, elements, energy.code.ports, program, rows, start, filled)
                    run(energy.code.steps[energy.code.firsts[program] : energy.code.firsts[program + 1]], rows)
                    total += _gather(elements, energy.code.ports, program, rows, start, filled, gradient)
                if program < 2:
                    row = energy.code.ports[program, _OPENNESS]
                    for i in range(filled):
                        openness[start + i] = rows[row + i]
                        is_low |= not rows[row + i] >= energy.low
                        spoils |= is_spoilt(before[start + i], rows[row + i], energy.guard, energy.kept)
    return (total if -np.inf < total < np.inf else np.inf), spoils


@inlined
def _lay_out(
    points: Floats, elements: Elements, ports: Ints, program: int, rows: Floats, start: int, filled: int
) -> None:
    """Lay out what differs between the elements of a block: points, what they must face, their weights."""
    for corner in range(4):
        row = ports[program, corner]
        if row >= 0:
            for i in range(filled):
                node = elements.nodes[start + i, corner]
                for axis in range(3):
                    rows[row + axis * LANES + i] = points[node, axis]
    row = ports[program, _FACING]
    if row >= 0:
        for i in range(filled):
            for axis in range(3):
                rows[row + axis * LANES + i] = elements.facing[start + i if len(elements.facing) > 1 else 0, axis]
    row = ports[program, _WEIGHT]
    if row >= 0:
        for i in range(filled):
            rows[row + i] = elements.weights[start + i]


@inlined
def _gather(
    elements: Elements, ports: Ints, program: int, rows: Floats, start: int, filled: int, gradient: Floats
) -> float:
    """The energy of a block of elements; adds its slopes to the gradient."""
    total = 0.0
    for i in range(filled):
        total += rows[ports[program, _VALUE] + i]
    for corner in range(4):
        row = ports[program, _SLOPES + corner]
        if row >= 0:
            for i in range(filled):
                node = elements.nodes[start + i, corner]
                for axis in range(3):
                    gradient[node, axis] += rows[row + axis * LANES + i]
    return total


@inlined
def is_spoilt(before: float, after: float, guard: float, kept: float) -> bool:
    """Whether an element loses too much: it may get down to the guard; below, it must keep a part of what it has."""
    return after < guard and not after >= kept * min(before, guard)
