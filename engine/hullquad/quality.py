"""How good a mesh is by one metric: value per element, worst, mean, which fail, how they are spread."""

from functools import cached_property
from math import isfinite

import attrs
import numpy as np

from hullquad.arrays import Bools, Floats, Longs
from hullquad.mesh import Mesh
from hullquad.metrics import Metric


@attrs.frozen(eq=False, kw_only=True)
class Quality:
    """Judged values of every element, triangles beside quads [the metric's unit]."""

    metric: Metric
    limit: float
    """At which quads begin to fail."""
    values: Floats
    """(E,) infinite, 0 or beyond the range where an element is not valid."""
    valid: Bools
    """(E,) convex, not collapsed, not against the plate."""
    failing: Bools
    """(E,) beyond its limit, or not valid."""
    is_triangle: Bools
    """(E,)"""

    @cached_property
    def worst_element(self) -> int:
        """Row of the worst element."""
        return int(self.values.argmin() if self.metric.higher_is_better else self.values.argmax())

    @property
    def worst(self) -> float:
        """Value of the worst element."""
        return float(self.values[self.worst_element])

    @property
    def mean(self) -> float:
        """Mean over all elements; infinite where one is."""
        return float(self.values.mean())

    @cached_property
    def failing_count(self) -> int:
        """Number of elements beyond their limit."""
        return int(self.failing.sum())

    @cached_property
    def inverted_count(self) -> int:
        """Number of elements that are not valid."""
        return int((~self.valid).sum())

    @cached_property
    def worst_first(self) -> Longs:
        """(E,) rows of the elements, those that are not valid first, then from the worst value to the best."""
        badness = -self.values if self.metric.higher_is_better else self.values
        return np.lexsort((-badness, self.valid))

    @cached_property
    def grades(self) -> Floats:
        """(E,) from -1 (as bad as can be) over 0 (the limit of the element's kind) to 1 (ideal)."""
        triangles = graded(self.metric.triangle_metric, self.values, self.metric.triangle_limit, triangle=True)
        quads = graded(self.metric, self.values, self.limit)
        return np.where(self.valid, np.where(self.is_triangle, triangles, quads), -1.0)

    def grade(self, value: float) -> float:
        """Grade of a quad of that value."""
        return float(graded(self.metric, np.array([value]), self.limit)[0])


def quality(mesh: Mesh, metric: Metric, limit: float | None = None) -> Quality:
    """Quality of a mesh by a metric.

    Quads fail beyond `limit`, or outside the metric's acceptable band when there is none; triangles always
    by their own band.
    """
    from hullquad.metrics.values import judged_values  # noqa: PLC0415  brings Numba: half a second

    elements, is_triangle = mesh.topology.elements, mesh.topology.is_triangle
    limit = metric.limit if limit is None else limit
    values, valid = judged_values(metric, mesh.points, elements, mesh.normals)
    limits = np.where(is_triangle, metric.triangle_limit, limit)
    beyond = values < limits if metric.higher_is_better else values > limits
    return Quality(
        metric=metric,
        limit=limit,
        values=values,
        valid=valid,
        failing=beyond | ~valid,
        is_triangle=is_triangle,
    )


def graded(metric: Metric, values: Floats, limit: float, *, triangle: bool = False) -> Floats:
    """Grade of each value: from -1 (as bad as can be) over 0 (the limit) to 1 (ideal)."""
    ideal = metric.triangle_ideal if triangle else metric.ideal
    passing = (values - limit) / (ideal - limit) if ideal != limit else np.ones_like(values)
    worst = metric.darkest
    if isfinite(worst):
        failing = (limit - values) / (worst - limit) if worst != limit else -np.ones_like(values)
    else:
        failing = limit / np.maximum(values, limit) - 1.0
    beyond = values < limit if metric.higher_is_better else values > limit
    return np.where(beyond, np.clip(failing, -1.0, 0.0), np.clip(passing, 0.0, 1.0))
