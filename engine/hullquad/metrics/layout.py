"""Blocks of elements laid out in rows, for a program to run on: sides, and the directions that they must face."""

import numpy as np
import numpy.typing as npt

from hullquad.arrays import Floats, Ints
from hullquad.metrics.compiled import woven
from hullquad.metrics.program import LANES, Program

Lanes = npt.NDArray[np.uint64]
"""Which elements are worked on side by side."""

ROW, SIDE, SIDES = np.uint64(LANES), np.uint64(3 * LANES), np.uint64(12 * LANES)  # no place is below 0
"""Numbers in the row of a number, in those of a side, and in those of all four sides."""
ONE, AXES = np.uint64(1), np.uint64(3)
_COORDINATES = np.uint64(12)
_SMALL, _LARGE = 2.0**-60, 2.0**60
"""Sizes between which no product of edges is too small or too large for a float."""
_EXPONENT, _GREATEST = np.uint64(52), np.uint64(2046)
"""Place of the exponent in the bits of a float, and the greatest one."""


@woven
def next_lanes(
    elements: Ints, is_triangle: bool, start: np.uint64, lanes: Lanes, is_mixed: bool
) -> tuple[np.uint64, np.uint64]:
    """Fill `lanes` with the next elements, of one kind if there are both; how many there were, and where to go on."""
    filled, end, length = np.uint64(0), start, np.uint64(len(elements))
    if is_mixed:
        while end < length and filled < ROW:
            lanes[filled] = end
            filled += ONE if (elements[end, AXES] < 0) == is_triangle else np.uint64(0)
            end += ONE
    else:
        filled = min(ROW, length - start)
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
        a, b = AXES * np.uint64(nodes[first]), AXES * np.uint64(nodes[first + ONE])
        c, d = AXES * np.uint64(nodes[first + np.uint64(2)]), AXES * np.uint64(max(nodes[first + last], 0))
        for axis in range(AXES):
            pa, pb, pc, pd = coordinates[a + axis], coordinates[b + axis], coordinates[c + axis], coordinates[d + axis]
            place = axis * ROW + i
            rows[place] = pb - pa
            rows[place + np.uint64(3) * ROW] = pc - pb
            rows[place + np.uint64(6) * ROW] = pd - pc
            rows[place + np.uint64(9) * ROW] = pa - pd
    is_usual = True
    for i in range(ROW):
        size = 0.0
        for k in range(_COORDINATES):
            size = max(size, abs(rows[k * ROW + i]))
        is_usual &= (size > _SMALL) & (size < _LARGE)
        rows[SIDES + i] = size
    if is_usual:
        rows[SIDES : SIDES + ROW] = 1.0
    else:
        _shrink(rows)
    return are_complete


@woven
def _shrink(rows: Floats) -> None:
    """Multiply the sides of each element by a power of 2; by 0 where they have no size or an infinite one."""
    words = rows.view(np.uint64)
    for i in range(ROW):
        exponent = words[SIDES + i] >> _EXPONENT
        is_finite = (rows[SIDES + i] > 0.0) & (exponent < _GREATEST)
        words[SIDES + i] = (_GREATEST - exponent) << _EXPONENT if is_finite else np.uint64(0)
    for k in range(_COORDINATES):
        for i in range(ROW):
            rows[k * ROW + i] *= rows[SIDES + i]


@woven
def face(program: Program, rows: Floats, normals: Floats, lanes: Lanes, filled: np.uint64) -> None:
    """Lay out the directions (E, 3) that some elements must face, if the program asks for them."""
    if program.inputs[0] >= 0:
        row = np.uint64(program.inputs[0])
        for i in range(filled):
            for axis in range(AXES):
                rows[row + axis * ROW + i] = normals[lanes[i], axis]


@woven
def face_all(program: Program, rows: Floats, normals: Floats) -> None:
    """Lay out the direction (1, 3) that all elements must face, if the program asks for it."""
    if program.inputs[0] >= 0:
        row = np.uint64(program.inputs[0])
        for axis in range(AXES):
            for i in range(ROW):
                rows[row + axis * ROW + i] = normals[0, axis]
