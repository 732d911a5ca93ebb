"""The table of quality metrics; their compiled kernels are loaded on first use (`hullquad.metrics.values`)."""

from hullquad.errors import HullquadError
from hullquad.metrics.row import DEGREES, Band, Metric, Scale, Sense
from hullquad.metrics.table import METRICS

__all__ = ["DEGREES", "METRICS", "OBJECTIVES", "Band", "Metric", "Scale", "Sense", "metric"]

_SAME_FOR_ALL_QUADS = "abaqus_shape_factor"

OBJECTIVES: tuple[Metric, ...] = tuple(
    row for row in METRICS if row.sense is not Sense.NEARER and row.key != _SAME_FOR_ALL_QUADS
)
"""Metrics whose sum over the quads can be made better."""

_BY_KEY = {row.key: row for row in METRICS}


def metric(key: str) -> Metric:
    """The table's row with that key; an error that names the known ones where there is none."""
    try:
        return _BY_KEY[key]
    except KeyError:
        raise HullquadError("E_METRIC", key, known=", ".join(_BY_KEY)) from None
