"""The loops over all elements, compiled: blocks of elements are laid out in rows, and a program is run on them."""

import numpy as np

from hullquad.arrays import Bools, Floats, Ints
from hullquad.metrics.compiled import compiled, inlined, woven
from hullquad.metrics.layout import AXES, ONE, ROW, SIDE, SIDES, Lanes, face, face_all, lay_out, next_lanes
from hullquad.metrics.machine import run
from hullquad.metrics.program import LANES, Program


@compiled
def judge(
    program: Program, rows: Floats, is_triangle: bool, points: Floats, elements: Ints, normals: Floats,
    factors: Floats, invalid: Floats, values: Floats, valid: Bools,
) -> int:  # fmt: skip
    """Values (M, E) and validity (E,) of the elements of one kind by a program; how many there are.

    The program gives M values and openness. Values are multiplied by `factors` (M,). `invalid` is (M, 2): between
    what the value of an invalid element is kept. `normals` is (E, 3), or (1, 3) of all elements.
    """
    lanes = np.empty(LANES, dtype=np.uint64)
    count, start, done = len(program.outputs) - 1, np.uint64(0), np.uint64(0)
    last, is_open = np.uint64(0 if is_triangle else 3), np.uint64(program.outputs[count])
    flat, length = values.reshape(-1), np.uint64(len(elements))
    if len(normals) == 1:
        face_all(program, rows, normals)
    is_mixed = is_triangle
    while start < length:
        filled, end = next_lanes(elements, is_triangle, start, lanes, is_mixed)
        if not lay_out(rows, points, elements, last, lanes, filled):
            is_mixed = True
            continue  # with this block again
        start = end
        if len(normals) > 1:
            face(program, rows, normals, lanes, filled)
        run(program.steps, rows)
        if filled > 0 and lanes[filled - ONE] - lanes[0] == filled - ONE:  # the usual case, many at once
            first = lanes[0]
            for i in range(filled):
                valid[first + i] = rows[is_open + i] > 0.0
            for k in range(np.uint64(count)):
                row, to = np.uint64(program.outputs[k]), k * length + first
                factor, least, most = factors[k], invalid[k, 0], invalid[k, 1]
                for i in range(filled):
                    flat[to + i] = judged(factor * rows[row + i], rows[is_open + i], least, most)
        else:
            for i in range(filled):
                valid[lanes[i]] = rows[is_open + i] > 0.0
                for k in range(np.uint64(count)):
                    value, to = factors[k] * rows[np.uint64(program.outputs[k]) + i], k * length + lanes[i]
                    flat[to] = judged(value, rows[is_open + i], invalid[k, 0], invalid[k, 1])
        done += filled
    return int(done)


@compiled
def differences(
    program: Program, rows: Floats, points: Floats, quads: Ints, normals: Floats, tangents: Floats, step: float,
    gradient: Floats,
) -> None:  # fmt: skip
    """Central differences of the sum of values by the nodes' parameters, added to `gradient` (N, 2).

    Every corner of every quad is moved by `step` either way along its two tangents (N, 2, 3): eight pairs of
    evaluations of the whole mesh, whatever the number of nodes.
    """
    lanes, ahead, kept = np.empty(LANES, dtype=np.uint64), np.empty(LANES), np.empty((2, 3, LANES))
    value = np.uint64(program.outputs[0])
    if len(normals) == 1:
        face_all(program, rows, normals)
    for start in range(np.uint64(0), np.uint64(len(quads)), ROW):
        filled = min(ROW, np.uint64(len(quads)) - start)
        for i in range(filled):
            lanes[i] = start + i
        lay_out(rows, points, quads, AXES, lanes, filled)
        if len(normals) > 1:
            face(program, rows, normals, lanes, filled)
        for corner in range(np.uint64(4)):
            keep(rows, corner, kept)
            for direction in range(np.uint64(2)):
                for way in (step, -step, 0.0):
                    move(rows, corner, kept, quads, tangents, direction, way, lanes, filled)
                    if way != 0.0:
                        run(program.steps, rows)
                    for i in range(filled):
                        if way > 0.0:
                            ahead[i] = rows[value + i]
                        elif way < 0.0:
                            gradient[quads[lanes[i], corner], direction] += (ahead[i] - rows[value + i]) / (2.0 * step)


@woven
def keep(rows: Floats, corner: int | np.uint64, kept: Floats) -> None:
    """Keep the sides that begin and end at a corner of the quads, as (2, 3, LANES)."""
    for side in range(np.uint64(2)):
        first = SIDE * ((corner + AXES * side) % np.uint64(4))
        for axis in range(AXES):
            for i in range(ROW):
                kept[side, axis, i] = rows[first + axis * ROW + i]


@woven
def move(
    rows: Floats, corner: int | np.uint64, kept: Floats, quads: Ints, tangents: Floats, direction: int | np.uint64,
    way: float, lanes: Lanes, filled: np.uint64,
) -> None:  # fmt: skip
    """Lay out these sides as they are with the corner moved so far along one of its tangents."""
    begins, ends = SIDE * corner, SIDE * ((corner + AXES) % np.uint64(4))
    for i in range(filled):
        node, length = quads[lanes[i], corner], way * rows[SIDES + i]
        for axis in range(AXES):
            shift, place = length * tangents[node, direction, axis], axis * ROW + i
            rows[begins + place] = kept[np.uint64(0), axis, i] - shift
            rows[ends + place] = kept[np.uint64(1), axis, i] + shift


@inlined
def judged(value: float, openness: float, least: float, most: float) -> float:
    """The value of an open element; of another one what is nearest to it between two bounds."""
    below = value if value < most else most
    kept = below if below > least else least
    return value if openness > 0.0 else kept
