"""What a run is to make better: one metric, or several with weights."""

import attrs
import numpy as np

from hullquad.arrays import Floats, Ints, floats, ints
from hullquad.errors import HullquadError
from hullquad.mesh import Mesh
from hullquad.metrics import METRICS, OBJECTIVES, Metric, metric

_UNIT = 0.75
"""What a metric counts over the way from its limit to its ideal: stretch, from 0.25 to 1, counts as itself."""


@attrs.frozen
class Term:
    """A metric with its weight."""

    metric: Metric
    weight: float = 1.0


@attrs.frozen
class Objective:
    """Metrics whose values over all quads are made better together."""

    terms: tuple[Term, ...]

    @property
    def metric(self) -> Metric:
        """The first: by which the mesh is judged."""
        return self.terms[0].metric

    @property
    def rows(self) -> Ints:
        """(K,) rows of the metrics in the table."""
        return ints([METRICS.index(term.metric) for term in self.terms])

    @property
    def gains(self) -> Floats:
        """(K,) what a unit of each metric's kernel is worth; negative where lower is better."""
        return floats([_gain(term) for term in self.terms])

    def total(self, mesh: Mesh) -> float:
        """Sum of the metric's raw values over all quads [its unit]; of several, what they gain, with weights."""
        if len(self.terms) == 1:
            return objective_sum(mesh, self.metric)
        worth = zip(self.gains.tolist(), self.terms, strict=True)
        return float(sum(gain * objective_sum(mesh, term.metric) / term.metric.factor for gain, term in worth))


def objective(text: str) -> Objective:
    """The objective that is written ``KEY[=WEIGHT][,KEY…]``.

    Raises
    ------
    HullquadError
        E_METRIC: no such metric. E_OBJECTIVE: one whose sum tells nothing, or a weight that is not above zero.
    """
    return Objective(tuple(_term(part) for part in text.split(",")))


def objective_sum(mesh: Mesh, metric: Metric) -> float:
    """The paper's objective: sum of the metric's raw values over all quads [the metric's unit]."""
    from hullquad.metrics.values import raw_values  # noqa: PLC0415  brings Numba: half a second

    return float(raw_values(metric, mesh.points, mesh.topology.quads, mesh.normals, mesh.reference_areas).sum())


def _term(text: str) -> Term:
    key, _, written = text.strip().partition("=")
    row = metric(key.strip())
    if row not in OBJECTIVES:
        raise HullquadError("E_OBJECTIVE", key)
    try:
        weight = float(written) if written else 1.0
    except ValueError:
        weight = 0.0
    if not 0.0 < weight < np.inf:
        raise HullquadError("E_OBJECTIVE", key, "weight", found=written)
    return Term(row, weight)


def _gain(term: Term) -> float:
    scale, (limit,) = term.metric.quads, term.metric.limits(term.metric.band)
    return term.weight * _UNIT * term.metric.factor / (scale.ideal - limit)
