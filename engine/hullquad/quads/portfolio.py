"""Several ways to place the points of a plate, of which the best finished mesh is kept.

Small plates are worth many tries, large ones have one: the number depends on the number of elements only, never on
the clock, so that the same plate always gives the same mesh. It ends early when a mesh costs next to nothing.
"""

from collections.abc import Iterator
from math import inf

import attrs
import numpy as np

from hullquad.quads.making import Task, making, shaking
from hullquad.quads.settings import MeshSettings
from hullquad.quads.stages import States
from hullquad.triangulation.contour import MOST_ELEMENTS, Contour
from hullquad.triangulation.delaunay import Triangulation, triangulate
from hullquad.triangulation.field import Field, corners, field, fitting_elements
from hullquad.triangulation.points import aligned_points

MOST_TRIANGLES = 4 * MOST_ELEMENTS
"""Two for each element, and as many again, so that a size that was allowed is never refused afterwards."""

_EFFORT = 1200
"""Elements that all candidates together may have, about; the first one may have any number."""
_NOTHING_LEFT = 0.02
"""Cost above the least possible below which no other candidate is tried."""
_OWN_AREA = 0.8
_OWN_ANGLE = 30.0


@attrs.frozen
class Candidate:
    """A way to place the points."""

    spacing: float
    """Distance that points keep, over the local size; 0 for the points that Triangle places itself."""
    grading: float = 1.0
    """Factor of the grading that is asked for."""


CANDIDATES = (
    Candidate(0.75),
    Candidate(0.62, 0.7),
    Candidate(0.88, 0.7),
    Candidate(0.78, 0.5),
    Candidate(0.0),
    Candidate(0.56),
    Candidate(0.68),
    Candidate(0.82),
)


@attrs.frozen(eq=False, kw_only=True)
class Trial:
    """States of one of the candidates."""

    number: int
    """Of the candidate, from 0."""
    count: int
    """Candidates that are tried at most."""
    states: States
    is_best: bool = False
    """Whether it is a finished mesh, and the best so far."""


def trials(contour: Contour, settings: MeshSettings, *, is_watched: bool) -> Iterator[Trial | None]:
    """States of all candidates, one after the other; the mesh to take is the last one that is the best so far.

    Beside them it yields None from time to time: it may be dropped then.

    Parameters
    ----------
    contour : Contour
    settings : MeshSettings
    is_watched
        Whether there are states on the way, beside the finished ones.

    Raises
    ------
    MeshingError, WorkerError
        The plate could not be triangulated.
    """
    task = _task(contour, settings)
    guide = field(contour, settings.grading)
    count, best, lowest = 1, None, inf
    for number, candidate in enumerate(CANDIDATES):
        if number == count or lowest < task.least_cost + _NOTHING_LEFT:
            break
        yield None
        placed = _triangulated(contour, candidate, guide)
        for states in making(placed.nodes, placed.triangles, task, is_watched=is_watched):
            trial = _trial(states, number, count, lowest)
            if trial is not None and trial.is_best:
                best, lowest = trial, trial.states.cost or 0.0
            yield trial
        if number == 0 and best is not None:
            count = max(1, min(len(CANDIDATES), _EFFORT // len(best.states.rows)))
    if best is not None and lowest >= task.least_cost + _NOTHING_LEFT:
        for states in shaking(best.states, task, is_watched=is_watched):
            yield _trial(states, best.number, count, inf)


def _trial(states: States | None, number: int, count: int, lowest: float) -> Trial | None:
    """States as those of a candidate; the best is finished and costs less than the lowest cost so far."""
    if states is None:
        return None
    is_best = states.cost is not None and states.cost < lowest
    return Trial(number=number, count=count, states=states, is_best=is_best)


def _task(contour: Contour, settings: MeshSettings) -> Task:
    angles, _ = corners(contour)
    return Task(
        given=len(contour.nodes),
        rim_ideal=fitting_elements(angles),
        size=contour.size,
        squares=contour.area / contour.size**2,
        unavoidable=contour.triangles_unavoidable,
        prefer=settings.prefer,
    )


def _triangulated(contour: Contour, candidate: Candidate, guide: Field) -> Triangulation:
    """Triangles of the contour and of a candidate's points."""
    place = contour.plate.place
    if candidate.spacing == 0:
        area = _OWN_AREA * contour.size**2
        return triangulate(
            contour.nodes,
            contour.loop_starts,
            area=area,
            min_angle=_OWN_ANGLE,
            place=place,
            element_limit=MOST_TRIANGLES,
        )
    eased = attrs.evolve(guide, grading=candidate.grading * guide.grading)
    points = aligned_points(contour.nodes, contour.segments, eased, contour.size, candidate.spacing)
    nodes = np.concatenate([contour.nodes, points])
    return triangulate(nodes, contour.loop_starts, area=None, place=place, element_limit=MOST_TRIANGLES)
