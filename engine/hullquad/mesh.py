"""The mesh: quads and triangles on a plate, as one value that never changes."""

from functools import cached_property

import attrs
import numpy as np

from hullquad.arrays import Floats, Ints, floats
from hullquad.surface import Plane
from hullquad.topology import Topology, rim_edge_count


@attrs.frozen(eq=False, kw_only=True, repr=False)
class Mesh:
    """Quads and triangles in space, with all that is known of them.

    Moving nodes gives a new mesh that shares the topology.
    """

    points: Floats = attrs.field(converter=floats)
    """(N, 3) [mm]"""
    topology: Topology
    target_size: float
    """Length that an edge should have [mm]."""
    surface: Plane | None = None
    """What the nodes lie on; None for a mesh of unknown origin that is not flat."""
    parameters: Floats | None = attrs.field(default=None, converter=attrs.converters.optional(floats))
    """(N, 2) places of the nodes on `surface`."""
    lines: Floats = attrs.field(factory=lambda: np.empty((0, 2, 3)), converter=floats)
    """(L, 2, 3) ends of the plate's stiffener and seam lines [mm]."""
    reference_areas: Floats | None = attrs.field(default=None, converter=attrs.converters.optional(floats))
    """(2,) what sizes of quads and of triangles are relative to [mm²]; None for the means of its own."""
    unavoidable: int | None = None
    """Triangles that no mesh with these nodes on its contour and its followed lines can do without; None where elements
    follow no lines, for then the contour tells."""
    plate_id: str = ""
    thickness: float | None = None
    """[mm]"""
    input_hash: str = ""
    """SHA-256 of the plate document the mesh was made from."""

    def __repr__(self) -> str:
        known = self.topology
        counts = f"{len(known.quads)} quads, {len(known.triangles)} triangles, {len(self.points)} nodes"
        return f"<Mesh {self.plate_id or 'bare'}: {counts}>"

    @property
    def is_bare(self) -> bool:
        """Whether nothing is known of it but nodes and elements: it comes from another program."""
        return not self.input_hash

    @property
    def triangles_unavoidable(self) -> int:
        """Triangles that no mesh of this contour, and with these followed lines, can do without."""
        return rim_edge_count(self.topology.elements) % 2 if self.unavoidable is None else self.unavoidable

    @property
    def normals(self) -> Floats:
        """(1, 3) direction that elements must face; zero where only their own sense is known."""
        return np.zeros((1, 3)) if self.surface is None else self.surface.normal[None]

    @cached_property
    def areas(self) -> Floats:
        """(2,) what sizes of quads and of triangles are relative to [mm²]."""
        if self.reference_areas is not None:
            return self.reference_areas
        return mean_areas(self.points, self.topology.elements)

    def with_parameters(self, parameters: Floats) -> "Mesh":
        """The same mesh, its free nodes at `parameters` (N, 2); every other node keeps its bits.

        Sizes stay relative to what they were before: elements do not change with those far away.
        """
        if self.surface is None or self.parameters is None:
            raise ValueError("a mesh without a surface has no parameters")
        free = self.topology.is_free[:, None]
        points = np.where(free, self.surface.points(parameters), self.points)
        parameters = np.where(free, parameters, self.parameters)
        return attrs.evolve(self, points=points, parameters=parameters, reference_areas=self.areas)


def mean_areas(points: Floats, elements: Ints) -> Floats:
    """(2,) mean projected areas of the quads and of the triangles [mm²]; 0 where there are none."""
    is_triangle = elements[:, 3] < 0
    last = points[np.where(is_triangle, elements[:, 0], elements[:, 3])]
    across, along = points[elements[:, 2]] - points[elements[:, 0]], last - points[elements[:, 1]]
    with np.errstate(invalid="ignore", over="ignore"):
        doubled = np.linalg.norm(np.cross(across, along), axis=1)
    kinds = (0.5 * doubled[np.isfinite(doubled) & (is_triangle == kind)] for kind in (False, True))
    return floats([areas.mean() if len(areas) else 0.0 for areas in kinds])
