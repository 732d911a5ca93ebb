"""The whole way of a plate: contour -> triangles -> quads -> better quads."""

from collections.abc import Callable, Iterable, Iterator
from functools import partial
from typing import TYPE_CHECKING

import attrs
import numpy as np

from hullquad.arrays import Bytes, Floats, Ints, floats, ints
from hullquad.errors import HullquadError, MeshingError
from hullquad.mesh import Mesh
from hullquad.optimization.iterate import Iterate, Outcome, outcome
from hullquad.plate import Plate
from hullquad.quads.settings import MeshSettings
from hullquad.quads.stages import States, Step, whole
from hullquad.surface import Plane
from hullquad.topology import NodeState, topology
from hullquad.triangulation.contour import MOST_ELEMENTS, Contour
from hullquad.triangulation.delaunay import triangulate

if TYPE_CHECKING:
    from hullquad.quads.pairs import Pairs
    from hullquad.quads.portfolio import Trial

MIN_ANGLE = 30.0
"""Least angle of the triangles, where the contour allows it [degrees]."""

TRIANGLE_AREA = 0.8
"""Largest triangle over the square of the element size: the average one is then half a square of that size."""

_MOST_TRIANGLES = 4 * MOST_ELEMENTS
"""Two for each element, and as many again, so that a size that was allowed is never refused afterwards."""


def paper_mesh(contour: Contour, input_hash: str = "") -> Mesh:
    """Quads and the triangles left, by the paper's method: constrained Delaunay, then the advancing front.

    Raises
    ------
    MeshingError, WorkerError
        The plate could not be triangulated.
    """
    from hullquad.quads.join import elements, joins  # noqa: PLC0415  brings Numba: half a second

    nodes, possible = _triangulated_pairs(contour)
    return _mesh(contour, nodes, elements(possible, joins(possible)), input_hash)


@attrs.frozen(eq=False, kw_only=True)
class MeshStage:
    """A state of a mesh that is being made."""

    step: Step
    candidate: int
    """Which of several ways to place the points this is, from 0."""
    candidates: int
    """So many at most."""
    is_best: bool
    """Whether it is a finished mesh, and the best so far: the last one of these is the result."""
    _mesh: Callable[[], Mesh]

    def mesh(self) -> Mesh:
        """The mesh then, put together now: a plate has thousands of stages."""
        return self._mesh()


def paper_stages(contour: Contour, input_hash: str = "") -> Iterator[MeshStage | None]:
    """All states of the paper's mesher, join after join, the mesh of `paper_mesh` last; None where it may be dropped.

    Raises
    ------
    MeshingError, WorkerError
        The plate could not be triangulated.
    """
    from hullquad.quads.join import elements, joins  # noqa: PLC0415  brings Numba: half a second
    from hullquad.quads.joining import paper_states  # noqa: PLC0415

    yield None
    nodes, possible = _triangulated_pairs(contour)
    steps = []
    for join in joins(possible):
        steps.append(join)
        yield None
    given = len(contour.nodes)
    for states in paper_states(nodes, possible, steps):
        yield from _stages(contour, input_hash, states, partial(states.at, given=given))
    last = whole(Step.JOINED, nodes, elements(possible, steps))
    yield from _stages(contour, input_hash, last, partial(last.at, given=given), is_best=True)


def best_stages(
    contour: Contour, input_hash: str = "", settings: MeshSettings | None = None
) -> Iterator[MeshStage | None]:
    """All states of the best mesher, candidate after candidate; None where it may be dropped.

    Raises
    ------
    MeshingError, WorkerError
        The plate could not be triangulated.
    """
    for trial in _trials(contour, settings, is_watched=True):
        if trial is None:
            yield None
        else:
            at = partial(_glued, contour, trial.states, settled=trial.settled)
            numbers = trial.number, trial.count
            yield from _stages(contour, input_hash, trial.states, at, *numbers, is_best=trial.is_best)


def best_mesh(
    contour: Contour,
    input_hash: str = "",
    settings: MeshSettings | None = None,
    watch: Callable[[int, int], None] = lambda *_: None,
) -> Mesh:
    """The best mesh there is: as few triangles as the contour allows, then few and well shaped quads.

    Parameters
    ----------
    contour : Contour
    input_hash : str
    settings : MeshSettings, optional
    watch : callable
        Called from time to time with the number of the candidate in the making, from 0, and of how many at most.

    Raises
    ------
    MeshingError, WorkerError
        The plate could not be triangulated.
    """
    number, count = 0, 1
    for trial in _trials(contour, settings, is_watched=False):
        if trial is not None:
            number, count = trial.number, trial.count
        if trial is not None and trial.is_best:
            best = trial.states
        watch(number, count)
    return _mesh(contour, *_glued(contour, best, 0), input_hash)  # every plate has a first candidate


def _trials(contour: Contour, settings: MeshSettings | None, *, is_watched: bool) -> Iterator["Trial | None"]:
    from hullquad.quads.portfolio import trials  # noqa: PLC0415  brings Numba: half a second

    plane_of(contour.plate)
    try:
        yield from trials(contour, settings or MeshSettings(), is_watched=is_watched)
    except HullquadError as error:
        raise error.concerning(contour.plate.id) from error


def _stages(
    contour: Contour,
    input_hash: str,
    states: States,
    at: Callable[[int], tuple[Floats, Ints]],
    candidate: int = 0,
    candidates: int = 1,
    *,
    is_best: bool = False,
) -> Iterator[MeshStage]:
    """A stage of every state, of which `at` gives the nodes and elements."""

    def mesh(index: int) -> Mesh:
        return _mesh(contour, *at(index), input_hash)

    for index in range(len(states)):
        yield MeshStage(
            step=states.step,
            candidate=candidate,
            candidates=candidates,
            is_best=is_best,
            mesh=partial(mesh, index),
        )


def _glued(
    contour: Contour, states: States, index: int, settled: tuple[Floats, Ints] | None = None
) -> tuple[Floats, Ints]:
    """Nodes and elements of a state of the cut plate, glued along the lines, with what is settled elsewhere."""
    given = len(contour.cut.originals)
    nodes, elements = states.at(index, given)
    if settled is not None:
        moved = np.where(settled[1] >= given, settled[1] + len(nodes) - given, settled[1])
        nodes = floats(np.concatenate([nodes, settled[0][given:]]))
        elements = ints(np.concatenate([elements, moved]))
    return contour.cut.glued(nodes, elements)


def _points(contour: Contour, nodes: Floats) -> Floats:
    """(N, 3) nodes in space; those of the contour keep their bits."""
    points = plane_of(contour.plate).points(nodes)
    points[: len(contour.points)] = contour.points
    return points


def _mesh(contour: Contour, nodes: Floats, elements: Ints, input_hash: str) -> Mesh:
    return Mesh(
        points=_points(contour, nodes),
        topology=topology(elements, _states(contour, len(nodes)), _lines(contour, len(nodes))),
        target_size=contour.size,
        surface=plane_of(contour.plate),
        parameters=nodes,
        lines=contour.lines,
        plate_id=contour.plate.id,
        thickness=contour.plate.thickness,
        input_hash=input_hash,
    )


def plane_of(plate: Plate) -> Plane:
    """The plane of a plane plate.

    Raises
    ------
    MeshingError
        E_CURVED: the plate is curved.
    """
    if not isinstance(plate.surface, Plane):
        raise MeshingError("E_CURVED", plate.place, plate=plate.id)
    return plate.surface


def _triangulated_pairs(contour: Contour) -> tuple[Floats, "Pairs"]:
    """(N, 2) nodes of the paper's triangles, and those that can be joined."""
    from hullquad.quads.pairs import pairs  # noqa: PLC0415  brings Numba: half a second

    surface = plane_of(contour.plate)
    try:
        found = triangulate(
            contour.nodes,
            contour.loop_starts,
            area=TRIANGLE_AREA * contour.size**2,
            min_angle=MIN_ANGLE,
            place=contour.plate.place,
            lines=contour.line_edges,
            element_limit=_MOST_TRIANGLES,
        )
    except HullquadError as error:
        raise error.concerning(contour.plate.id) from error
    points, constraints = _points(contour, found.nodes), ints(contour.line_edges)
    return found.nodes, pairs(points, found.triangles, surface.normal[None], constraints)


def improved(iterates: Iterable[Iterate], watch: Callable[[Iterate], None] = lambda _: None) -> Outcome:
    """Run an optimisation to its end, showing each iterate to `watch`."""

    def watched() -> Iterable[Iterate]:
        for iterate in iterates:
            watch(iterate)
            yield iterate

    return outcome(watched())


def prepare() -> None:
    """Load every compiled kernel, compiling it first where none is on disk: milliseconds, or seconds once."""
    prepare_judging()
    prepare_meshing()
    prepare_optimizing()


def prepare_judging() -> None:
    """Load what judging needs."""
    from hullquad.metrics import metric  # noqa: PLC0415
    from hullquad.quality import quality  # noqa: PLC0415

    quality(_little_mesh(), metric("shape"))


def prepare_meshing() -> None:
    """Load what both meshers need: three triangles go the paper's whole way."""
    from hullquad.quads.augment import augment  # noqa: PLC0415  all of these bring Numba
    from hullquad.quads.join import joins  # noqa: PLC0415
    from hullquad.quads.pairs import pairs  # noqa: PLC0415
    from hullquad.quads.preparation import prepare_kernels  # noqa: PLC0415

    prepare_kernels()
    mesh = _little_mesh()
    triangles = np.array([[0, 1, 3], [1, 4, 3], [0, 3, 6]], dtype=np.int32)
    possible = pairs(mesh.points, triangles, mesh.normals)
    list(joins(possible))
    list(augment(possible, set()))


def prepare_optimizing() -> None:
    """Load what the paper's method and all others need."""
    from hullquad.metrics import metric  # noqa: PLC0415  all of these bring Numba
    from hullquad.optimization.modes import default_iterates  # noqa: PLC0415
    from hullquad.optimization.objective import Objective, Term  # noqa: PLC0415
    from hullquad.optimization.paper import paper_iterates  # noqa: PLC0415
    from hullquad.optimization.settings import PaperSettings, SearchSettings  # noqa: PLC0415

    mesh, stretch = _little_mesh(), metric("stretch")
    list(paper_iterates(mesh, stretch, PaperSettings(iterations=1)))
    list(default_iterates(mesh, Objective((Term(stretch),)), SearchSettings(iterations=3)))


def _little_mesh() -> Mesh:
    """Two quads and a triangle around one free node."""
    ground = Plane([0, 0, 0], [1, 0, 0], [0, 1, 0])
    nodes = np.array([[0, 0], [1, 0], [2, 0], [1.1, 0.9], [2, 1], [1, 2], [0, 1]], dtype=float)
    elements = np.array([[0, 1, 3, 6], [1, 2, 4, 3], [3, 4, 5, -1], [3, 5, 6, -1]], dtype=np.int32)
    states = np.full(len(nodes), NodeState.CONTOUR, dtype=np.int8)
    states[3] = NodeState.FREE
    return Mesh(
        points=ground.points(nodes),
        topology=topology(elements, states),
        target_size=1.0,
        surface=ground,
        parameters=nodes,
    )


def _states(contour: Contour, nodes: int) -> Bytes:
    states = np.full(nodes, NodeState.FREE, dtype=np.int8)
    states[: len(contour.nodes)] = NodeState.FIXED
    states[: len(contour.nodes)][contour.node_lines >= 0] = NodeState.ON_LINE
    states[: contour.edge_count] = NodeState.CONTOUR
    return states


def _lines(contour: Contour, nodes: int) -> Ints:
    """(N,) row of the contour's lines that each node slides on, else -1."""
    return ints(np.concatenate([contour.node_lines, np.full(nodes - len(contour.nodes), -1)]))
