"""The worst elements of a mesh, with the figures by which people look at them."""

import attrs
import numpy as np

from hullquad.arrays import Floats, Longs, floats, longs
from hullquad.mesh import Mesh
from hullquad.metrics import Metric, metric
from hullquad.quality import Quality


@attrs.frozen(eq=False, kw_only=True)
class Ranking:
    """The worst elements of a mesh, worst first."""

    rows: Longs = attrs.field(converter=longs)
    """(K,) their rows in the mesh."""
    min_angles: Floats = attrs.field(converter=floats)
    """(K,) smallest interior angle [degrees]."""
    aspect_ratios: Floats = attrs.field(converter=floats)
    """(K,) longest over shortest edge."""


def ranking(mesh: Mesh, judged: Quality, most: int) -> Ranking:
    """The worst elements of a mesh, at most so many, in the order of `Quality.worst_first`."""
    rows = worst_rows(judged, most)
    return Ranking(
        rows=rows,
        min_angles=values_of(mesh, metric("min_angle"), rows),
        aspect_ratios=values_of(mesh, metric("aspect_ratio"), rows),
    )


def worst_rows(judged: Quality, most: int) -> Longs:
    """The first rows of `Quality.worst_first`; of a large mesh without sorting all of it."""
    if len(judged.values) <= most:
        return judged.worst_first
    badness = np.where(judged.valid, judged.badness, np.inf)
    least = -np.partition(-badness, most - 1)[most - 1]
    candidates = np.flatnonzero(badness >= least)
    order = np.lexsort((-judged.badness[candidates], judged.valid[candidates]))
    return longs(candidates[order][:most])


def values_of(mesh: Mesh, by: Metric, rows: Longs) -> Floats:
    """Judged values of some elements of a mesh by a metric."""
    from hullquad.metrics.values import judged_values  # noqa: PLC0415  brings Numba: half a second

    return judged_values(by, mesh.points, mesh.topology.elements[rows], mesh.normals, mesh.areas)[0]
