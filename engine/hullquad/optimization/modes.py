"""Ways of moving the nodes, one behind the other, each a generator of iterates."""

from collections.abc import Iterator

from hullquad.mesh import Mesh
from hullquad.metrics import Metric
from hullquad.optimization.course import Course
from hullquad.optimization.iterate import Iterate
from hullquad.optimization.looks import Rank, looks
from hullquad.optimization.problem import problem
from hullquad.optimization.settings import SearchSettings
from hullquad.optimization.untangle import evenness, folded_count, relaxing, untangling

_RELAXING = 60


def untangle_iterates(mesh: Mesh, metric: Metric, settings: SearchSettings | None = None) -> Iterator[Iterate]:
    """Iterates that open folded elements, then even the mesh out: fewest folded, then least energy, is best.

    The mesh is judged by `metric`, which has no part in it. The last iterate names the elements that stay folded.
    """
    course = _course(mesh, settings or SearchSettings())

    def stages() -> Iterator[str]:
        for _ in untangling(course):
            yield "untangle"
        for _ in relaxing(course, _RELAXING):
            yield "even out"

    def rank() -> Rank:
        return -float(folded_count(course)), -evenness(course)

    yield from looks(mesh, metric, course, stages(), rank)


def _course(mesh: Mesh, settings: SearchSettings) -> Course:
    return Course(problem(mesh), settings.iterations, settings.seconds, settings.stride)
