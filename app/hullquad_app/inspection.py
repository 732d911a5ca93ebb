"""The element that is looked at: its shape, and what every metric says of it."""

from collections.abc import Mapping
from functools import cached_property

import attrs

from hullquad.anatomy import Anatomy
from hullquad.arrays import Bools
from hullquad.mesh import Mesh
from hullquad.metrics import Band, Metric
from hullquad.quality import Quality
from hullquad_app.verdict_words import Fate


@attrs.frozen(eq=False)
class Reading:
    """What one metric says of the element."""

    metric: Metric
    """Of the row; a triangle may be judged by another one."""
    judge: Metric
    """By which the value is."""
    value: float
    band: Band
    """Within which the element is acceptable, by `judge`."""
    fate: Fate


@attrs.frozen(eq=False, kw_only=True)
class Inspection:
    """The only selected element of the mesh that is shown; what is asked for is computed then, and once."""

    mesh: Mesh
    row: int
    metric: Metric
    """The chosen one."""
    bands: Mapping[str, Band]
    """The user's, by metric key."""

    @cached_property
    def anatomy(self) -> Anatomy:
        """Its edges and corners."""
        return Anatomy(self.mesh, self.row)

    @property
    def label(self) -> int:
        """As in the file."""
        return int(self.mesh.topology.element_labels[self.row])

    @property
    def is_triangle(self) -> bool:
        """Whether it has three corners."""
        return bool(self.mesh.topology.is_triangle[self.row])

    @cached_property
    def worst_corner(self) -> int | None:
        """Where its value by the chosen metric comes from; None where that is not of a corner."""
        return self.anatomy.worst_corner(self.metric)

    @cached_property
    def readings(self) -> tuple[Reading, ...]:
        """What every metric says, in the order of the table."""
        return tuple(self._reading(*found) for found in self.anatomy.judged(self.bands))

    def _reading(self, judged: Quality, given: Bools) -> Reading:
        row = judged.metric
        judge, band = (row.triangle_metric, judged.triangle_band) if self.is_triangle else (row, judged.band)
        fate = Fate(bool(judged.valid[0]), bool(judged.failing[0]), bool(given[0]))
        return Reading(row, judge, float(judged.values[0]), band, fate)
