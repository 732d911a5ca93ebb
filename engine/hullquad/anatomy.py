"""One element by itself: its edges, its corners, and what every metric says of it."""

from collections.abc import Mapping
from functools import cached_property

import attrs
import numpy as np

from hullquad.arrays import Bools, Floats, floats
from hullquad.given import given
from hullquad.mesh import Mesh
from hullquad.metrics import METRICS, Band, Metric, metric
from hullquad.quality import Quality

_NONE: Bools = np.zeros(1, dtype=bool)


@attrs.frozen(eq=False)
class Anatomy:
    """An element of a mesh."""

    mesh: Mesh
    row: int
    """Of the element in the mesh."""

    @cached_property
    def corners(self) -> Floats:
        """(3 or 4, 3) places of its nodes, in order [mm]."""
        nodes = self.mesh.topology.elements[self.row]
        return floats(self.mesh.points[nodes[nodes >= 0]])

    @cached_property
    def edge_lengths(self) -> Floats:
        """(3 or 4,) lengths of its edges, each from a corner to the next [mm]."""
        return floats(np.linalg.norm(np.roll(self.corners, -1, axis=0) - self.corners, axis=1))

    @cached_property
    def corner_angles(self) -> Floats:
        """(3 or 4,) interior angles; above 180 at a concave corner of a quad [degrees]."""
        return floats(self._of_corners(metric("max_angle"))[: len(self.corners)])

    def worst_corner(self, by: Metric) -> int | None:
        """Which corner a metric is the value of; None where it is not the value of a corner."""
        if not by.is_of_corners:
            return None
        values, scale = self._of_corners(by), by.triangles if self._is_triangle else by.quads
        if scale is None or np.isnan(values).all():
            return None
        return int(np.nanargmax(by.badness(values, scale.ideal)))

    def judged(self, bands: Mapping[str, Band]) -> tuple[tuple[Quality, Bools], ...]:
        """Its quality by every metric, and whether the contour gives it so; `bands` are the user's, by metric key."""
        from hullquad.metrics.values import all_judged  # noqa: PLC0415  brings Numba

        whole, alone = self.mesh, self._alone
        values, valid = all_judged(alone.points, alone.topology.elements, alone.normals, whole.areas)
        found = (
            _quality(row, bands.get(row.key, row.band), values[:, column], valid, alone.topology.is_triangle)
            for column, row in enumerate(METRICS)
        )
        return tuple((judged, given(alone, judged) if judged.failing[0] else _NONE) for judged in found)

    @property
    def _is_triangle(self) -> bool:
        return len(self.corners) == 3

    @cached_property
    def _alone(self) -> Mesh:
        """A mesh of this element only."""
        grid = self.mesh.topology
        chosen = attrs.evolve(grid, elements=grid.elements[[self.row]], element_labels=grid.element_labels[[self.row]])
        return attrs.evolve(self.mesh, topology=chosen)

    def _of_corners(self, by: Metric) -> Floats:
        from hullquad.metrics.values import corner_values  # noqa: PLC0415

        return np.ravel(corner_values(by, self.mesh.points, self._alone.topology.elements, self._alone.normals))


def _quality(by: Metric, band: Band, values: Floats, valid: Bools, is_triangle: Bools) -> Quality:
    judge, ends = (by.triangle_metric, by.triangle_band_beside(band)) if is_triangle[0] else (by, band)
    failing = ~(judge.is_within(ends, values) & valid)
    return Quality(metric=by, band=band, values=values, valid=valid, failing=failing, is_triangle=is_triangle)
