"""Steps shortened where they would spoil elements, compiled."""

from hullquad.arrays import Floats, Ints
from hullquad.metrics.compiled import inlined
from hullquad.optimization.energy import is_spoilt

HALVINGS = 4
"""How often the moves of an element's nodes are halved before they are taken back."""
ROUNDS = 12


@inlined
def hold_back(
    points: Floats, trial: Floats, elements: Ints, before: Floats, after: Floats, guard: float, kept: float,
    share: float, shares: Floats,
) -> None:  # fmt: skip
    """Leave the nodes of spoilt elements (E, 4) a share of their move from `points` to `trial`.

    `before` and `after` (E,) are the elements' openness; `shares` (M,) is for the movable nodes.
    """
    for node in range(len(shares)):
        shares[node] = 1.0
    for i in range(len(elements)):
        if is_spoilt(before[i], after[i], guard, kept):
            for corner in range(4):
                node = elements[i, corner]
                if 0 <= node < len(shares):
                    shares[node] = share
    for node in range(len(shares)):
        if shares[node] < 1.0:
            for axis in range(3):
                trial[node, axis] = points[node, axis] + share * (trial[node, axis] - points[node, axis])
