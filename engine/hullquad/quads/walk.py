r"""Two triangles that are far apart brought together: one walks to the other, a step at a time.

A triangle and the quad beside it are a pentagon. Divided anew it has its triangle elsewhere::

       .-------.            .-------.
      /|       |           /        |\
     / |       |    ->    /    ----' | \        so the triangle steps over the quad; the last step
     \ |       |          \ --'      | /        joins it with the other triangle.
      \|       |           '---------'
       '-------'

Every step is followed by smoothing and chosen by what it costs then; the way as a whole is judged by the caller.
"""

from math import inf

from hullquad.arrays import Longs
from hullquad.metrics.compiled import called, plain, woven
from hullquad.quads.changes import centre_pentagon, divide
from hullquad.quads.draft import NONE, Draft, corner_count, element_across, element_with_side
from hullquad.quads.trial import ADDED, FAIRLY, NEVER, ONE_RING, TWO_RINGS, WELL, Change, Ground, attempt
from hullquad.quads.uniting import united

_STEP_COST = 2.0
"""Energy that one element more on the way outweighs."""
DETOURS = 4
"""Steps that need not bring the triangle nearer."""
LOST, JOINED, GOING_ON = range(3)
_FAR = plain(1_000_000_000)


@called
def distances_to(made: Draft, target: int, distances: Longs, queue: Longs, enough: int) -> int:
    """Steps from every element over edges to a target, through quads only, into `distances`; the nearest triangle.

    Without another triangle -1. The search ends at `enough` elements seen beyond the first triangle it meets.
    """
    distances[:] = _FAR
    distances[target], queue[0] = 0, target
    head, tail, nearest = 0, 1, -1
    while head < tail and enough > 0:
        element = queue[head]
        head += 1
        if nearest >= 0:
            enough -= 1
        corners = corner_count(made.elements, element)
        if corners == 3 and element != target:
            continue
        for corner in range(corners):
            start, end = made.elements[element, corner], made.elements[element, (corner + 1) % corners]
            other = element_across(made, element, start, end)
            if other >= 0 and distances[other] == _FAR:
                distances[other] = distances[element] + 1
                queue[tail] = other
                tail += 1
                if nearest < 0 and corner_count(made.elements, other) == 3:
                    nearest = other
    return nearest


@woven
def _distance_of_new(made: Draft, wish: Change, distances: Longs) -> int:
    """Distance that the new triangle of a division would have: over its own sides, or over a new quad beside it."""
    least = _FAR
    for number in range(wish.tallies[ADDED]):
        corners = 3 if wish.added[number, 3] < 0 else 4
        for corner in range(corners):
            start, end = wish.added[number, corner], wish.added[number, (corner + 1) % corners]
            other = element_with_side(made, end, start)
            if other >= 0 and other != wish.removed[0] and other != wish.removed[1]:
                least = min(least, distances[other] + (1 if number == 0 else 2))
    return least


@called
def _step(made: Draft, wish: Change, triangle: int, side: int, corner: int) -> bool:
    """Write one of the nine ways over a side of a triangle into `wish`: four of them as they are, five with a node."""
    node = made.elements[triangle, side]
    if corner <= 4:
        return divide(made, wish, triangle, node, corner)
    return centre_pentagon(made, wish, triangle, node, corner - 5)


@woven
def walk(made: Draft, wish: Change, floor: Ground, at: Longs, steps: int) -> int:
    """Let a triangle walk to another one and join it, or as far as so many steps lead: `LOST`, `JOINED`, `GOING_ON`.

    `at` (3,) is the triangle, the other one and the detours that are left. Lost, it leaves the draft spoilt.
    """
    distances, queue = floor.search[0], floor.search[1]
    triangle, target, detours = at[0], at[1], at[2]
    for _ in range(steps):
        distances_to(made, target, distances, queue, _FAR)
        if distances[triangle] == _FAR:
            return LOST
        slack = 1 if detours > 0 else 0
        if distances[triangle] == 1:
            if united(made, wish, floor, triangle, target):
                return JOINED
            if detours <= 0:
                return LOST
            triangle, target, slack = target, triangle, 3  # they do not fit here: the other one moves on
            distances_to(made, target, distances, queue, _FAR)
        best, best_side, best_corner, best_ahead = NEVER, NONE, NONE, 0
        for side in range(3):
            for corner in range(1, 10):
                if not _step(made, wish, triangle, side, corner):
                    continue
                ahead = _distance_of_new(made, wish, distances)
                if ahead >= distances[triangle] + slack:
                    continue
                gain = attempt(made, wish, floor, ONE_RING, FAIRLY, inf)
                if gain > NEVER and gain - _STEP_COST * ahead > best:
                    best, best_side, best_corner = gain - _STEP_COST * ahead, side, corner
                    best_ahead = ahead
        if best_side < 0:
            return LOST
        _step(made, wish, triangle, best_side, best_corner)
        if attempt(made, wish, floor, TWO_RINGS, WELL, NEVER) <= NEVER:
            return LOST
        detours -= best_ahead >= distances[triangle]
        triangle = floor.rows[0]
    at[0], at[1], at[2] = triangle, target, detours
    return GOING_ON
