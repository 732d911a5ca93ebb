"""What Triangle must never get: it would crash, hang, or answer nonsense without a word."""

import math

import numpy as np
import numpy.typing as npt
import shapely

from hullquad.arrays import Bools, Floats, Longs, floats, longs
from hullquad.errors import MeshingError
from hullquad.triangulation.clearance import crossing, near_segments
from hullquad.triangulation.region import Region

FARTHEST = 1e12
"""Largest coordinate; beyond it products of four coordinates come near the largest double."""

WIDEST_ANGLE = 33.0
"""Largest minimum angle for which Triangle ends in practice."""

TRIANGLES_PER_AREA = 1.58
"""Triangles that Triangle makes of a region, times the largest area allowed, over the region's area."""


def sound_region(nodes: npt.ArrayLike, loop_starts: npt.ArrayLike, place: str) -> Region:
    """The region, when it is one that Triangle can be trusted with; MeshingError otherwise."""
    region = Region(_sound_nodes(nodes, place), longs([0]))
    region = Region(region.nodes, _sound_starts(loop_starts, len(region.nodes), place))
    _refuse_coincident_nodes(region, place)
    _refuse_touching_edges(region, place)
    _refuse_crossing_loops(region, place)
    _refuse_turned_loops(region, place)
    _refuse_points_outside(region, place)
    return region


def refuse_limits(area: float | None, min_angle: float, place: str) -> None:
    """Refuse a largest area or a smallest angle that Triangle would misread."""
    if area is not None and not (math.isfinite(area) and area > 0):
        raise MeshingError("E_TRIANGLE", place, "area", area=area)
    if not 0 <= min_angle <= WIDEST_ANGLE:
        raise MeshingError("E_TRIANGLE", place, "angle", angle=min_angle, most=WIDEST_ANGLE)


def expected_triangles(region: Region, area: float | None) -> float:
    """About how many triangles a region will have, from its nodes and from its area."""
    return 2 * len(region.nodes) + (TRIANGLES_PER_AREA * region.polygon.area / area if area else 0)


def refuse_too_many(triangles: float, element_limit: int, place: str) -> None:
    """Refuse what would need more triangles than the limit."""
    if triangles > element_limit:
        raise MeshingError("E_TRIANGLE", place, "many", triangles=triangles, most=element_limit)


def _sound_nodes(nodes: npt.ArrayLike, place: str) -> Floats:
    given = np.asarray(nodes)
    if given.dtype.kind not in "fiu" or given.ndim != 2 or given.shape[1] != 2:
        raise MeshingError("E_CONTOUR", place, "numbers")
    found = floats(given)
    _refuse("far", ~(np.abs(found).max(axis=1) <= FARTHEST), found, place)  # NaN is not <= either
    return found


def _sound_starts(loop_starts: npt.ArrayLike, nodes: int, place: str) -> Longs:
    given = np.asarray(loop_starts)
    countable = given.dtype.kind in "iu" and given.ndim == 1 and len(given) >= 2
    if not (countable and given[0] == 0 and (np.diff(given.astype(np.int64)) >= 3).all() and given[-1] <= nodes):
        raise MeshingError("E_CONTOUR", place, "loops")
    return longs(given)


def _refuse_coincident_nodes(region: Region, place: str) -> None:
    from scipy.spatial import KDTree  # noqa: PLC0415  a quarter of a second, while a plate may be opening

    last, first = region.starts[1:] - 1, region.starts[:-1]
    closing = np.zeros(len(region.nodes), dtype=bool)
    closing[last] = np.hypot(*(region.nodes[last] - region.nodes[first]).T) < region.tolerance
    _refuse("closing", closing, region.nodes, place)
    distances = np.asarray(KDTree(region.nodes).query(region.nodes, k=[2])[0])[:, 0]
    _refuse("coincident", distances < region.tolerance, region.nodes, place)


def _refuse_touching_edges(region: Region, place: str) -> None:
    near = near_segments(region.nodes, region.contour, region.starts.tolist(), region.tolerance)
    touching = np.zeros(len(region.nodes), dtype=bool)
    touching[near[:, 0]] = True
    _refuse("touching", touching, region.nodes, place)


def _refuse_crossing_loops(region: Region, place: str) -> None:
    if not shapely.is_valid(region.polygon):
        x, y = crossing(region.polygon)
        raise MeshingError("E_CONTOUR", place, "crossing", u=float(x), v=float(y))


def _refuse_turned_loops(region: Region, place: str) -> None:
    runs_left = shapely.is_ccw([shapely.LinearRing(loop) for loop in region.loops])
    wanted = np.arange(len(runs_left)) == 0
    _refuse("turned", runs_left != wanted, region.nodes[region.starts[:-1]], place)


def _refuse_points_outside(region: Region, place: str) -> None:
    shapely.prepare(region.polygon)
    _refuse("outside", ~shapely.contains_xy(region.polygon, region.inside), region.inside, place)


def _refuse(case: str, faulty: Bools, points: Floats, place: str) -> None:
    """Refuse the first faulty point."""
    if faulty.any():
        u, v = points[np.argmax(faulty)]
        raise MeshingError("E_CONTOUR", place, case, u=float(u), v=float(v), count=int(faulty.sum()))
