"""Loops over all elements, compiled: blocks of elements are laid out in rows, and a program is run on them.

`normals` is the direction that elements must face: (1, 3) for a plane, (E, 3) one for each element, or a zero
row where an element's own sense is all that is known. `areas` is (2,): what sizes of quads and of triangles are
relative to.
"""

from math import inf

import numpy as np

from hullquad.arrays import Bools, Floats, Ints, Longs
from hullquad.metrics.compiled import compiled, inlined
from hullquad.metrics.machine import put, run
from hullquad.metrics.program import LANES, Program
from hullquad.metrics.vectors import vector

_LINE = 8
"""Numbers in a cache line."""


@compiled
def judge(
    program: Program, is_triangle: bool, points: Floats, elements: Ints, normals: Floats, area: float,
    factors: Floats, invalid: Floats, values: Floats, valid: Bools,
) -> int:  # fmt: skip
    """Values (E, M) and validity (E,) of the elements of one kind by a program; how many there are.

    Values are multiplied by `factors` (M,). `invalid` is (M, 2): between what the value of an invalid one is kept.
    """
    lanes, rows = np.empty(LANES, dtype=np.int64), rows_of(program)
    count, start, done = len(program.outputs) - 1, 0, 0
    while start < len(elements):
        filled, start = next_lanes(elements, is_triangle, start, lanes)
        done += filled
        load(program, rows, points, elements, normals, area, lanes, filled)
        run(program.steps, rows)
        is_open = np.uint64(program.outputs[count])
        for i in range(np.uint64(filled)):
            valid[np.uint64(lanes[i])] = rows[is_open + i] > 0.0
        for k in range(count):
            row, factor, least, most = np.uint64(program.outputs[k]), factors[k], invalid[k, 0], invalid[k, 1]
            for i in range(np.uint64(filled)):
                value = factor * rows[row + i]
                below = value if value < most else most
                kept = below if below > least else least
                values[np.uint64(lanes[i]), np.uint64(k)] = value if rows[is_open + i] > 0.0 else kept
    return done


@compiled
def slopes(
    program: Program, points: Floats, elements: Ints, normals: Floats, area: float, factor: float,
    values: Floats, gradients: Floats,
) -> None:  # fmt: skip
    """Values (E,) and slopes (E, 4 or 3, 3) of elements of one kind, both times `factor`; slopes of no size are 0."""
    lanes = np.empty(LANES, dtype=np.int64)
    rows, nodes = rows_of(program), gradients.shape[1]
    for start in range(0, len(elements), LANES):
        filled = min(LANES, len(elements) - start)
        for i in range(filled):
            lanes[i] = start + i
        load(program, rows, points, elements, normals, area, lanes, filled)
        run(program.steps, rows)
        for i in range(filled):
            values[start + i] = factor * rows[program.outputs[0] + i]
        for node in range(nodes):
            row = np.uint64(program.outputs[1 + node])
            for i in range(np.uint64(filled)):
                element = np.uint64(start) + i
                for axis in range(np.uint64(3)):
                    slope = factor * rows[row + axis * np.uint64(LANES) + i]
                    gradients[element, np.uint64(node), axis] = slope if -inf < slope < inf else 0.0


@compiled
def differences(
    program: Program, points: Floats, quads: Ints, normals: Floats, area: float, tangents: Floats, step: float,
    gradient: Floats,
) -> None:  # fmt: skip
    """Central differences of the sum of values by the nodes' parameters, added to `gradient` (N, 2).

    Every corner of every quad is moved by `step` either way along its two tangents (N, 2, 3): eight pairs of
    evaluations of the whole mesh, whatever the number of nodes.
    """
    lanes, ahead = np.empty(LANES, dtype=np.int64), np.empty(LANES)
    rows = rows_of(program)
    for start in range(0, len(quads), LANES):
        filled = min(LANES, len(quads) - start)
        for i in range(filled):
            lanes[i] = start + i
        load(program, rows, points, quads, normals, area, lanes, filled)
        for corner in range(4):
            row = program.inputs[corner]
            for direction in range(2):
                for sign in (1.0, -1.0, 0.0):
                    for i in range(filled):
                        node = quads[start + i, corner]
                        for axis in range(3):
                            shift = sign * step * tangents[node, direction, axis]
                            rows[row + axis * LANES + i] = points[node, axis] + shift
                    if sign != 0.0:
                        run(program.steps, rows)
                        for i in range(filled):
                            value = rows[program.outputs[0] + i]
                            if sign > 0.0:
                                ahead[i] = value
                            else:
                                gradient[quads[start + i, corner], direction] += (ahead[i] - value) / (2.0 * step)


@compiled
def rows_of(program: Program) -> Floats:
    """Rows for a program to run on, its constants in place.

    They begin where a cache line does: vectors across two lines take twice the time.
    """
    room = np.empty(program.length + _LINE)
    first = -(room.ctypes.data // room.itemsize) % _LINE
    rows = room[first : first + program.length]
    for k in range(len(program.inputs)):
        row = max(program.inputs[k], 0)
        rows[row : min(row + 3 * LANES, program.length)] = 0.0  # lanes without an element work on these
    for k in range(len(program.constants)):
        row = program.constant_rows[k]
        rows[row : row + LANES] = program.constants[k]
    return rows


@inlined
def next_lanes(elements: Ints, is_triangle: bool, start: int, lanes: Longs) -> tuple[int, int]:
    """Fill `lanes` with the next elements of one kind; how many there were, and where to go on."""
    filled = 0
    while start < len(elements) and filled < LANES:
        lanes[np.uint64(filled)] = start
        filled += 1 if (elements[np.uint64(start), np.uint64(3)] < 0) == is_triangle else 0
        start += 1
    return filled, start


@inlined
def load(
    program: Program, rows: Floats, points: Floats, elements: Ints, normals: Floats, area: float,
    lanes: Longs, filled: int,
) -> None:  # fmt: skip
    """Lay out the points of some elements, what they must face and what their areas are relative to."""
    nodes = len(program.inputs) - 2
    for node in range(nodes):
        if program.inputs[node] < 0:
            return  # nothing is made of the points
    a, b, c = np.uint64(program.inputs[0]), np.uint64(program.inputs[1]), np.uint64(program.inputs[2])
    d = np.uint64(program.inputs[nodes - 1])
    for i in range(np.uint64(filled)):
        element = np.uint64(lanes[i])
        put(rows, a + i, vector(points, np.uint64(elements[element, np.uint64(0)])))
        put(rows, b + i, vector(points, np.uint64(elements[element, np.uint64(1)])))
        put(rows, c + i, vector(points, np.uint64(elements[element, np.uint64(2)])))
        put(rows, d + i, vector(points, np.uint64(elements[element, np.uint64(nodes - 1)])))
    row, each = program.inputs[nodes], len(normals) > 1
    if row >= 0:
        for i in range(filled):
            normal = lanes[i] if each else 0
            rows[row + i] = normals[normal, 0]
            rows[row + LANES + i] = normals[normal, 1]
            rows[row + 2 * LANES + i] = normals[normal, 2]
    row = program.inputs[nodes + 1]
    if row >= 0:
        rows[row : row + LANES] = area
