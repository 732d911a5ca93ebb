"""Two triangles side by side made quads: one if that is good, else two or three together with a quad beside them.

The two triangles and the quad are a hexagon, which two quads fill, or three around a new node: so triangles go from a
corner where the contour runs straight on beside them.
"""

from math import inf

from hullquad.metrics.compiled import called, woven
from hullquad.quads.changes import divide, fill_hexagon
from hullquad.quads.draft import NONE, Draft, corner_count, element_across, node_after
from hullquad.quads.trial import FULLY, NEVER, TWO_RINGS, Change, Ground, attempt, clear, remove

_FILLINGS = 5


@woven
def united(made: Draft, wish: Change, floor: Ground, one: int, other: int) -> bool:
    """Make quads of two triangles with a common edge; whether there is a way."""
    for corner in range(3):
        start, end = made.elements[one, corner], made.elements[one, (corner + 1) % 3]
        if element_across(made, one, start, end) == other:
            divide(made, wish, one, start, 0)
            if attempt(made, wish, floor, TWO_RINGS, FULLY, NEVER) > NEVER:
                return True
            return _united_with_quad(made, wish, floor, one, other)
    return False


@woven
def _united_with_quad(made: Draft, wish: Change, floor: Ground, one: int, other: int) -> bool:
    """Fill the best of the hexagons that two triangles are with a quad beside them, in the best way."""
    best, best_side, best_filling = NEVER, NONE, NONE
    for side in range(6):
        for filling in range(_FILLINGS):
            if _propose(made, wish, one, other, side, filling):
                gain = attempt(made, wish, floor, TWO_RINGS, FULLY, inf)
                if gain > best:
                    best, best_side, best_filling = gain, side, filling
    if best_side < 0 or not _propose(made, wish, one, other, best_side, best_filling):
        return False
    return attempt(made, wish, floor, TWO_RINGS, FULLY, NEVER) > NEVER


@called
def _propose(made: Draft, wish: Change, one: int, other: int, side: int, filling: int) -> bool:
    """Write a filling of the hexagon beyond one of the triangles' six sides into `wish`; False where there is none."""
    clear(wish)
    triangle, twin = (one, other) if side < 3 else (other, one)
    elements = made.elements
    start = elements[triangle, side % 3]
    end = node_after(elements, triangle, start, 1)
    quad = element_across(made, triangle, start, end)
    if quad < 0 or corner_count(elements, quad) == 3:
        return False
    tip = node_after(elements, triangle, end, 1)
    x, y = node_after(elements, quad, start, 1), node_after(elements, quad, start, 2)
    ring = (end, node_after(elements, twin, end, 1), tip, start, x, y)
    if element_across(made, triangle, end, tip) != twin:
        ring = (end, tip, node_after(elements, twin, tip, 1), start, x, y)
    remove(wish, triangle)
    remove(wish, twin)
    remove(wish, quad)
    return fill_hexagon(made, wish, ring, filling)
