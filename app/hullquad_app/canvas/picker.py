"""Which element is at a place of the picture."""

import numpy as np

from hullquad.arrays import Floats
from hullquad.mesh import Mesh
from hullquad.sight import Sight, sight
from hullquad_app.canvas.camera import Camera


class Picker:
    """Keeps how a mesh lies across the view, until its nodes or the direction change."""

    def __init__(self) -> None:
        self._sight: Sight | None = None
        self._seen: tuple[object, ...] = ()

    def element_at(self, mesh: Mesh | None, camera: Camera, place: Floats) -> int:
        """Row of the element at a place (2,) across the view; -1 where there is none."""
        if mesh is None:
            return -1
        seen = (mesh.points, camera.right, camera.up)
        if self._sight is None or any(one is not other for one, other in zip(seen, self._seen, strict=True)):
            self._seen = seen
            self._sight = sight(mesh.points, mesh.topology.elements, camera.right, camera.up)
        return self._sight.element_at(place)


def corners(mesh: Mesh, row: int) -> Floats:
    """(3 or 4, 3) corners of an element."""
    nodes = mesh.topology.elements[row]
    return np.asarray(mesh.points[nodes[nodes >= 0]])


def nodes_of(mesh: Mesh, rows: "list[int]") -> Floats:
    """(N, 3) the nodes of several elements."""
    nodes = np.unique(mesh.topology.elements[rows])
    return np.asarray(mesh.points[nodes[nodes >= 0]])
