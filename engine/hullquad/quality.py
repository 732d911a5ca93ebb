"""How good a mesh is by one metric: value per element, worst, mean, which fail, how they are spread."""

from functools import cached_property

import attrs
import numpy as np

from hullquad.arrays import Bools, Floats, Longs
from hullquad.grades import graded, value_of_grade
from hullquad.mesh import Mesh
from hullquad.metrics import Band, Metric


@attrs.frozen(eq=False, kw_only=True)
class Quality:
    """Judged values of every element, triangles beside quads [the metric's unit]."""

    metric: Metric
    band: Band
    """Within which quads are acceptable."""
    values: Floats
    """(E,) infinite, 0 or beyond the range where an element is not valid; of triangles by `Metric.triangle_metric`."""
    valid: Bools
    """(E,) convex, not collapsed, not against the plate."""
    failing: Bools
    """(E,) outside its band, or not valid."""
    is_triangle: Bools
    """(E,)"""

    @property
    def limits(self) -> tuple[float, ...]:
        """Where quads begin to fail: at one value, or at two of a two-sided metric."""
        return self.metric.limits(self.band)

    @property
    def triangle_band(self) -> Band:
        """Within which triangles are acceptable, by `Metric.triangle_metric`."""
        return self.metric.triangle_band_beside(self.band)

    @cached_property
    def is_on_scale(self) -> Bools:
        """(E,) whose values stand on the metric's axis: all but triangles that are judged by another measure."""
        return np.ones_like(self.is_triangle) if self.metric.holds_triangles else ~self.is_triangle

    @cached_property
    def worst_element(self) -> int:
        """Row of the worst element; where triangles are judged by another measure, the worst quad if there is one."""
        chosen = self.is_on_scale if self.is_on_scale.any() else ~self.is_on_scale
        return int(np.where(chosen, self.badness, -np.inf).argmax())

    @property
    def worst(self) -> float:
        """Value of the worst element."""
        return float(self.values[self.worst_element])

    @property
    def worst_quad(self) -> float:
        """Value of the worst quad; of the worst element where there are none."""
        if self.is_triangle.all():
            return self.worst
        return float(self.values[np.where(self.is_triangle, -np.inf, self.badness).argmax()])

    @cached_property
    def mean(self) -> float:
        """Mean over the elements on the metric's axis; infinite where one is, nan where there are none."""
        values = self.values[self.is_on_scale]
        return float(values.mean()) if len(values) else float("nan")

    @cached_property
    def failing_count(self) -> int:
        """Number of elements outside their band."""
        return int(self.failing.sum())

    @cached_property
    def inverted_count(self) -> int:
        """Number of elements that are not valid."""
        return int((~self.valid).sum())

    @cached_property
    def worst_first(self) -> Longs:
        """(E,) rows of the elements, those that are not valid first, then from the worst to the best."""
        return np.lexsort((-self.badness, self.valid))

    @cached_property
    def badness(self) -> Floats:
        """(E,) how bad each element is, the greater the worse [the metric's unit].

        A triangle that is judged by another measure is as bad as a quad of its grade.
        """
        metric = self.metric
        if metric.triangles is not None:
            ideals = np.where(self.is_triangle, metric.triangles.ideal, metric.quads.ideal)
            return metric.badness(self.values, ideals)
        values = self.values
        if not metric.holds_triangles:
            values = np.where(self.is_triangle, value_of_grade(metric, self.grades, self.band), values)
        return metric.badness(values)

    @cached_property
    def grades(self) -> Floats:
        """(E,) from -1 (as bad as can be) over 0 (the end of the band of the element's kind) to 1 (ideal)."""
        row = self.metric
        triangles = graded(row.triangle_metric, self.values, self.triangle_band, ideal=row.triangle_scale.ideal)
        quads = graded(row, self.values, self.band)
        return np.where(self.valid, np.where(self.is_triangle, triangles, quads), -1.0)

    def grade(self, value: float) -> float:
        """Grade of a quad of that value."""
        return float(graded(self.metric, np.array([value]), self.band)[0])


def quality(mesh: Mesh, metric: Metric, band: Band | None = None) -> Quality:
    """Quality of a mesh by a metric.

    Quads fail outside `band`, or outside the metric's acceptable band when there is none; triangles outside the same
    if the metric has one scale for both, else outside their own.
    """
    from hullquad.metrics.values import judged_values  # noqa: PLC0415  brings Numba: half a second

    elements, is_triangle = mesh.topology.elements, mesh.topology.is_triangle
    band = metric.band if band is None else band
    values, valid = judged_values(metric, mesh.points, elements, mesh.normals, mesh.reference_areas)
    within = np.where(
        is_triangle,
        metric.triangle_metric.is_within(metric.triangle_band_beside(band), values),
        metric.is_within(band, values),
    )
    return Quality(
        metric=metric, band=band, values=values, valid=valid, failing=~(within & valid), is_triangle=is_triangle
    )
