"""From triangles to the finished quads of one candidate: joined, repaired, cleaned up, smoothed."""

from collections.abc import Iterator

import attrs
import numpy as np

from hullquad.arrays import Bools, Floats, Ints, Longs, ints
from hullquad.quads.cleanup import clean_up
from hullquad.quads.cost import cost, least_cost
from hullquad.quads.draft import Draft, draft, finished
from hullquad.quads.energy import INVALID, quad_energy
from hullquad.quads.join import joined_elements
from hullquad.quads.matching import matching
from hullquad.quads.pairs import Pairs, pairs
from hullquad.quads.repair import repair
from hullquad.quads.settings import Preference
from hullquad.quads.shaking import shake
from hullquad.quads.smoothing import relax_all
from hullquad.quads.stages import Draught, Step
from hullquad.quads.trial import change, ground

_ATTEMPTS = 3
"""Pairings with quads that smoothing must mend, before only those are joined that are good as they are."""
_SWEEPS = 12
_LAST_SWEEPS = 40
_PASSES = 8
_SHAKING = 150_000
_MOST_SHAKES = 2000
"""Shakes times elements, and shakes: small meshes are worth them."""
_FEWEST_SHAKES = 100
_NEAR = 0.02
_NEARER = 0.001
"""Smoothing ends when no node moves farther than this part of the element size."""

_UP = np.array([[0.0, 0.0, 1.0]])


@attrs.frozen(eq=False, kw_only=True)
class Task:
    """What every candidate of a plate has in common."""

    given: int
    """Number of nodes that the contour and the plate give; they are the first ones and never move."""
    rim_ideal: Longs
    """(R,) number of elements that fit best around each contour node."""
    size: float
    """Length that an edge should have [mm]."""
    squares: float
    """Number of squares of that size that the plate has room for."""
    unavoidable: int
    """Triangles."""
    prefer: Preference = Preference.QUADS

    @property
    def least_cost(self) -> float:
        """What a mesh of nothing but squares would cost."""
        return least_cost(self.prefer)


def draughts(nodes: Floats, triangles: Ints, task: Task) -> Iterator[Draught]:
    """States of the mesh that is made from triangles, the finished one last.

    Parameters
    ----------
    nodes : (N, 2) float array
        Those that are given first [mm].
    triangles : (T, 3) int array
        Counter-clockwise.
    task : Task
    """
    yield Draught(step=Step.TRIANGULATED, nodes=nodes, elements=_padded(triangles))
    made = _joined(nodes, triangles, task)
    yield _draught(Step.JOINED, made, task)
    wish, floor = change(), ground(made)
    if task.prefer is Preference.QUADS and len(made.triangles) > task.unavoidable:
        repair(made, wish, floor, task.unavoidable)
        yield _draught(Step.REPAIRED, made, task)
    clean_up(made, wish, floor, _PASSES, np.ones(len(made.nodes), dtype=np.int64))
    yield _draught(Step.CLEANED, made, task)
    relax_all(made, _LAST_SWEEPS, _NEARER * task.size)
    yield _draught(Step.SMOOTHED, made, task)


def shaken(finished_one: Draught, task: Task) -> Draught:
    """A finished mesh shaken, the more often the smaller it is."""
    made = draft(finished_one.nodes, finished_one.elements, task.given, task.rim_ideal)
    times = min(_MOST_SHAKES, _SHAKING // len(finished_one.elements))
    shake(made, change(), ground(made), times if times >= _FEWEST_SHAKES else 0)
    relax_all(made, _LAST_SWEEPS, _NEARER * task.size)
    return _draught(Step.SHAKEN, made, task)


def _joined(nodes: Floats, triangles: Ints, task: Task) -> Draft:
    """Draft of the pairing whose quads are all valid once they are smoothed."""
    points = np.pad(nodes, ((0, 0), (0, 1)))
    forbidden = np.empty((0, 2), dtype=np.int32)
    for attempt in range(_ATTEMPTS + 1):
        held = task.given if attempt < _ATTEMPTS else None
        possible = pairs(points, triangles, _UP, forbidden, held)
        chosen = matching(possible, possible.scores, np.zeros(len(triangles)))
        made = draft(nodes, joined_elements(possible, sorted(chosen)), task.given, task.rim_ideal)
        relax_all(made, _SWEEPS, _NEAR * task.size)
        spoilt = _spoilt(made)
        if not spoilt:
            break
        forbidden = np.concatenate([forbidden, _cuts(possible, sorted(chosen), spoilt)])
    return made


def _spoilt(made: Draft) -> set[tuple[int, ...]]:
    """Nodes of the quads that are not valid, sorted."""
    rows = made.element_rows
    return {tuple(sorted(row)) for row in rows[rows[:, 3] >= 0].tolist() if quad_energy(made.nodes, *row) >= INVALID}


def _cuts(possible: Pairs, chosen: list[int], spoilt: set[tuple[int, ...]]) -> Ints:
    """(K, 2) edges that were taken out to make the spoilt quads."""
    quads = possible.quads[chosen]
    is_spoilt: Bools = np.array([tuple(sorted(row)) in spoilt for row in quads.tolist()], dtype=bool)
    return ints(quads[is_spoilt][:, [1, 3]])


def _padded(triangles: Ints) -> Ints:
    return np.pad(triangles, ((0, 0), (0, 1)), constant_values=-1)


def _draught(step: Step, made: Draft, task: Task) -> Draught:
    nodes, elements = finished(made, task.given)
    price = cost(made, task.unavoidable, task.squares, task.prefer)
    return Draught(step=step, nodes=nodes, elements=elements, cost=price)
