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


def looks(
    mesh: Mesh, objective: Objective, course: Course, stages: Iterator[str], rank: Callable[[], Rank]
) -> Iterator[Iterate]:
    """Iterates of a course, the given mesh first; `stages` yields the name of its stage after each of its steps.

    `rank` is that of the nodes as they are now; an iterate is the best when its rank is greater than that of all
    before it. The last one knows why the course ended; when that could gain nothing, the given mesh is the best,
    and the stop says so.
    """
    best = rank()
    newest = _first(mesh, objective)
    if not course.problem.movable:
        yield attrs.evolve(newest, stop=stops.NO_FREE_NODES)
        return
    is_better = False
    for stage in stages:
        yield newest
        now = course.mesh()
        value = rank() if course.is_at_check else best
        is_best = value > best
        best, is_better = max(best, value), is_better or is_best
        newest = _next(newest, now, objective, course.number, stage, is_best=is_best)
    yield attrs.evolve(newest, stop=ending(course, newest, is_better=is_better))


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


def _first(mesh: Mesh, objective: Objective) -> Iterate:
    return Iterate(number=0, mesh=mesh, quality=quality(mesh, objective.metric), objective=objective.total(mesh))


def _next(before: Iterate, mesh: Mesh, objective: Objective, number: int, stage: str, *, is_best: bool) -> Iterate:
    return Iterate(
        number=number,
        mesh=mesh,
        quality=quality(mesh, objective.metric),
        objective=objective.total(mesh),
        displacement=farthest_move(before.mesh.points, mesh.points),
        is_best=is_best,
        stage=stage,
    )
