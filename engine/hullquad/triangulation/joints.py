"""Where the plates of a document meet: their common fixed nodes, each one point in space.

Every vertex, line's end and fixed point of a plate is a stop. Stops of different plates within the tolerance of each
other are one joint; a stop beside an edge of another plate is a joint on that edge, and one beside its face is a
joint inside. The place of a joint is that of its first stop: vertices before ends of lines, plates as they follow
each other in the document.
"""

from collections.abc import Sequence

import attrs
import numpy as np
import shapely

from hullquad.arrays import Floats, Longs, floats, longs
from hullquad.plate import JOIN, SNAP
from hullquad.triangulation.anchors import Anchors
from hullquad.triangulation.standing import line_crossings, on_faces, standing
from hullquad.triangulation.stops import Rank, Stop, Unions, own_stops
from hullquad.triangulation.wireframe import Wireframe, seen

EXACT = 1e-6
"""Nearer than this two points in space differ by rounding only [mm]."""
_ROUNDS = 4
"""A joint may be handed on from edge to edge so often: each lies within the tolerance of the next, not of the first."""


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
        own = own_stops(frame, fixed)
        met = np.concatenate([frame.crossings(JOIN), line_crossings(frame, self._standing)])
        self._stops = [*own.stops, *(Stop(Rank.CROSSING, -1, point) for point in met)]
        self._points = floats(np.reshape([stop.point for stop in self._stops], (-1, 3)))
        self._rows = [list(row) for row in own.on_wires]
        self._inside = [list(row) for row in own.inside]
        self._unions = Unions(self._stops)
        self._first = self._unions.first

    def unite_near_stops(self) -> None:
        """Make one joint of stops that are near each other, the nearest first."""
        dots = shapely.points(seen(self._points))
        one, other = shapely.STRtree(dots).query(dots, predicate="dwithin", distance=JOIN)
        one, other = one[one < other], other[one < other]
        away = np.round(np.linalg.norm(self._points[one] - self._points[other], axis=1), 6)
        for i in np.lexsort((other, one, away)):
            if away[i] <= JOIN:
                self._unions.unite(int(one[i]), int(other[i]))

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
        known: list[set[int]] = [{self._first(stop) for stop, _ in inside} for inside in self._inside]
        for wire, row in zip(self._frame.wires, self._rows, strict=True):
            known[wire.plate] |= {self._first(stop) for _, stop, _ in row}
        for plate, number, own in on_faces(self._frame.plates, points, JOIN):
            stop = int(stops[number])
            if self._first(stop) not in known[plate] and self._stops[stop].rank != Rank.INSIDE:
                known[plate].add(self._first(stop))
                self._inside[plate].append((stop, own))

    def result(self) -> Joints:
        """What has come together."""
        firsts = sorted({self._first(stop) for stop in range(len(self._stops))})
        numbers = {stop: i for i, stop in enumerate(firsts)}
        plates = tuple(self._stops[stop].plate for stop in firsts)
        return Joints(self._points[firsts], plates, self._breaks(numbers), self._insides(numbers), self._standing)

    def _breaks(self, numbers: dict[int, int]) -> tuple[tuple[Break, ...], ...]:
        """Breaks of each wire; a joint that a plate has already, as a stop of its own or on another edge, is none."""
        taken: list[set[int]] = [set() for _ in self._frame.plates]
        for stop, known in enumerate(self._stops):
            if known.rank in {Rank.VERTEX, Rank.ANCHOR}:
                taken[known.plate].add(self._first(stop))
        found = []
        for wire, row in zip(self._frame.wires, self._rows, strict=True):
            breaks = []
            for length, stop, own in row:
                head, is_own = self._first(stop), self._stops[stop].plate == wire.plate
                if is_own or head not in taken[wire.plate]:
                    taken[wire.plate].add(head)
                    breaks.append(Break(length, own, numbers[head], self._place(stop, wire.plate)))
            found.append(tuple(breaks))
        return tuple(found)

    def _insides(self, numbers: dict[int, int]) -> tuple[tuple[Inside, ...], ...]:
        """Joints inside each plate that are not on its contour too."""
        taken: list[set[int]] = [set() for _ in self._frame.plates]
        for wire, row in zip(self._frame.wires, self._rows, strict=True):
            taken[wire.plate] |= {self._first(stop) for _, stop, _ in row}
        found: list[list[Inside]] = [[] for _ in self._frame.plates]
        for plate, inside in enumerate(self._inside):
            for stop, own in inside:
                head = self._first(stop)
                if head not in taken[plate]:
                    taken[plate].add(head)
                    found[plate].append(Inside(own, numbers[head], self._place(stop, plate)))
        return tuple(map(tuple, found))

    def _place(self, stop: int, plate: int) -> str:
        return self._stops[stop].place or self._frame.plates[plate].place

    def _put(self, stop: int, wire: int, length: float) -> bool:
        """Put a joint on a wire; whether it is there as a break of its own."""
        row, head = self._rows[wire], self._first(stop)
        if self._stops[stop].plate == self._frame.wires[wire].plate or any(self._first(k) == head for _, k, _ in row):
            return False
        nearest, at, _ = min(((abs(x - length), k, x) for x, k, _ in row))
        if nearest <= JOIN and (self._unions.unite(stop, at) or nearest < SNAP):
            return False
        row.append((length, stop, self._frame.wires[wire].curve.points(np.array([length]))[0]))
        row.sort(key=lambda item: item[0])
        return True

    def _different(self) -> tuple[Longs, Floats]:
        """Stops and their points, those of the same joint and place once."""
        firsts: dict[int, list[int]] = {}
        for stop in sorted(range(len(self._stops)), key=lambda stop: self._stops[stop].rank):
            known = firsts.setdefault(self._first(stop), [])
            if not any(np.abs(self._points[stop] - self._points[k]).max() <= EXACT for k in known):
                known.append(stop)
        stops = longs(sorted(stop for known in firsts.values() for stop in known))
        return stops, floats(self._points[stops])
