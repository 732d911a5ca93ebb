"""What rules measure: metrics, metrics over a length, and what only a whole mesh has."""

from collections.abc import Callable

import attrs
import numpy as np

from hullquad.arrays import Floats
from hullquad.mesh import Mesh
from hullquad.metrics import METRICS

VALID = "valid"
TRIANGLE_SHARE = "triangle_share"

_LEAST_SIDE = 1e-200  # only keeps quotients finite

_Length = Callable[[Mesh], float | Floats]


@attrs.frozen
class Measure:
    """One row of the table of measures."""

    key: str
    title: str
    formula: str
    """In words and signs, for people."""
    unit: str = ""
    metric: str = ""
    """Key of the metric that the elements are measured by; empty for what only the whole mesh has."""
    needs: str = ""
    """What the mesh must tell: ``target_size``, ``thickness``; empty for nothing."""
    length: _Length = lambda _: 1.0
    """What the metric is divided by: one length, or one for each element [mm]."""

    def is_told_by(self, mesh: Mesh) -> bool:
        """Whether the mesh tells what is needed."""
        if self.needs == "target_size":
            return not mesh.is_bare  # the mean length of its edges is not what somebody asked for
        return self.needs != "thickness" or mesh.thickness is not None


def _size(mesh: Mesh) -> float:
    return mesh.target_size


def _thickness(mesh: Mesh) -> float:
    assert mesh.thickness is not None  # nobody asks before `is_told_by`
    return mesh.thickness


def _thickness_per_side(mesh: Mesh) -> Floats:
    """(E,) thickness over the side of a square of the element's projected area."""
    a, b, c, d = (mesh.points[mesh.topology.elements[:, corner]] for corner in range(4))
    doubled = np.linalg.norm(np.cross(c - a, d - b), axis=1)
    return np.asarray(_thickness(mesh) / np.maximum(np.sqrt(doubled / 2.0), _LEAST_SIDE))


_OF_MESHES = (
    Measure(VALID, "Valid", "1 where the element is convex, not collapsed and not against the plate, else 0"),
    Measure(TRIANGLE_SHARE, "Share of triangles", "triangles / elements"),
    Measure("edge_over_size", "Longest edge / element size", "longest edge / target size s of the mesh",
            metric="longest_edge", needs="target_size", length=_size),
    Measure("edge_over_thickness", "Longest edge / thickness", "longest edge / thickness t of the plate",
            metric="longest_edge", needs="thickness", length=_thickness),
    Measure("ansys_warping_over_thickness", "Warping over thickness (ANSYS)",
            "height of an edge's ends off each other / thickness t of the plate",
            metric="ansys_warping_factor", needs="thickness", length=_thickness_per_side),
)  # fmt: skip

MEASURES: dict[str, Measure] = {
    **{row.key: Measure(row.key, row.title, row.formula, row.unit, row.key) for row in METRICS},
    **{row.key: row for row in _OF_MESHES},
}
"""Every measure by its key."""
