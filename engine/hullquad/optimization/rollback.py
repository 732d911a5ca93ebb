"""Steps shortened where they would spoil elements, compiled."""

from hullquad.arrays import Floats, Ints
from hullquad.metrics.compiled import compiled
from hullquad.optimization.energy import Elements, Energy, is_spoilt

HALVINGS = 4
"""How often the moves of an element's nodes are halved before they are taken back."""
ROUNDS = 12


@compiled
def hold_back(
    points: Floats, trial: Floats, elements: Elements, before: Floats, after: Floats, energy: Energy, share: float,
    shares: Floats,
) -> None:  # fmt: skip
    """Leave the nodes of spoilt elements a share of their move from `points` to `trial`.

    `before` and `after` (Q + T,) are the elements' openness; `shares` (M,) is for the movable nodes.
    """
    shares[:] = 1.0
    quads = len(elements.quads)
    _mark(elements.quads, before[:quads], after[:quads], energy, share, shares)
    _mark(elements.triangles, before[quads:], after[quads:], energy, share, shares)
    for node in range(len(shares)):
        if shares[node] < 1.0:
            for axis in range(3):
                trial[node, axis] = points[node, axis] + share * (trial[node, axis] - points[node, axis])


@compiled
def _mark(elements: Ints, before: Floats, after: Floats, energy: Energy, share: float, shares: Floats) -> None:
    for i in range(len(elements)):
        if is_spoilt(before[i], after[i], energy.guard, energy.kept):
            for corner in range(elements.shape[1]):
                if elements[i, corner] < len(shares):
                    shares[elements[i, corner]] = share
