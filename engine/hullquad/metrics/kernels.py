"""The loops over all elements, compiled: blocks of elements are laid out in rows, and a program is run on them."""

import numpy as np
import numpy.typing as npt

from hullquad.arrays import Bools, Floats, Ints
from hullquad.metrics.compiled import compiled, inlined, woven
from hullquad.metrics.machine import run
from hullquad.metrics.program import LANES, Program

Lanes = npt.NDArray[np.uint64]
"""Which elements are worked on side by side."""

_ONE, _AXES, _COORDINATES = np.uint64(1), np.uint64(3), np.uint64(12)  # no place is below 0
_ROW, _SIDE, _SIDES = np.uint64(LANES), np.uint64(3 * LANES), np.uint64(12 * LANES)
_SMALL, _LARGE = 2.0**-60, 2.0**60
"""Sizes between which no product of edges is too small or too large for a float."""
_EXPONENT, _GREATEST = np.uint64(52), np.uint64(2046)
"""Place of the exponent in the bits of a float, and the greatest one."""


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
        if filled > 0 and lanes[filled - _ONE] - lanes[0] == filled - _ONE:  # the usual case, many at once
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
    for start in range(np.uint64(0), np.uint64(len(quads)), _ROW):
        filled = min(_ROW, np.uint64(len(quads)) - start)
        for i in range(filled):
            lanes[i] = start + i
        lay_out(rows, points, quads, _AXES, lanes, filled)
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
        first = _SIDE * ((corner + _AXES * side) % np.uint64(4))
        for axis in range(_AXES):
            for i in range(_ROW):
                kept[side, axis, i] = rows[first + axis * _ROW + i]


@woven
def move(
    rows: Floats, corner: int | np.uint64, kept: Floats, quads: Ints, tangents: Floats, direction: int | np.uint64,
    way: float, lanes: Lanes, filled: np.uint64,
) -> None:  # fmt: skip
    """Lay out these sides as they are with the corner moved so far along one of its tangents."""
    begins, ends = _SIDE * corner, _SIDE * ((corner + _AXES) % np.uint64(4))
    for i in range(filled):
        node, length = quads[lanes[i], corner], way * rows[_SIDES + i]
        for axis in range(_AXES):
            shift, place = length * tangents[node, direction, axis], axis * _ROW + i
            rows[begins + place] = kept[np.uint64(0), axis, i] - shift
            rows[ends + place] = kept[np.uint64(1), axis, i] + shift


@inlined
def judged(value: float, openness: float, least: float, most: float) -> float:
    """The value of an open element; of another one what is nearest to it between two bounds."""
    below = value if value < most else most
    kept = below if below > least else least
    return value if openness > 0.0 else kept


@woven
def next_lanes(
    elements: Ints, is_triangle: bool, start: np.uint64, lanes: Lanes, is_mixed: bool
) -> tuple[np.uint64, np.uint64]:
    """Fill `lanes` with the next elements, of one kind if there are both; how many there were, and where to go on."""
    filled, end, length = np.uint64(0), start, np.uint64(len(elements))
    if is_mixed:
        while end < length and filled < _ROW:
            lanes[filled] = end
            filled += _ONE if (elements[end, _AXES] < 0) == is_triangle else np.uint64(0)
            end += _ONE
    else:
        filled = min(_ROW, length - start)
        end = start + filled
        for i in range(filled):
            lanes[i] = start + i
    return filled, end


@woven
def lay_out(rows: Floats, points: Floats, elements: Ints, last: np.uint64, lanes: Lanes, filled: np.uint64) -> bool:
    """Lay out the sides of some elements; whether all of them have a node in the column `last`: the first in triangles.

    They are in the first twelve rows; what they were multiplied by is in the next one: 1, or where their size is
    unusual a power of 2, so that this changes no digit of anything.
    """
    coordinates, nodes, width = points.reshape(-1), elements.reshape(-1), np.uint64(elements.shape[1])
    are_complete = True
    for i in range(filled):
        first = width * lanes[i]
        are_complete &= nodes[first + last] >= 0
        a, b = _AXES * np.uint64(nodes[first]), _AXES * np.uint64(nodes[first + _ONE])
        c, d = _AXES * np.uint64(nodes[first + np.uint64(2)]), _AXES * np.uint64(max(nodes[first + last], 0))
        for axis in range(_AXES):
            pa, pb, pc, pd = coordinates[a + axis], coordinates[b + axis], coordinates[c + axis], coordinates[d + axis]
            place = axis * _ROW + i
            rows[place] = pb - pa
            rows[place + np.uint64(3) * _ROW] = pc - pb
            rows[place + np.uint64(6) * _ROW] = pd - pc
            rows[place + np.uint64(9) * _ROW] = pa - pd
    is_usual = True
    for i in range(_ROW):
        size = 0.0
        for k in range(_COORDINATES):
            size = max(size, abs(rows[k * _ROW + i]))
        is_usual &= (size > _SMALL) & (size < _LARGE)
        rows[_SIDES + i] = size
    if is_usual:
        rows[_SIDES : _SIDES + _ROW] = 1.0
    else:
        _shrink(rows)
    return are_complete


@woven
def _shrink(rows: Floats) -> None:
    """Multiply the sides of each element by a power of 2; by 0 where they have no size or an infinite one."""
    words = rows.view(np.uint64)
    for i in range(_ROW):
        exponent = words[_SIDES + i] >> _EXPONENT
        is_finite = (rows[_SIDES + i] > 0.0) & (exponent < _GREATEST)
        words[_SIDES + i] = (_GREATEST - exponent) << _EXPONENT if is_finite else np.uint64(0)
    for k in range(_COORDINATES):
        for i in range(_ROW):
            rows[k * _ROW + i] *= rows[_SIDES + i]


@woven
def face(program: Program, rows: Floats, normals: Floats, lanes: Lanes, filled: np.uint64) -> None:
    """Lay out the directions (E, 3) that some elements must face, if the program asks for them."""
    if program.inputs[0] >= 0:
        row = np.uint64(program.inputs[0])
        for i in range(filled):
            for axis in range(_AXES):
                rows[row + axis * _ROW + i] = normals[lanes[i], axis]


@woven
def face_all(program: Program, rows: Floats, normals: Floats) -> None:
    """Lay out the direction (1, 3) that all elements must face, if the program asks for it."""
    if program.inputs[0] >= 0:
        row = np.uint64(program.inputs[0])
        for axis in range(_AXES):
            for i in range(_ROW):
                rows[row + axis * _ROW + i] = normals[0, axis]
