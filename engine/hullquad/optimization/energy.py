"""What a minimiser makes smaller, compiled: a sum over all elements of a program's value, whatever the program is."""

from typing import NamedTuple

import numpy as np

from hullquad.arrays import Floats, Ints
from hullquad.metrics import kernels
from hullquad.metrics.compiled import compiled, inlined, woven
from hullquad.metrics.machine import run
from hullquad.metrics.program import LANES, Program


class Elements(NamedTuple):
    """The elements of a problem, with the directions that they must face: (1, 3), or one for each."""

    quads: Ints
    """(Q, 4)"""
    triangles: Ints
    """(T, 3)"""
    quad_normals: Floats
    triangle_normals: Floats
    quad_weights: Floats
    """(Q,) last input of the programs: how much each element counts in some energies."""
    triangle_weights: Floats
    """(T,)"""


class Energy(NamedTuple):
    """What quads and what triangles cost; each program gives value, openness, and slopes by the nodes if it has any."""

    quads: Program
    triangles: Program
    low_quads: Program
    """What quads of little openness cost besides: run for blocks that have some."""
    low_triangles: Program
    low: float
    """Openness from which on they cost nothing besides."""
    parameters: tuple[float, float]
    """Reference input of the programs for quads, and of those for triangles."""
    size: float
    """Element size [mm]."""
    guard: float
    """Openness below which elements must keep most of what they have; -inf: elements may even be folded."""
    kept: float
    """Part of its openness that an element below the guard must keep in one step."""


class Rows(NamedTuple):
    """What the programs of an energy work on, constants and parameters in place."""

    quads: Floats
    triangles: Floats
    low_quads: Floats
    low_triangles: Floats


@woven
def rows_of(energy: Energy) -> Rows:
    """Rows for the programs of an energy."""
    of_quads, of_triangles = energy.parameters
    return Rows(
        _rows(energy.quads, of_quads), _rows(energy.triangles, of_triangles),
        _rows(energy.low_quads, of_quads), _rows(energy.low_triangles, of_triangles),
    )  # fmt: skip


@compiled
def energy_at(
    points: Floats, elements: Elements, energy: Energy, before: Floats, openness: Floats, gradient: Floats
) -> tuple[float, bool]:
    """The energy, and whether a step to here would spoil an element.

    `before` and `openness` (Q + T,) are the elements' openness where the step began, and here; the gradient by the
    points is written to `gradient` (K, 3).
    """
    return total_at(points, elements, energy, rows_of(energy), before, openness, gradient)


@compiled
def total_at(
    points: Floats, elements: Elements, energy: Energy, rows: Rows, before: Floats, openness: Floats, gradient: Floats
) -> tuple[float, bool]:
    """The same on rows that are there already."""
    gradient[:] = 0.0
    quads = len(elements.quads)
    of_quads, spoils = _sum_over(
        energy.quads, energy.low_quads, rows.quads, rows.low_quads, points, elements.quads, elements.quad_normals,
        elements.quad_weights, energy.low, energy.guard, energy.kept, before[:quads], openness[:quads], gradient,
    )  # fmt: skip
    of_triangles, spoils_too = _sum_over(
        energy.triangles, energy.low_triangles, rows.triangles, rows.low_triangles, points, elements.triangles,
        elements.triangle_normals, elements.triangle_weights, energy.low, energy.guard, energy.kept,
        before[quads:], openness[quads:], gradient,
    )  # fmt: skip
    total = of_quads + of_triangles
    return (total if np.isfinite(total) else np.inf), spoils or spoils_too


@compiled
def _sum_over(
    program: Program, low_program: Program, rows: Floats, low_rows: Floats, points: Floats, elements: Ints,
    normals: Floats, weights: Floats, low: float, guard: float, kept: float, before: Floats, openness: Floats,
    gradient: Floats,
) -> tuple[float, bool]:  # fmt: skip
    """The energy of elements of one kind."""
    total, spoils = 0.0, False
    for start in range(0, len(elements), LANES):
        filled = min(LANES, len(elements) - start)
        total += _run(program, rows, points, elements, normals, weights, start, filled, gradient)
        is_low = False
        for i in range(filled):
            openness[start + i] = rows[program.outputs[1] + i]
            is_low |= not openness[start + i] >= low
            spoils |= is_spoilt(before[start + i], openness[start + i], guard, kept)
        if is_low:
            total += _run(low_program, low_rows, points, elements, normals, weights, start, filled, gradient)
    return total, spoils


@compiled
def _run(
    program: Program, rows: Floats, points: Floats, elements: Ints, normals: Floats, weights: Floats,
    start: int, filled: int, gradient: Floats,
) -> float:  # fmt: skip
    """The energy of a block of elements; adds its slopes to the gradient."""
    _lay_out(program, rows, points, elements, normals, weights, start, filled)
    run(program.steps, rows)
    total = 0.0
    for i in range(filled):
        total += rows[program.outputs[0] + i]
    for node in range(len(program.outputs) - 2):
        row = program.outputs[2 + node]
        for i in range(filled):
            at = elements[start + i, node]
            for axis in range(3):
                gradient[at, axis] += rows[row + axis * LANES + i]
    return total


@inlined
def _lay_out(
    program: Program, rows: Floats, points: Floats, elements: Ints, normals: Floats, weights: Floats,
    start: int, filled: int,
) -> None:  # fmt: skip
    """Lay out what differs between the elements of a block: points, what they must face, their weights."""
    nodes, each = elements.shape[1], len(normals) > 1
    for node in range(nodes + 1):
        row = program.inputs[node]
        if row >= 0:
            for i in range(filled):
                for axis in range(3):
                    at = row + axis * LANES + i
                    if node < nodes:
                        rows[at] = points[elements[start + i, node], axis]
                    else:
                        rows[at] = normals[start + i if each else 0, axis]
    row = program.inputs[nodes + 2]
    if row >= 0:
        for i in range(filled):
            rows[row + i] = weights[start + i]


@compiled
def _rows(program: Program, parameter: float) -> Floats:
    """Rows for a program to work on, with the value of the input that is the same for all elements."""
    rows, row = kernels.rows_of(program), program.inputs[len(program.inputs) - 2]
    if row >= 0:
        rows[row : row + LANES] = parameter
    return rows


@inlined
def is_spoilt(before: float, after: float, guard: float, kept: float) -> bool:
    """Whether an element loses too much: it may get down to the guard; below, it must keep a part of what it has."""
    return after < guard and not after >= kept * min(before, guard)
