"""Ways of moving the nodes, one behind the other, each a generator of iterates."""

from collections.abc import Iterator

import numpy as np

from hullquad.mesh import Mesh
from hullquad.optimization import energies
from hullquad.optimization.iterate import Iterate
from hullquad.optimization.looks import Rank, looks
from hullquad.optimization.objective import Objective
from hullquad.optimization.settings import SearchSettings
from hullquad.optimization.stages import continued, course_of, evened, floor_of_others, opened, raised, worst_value
from hullquad.optimization.untangle import evenness, folded, folded_count


def untangle_iterates(mesh: Mesh, objective: Objective, settings: SearchSettings | None = None) -> Iterator[Iterate]:
    """Iterates that open folded elements, then even the mesh out: fewest folded, then least energy, is best.

    The mesh is judged by the objective's metric, which has no part in it. The last iterate names the elements that
    stay folded.
    """
    course = course_of(mesh, settings or SearchSettings())

    def stages() -> Iterator[str]:
        yield from opened(course)
        yield from evened(course)

    def rank() -> Rank:
        return -float(folded_count(course)), -evenness(course)

    yield from looks(mesh, objective, course, stages(), rank)


def default_iterates(mesh: Mesh, objective: Objective, settings: SearchSettings | None = None) -> Iterator[Iterate]:
    """Iterates towards the optimum of the objective's sum: Winslow's start, then the stand-ins of growing exponent.

    The best is the one with the best exact sum, less what corners below the floor cost.
    """
    settings = settings or SearchSettings()
    course = course_of(mesh, settings)
    exact = energies.merit(objective, mesh.target_size, mesh.areas, None, settings.floor)

    def stages() -> Iterator[str]:
        yield from opened(course)
        yield from evened(course)
        yield from continued(course, objective, settings)

    def rank() -> Rank:
        value, openness = course.look(exact)
        return -float(folded(openness)), -value

    yield from looks(mesh, objective, course, stages(), rank)


def worst_iterates(mesh: Mesh, objective: Objective, settings: SearchSettings | None = None) -> Iterator[Iterate]:
    """Iterates that raise the worst element as far as it goes, then the sum without lowering it again.

    The best has the best worst element by the objective's first metric, triangles included where they have it, then
    the best exact sum.
    """
    settings = settings or SearchSettings()
    course = course_of(mesh, settings)
    exact = energies.merit(objective, mesh.target_size, mesh.areas, None, floor_of_others(settings))
    metric = objective.metric

    def stages() -> Iterator[str]:
        yield from opened(course)
        yield from evened(course)
        yield from raised(course, objective, settings)

    def rank() -> Rank:
        worst = float(metric.badness(np.array(worst_value(course, metric, settings))))
        value, openness = course.look(exact)
        return -float(folded(openness)), -worst, -value

    yield from looks(mesh, objective, course, stages(), rank)
