"""Points that plates make nodes: vertices, ends of lines, fixed points; and which of them are one node."""

from collections.abc import Iterable, Iterator, Sequence
from enum import IntEnum

import attrs
import numpy as np

from hullquad.arrays import Floats, floats
from hullquad.curves import is_backwards
from hullquad.plate import Plate
from hullquad.triangulation.anchors import Anchors
from hullquad.triangulation.standing import plane_of
from hullquad.triangulation.wireframe import Wireframe


class Rank(IntEnum):
    """Which stop gives a node its place when several are one."""

    VERTEX = 0
    ANCHOR = 1
    INSIDE = 2
    CROSSING = 3
    """Of edges of several plates: it belongs to none of them."""


@attrs.frozen(eq=False)
class Stop:
    """A point that becomes a node."""

    rank: Rank
    plate: int
    """-1 for a crossing."""
    point: Floats = attrs.field(converter=floats)
    """(3,) [mm]"""
    place: str = ""


@attrs.frozen(eq=False)
class Stops:
    """The stops of all plates, by number, and where each plate has them."""

    stops: tuple[Stop, ...]
    on_wires: tuple[tuple[tuple[float, int, Floats], ...], ...]
    """Of each wire, from start to end: length, stop and point (2,) in the plate's plane."""
    inside: tuple[tuple[tuple[int, Floats], ...], ...]
    """Of each plate: stop and point (2,) in its plane."""


def own_stops(frame: Wireframe, fixed: Sequence[Anchors]) -> Stops:
    """Stops that the plates have by themselves."""
    stops: list[Stop] = []
    vertices = {}
    for k, plate in enumerate(frame.plates):
        for i, j, stop in _vertices(k, plate):
            vertices[k, i, j] = len(stops)
            stops.append(stop)
    rows = []
    for wire in frame.wires:
        loop = frame.plates[wire.plate].loops[wire.loop]
        ends = [vertices[wire.plate, wire.loop, j % len(loop.curves)] for j in (wire.edge, wire.edge + 1)]
        start, end = ends[::-1] if is_backwards(loop.curves[wire.edge]) else ends
        row = [(0.0, start, wire.curve.start)]
        for anchor in fixed[wire.plate].on_edges.get((wire.loop, wire.edge), []):
            row.append((anchor.length, len(stops), anchor.own))
            point = wire.surface.points(anchor.own[None])[0]
            stops.append(Stop(Rank.ANCHOR, wire.plate, point, loop.edge_place(wire.edge)))
        rows.append((*row, (wire.curve.length, end, wire.curve.end)))
    inside: list[tuple[tuple[int, Floats], ...]] = []
    for k, anchors in enumerate(fixed):
        points = plane_of(frame.plates[k]).points(anchors.inside)
        inside.append(tuple((len(stops) + i, own) for i, own in enumerate(anchors.inside)))
        stops += [Stop(Rank.INSIDE, k, *item) for item in zip(points, anchors.inside_places, strict=True)]
    return Stops(tuple(stops), tuple(rows), tuple(inside))


def _vertices(number: int, plate: Plate) -> Iterator[tuple[int, int, Stop]]:
    for i, loop in enumerate(plate.loops):
        points = plane_of(plate).points(np.stack([curve.start for curve in loop.curves]))
        for j, point in enumerate(points):
            yield i, j, Stop(Rank.VERTEX, number, point, loop.vertex_place(j))


class Unions:
    """Stops that are being united; two of one plate never are."""

    def __init__(self, stops: Iterable[Stop]) -> None:
        self._stops = tuple(stops)
        self._head = list(range(len(self._stops)))
        self._owners = [{stop.plate} - {-1} for stop in self._stops]

    def first(self, stop: int) -> int:
        """The stop of least rank, and then number, of those that are one with a stop."""
        while self._head[stop] != stop:
            self._head[stop] = self._head[self._head[stop]]
            stop = self._head[stop]
        return stop

    def unite(self, one: int, other: int) -> bool:
        """Make two stops one unless a plate has both, or others that are one with them; whether they are one now."""
        one, other = self.first(one), self.first(other)
        if one == other:
            return True
        if self._owners[one] & self._owners[other]:
            return False
        first, second = sorted((one, other), key=lambda stop: (self._stops[stop].rank, stop))
        self._head[second] = first
        self._owners[first] |= self._owners[second]
        return True
