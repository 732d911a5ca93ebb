"""The stages that runs are made of: each yields its name after every stride."""

from collections.abc import Iterator

import numpy as np

from hullquad.mesh import Mesh
from hullquad.metrics import Metric
from hullquad.optimization import energies
from hullquad.optimization.course import Course
from hullquad.optimization.demand import Demand
from hullquad.optimization.objective import Objective
from hullquad.optimization.problem import problem
from hullquad.optimization.settings import SearchSettings
from hullquad.optimization.untangle import relaxing, untangling
from hullquad.quality import quality

_RELAXING = 60
_POWERS = (2, 3, 4, 5, 6, 7)
"""Doublings of the power by which the worst element counts."""
_SHARPER = 3
"""How much further the corners' exponent is doubled than that power."""
_MOST_DOUBLINGS = 10
_RAISING, _RAISING_GAIN = 100, 1e-4
_MENDING = 200
_SOFTNESS = (2.0, 1.0, 0.5, 0.25, 0.1, 0.05)
"""How far beyond a limit an element counts by half, ever less."""


def course_of(mesh: Mesh, settings: SearchSettings) -> Course:
    """The course of a run."""
    return Course(problem(mesh, settings.chosen), settings.iterations, settings.seconds, settings.stride)


def opened(course: Course) -> Iterator[str]:
    """Open what is folded."""
    for _ in untangling(course):
        yield "untangle"


def evened(course: Course) -> Iterator[str]:
    """Even the mesh out: a start from which every metric does well."""
    for _ in relaxing(course, _RELAXING):
        yield "even out"


def continued(course: Course, objective: Objective, settings: SearchSettings) -> Iterator[str]:
    """Make the objective better by stand-ins that come ever closer to it."""
    mesh, schedule = course.problem.mesh, settings.schedule
    gain = schedule.gain * course.problem.quads
    for doublings in schedule.doublings:
        energy = energies.merit(objective, mesh.target_size, mesh.areas, doublings, settings.floor)
        for _ in course.stage(energy, schedule.most, gain):
            yield f"p = {2**doublings}"


def raised(course: Course, objective: Objective, settings: SearchSettings) -> Iterator[str]:
    """Raise the worst element, then the objective without letting it fall again."""
    mesh, metric = course.problem.mesh, objective.metric
    floor = floor_of_others(settings)
    for power in _POWERS:
        worst = worst_value(course, metric, settings)
        if worst == metric.quads.ideal or course.is_complete:
            break
        doublings = min(power + _SHARPER, _MOST_DOUBLINGS)
        course.weigh(np.full(len(mesh.topology.elements), energies.weight_at(metric, worst)))
        energy = energies.worst_first(metric, mesh.target_size, mesh.areas, doublings, power, floor)
        for _ in course.stage(energy, _RAISING, _RAISING_GAIN):
            yield "worst first"
    worst, schedule = worst_value(course, metric, settings), settings.schedule
    if worst == metric.quads.ideal:
        return
    course.weigh(np.full(len(mesh.topology.elements), energies.weight_at(metric, worst)))
    for doublings in schedule.doublings:
        energy = energies.held_at(objective, mesh.target_size, mesh.areas, doublings, floor)
        for _ in course.stage(energy, schedule.most, schedule.gain * course.problem.quads):
            yield f"then the sum, p = {2**doublings}"


def mended(course: Course, asked: tuple[Demand, ...], objective: Objective, settings: SearchSettings) -> Iterator[str]:
    """Bring elements within what is asked of them, ever more by their number."""
    mesh = course.problem.mesh
    for softness in _SOFTNESS if asked else ():
        energy = energies.chasing(asked, objective, mesh.target_size, mesh.areas, softness, settings.floor)
        for _ in course.stage(energy, _MENDING, settings.schedule.gain * course.problem.quads):
            yield "fewest violations"


def worst_value(course: Course, metric: Metric, settings: SearchSettings) -> float:
    """Value of the worst element, or of the worst quad, if that is what counts [the metric's unit]."""
    judged = quality(course.mesh(), metric)
    return judged.worst_quad if settings.is_for_quads else judged.worst


def floor_of_others(settings: SearchSettings) -> float | None:
    """The floor of what is not to be raised; None where everything is."""
    return max(settings.floor or 0.0, energies.LEAST_GUARD) if settings.is_for_quads else None
