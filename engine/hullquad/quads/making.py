"""From triangles to the finished quads of one candidate: joined, repaired, cleaned up, smoothed."""

from collections.abc import Generator, Iterator
from functools import partial

import attrs
import numpy as np

from hullquad.arrays import Bools, Floats, Ints, Longs, ints
from hullquad.quads.cleanup import cleaned
from hullquad.quads.cost import cost, element_price, least_cost
from hullquad.quads.draft import Draft, draft, finished
from hullquad.quads.energy import INVALID, element_energies
from hullquad.quads.inwards import inwards
from hullquad.quads.join import joined_elements
from hullquad.quads.joining import joined_states
from hullquad.quads.log import Log
from hullquad.quads.matching import matching
from hullquad.quads.pairs import Pairs, pairs
from hullquad.quads.repair import repaired
from hullquad.quads.settings import Preference
from hullquad.quads.shaking import Costs, shaken
from hullquad.quads.smoothing import relaxed
from hullquad.quads.splitting import split
from hullquad.quads.stages import States, Step, padded, whole
from hullquad.quads.trial import change, ground

_ATTEMPTS = 3
"""Pairings with quads that smoothing must mend, before only those are joined that are good as they are."""
_SWEEPS = 12
_LAST_SWEEPS = 40
_PASSES = 8
_LARGE = 30_000
"""Elements of a large mesh."""
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
    bound: Ints
    """(K, 2) lines of one segment with elements all around: nothing else holds them."""
    size: float
    """Length that an edge should have [mm]."""
    usual: float
    """Number of elements that others are compared with: that of half the triangles of the first candidate."""
    unavoidable: int
    """Triangles."""
    prefer: Preference = Preference.QUADS

    @property
    def is_large(self) -> bool:
        """Whether a mesh has one candidate and is not shaken: it would take long, and few of its elements are poor."""
        return self.usual > _LARGE

    @property
    def settles(self) -> bool:
        """Whether a finished mesh is judged by where its nodes settle (`quads.settling`), or as it is.

        Where the worst element matters most an optimiser will be chosen that gives none up.
        """
        return self.prefer is Preference.QUADS and not self.is_large

    @property
    def least_cost(self) -> float:
        """What a mesh of nothing but squares would cost."""
        return least_cost(self.prefer)


Making = Iterator[States | None]
"""States of a mesh on the way, if somebody watches, and the finished one, which has a cost, as the last.

Beside them it yields None from time to time: it may be dropped then.
"""


def making(nodes: Floats, triangles: Ints, task: Task, *, is_watched: bool) -> Making:
    """What becomes of triangles.

    Parameters
    ----------
    nodes : (N, 2) float array
        Those that are given first [mm].
    triangles : (T, 3) int array
        Counter-clockwise.
    task : Task
    is_watched
        Whether there are states on the way.
    """
    log = Log(is_watched=is_watched)
    made = yield from _joined(nodes, triangles, task, log)
    wish, floor = change(), ground(made)
    if task.prefer is Preference.QUADS:
        yield from repaired(made, wish, floor, task.unavoidable, log)
    yield from cleaned(made, wish, floor, _PASSES, log)
    yield from relaxed(made, _LAST_SWEEPS, _NEARER * task.size, log)
    yield _finished(Step.SMOOTHED, made, task)


def shaking(finished_one: States, task: Task, *, is_watched: bool) -> Making:
    """A finished mesh shaken."""
    nodes, elements = finished_one.at(0, task.given)
    made, log = draft(nodes, elements, task.given, task.rim_ideal, task.bound), Log(is_watched=is_watched)
    log.begin(made, finished_one)
    costs = Costs(partial(_cost, task=task), partial(element_price, usual=task.usual))
    yield from shaken(made, change(), ground(made), costs, log)
    yield from relaxed(made, _LAST_SWEEPS, _NEARER * task.size, log)
    yield _finished(Step.SHAKEN, made, task)


def mending(finished_one: States, task: Task, *, is_watched: bool) -> Making:
    """A finished mesh without the triangles that could be avoided, whatever elements that takes."""
    (nodes, elements), log = finished_one.at(0, task.given), Log(is_watched=is_watched)
    while int((elements[:, 3] < 0).sum()) > task.unavoidable and (fewer := split(nodes, elements, task.bound)):
        nodes, elements = fewer
        yield None
    made = draft(nodes, elements, task.given, task.rim_ideal, task.bound)
    log.begin(made, finished_one)
    yield from relaxed(made, _SWEEPS, _NEAR * task.size, log)
    yield from cleaned(made, change(), ground(made), _PASSES, log)
    yield from relaxed(made, _LAST_SWEEPS, _NEARER * task.size, log)
    yield _finished(Step.REPAIRED, made, task)


def _joined(nodes: Floats, triangles: Ints, task: Task, log: Log) -> Generator[States | None, None, Draft]:
    """Draft of the pairing whose quads are all valid once they are smoothed."""
    points = np.pad(nodes, ((0, 0), (0, 1)))
    forbidden = task.bound
    for attempt in range(_ATTEMPTS + 1):
        held = task.given if attempt < _ATTEMPTS else None
        possible = pairs(points, triangles, _UP, forbidden, held)
        yield None
        chosen = yield from matching(possible, possible.scores, np.zeros(len(triangles)))
        elements = joined_elements(possible, sorted(chosen))
        made = draft(nodes, elements, task.given, task.rim_ideal, task.bound)
        log.begin(made, whole(Step.JOINED, nodes, elements))
        smoothing = []
        for states in relaxed(made, _SWEEPS, _NEAR * task.size, log):
            smoothing.append(states)
            yield None
        spoilt = _spoilt(made)
        if not spoilt:
            break
        forbidden = np.concatenate([forbidden, _cuts(possible, sorted(chosen), spoilt)])
    if log.is_watched:
        start = whole(Step.TRIANGULATED, nodes, padded(triangles))
        order = yield from inwards(possible, chosen)
        yield from (start, joined_states(start, possible, order))
        yield from smoothing
        yield log.compared(Step.SMOOTHED, made)
    return made


def _spoilt(made: Draft) -> set[tuple[int, ...]]:
    """Nodes of the quads that are not valid, sorted."""
    rows = made.element_rows
    is_spoilt = (rows[:, 3] >= 0) & (element_energies(made.nodes, rows) >= INVALID)
    return {tuple(sorted(row)) for row in rows[is_spoilt].tolist()}


def _cuts(possible: Pairs, chosen: list[int], spoilt: set[tuple[int, ...]]) -> Ints:
    """(K, 2) edges that were taken out to make the spoilt quads."""
    quads = possible.quads[chosen]
    is_spoilt: Bools = np.array([tuple(sorted(row)) in spoilt for row in quads.tolist()], dtype=bool)
    return ints(quads[is_spoilt][:, [1, 3]])


def _finished(step: Step, made: Draft, task: Task) -> States:
    return whole(step, *finished(made, task.given), _cost(made, task))


def _cost(made: Draft, task: Task) -> float:
    return cost(made, task.unavoidable, task.usual, task.prefer)
