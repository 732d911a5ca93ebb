"""Looks at a minimisation while it goes on: its iterates, the best so far, and why it ended."""

from collections.abc import Callable, Iterator

import attrs
import numpy as np

from hullquad.arrays import Floats
from hullquad.mesh import Mesh
from hullquad.optimization import stops
from hullquad.optimization.course import Course
from hullquad.optimization.iterate import Iterate
from hullquad.optimization.objective import Objective
from hullquad.optimization.stops import Stop
from hullquad.quality import quality

Rank = tuple[float, ...]
"""How good a mesh is, the greater the better: compared number by number."""


@attrs.frozen(eq=False)
class _Look:
    """Where a course was."""

    number: int
    stage: str
    points: Floats
    """(K, 3)"""
    is_best: bool


def looks(
    mesh: Mesh, objective: Objective, course: Course, stages: Iterator[str], rank: Callable[[], Rank]
) -> Iterator[Iterate]:
    """Iterates of a course, the given mesh first; `stages` yields the name of its stage after each of its steps.

    `rank` is that of the nodes as they are now; an iterate is the best when its rank is greater than that of all
    before it. Within a stride only the best is an iterate. The last one knows why the course ended; when that could
    gain nothing, the given mesh is the best, and the stop says so.
    """
    newest = Iterate(number=0, mesh=mesh, quality=quality(mesh, objective.metric), objective=objective.total(mesh))
    if not course.problem.movable:
        yield attrs.evolve(newest, stop=stops.NO_FREE_NODES)
        return
    best, stage, is_better, kept = rank(), "", False, None
    for stage in stages:
        value = rank() if course.is_at_check else best
        if value > best:
            best, is_better, kept = value, True, _Look(course.number, stage, course.points.copy(), is_best=True)
            if kept.number == newest.number:  # what was thought to be on the way is the end of a stage
                newest, kept = attrs.evolve(newest, is_best=True), None
        if course.number - newest.number >= course.stride:
            for look in _since(kept, course, stage):
                yield newest
                newest = _next(newest, look, course, objective)
            kept = None
    for look in _since(kept, course, stage) if course.number > newest.number else ():
        yield newest
        newest = _next(newest, look, course, objective)
    yield attrs.evolve(newest, stop=ending(course, newest, is_better=is_better))


def _since(kept: _Look | None, course: Course, stage: str) -> Iterator[_Look]:
    """The best look since the last iterate, if there is one, and how it is now."""
    if kept is not None:
        yield kept
    if kept is None or kept.number < course.number:
        yield _Look(course.number, stage, course.points, is_best=False)


def ending(course: Course, last: Iterate, *, is_better: bool) -> Stop:
    """Why a course ended, and with what."""
    if course.is_complete and not course.is_out_of_time:
        return stops.ITERATIONS
    if course.is_complete:
        return stops.TIME
    folded = ~last.quality.valid & ~course.problem.turned
    if folded.any():
        return stops.still_folded(last.mesh.topology.element_labels[folded].tolist())
    return stops.GAIN if is_better else stops.NO_GAIN


def farthest_move(before: Floats, after: Floats) -> float:
    """How far the node that moved most has moved [mm]."""
    return float(np.sqrt(((after - before) ** 2).sum(axis=1).max(initial=0.0)))


def _next(before: Iterate, look: _Look, course: Course, objective: Objective) -> Iterate:
    mesh = course.problem.mesh_at(look.points)
    return Iterate(
        number=look.number,
        mesh=mesh,
        quality=quality(mesh, objective.metric),
        objective=objective.total(mesh),
        displacement=farthest_move(before.mesh.points, mesh.points),
        is_best=look.is_best,
        stage=look.stage,
    )
