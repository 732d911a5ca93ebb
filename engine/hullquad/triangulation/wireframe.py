"""The edges of all plane plates of a document in space, as one frame of wires: which points and wires come near."""

from collections.abc import Sequence
from functools import cached_property

import attrs
import numpy as np
import shapely

from hullquad.arrays import Bools, Floats, Longs, floats, longs
from hullquad.curves import Curve, Straight, canonical, chord_error, nearest, polyline
from hullquad.plate import Plate
from hullquad.surface import Plane

_VIEW = 0.99 * np.array([[0.8165, -0.3651, -0.4472], [0.0912, 0.8507, -0.5175]])
"""Of a picture along no direction that a ship is built in: what is near in space is near there, little else is."""
_PARALLEL, _TANGENT = 1e-3, 0.02
"""Sines of the angles from which straight and round wires meet in a point; under smaller ones they run beside each
other."""
_ROUNDS = 8
"""Newton's steps to where two wires meet."""


@attrs.frozen(eq=False)
class Wire:
    """An edge of a plate."""

    plate: int
    loop: int
    edge: int
    curve: Curve
    """The edge in the plate's plane, in its canonical direction."""
    surface: Plane

    def points(self, lengths: Floats) -> Floats:
        """(N, 3) points in space at (N,) lengths from the start."""
        return self.surface.points(self.curve.points(lengths))

    def foot(self, point: Floats) -> float:
        """Length from the start at which the wire is nearest to a point (3,)."""
        return nearest(self.curve, self.surface.parameters(point[None])[0])

    def tangent(self, length: float) -> Floats:
        """(3,) unit vector along the wire at a length from the start."""
        heading = self.curve.headings(np.array([length]))[0]
        return np.asarray(np.cos(heading) * self.surface.u + np.sin(heading) * self.surface.v)


@attrs.frozen(eq=False)
class Wireframe:
    """All edges of some plane plates."""

    plates: tuple[Plate, ...]
    wires: tuple[Wire, ...]

    @cached_property
    def plate_of(self) -> Longs:
        """(W,) number of the plate of each wire."""
        return longs([wire.plate for wire in self.wires])

    @cached_property
    def is_straight(self) -> Bools:
        """(W,) True for straight wires."""
        return np.array([isinstance(wire.curve, Straight) for wire in self.wires], dtype=bool)

    @cached_property
    def lengths(self) -> Floats:
        """(W,) lengths [mm]."""
        return floats([wire.curve.length for wire in self.wires])

    @cached_property
    def ends(self) -> Floats:
        """(W, 2, 3) start and end of each wire."""
        return floats(np.reshape([row[[0, -1]] for row in self.rows], (-1, 2, 3)))

    @cached_property
    def rows(self) -> list[Floats]:
        """(N, 3) polyline of each wire."""
        return [wire.surface.points(row) for wire, row in zip(self.wires, self.polylines, strict=True)]

    @cached_property
    def boxes(self) -> Floats:
        """(W, 2, 3) least and greatest coordinates of each wire."""
        boxes = np.reshape([(row.min(axis=0), row.max(axis=0)) for row in self.rows], (-1, 2, 3))
        return floats(boxes + self._slack * np.array([-1.0, 1.0])[:, None])

    @cached_property
    def polylines(self) -> list[Floats]:
        """(N, 2) the same in the plane of its plate."""
        return [polyline(wire.curve, self.plates[wire.plate].chord_error) for wire in self.wires]

    @cached_property
    def _slack(self) -> float:
        """How far a wire leaves its polyline at most [mm]."""
        pairs = zip(self.wires, self.polylines, strict=True)
        return max((chord_error(wire.curve, row) for wire, row in pairs), default=0.0)

    @cached_property
    def _tree(self) -> shapely.STRtree:
        return shapely.STRtree([shapely.linestrings(seen(row)) for row in self.rows])

    def near(self, points: Floats, distance: float) -> tuple[Longs, Longs, Floats, Floats]:
        """Points (N, 3) within a distance of wires: number of point and wire, foot's length, distance."""
        reach = distance + self._slack
        point, wire = self._tree.query(shapely.points(seen(points)), predicate="dwithin", distance=reach)
        low, high = self.boxes[wire, 0], self.boxes[wire, 1]
        is_near = ((points[point] >= low - distance) & (points[point] <= high + distance)).all(axis=1)
        point, wire = point[is_near], wire[is_near]
        lengths, away = self.feet(points[point], wire)
        found = np.flatnonzero(away <= distance)
        found = found[np.lexsort((wire[found], point[found]))]
        return longs(point[found]), longs(wire[found]), floats(lengths[found]), floats(away[found])

    def feet(self, points: Floats, wires: Longs) -> tuple[Floats, Floats]:
        """Of each point (N, 3) on its wire: length from the start to the foot, and distance of the foot."""
        starts, ways = self.ends[wires, 0], self.ends[wires, 1] - self.ends[wires, 0]
        part = np.clip(((points - starts) * ways).sum(axis=1) / np.maximum((ways**2).sum(axis=1), 1e-300), 0, 1)
        lengths = part * self.lengths[wires]
        feet = starts + part[:, None] * ways
        for i in np.flatnonzero(~self.is_straight[wires]):
            wire = self.wires[wires[i]]
            lengths[i] = wire.foot(points[i])
            feet[i] = wire.points(lengths[i : i + 1])[0]
        return lengths, np.linalg.norm(points - feet, axis=1)

    def crossings(self, distance: float) -> Floats:
        """(N, 3) points where wires of different plates pass within a distance, neither beside the other."""
        one, other = self._pairs(distance)
        straight = self.is_straight[one] & self.is_straight[other]
        rows = [self._straight_crossings(one[straight], other[straight], distance)]
        for i, j in zip(one[~straight], other[~straight], strict=True):
            rows.append(self._round_crossings(int(i), int(j), distance))
        return floats(np.concatenate(rows))

    def _pairs(self, distance: float) -> tuple[Longs, Longs]:
        """Wires of different plates that may come near."""
        lines = self._tree.geometries
        one, other = self._tree.query(lines, predicate="dwithin", distance=distance + 2 * self._slack)
        kept = (one < other) & (self.plate_of[one] != self.plate_of[other])
        one, other = one[kept], other[kept]
        low = np.maximum(self.boxes[one, 0], self.boxes[other, 0])
        high = np.minimum(self.boxes[one, 1], self.boxes[other, 1])
        kept = (low <= high + distance).all(axis=1)
        one, other = one[kept], other[kept]
        order = np.lexsort((other, one))
        return longs(one[order]), longs(other[order])

    def _straight_crossings(self, one: Longs, other: Longs, distance: float) -> Floats:
        """Where straight wires pass each other at an angle: on the first of the two."""
        p, q = self.ends[one, 0], self.ends[other, 0]
        a, b = self.ends[one, 1] - p, self.ends[other, 1] - q
        aa, bb, ab = (a * a).sum(axis=1), (b * b).sum(axis=1), (a * b).sum(axis=1)
        square = aa * bb - ab * ab
        angled = square > _PARALLEL**2 * aa * bb
        p, q, a, b, aa, bb, ab, square = (x[angled] for x in (p, q, a, b, aa, bb, ab, square))
        w = p - q
        aw, bw = (a * w).sum(axis=1), (b * w).sum(axis=1)
        s, t = (ab * bw - bb * aw) / square, (aa * bw - ab * aw) / square
        meeting, opposite = p + s[:, None] * a, q + t[:, None] * b
        meet = np.linalg.norm(meeting - opposite, axis=1) <= distance
        return floats(meeting[meet & (s > 0) & (s < 1) & (t > 0) & (t < 1)])

    def _round_crossings(self, one: int, another: int, distance: float) -> Floats:
        """Where a round wire passes another one: looked for in the first one's plane, then in space."""
        if self.is_straight[one]:
            one, another = another, one
        wire, other = self.wires[one], self.wires[another]
        own = shapely.LineString(self.polylines[one])
        beside = shapely.LineString(wire.surface.parameters(self.rows[another])).buffer(distance, quad_segs=2)
        pieces = shapely.get_parts(shapely.intersection(own, beside))
        pieces = pieces[shapely.length(pieces) <= 2 * distance / _TANGENT]  # longer ones run beside each other
        middles = shapely.get_coordinates(shapely.line_interpolate_point(pieces, 0.5, normalized=True))
        found = [_approached(wire, other, point) for point in wire.surface.points(middles)]
        return np.array([p for p, away, sine in found if away <= distance and sine > _TANGENT]).reshape(-1, 3)


def wireframe(plates: Sequence[Plate]) -> Wireframe:
    """Edges of plane plates, in the order of the document."""
    wires = [
        Wire(k, i, j, canonical(curve), plate.surface)
        for k, plate in enumerate(plates)
        if isinstance(plate.surface, Plane)
        for i, loop in enumerate(plate.loops)
        for j, curve in enumerate(loop.curves)
    ]
    return Wireframe(tuple(plates), tuple(wires))


def seen(points: Floats) -> Floats:
    """(N, 2) the points (N, 3) in a picture: never farther apart there than in space."""
    return np.asarray(points @ _VIEW.T)


def _approached(wire: Wire, other: Wire, point: Floats) -> tuple[Floats, float, float]:
    """Point of a wire that is nearest to another one, from a point near it; their distance, and sine of their angle."""
    here, there = wire.foot(point), other.foot(point)
    for _ in range(_ROUNDS):
        a, b = wire.tangent(here), other.tangent(there)
        way = other.points(np.array([there]))[0] - wire.points(np.array([here]))[0]
        square = max(1 - float(a @ b) ** 2, _TANGENT**2)
        step, opposite = (a - (a @ b) * b) @ way / square, ((a @ b) * a - b) @ way / square
        here = float(np.clip(here + step, 0, wire.curve.length))
        there = float(np.clip(there + opposite, 0, other.curve.length))
    here_point, there_point = wire.points(np.array([here]))[0], other.points(np.array([there]))[0]
    sine = float(np.linalg.norm(np.cross(wire.tangent(here), other.tangent(there))))
    return here_point, float(np.linalg.norm(here_point - there_point)), sine
