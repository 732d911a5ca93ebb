"""The whole way of a plate: contour -> triangles -> quads -> better quads."""

from collections.abc import Callable, Iterable

import numpy as np

from hullquad.arrays import Bytes, Floats
from hullquad.errors import MeshingError
from hullquad.mesh import Mesh
from hullquad.optimization.iterate import Iterate, Outcome, outcome
from hullquad.plate import Plate
from hullquad.surface import Plane
from hullquad.topology import NodeState, topology
from hullquad.triangulation.contour import Contour
from hullquad.triangulation.delaunay import triangulate

MIN_ANGLE = 30.0
"""Least angle of the triangles, where the contour allows it [degrees]."""

TRIANGLE_AREA = 0.8
"""Largest triangle over the square of the element size: the average one is then half a square of that size."""


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
    triangulation = triangulate(
        contour.nodes,
        contour.loop_starts,
        area=TRIANGLE_AREA * contour.size**2,
        min_angle=MIN_ANGLE,
        place=plate.id,
    )
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
        raise MeshingError("E_CURVED", plate.id)
    return plate.surface


def improved(iterates: Iterable[Iterate], watch: Callable[[Iterate], None] = lambda _: None) -> Outcome:
    """Run an optimisation to its end, showing each iterate to `watch`."""

    def watched() -> Iterable[Iterate]:
        for iterate in iterates:
            watch(iterate)
            yield iterate

    return outcome(watched())


def prepare() -> None:
    """Load every compiled kernel, compiling it first where none is on disk: milliseconds, or seconds once."""
    from hullquad.metrics import METRICS  # noqa: PLC0415
    from hullquad.metrics.values import difference_gradient, judged_values, raw_values, valid_elements  # noqa: PLC0415
    from hullquad.quads.join import joins  # noqa: PLC0415
    from hullquad.quads.pairs import pairs  # noqa: PLC0415

    corners: Floats = np.array([[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0]], dtype=float)
    up, quad = np.array([[0.0, 0.0, 1.0]]), np.array([[0, 1, 2, 3]], dtype=np.int32)
    halves = np.array([[0, 1, 2], [0, 2, 3]], dtype=np.int32)
    tangents = np.zeros((4, 2, 3))
    judged_values(METRICS[0], corners, quad, up)
    raw_values(METRICS[0], corners, quad, up)
    difference_gradient(METRICS[0], corners, quad, tangents, 1e-3, up)
    valid_elements(corners, quad, up)
    list(joins(pairs(corners, halves, up)))


def _states(contour: Contour, nodes: int) -> Bytes:
    states = np.full(nodes, NodeState.FREE, dtype=np.int8)
    states[: len(contour.nodes)] = NodeState.FIXED
    states[: contour.edge_count] = NodeState.CONTOUR
    return states
