"""What of other plates lies in the plane of a plate: edges that stand on it, points on its face."""

from collections.abc import Iterator, Sequence

import numpy as np
import shapely

from hullquad.arrays import Bools, Floats, Longs, floats, longs
from hullquad.plate import Plate
from hullquad.surface import Plane
from hullquad.triangulation.wireframe import Wireframe


def standing(frame: Wireframe, distance: float) -> tuple[Longs, ...]:
    """Of each plate, the wires of others that lie within a distance of its plane and meet its box."""
    middles = np.reshape([row[len(row) // 2] for row in frame.rows], (-1, 3))
    probes = np.concatenate([frame.ends, middles[:, None]], axis=1)  # the middle of a straight wire is its end
    return tuple(_in_plane(frame, number, probes, distance) for number in range(len(frame.plates)))


def _in_plane(frame: Wireframe, number: int, probes: Floats, distance: float) -> Longs:
    plate = frame.plates[number]
    low, high = box_in_space(plate, distance)
    near = (frame.boxes[:, 0] <= high).all(axis=1) & (frame.boxes[:, 1] >= low).all(axis=1)
    found = np.flatnonzero(near & (frame.plate_of != number))
    return longs(found[(heights(plate, probes[found]) <= distance).all(axis=1)])


def line_crossings(frame: Wireframe, standing_on: Sequence[Longs]) -> Floats:
    """(N, 3) points where stiffeners and seams of a plate pass edges that stand on it."""
    found = [np.empty((0, 3))]
    for plate, wires in zip(frame.plates, standing_on, strict=True):
        if not len(wires) or not len(plate.rows):
            continue
        plane = plane_of(plate)
        feet = [shapely.LineString(plane.parameters(frame.rows[wire])) for wire in wires]
        tree = shapely.STRtree(feet)
        row, foot = tree.query(plate.rows, predicate="intersects")
        for i, j in sorted(zip(row.tolist(), foot.tolist(), strict=True)):
            for part in shapely.get_parts(shapely.intersection(plate.rows[i], feet[j])):
                if shapely.get_type_id(part) == 0 and plate.region.intersects(part):
                    wire = frame.wires[wires[j]]
                    at = wire.foot(plane.points(shapely.get_coordinates(part))[0])
                    found.append(wire.points(np.array([at])))
    return np.concatenate(found)


def on_faces(plates: Sequence[Plate], points: Floats, distance: float) -> Iterator[tuple[int, int, Floats]]:
    """Plate, number and parameters (2,) of every point (N, 3) that lies on the face of a plate."""
    for k, plate in enumerate(plates):
        low, high = box_in_space(plate, distance)
        near = np.flatnonzero(((points >= low) & (points <= high)).all(axis=1))
        near = near[heights(plate, points[near]) <= distance]
        if len(near):
            feet = plane_of(plate).parameters(points[near])
            for i in np.flatnonzero(is_inside(plate, feet)):
                yield k, int(near[i]), feet[i]


def is_inside(plate: Plate, feet: Floats) -> Bools:
    """(N,) True for the points (N, 2) within the contour of a plate."""
    return np.asarray(shapely.contains_xy(plate.region, feet[:, 0], feet[:, 1]), dtype=bool)


def heights(plate: Plate, points: Floats) -> Floats:
    """(...,) distances of points (..., 3) from the plane of a plate [mm]."""
    plane = plane_of(plate)
    return np.asarray(np.abs((points - plane.origin) @ plane.normal))


def box_in_space(plate: Plate, distance: float) -> Floats:
    """(2, 3) least and greatest coordinates of a plate, and a distance more."""
    corners = plane_of(plate).points(np.concatenate([plate.outlines[0]]))
    return floats([corners.min(axis=0) - distance, corners.max(axis=0) + distance])


def plane_of(plate: Plate) -> Plane:
    """The plane of a plate that is known to be flat."""
    assert isinstance(plate.surface, Plane)  # only plane plates have neighbours yet
    return plate.surface
