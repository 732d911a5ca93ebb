"""Necks: where two edges of one loop come near each other, with wider parts of the plate on both sides."""

from collections.abc import Iterator

import attrs
import numpy as np
import shapely

from hullquad.arrays import Floats, floats
from hullquad.curves import polyline
from hullquad.plate import Loop, Plate

_WIDER = 1.1
"""Parts beside a neck are wider so many times, or the plate only runs out there into a corner or a narrow end."""


@attrs.frozen(eq=False)
class Neck:
    """The shortest way across the plate from one edge of a loop to another one."""

    place: str
    """Path in the document of the first edge."""
    width: float
    """[mm]"""
    point: Floats = attrs.field(converter=floats)
    """(2,) on the first edge, in the plate's plane."""


def necks(plate: Plate, width: float) -> Iterator[Neck]:
    """Of every loop the narrowest neck, if there is one that is narrower than a width [mm]."""
    for loop in plate.loops:
        found = sorted(_necks(plate, loop, width), key=lambda neck: round(neck.width, 6))
        yield from found[:1]


def _necks(plate: Plate, loop: Loop, width: float) -> Iterator[Neck]:
    rows = np.array([shapely.LineString(polyline(curve, plate.chord_error)) for curve in loop.curves])
    one, other = shapely.STRtree(rows).query(rows, predicate="dwithin", distance=width)
    apart = (other - one > 1) & (other - one < len(rows) - 1)
    one, other = one[apart], other[apart]
    ways = shapely.shortest_line(rows[one], rows[other])
    within = shapely.contains(plate.region, shapely.line_interpolate_point(ways, 0.5, normalized=True))
    ring = shapely.LineString(
        np.concatenate([shapely.get_coordinates(row)[:-1] for row in rows] + [rows[0].coords[:1]])
    )
    for i in np.flatnonzero(within & (shapely.length(ways) < width)):
        if _joins_wider_parts(ring, ways[i]):
            point = shapely.get_coordinates(ways[i])[0]
            yield Neck(loop.edge_place(int(one[i])), float(ways[i].length), point)


def _joins_wider_parts(ring: shapely.LineString, way: shapely.LineString) -> bool:
    """Whether both parts that a way across cuts a loop into are wider than the way is long."""
    start, end = sorted(ring.project(shapely.Point(point)) for point in way.coords)
    row = shapely.get_coordinates(ring)
    at = np.concatenate([[0.0], np.cumsum(np.hypot(*np.diff(row, axis=0).T))])
    is_between = (at > start) & (at < end)
    ends = shapely.get_coordinates([ring.interpolate(start), ring.interpolate(end)])
    parts = [
        np.concatenate([ends[:1], row[is_between], ends[1:]]),
        np.concatenate([row[at <= start], ends, row[:-1][at[:-1] >= end]]),
    ]
    reach = _WIDER * way.length / 2
    return all(len(part) > 2 and not shapely.Polygon(part).buffer(0).buffer(-reach).is_empty for part in parts)
