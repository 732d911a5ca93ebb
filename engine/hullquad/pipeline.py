"""The whole way of a plate: contour -> triangles -> quads -> better quads."""

from collections.abc import Callable, Iterable

import numpy as np

from hullquad.arrays import Bytes
from hullquad.errors import HullquadError, MeshingError
from hullquad.mesh import Mesh
from hullquad.optimization.iterate import Iterate, Outcome, outcome
from hullquad.plate import Plate
from hullquad.surface import Plane
from hullquad.topology import NodeState, topology
from hullquad.triangulation.contour import MOST_ELEMENTS, Contour
from hullquad.triangulation.delaunay import Triangulation, triangulate

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
    from hullquad.quads.pairs import pairs  # noqa: PLC0415

    plate, surface = contour.plate, plane_of(contour.plate)
    triangulation = _triangulated(contour)
    points = surface.points(triangulation.nodes)
    points[: len(contour.points)] = contour.points
    possible = pairs(points, triangulation.triangles, surface.normal[None])
    return Mesh(
        points=points,
        topology=topology(elements(possible, joins(possible)), _states(contour, len(points))),
        target_size=contour.size,
        surface=surface,
        parameters=triangulation.nodes,
        lines=contour.lines,
        plate_id=plate.id,
        thickness=plate.thickness,
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


def _triangulated(contour: Contour) -> Triangulation:
    try:
        return triangulate(
            contour.nodes,
            contour.loop_starts,
            area=TRIANGLE_AREA * contour.size**2,
            min_angle=MIN_ANGLE,
            place=contour.plate.place,
            element_limit=_MOST_TRIANGLES,
        )
    except HullquadError as error:
        raise error.concerning(contour.plate.id) from error


def improved(iterates: Iterable[Iterate], watch: Callable[[Iterate], None] = lambda _: None) -> Outcome:
    """Run an optimisation to its end, showing each iterate to `watch`."""

    def watched() -> Iterable[Iterate]:
        for iterate in iterates:
            watch(iterate)
            yield iterate

    return outcome(watched())


def prepare() -> None:
    """Load every compiled kernel, compiling it first where none is on disk: milliseconds, or seconds once.

    A plate of three triangles goes the whole way, so that each kernel is met as it is in earnest.
    """
    from hullquad.metrics import metric  # noqa: PLC0415  all of these bring Numba
    from hullquad.metrics.values import smooth_gradients  # noqa: PLC0415
    from hullquad.optimization.paper import PaperSettings, paper_iterates  # noqa: PLC0415
    from hullquad.quads.augment import augment  # noqa: PLC0415
    from hullquad.quads.join import elements, joins  # noqa: PLC0415
    from hullquad.quads.pairs import pairs  # noqa: PLC0415

    ground = Plane([0, 0, 0], [1, 0, 0], [0, 1, 0])
    nodes = np.array([[0, 0], [2, 0], [2, 1], [1, 1], [0, 1]], dtype=float)
    triangles = np.array([[0, 1, 3], [1, 2, 3], [0, 3, 4]], dtype=np.int32)
    points = ground.points(nodes)
    possible = pairs(points, triangles, ground.normal[None])
    list(augment(possible, set()))
    mesh = Mesh(
        points=points,
        topology=topology(elements(possible, joins(possible)), np.zeros(len(nodes), dtype=np.int8)),
        target_size=1.0,
        surface=ground,
        parameters=nodes,
    )
    list(paper_iterates(mesh, metric("stretch"), PaperSettings(iterations=1)))
    smooth_gradients(metric("shape"), 4.0, mesh.points, mesh.topology.quads, mesh.normals)


def _states(contour: Contour, nodes: int) -> Bytes:
    states = np.full(nodes, NodeState.FREE, dtype=np.int8)
    states[: len(contour.nodes)] = NodeState.FIXED
    states[: contour.edge_count] = NodeState.CONTOUR
    return states
