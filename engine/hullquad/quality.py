"""How good a mesh is by one metric: value per element, worst, mean, which fail."""

import attrs
import numpy as np

from hullquad.arrays import Bools, Floats
from hullquad.mesh import Mesh
from hullquad.metrics import Metric


@attrs.frozen(eq=False, kw_only=True)
class Quality:
    """Judged values of every element, triangles beside quads [the metric's unit]."""

    metric: Metric
    values: Floats
    """(E,) infinite or 0 where an element is not valid."""
    valid: Bools
    """(E,) convex, not collapsed, not against the plate."""
    failing: Bools
    """(E,) beyond the limit."""

    @property
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

    @property
    def failing_count(self) -> int:
        """Number of elements beyond the limit."""
        return int(self.failing.sum())

    @property
    def inverted_count(self) -> int:
        """Number of elements that are not valid."""
        return int((~self.valid).sum())


def quality(mesh: Mesh, metric: Metric) -> Quality:
    """Quality of a mesh by a metric, failing where outside the metric's acceptable band."""
    from hullquad.metrics.values import judged_values  # noqa: PLC0415  brings Numba: half a second

    elements = mesh.topology.elements
    values, valid = judged_values(metric, mesh.points, elements, mesh.normals)
    limits = np.where(mesh.topology.is_triangle, metric.triangle_limit, metric.limit)
    beyond = values < limits if metric.higher_is_better else values > limits
    return Quality(metric=metric, values=values, valid=valid, failing=beyond | ~valid)
