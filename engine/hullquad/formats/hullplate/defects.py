"""Faults in the shape of a plate: contours that cross, lines that leave it."""

from collections.abc import Iterator
from functools import cache

import numpy as np
import numpy.typing as npt
import shapely

from hullquad.arrays import Floats
from hullquad.errors import PlateError
from hullquad.plate import Line, Loop, Plate
from hullquad.triangulation.anchors import nearest_edges
from hullquad.triangulation.clearance import crossing, near_segments
from hullquad.triangulation.contour import refuse_size

_SLENDEREST = 1e-2
"""Part of the least length by which vertices must stay clear of the other edges of their loop."""


def defects(plate: Plate) -> list[PlateError]:
    """Return everything that makes the shape of the plate impossible; an empty list for a sound one."""
    in_loops = [*_loop_defects(plate)]
    if in_loops:
        return in_loops
    return [*_hole_defects(plate), *_line_defects(plate), *_point_defects(plate)]


def _loop_defects(plate: Plate) -> Iterator[PlateError]:
    for loop, outline in zip(plate.loops, plate.outlines, strict=True):
        polygon = shapely.Polygon(outline)
        least_area = plate.least_length**2
        if polygon.convex_hull.area < least_area:
            yield PlateError("E_AREA", loop.place, u=outline[0, 0], v=outline[0, 1])
        elif not polygon.is_valid:
            u, v = crossing(polygon)
            yield PlateError("E_SELF_INTERSECT", loop.place, u=u, v=v)
        elif polygon.area < least_area:
            yield PlateError("E_AREA", loop.place, u=outline[0, 0], v=outline[0, 1])
        else:
            yield from _necks(loop, outline, _SLENDEREST * plate.least_length, plate.unit)


def _necks(loop: Loop, outline: Floats, least: float, unit: str) -> Iterator[PlateError]:
    """Refuse a loop that nearly touches itself: the mesher would take the two sides for one."""
    vertices = np.stack([curve.start for curve in loop.curves])
    touching = near_segments(vertices, outline, [0, len(outline)], least)
    if len(touching):
        u, v = vertices[touching[0, 0]]
        yield PlateError("E_SELF_INTERSECT", loop.place, "neck", u=u, v=v, least=least, unit=unit)


def _hole_defects(plate: Plate) -> Iterator[PlateError]:
    openings = plate.openings
    rim = shapely.Polygon(plate.outlines[0])
    shapely.prepare(rim)
    edge = rim.exterior
    shapely.prepare(edge)
    is_inside = shapely.contains(rim, openings)
    is_near = shapely.dwithin(edge, openings, plate.least_length)
    neighbours = _neighbours(openings, plate.least_length)
    for i, hole in enumerate(plate.holes):
        u, v = plate.outlines[i + 1][0]
        width = float(shapely.distance(edge, openings[i])) if is_near[i] else np.inf
        if not is_inside[i] or width == 0:
            case = "crossing" if shapely.intersects(rim, openings[i]) else ""
            yield PlateError("E_HOLE_OUTSIDE", hole.place, case, u=u, v=v)
        elif width < plate.least_length:
            numbers = {"u": u, "v": v, "width": width, "least": plate.least_length, "unit": plate.unit}
            yield PlateError("E_LIGAMENT", hole.place, "contour", **numbers)
        elif i in neighbours:
            other = neighbours[i]
            width = float(shapely.distance(openings[i], openings[other]))
            code = "E_LIGAMENT" if width > 0 else "E_HOLE_OVERLAP"
            numbers = {"u": u, "v": v, "hole": other, "width": width, "least": plate.least_length, "unit": plate.unit}
            yield PlateError(code, hole.place, "hole" if width > 0 else "", **numbers)


def _neighbours(openings: npt.NDArray[np.object_], distance: float) -> dict[int, int]:
    """For each hole that comes too near to one before it, the first such one."""
    one, other = shapely.STRtree(openings).query(openings, predicate="dwithin", distance=distance)
    is_near = (other < one) & (shapely.distance(openings[one], openings[other]) < distance)
    pairs = np.stack([one, other], axis=1)[is_near].tolist()
    return dict(sorted(pairs, reverse=True))


def _line_defects(plate: Plate) -> Iterator[PlateError]:
    rim = shapely.Polygon(plate.outlines[0])
    shapely.prepare(rim)

    @cache
    def widened() -> shapely.Polygon:
        return rim.buffer(plate.snap + plate.outline_error, join_style="mitre")

    for line, row in zip(plate.lines, plate.rows, strict=True):
        if not rim.covers(row) and not (widened().covers(row) and _ends_at_rim(plate, line, rim)):
            yield _line_outside(line, row, rim.buffer(plate.snap, join_style="mitre"))


def _ends_at_rim(plate: Plate, line: Line, rim: shapely.Polygon) -> bool:
    """Whether the ends of a line that its outlines leave outside are on the true edges of the plate."""
    ends = np.stack([line.a, line.b])
    beyond = ends[~shapely.covers(rim, shapely.points(ends))]
    return None not in nearest_edges(plate, beyond)


def _line_outside(line: Line, row: shapely.LineString, widened: shapely.Polygon) -> PlateError:
    beyond = shapely.get_coordinates(shapely.difference(row, widened))
    u, v = beyond[-1] if len(beyond) else line.b
    return PlateError("E_LINE_OUTSIDE", line.place, u=float(u), v=float(v))


def _point_defects(plate: Plate) -> Iterator[PlateError]:
    points = shapely.points(plate.fixed)
    beyond = np.flatnonzero(~shapely.intersects(plate.region, points))
    edges = nearest_edges(plate, plate.fixed[beyond])
    for i in (i for i, edge in zip(beyond, edges, strict=True) if edge is None):
        u, v = plate.fixed[i]
        yield PlateError("E_POINT_OUTSIDE", f"{plate.place}/fixed/{i}", u=u, v=v)


def size_defects(plate: Plate) -> Iterator[PlateError]:
    """Refuse a target size with which a plate that is sound otherwise could not be meshed."""
    if plate.is_parametric:
        return  # no lengths before the surface can tell them
    try:
        refuse_size(plate, plate.target_size, f"{plate.place}/target_size")
    except PlateError as error:
        yield error
