"""Where the plates of a document meet: their common fixed nodes, each one point in space.

Every vertex, line's end and fixed point of a plate is a stop. Stops of different plates within the tolerance of each
other are one joint; a stop beside an edge of another plate is a joint on that edge, and one beside its face is a
joint inside. The place of a joint is that of its first stop: vertices before ends of lines, plates as they follow
each other in the document.
"""

from collections.abc import Iterator, Sequence

import attrs
import numpy as np
import shapely

from hullquad.arrays import Floats, Longs, floats, longs
from hullquad.curves import is_backwards
from hullquad.plate import JOIN, SNAP, Plate
from hullquad.triangulation.anchors import Anchors
from hullquad.triangulation.standing import line_crossings, on_faces, plane_of, standing
from hullquad.triangulation.wireframe import Wireframe, seen

EXACT = 1e-6
"""Nearer than this two points in space differ by rounding only [mm]."""
_ROUNDS = 4
"""A joint may be handed on from edge to edge so often: each lies within the tolerance of the next, not of the first."""
_VERTEX, _ANCHOR, _INSIDE, _CROSSING = range(4)


@attrs.frozen(eq=False)
class Stop:
    """A point that a plate, or where two of them meet, makes a node."""

    rank: int
    plate: int
    """-1 for one that belongs to none: a crossing."""
    own: Floats = attrs.field(converter=floats)
    """(2,) in the plate's plane; of a crossing nothing is known."""
    place: str


@attrs.frozen(eq=False)
class Break:
    """A joint on an edge."""

    length: float
    """From the start of the edge's canonical curve [mm]."""
    own: Floats = attrs.field(converter=floats)
    """(2,) where the edge itself has it, in the plate's plane."""
    joint: int
    place: str


@attrs.frozen(eq=False)
class Inside:
    """A joint in the interior of a plate."""

    own: Floats = attrs.field(converter=floats)
    """(2,) where the plate itself has it."""
    joint: int
    place: str


@attrs.frozen(eq=False)
class Joints:
    """The common fixed nodes of all plates, and where each plate has them."""

    points: Floats = attrs.field(converter=floats)
    """(J, 3) [mm]"""
    first_plates: tuple[int, ...]
    """Of each joint, the plate whose own node it is; -1 for a crossing."""
    breaks: tuple[tuple[Break, ...], ...]
    """Of each wire, from start to end."""
    inside: tuple[tuple[Inside, ...], ...]
    """Of each plate: its own fixed nodes first, then those where neighbours stand on it."""
    standing: tuple[Longs, ...]
    """Of each plate, the wires of others that lie in its plane."""


def joints(frame: Wireframe, fixed: Sequence[Anchors]) -> Joints:
    """Joints of the plates whose edges are in a wireframe, with their own fixed nodes."""
    meeting = _Meeting(frame, fixed)
    meeting.unite_near_stops()
    meeting.break_wires()
    meeting.enter_faces()
    return meeting.result()


class _Meeting:
    """Stops that are being united to joints."""

    def __init__(self, frame: Wireframe, fixed: Sequence[Anchors]) -> None:
        self._frame = frame
        self._standing = standing(frame, JOIN)
        self._rows: list[list[tuple[float, int, Floats]]] = [[] for _ in frame.wires]
        """Of each wire: length, stop and own point of what is on it."""
        self._stops: list[Stop] = []
        self._inside: list[list[tuple[int, Floats]]] = [[] for _ in frame.plates]
        self._gather(fixed)
        plate_points = [self._in_space(stop) for stop in self._stops]
        crossings = [frame.crossings(JOIN), line_crossings(frame, self._standing)]
        met = np.concatenate(crossings)
        self._stops += [Stop(_CROSSING, -1, np.zeros(2), "") for _ in met]
        self._points = np.concatenate([np.reshape(plate_points, (-1, 3)), met])
        self._order = np.argsort([stop.rank for stop in self._stops], kind="stable")
        self._precedence = np.argsort(self._order, kind="stable")
        self._head = list(range(len(self._stops)))
        self._owners = [{stop.plate} - {-1} for stop in self._stops]

    def unite_near_stops(self) -> None:
        """Make one joint of stops that are near each other, the nearest first."""
        dots = shapely.points(seen(self._points))
        one, other = shapely.STRtree(dots).query(dots, predicate="dwithin", distance=JOIN)
        one, other = one[one < other], other[one < other]
        away = np.round(np.linalg.norm(self._points[one] - self._points[other], axis=1), 6)
        for i in np.lexsort((other, one, away)):
            if away[i] <= JOIN:
                self._unite(int(one[i]), int(other[i]))

    def break_wires(self) -> None:
        """Put every joint on the edges of other plates that it lies on."""
        stops, points = self._different()
        for _ in range(_ROUNDS):
            found, wires, lengths, away = self._frame.near(points, JOIN)
            moved = []
            for i, wire, length, distance in zip(found, wires, lengths, away, strict=True):
                if self._put(int(stops[i]), int(wire), float(length)) and distance > EXACT:
                    moved.append((stops[i], self._frame.wires[wire].points(np.array([length]))[0]))
            if not moved:
                break
            stops, points = longs([stop for stop, _ in moved]), floats([point for _, point in moved])

    def enter_faces(self) -> None:
        """Put every joint of an edge into the plates on whose face it lies."""
        stops, points = self._different()
        known: list[set[int]] = [{self._find(stop) for stop, _ in inside} for inside in self._inside]
        for wire, row in zip(self._frame.wires, self._rows, strict=True):
            known[wire.plate] |= {self._find(stop) for _, stop, _ in row}
        for plate, number, own in on_faces(self._frame.plates, points, JOIN):
            stop = int(stops[number])
            if self._find(stop) not in known[plate] and self._stops[stop].rank != _INSIDE:
                known[plate].add(self._find(stop))
                self._inside[plate].append((stop, own))

    def result(self) -> Joints:
        """What has come together."""
        heads = sorted({self._find(stop) for stop in range(len(self._stops))})
        numbers = {head: i for i, head in enumerate(heads)}
        firsts = {head: head for head in heads}
        for stop in self._order[::-1]:
            firsts[self._find(int(stop))] = int(stop)
        points = self._points[[firsts[head] for head in heads]]
        plates = tuple(self._stops[firsts[head]].plate for head in heads)
        return Joints(points, plates, self._breaks(numbers), self._insides(numbers), self._standing)

    def _breaks(self, numbers: dict[int, int]) -> tuple[tuple[Break, ...], ...]:
        """Breaks of each wire; a joint that a plate has already, as a stop of its own or on another edge, is none."""
        taken: list[set[int]] = [set() for _ in self._frame.plates]
        for stop, known in enumerate(self._stops):
            if known.rank in {_VERTEX, _ANCHOR}:
                taken[known.plate].add(self._find(stop))
        found = []
        for wire, row in zip(self._frame.wires, self._rows, strict=True):
            breaks = []
            for length, stop, own in row:
                head, is_own = self._find(stop), self._stops[stop].plate == wire.plate
                if is_own or head not in taken[wire.plate]:
                    taken[wire.plate].add(head)
                    breaks.append(Break(length, own, numbers[head], self._place(stop, wire.plate)))
            found.append(tuple(breaks))
        return tuple(found)

    def _insides(self, numbers: dict[int, int]) -> tuple[tuple[Inside, ...], ...]:
        """Joints inside each plate that are not on its contour too."""
        taken: list[set[int]] = [set() for _ in self._frame.plates]
        for wire, row in zip(self._frame.wires, self._rows, strict=True):
            taken[wire.plate] |= {self._find(stop) for _, stop, _ in row}
        found: list[list[Inside]] = [[] for _ in self._frame.plates]
        for plate, inside in enumerate(self._inside):
            for stop, own in inside:
                head = self._find(stop)
                if head not in taken[plate]:
                    taken[plate].add(head)
                    found[plate].append(Inside(own, numbers[head], self._place(stop, plate)))
        return tuple(map(tuple, found))

    def _place(self, stop: int, plate: int) -> str:
        return self._stops[stop].place or self._frame.plates[plate].place

    def _put(self, stop: int, wire: int, length: float) -> bool:
        """Put a joint on a wire; whether it is there as a break of its own."""
        row, head = self._rows[wire], self._find(stop)
        if self._stops[stop].plate == self._frame.wires[wire].plate or any(self._find(k) == head for _, k, _ in row):
            return False
        nearest, at, _ = min(((abs(x - length), k, x) for x, k, _ in row))
        if nearest <= JOIN and (self._unite(stop, at) or nearest < SNAP):
            return False
        row.append((length, stop, self._frame.wires[wire].curve.points(np.array([length]))[0]))
        row.sort(key=lambda item: item[0])
        return True

    def _different(self) -> tuple[Longs, Floats]:
        """Stops and their points, those of the same joint and place once."""
        firsts: dict[int, list[int]] = {}
        for stop in map(int, self._order):
            known = firsts.setdefault(self._find(stop), [])
            if not any(np.abs(self._points[stop] - self._points[k]).max() <= EXACT for k in known):
                known.append(stop)
        stops = longs(sorted(stop for known in firsts.values() for stop in known))
        return stops, floats(self._points[stops])

    def _find(self, stop: int) -> int:
        while self._head[stop] != stop:
            self._head[stop] = self._head[self._head[stop]]
            stop = self._head[stop]
        return stop

    def _unite(self, one: int, other: int) -> bool:
        """Make one joint of two, unless a plate has a stop of its own in each: a plate's nodes never become one."""
        one, other = self._find(one), self._find(other)
        if one == other:
            return True
        if self._owners[one] & self._owners[other]:
            return False
        first, second = sorted((one, other), key=lambda stop: int(self._precedence[stop]))
        self._head[second] = first
        self._owners[first] |= self._owners[second]
        return True

    def _in_space(self, stop: Stop) -> Floats:
        return floats(plane_of(self._frame.plates[stop.plate]).points(stop.own[None])[0])

    def _gather(self, fixed: Sequence[Anchors]) -> None:
        """Stops of all plates: vertices, what lies on edges, what lies inside."""
        vertices = {}
        for k, plate in enumerate(self._frame.plates):
            for key, stop in _vertices(k, plate):
                vertices[key] = len(self._stops)
                self._stops.append(stop)
        for number, wire in enumerate(self._frame.wires):
            plate = self._frame.plates[wire.plate]
            loop = plate.loops[wire.loop]
            ends = [vertices[wire.plate, wire.loop, j % len(loop.curves)] for j in (wire.edge, wire.edge + 1)]
            start, end = ends[::-1] if is_backwards(loop.curves[wire.edge]) else ends
            row = self._rows[number]
            row.append((0.0, start, wire.curve.start))
            for anchor in fixed[wire.plate].on_edges.get((wire.loop, wire.edge), []):
                row.append((anchor.length, len(self._stops), anchor.own))
                self._stops.append(Stop(_ANCHOR, wire.plate, anchor.own, loop.edge_place(wire.edge)))
            row.append((wire.curve.length, end, wire.curve.end))
        for k, anchors in enumerate(fixed):
            for point, place in zip(anchors.inside, anchors.inside_places, strict=True):
                self._inside[k].append((len(self._stops), point))
                self._stops.append(Stop(_INSIDE, k, point, place))


def _vertices(number: int, plate: Plate) -> Iterator[tuple[tuple[int, int, int], Stop]]:
    for i, loop in enumerate(plate.loops):
        for j, curve in enumerate(loop.curves):
            yield (number, i, j), Stop(_VERTEX, number, curve.start, loop.vertex_place(j))
