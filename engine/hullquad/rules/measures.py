"""What rules measure: metrics, metrics over a length of the mesh, and what only a whole mesh has."""

import attrs

from hullquad.mesh import Mesh
from hullquad.metrics import METRICS

VALID = "valid"
TRIANGLE_SHARE = "triangle_share"


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
    over: str = ""
    """The length of the mesh that the metric is divided by: ``target_size``, ``thickness``; empty for none."""

    def length(self, mesh: Mesh) -> float | None:
        """What the metric is divided by [mm]; 1 for nothing, None where the mesh does not tell it."""
        if not self.over:
            return 1.0
        if self.over == "target_size" and mesh.is_bare:
            return None  # the mean length of its edges is not what somebody asked for
        length: float | None = getattr(mesh, self.over)
        return length


_OF_MESHES = (
    Measure(VALID, "Valid", "1 where the element is convex, not collapsed and not against the plate, else 0"),
    Measure(TRIANGLE_SHARE, "Share of triangles", "triangles / elements"),
    Measure("edge_over_size", "Longest edge / element size", "longest edge / the mesh's target size s",
            metric="longest_edge", over="target_size"),
    Measure("edge_over_thickness", "Longest edge / thickness", "longest edge / the plate's thickness t",
            metric="longest_edge", over="thickness"),
)  # fmt: skip

MEASURES: dict[str, Measure] = {
    **{row.key: Measure(row.key, row.title, row.formula, row.unit, row.key) for row in METRICS},
    **{row.key: row for row in _OF_MESHES},
}
"""Every measure by its key."""
