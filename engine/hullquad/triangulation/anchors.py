"""Where the fixed nodes of a plate lie: on which edge of its contour, or inside."""

from collections.abc import Iterator

import attrs
import numpy as np
import shapely

from hullquad.arrays import Floats, floats
from hullquad.curves import Curve, canonical, chord_error, nearest, polyline
from hullquad.plate import Plate

_EXACT = 1e-6
"""Nearer than this a point lies on its edge as it is, and no snap is told [mm]."""
_PROBES = np.array([0.0, 0.25, 0.5, 0.75])
"""Of the way from a line's end to where the line crosses the contour."""


@attrs.frozen(eq=False)
class Anchor:
    """A fixed node on an edge, between its ends."""

    length: float
    """From the start of the edge's canonical curve [mm]."""
    own: Floats = attrs.field(converter=floats)
    """(2,) in the plate's plane."""


@attrs.frozen(eq=False)
class Snap:
    """A line's end, a fixed point or a vertex whose node is not exactly where the document says."""

    place: str
    point: Floats = attrs.field(converter=floats)
    """(2,) as in the document."""
    node: Floats = attrs.field(converter=floats)
    """(2,) where the node is."""
    height: float = 0.0
    """How far it is from the plate's plane [mm]."""
    neighbour: str = ""
    """Id of the plate that has its node there; empty when the plate's own contour or fixed node is meant."""

    @property
    def distance(self) -> float:
        """Length of the way between the two [mm]."""
        return float(np.linalg.norm([*(self.node - self.point), self.height]))


@attrs.frozen(eq=False)
class Anchors:
    """All fixed nodes of a plate but the vertices of its contour."""

    on_edges: dict[tuple[int, int], list[Anchor]]
    """By loop and edge, in the order of the edge's canonical curve."""
    inside: Floats = attrs.field(converter=floats)
    """(K, 2)"""
    inside_places: tuple[str, ...]
    snaps: tuple[Snap, ...]


def anchors(plate: Plate) -> Anchors:
    """Fixed nodes from the ends of stiffeners and seams and from the fixed points, in the order of the document.

    Lines end, too, where holes cut them.

    An end nearer than the snap tolerance to a vertex is that vertex, to an edge lies on it, to an earlier fixed
    node is that node. An end within a hole is no node.
    """
    named = list(_points(plate))
    candidates = nearest_edges(plate, np.array([point for _, point in named]).reshape(-1, 2))
    on_edges: dict[tuple[int, int], list[Anchor]] = {}
    inside: list[tuple[str, Floats]] = []
    snaps = []
    for (place, point), key in zip(named, candidates, strict=True):
        if key is not None:
            curve = canonical(plate.loops[key[0]].curves[key[1]])
            snaps.append(Snap(place, point, _anchored(curve, point, on_edges.setdefault(key, []), plate.snap)))
        elif plate.region.intersects(shapely.Point(point)):
            inside.append((place, point))
    cuts = _cuts(plate)
    for cut, key in zip(cuts, nearest_edges(plate, cuts), strict=True):
        if key is not None:
            _anchored(canonical(plate.loops[key[0]].curves[key[1]]), cut, on_edges.setdefault(key, []), plate.snap)
    inside, merged = _merged(inside, plate.snap)
    return Anchors(
        {key: sorted(found, key=lambda anchor: anchor.length) for key, found in on_edges.items() if found},
        np.array([point for _, point in inside]).reshape(-1, 2),
        tuple(place for place, _ in inside),
        tuple(snap for snap in [*snaps, *merged] if snap.distance > _EXACT),
    )


def _points(plate: Plate) -> Iterator[tuple[str, Floats]]:
    for line in plate.lines:
        yield f"{line.place}/a", line.a
        yield f"{line.place}/b", line.b
    for i, point in enumerate(plate.fixed):
        yield f"{plate.place}/fixed/{i}", point


def _cuts(plate: Plate) -> Floats:
    """(K, 2) points where lines cross the contour elsewhere than at their ends."""
    rim = shapely.multilinestrings([shapely.linearrings(outline) for outline in plate.outlines])
    found = [np.empty((0, 2))]
    for line, crossed in zip(plate.lines, shapely.intersection(plate.rows, rim), strict=True):
        points = shapely.get_coordinates(crossed)
        for end in (line.a, line.b):
            on_way = end + _PROBES[:, None, None] * (points - end)
            along = shapely.distance(rim, shapely.points(on_way)).max(axis=0) <= plate.snap
            points = points[~along]  # what lies between is the contour itself, and the end a node of it
        found.append(points)
    return floats(np.concatenate(found))


def nearest_edges(plate: Plate, points: Floats) -> list[tuple[int, int] | None]:
    """Loop and edge that each point lies on, within the tolerance; None for the others.

    Polylines only tell which edges are worth measuring: those of large arcs may be farther off than the tolerance.
    """
    keys = [(i, j) for i, loop in enumerate(plate.loops) for j in range(len(loop.curves))]
    curves = [canonical(plate.loops[i].curves[j]) for i, j in keys]
    rows = [polyline(curve, plate.chord_error) for curve in curves]
    reach = plate.snap + max(chord_error(curve, row) for curve, row in zip(curves, rows, strict=True))
    tree = shapely.STRtree([shapely.LineString(row) for row in rows])
    near = tree.query(shapely.points(points), predicate="dwithin", distance=reach).T
    found: list[tuple[float, int]] = [(plate.snap, -1)] * len(points)
    for point, edge in sorted(map(tuple, near)):
        away = float(np.hypot(*(_foot(curves[edge], points[point]) - points[point])))
        found[point] = min(found[point], (away, edge))
    return [keys[edge] if edge >= 0 else None for _, edge in found]


def _foot(curve: Curve, point: Floats) -> Floats:
    return floats(curve.points(np.array([nearest(curve, point)]))[0])


def _anchored(curve: Curve, point: Floats, earlier: list[Anchor], tolerance: float) -> Floats:
    """Node of a point on an edge: one of its ends, an earlier anchor, or a new one."""
    length = nearest(curve, point)
    foot = curve.points(np.array([length]))[0]
    node = point if np.hypot(*(foot - point)) < _EXACT else foot
    existing = [curve.start, curve.end, *(anchor.own for anchor in earlier)]
    away = np.hypot(*(np.array(existing) - node).T)
    if away.min() <= tolerance:
        return existing[int(away.argmin())]
    earlier.append(Anchor(length, node))
    return node


def _merged(named: list[tuple[str, Floats]], tolerance: float) -> tuple[list[tuple[str, Floats]], list[Snap]]:
    """Points inside, without those near an earlier one; and what became of these."""
    if not named:
        return [], []
    points = np.array([point for _, point in named])
    kept_as = np.arange(len(points))
    dots = shapely.points(points)
    pairs = shapely.STRtree(dots).query(dots, predicate="dwithin", distance=tolerance).T
    for first, second in sorted((int(one), int(other)) for one, other in pairs if one < other):
        if kept_as[first] == first and kept_as[second] == second:
            kept_as[second] = first
    kept = [named[i] for i in np.flatnonzero(kept_as == np.arange(len(points)))]
    gone = np.flatnonzero(kept_as != np.arange(len(points)))
    return kept, [Snap(named[i][0], points[i], points[kept_as[i]]) for i in gone]
