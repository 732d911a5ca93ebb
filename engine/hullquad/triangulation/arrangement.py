"""Lines on a plate cut into pieces where they meet: each other, the contour, fixed nodes.

What is nearer than the tolerance to a node goes through it, so that pieces have nothing in common but their ends, and
lines that lie upon each other are one. Pieces outside of the plate, or along its contour, are none.
"""

from collections.abc import Iterable, Mapping, Sequence
from itertools import pairwise

import attrs
import numpy as np
import shapely

from hullquad.arrays import Bools, Floats, Longs, bools, floats, longs
from hullquad.plate import SNAP

_ROUNDS = 20
"""So often pieces may be cut anew; two or three are enough but for pieces that are hardly longer than the tolerance."""
_EXACT = 1e-9


@attrs.frozen(eq=False, kw_only=True)
class Arrangement:
    """Pieces of lines between vertices."""

    vertices: Floats = attrs.field(converter=floats)
    """(V, 2) the given nodes first, then ends and crossings of lines [mm]."""
    pieces: Longs = attrs.field(converter=longs)
    """(P, 2) vertices of each piece."""
    lines: Longs = attrs.field(converter=longs)
    """(P,) line that each piece belongs to; -1 for a segment of a row of given nodes."""
    crosses: Bools = attrs.field(converter=bools)
    """(P,) pieces that cross a segment of the contour, by less than the tolerance."""

    @property
    def lengths(self) -> Floats:
        """(P,) lengths of the pieces [mm]."""
        return floats(np.hypot(*(self.vertices[self.pieces[:, 1]] - self.vertices[self.pieces[:, 0]]).T))

    def with_stations(self, stations: Mapping[int, Sequence[float]]) -> tuple["Arrangement", Longs]:
        """The same with pieces cut anew, at parts of their lengths that follow one another; what each piece was."""
        vertices, sources = [*self.vertices], []
        pieces: list[tuple[int, int]] = []
        for piece, (start, end) in enumerate(self.pieces.tolist()):
            way = self.vertices[end] - self.vertices[start]
            row = [start]
            for share in stations.get(piece, ()):
                row.append(len(vertices))
                vertices.append(self.vertices[start] + share * way)
            pieces += pairwise([*row, end])
            sources += [piece] * len(row)
        rows = np.array(pieces, dtype=np.int64).reshape(-1, 2)
        was = longs(sources)
        cut = attrs.evolve(
            self, vertices=np.array(vertices), pieces=rows, lines=self.lines[was], crosses=self.crosses[was]
        )
        return cut, was

    def only(self, kept: Bools) -> "Arrangement":
        """The same without some of the pieces."""
        return attrs.evolve(self, pieces=self.pieces[kept], lines=self.lines[kept], crosses=self.crosses[kept])


def arrangement(
    nodes: Floats, tolerances: Floats, contour: Longs, region: shapely.Polygon, rows: Sequence[Longs], lines: Floats
) -> Arrangement:
    """Arrangement of lines on a plate.

    Parameters
    ----------
    nodes : (N, 2) float array
        Nodes that are given [mm].
    tolerances : (N,) float array
        How near to each of them a line goes through it [mm].
    contour : (E, 2) int array
        Nodes of the contour's segments.
    region : shapely.Polygon
        The plate within these segments.
    rows : sequence of int arrays
        Nodes in rows whose segments are pieces, too.
    lines : (L, 2, 2) float array
        Ends of the lines [mm].
    """
    work = _Work(nodes, tolerances, contour)
    for row in rows:
        work.add(zip(row[:-1].tolist(), row[1:].tolist(), strict=True), -1)
    for number, (start, end) in enumerate(lines):
        work.add([(work.vertex(start), work.vertex(end))], number)
    for _ in range(_ROUNDS):
        if not (work.cut_at_vertices() | work.cut_at_crossings()):
            break
    return work.result(region)


class _Work:
    """Pieces that are being cut."""

    def __init__(self, nodes: Floats, tolerances: Floats, contour: Longs) -> None:
        self._vertices = list(nodes)
        self._tolerances = list(tolerances)
        self._contour = contour
        self._pieces: dict[tuple[int, int], int] = {}

    def vertex(self, point: Floats) -> int:
        """The nearest vertex within the tolerance, or a new one."""
        away = np.hypot(*(np.asarray(self._vertices) - point).T) - np.asarray(self._tolerances)
        nearest = int(np.argmin(away))
        if away[nearest] <= 0:
            return nearest
        self._vertices.append(np.asarray(point))
        self._tolerances.append(SNAP)
        return len(self._vertices) - 1

    def add(self, pieces: Iterable[tuple[int, int]], line: int) -> None:
        """Add pieces of a line; one that is there already stays with the line it has."""
        for one, other in pieces:
            if one != other:
                key = min(one, other), max(one, other)
                self._pieces[key] = min(line, self._pieces.get(key, line))

    def cut_at_vertices(self) -> bool:
        """Let pieces go through vertices that they pass within the tolerance; whether there were any."""
        if not self._pieces:
            return False
        points, reach = np.asarray(self._vertices), np.asarray(self._tolerances)
        ends = np.array(list(self._pieces))
        tree = shapely.STRtree(shapely.points(points))
        piece, vertex = tree.query(shapely.linestrings(points[ends]), predicate="dwithin", distance=float(reach.max()))
        start, way = points[ends[piece, 0]], points[ends[piece, 1]] - points[ends[piece, 0]]
        length = np.hypot(*way.T)
        along = ((points[vertex] - start) * way).sum(axis=1) / length
        away = np.abs(_cross(way, points[vertex] - start)) / length
        inner = (along > _EXACT) & (along < length - _EXACT) & (away <= reach[vertex])
        inner &= (vertex != ends[piece, 0]) & (vertex != ends[piece, 1])
        piece, vertex, along = piece[inner], vertex[inner], along[inner]
        order = np.lexsort((vertex, along, piece))
        self._cut(ends, piece[order], vertex[order])
        return bool(inner.any())

    def cut_at_crossings(self) -> bool:
        """Make vertices of the points where pieces cross, and cut them there; whether there were any."""
        one, other, ends, at = self._crossings()
        both = (one < len(self._pieces)) & (other < len(self._pieces))
        one, other = one[both], other[both]
        if not len(one):
            return False
        found = self._vertices_at(at[both])
        piece, vertex = np.concatenate([one, other]), longs(np.tile(found, 2))
        points = np.asarray(self._vertices)
        along = np.hypot(*(points[vertex] - points[ends[piece, 0]]).T)
        order = np.lexsort((vertex, along, piece))
        self._cut(ends, piece[order], vertex[order])
        return True

    def _vertices_at(self, points: Floats) -> Longs:
        """Vertices for points, those within the tolerance of a vertex, or of an earlier point, the same."""
        known = shapely.STRtree(shapely.points(np.asarray(self._vertices)))
        near = known.query_nearest(shapely.points(points), max_distance=SNAP, all_matches=False)
        found = np.full(len(points), -1)
        found[near[0]] = near[1]
        fresh = np.flatnonzero(found < 0)
        firsts, numbers = np.unique(_firsts(points[fresh], SNAP), return_inverse=True)
        found[fresh] = len(self._vertices) + numbers
        self._vertices += list(points[fresh[firsts]])
        self._tolerances += [SNAP] * len(firsts)
        return longs(found)

    def result(self, region: shapely.Polygon) -> Arrangement:
        """The pieces inside the plate."""
        one, other, _, _ = self._crossings()
        points, pieces = floats(self._vertices), np.array(list(self._pieces), dtype=np.int64).reshape(-1, 2)
        middles = points[pieces].mean(axis=1)
        shapely.prepare(region)
        inside = np.asarray(shapely.contains_xy(region, middles[:, 0], middles[:, 1]), dtype=bool)
        on_contour = {(min(a, b), max(a, b)) for a, b in self._contour.tolist()}
        inside &= np.array([tuple(piece) not in on_contour for piece in pieces.tolist()], dtype=bool)
        lines = longs(list(self._pieces.values()))
        crosses = np.bincount(one[other >= len(lines)], minlength=len(lines)) > 0
        return Arrangement(vertices=points, pieces=pieces[inside], lines=lines[inside], crosses=crosses[inside])

    def _cut(self, ends: Longs, pieces: Longs, vertices: Longs) -> None:
        """Cut pieces at vertices, those of a piece in order."""
        stations: dict[int, list[int]] = {}
        for piece, vertex in zip(pieces.tolist(), vertices.tolist(), strict=True):
            stations.setdefault(piece, []).append(vertex)
        for piece, row in stations.items():
            start, end = ends[piece].tolist()
            line = self._pieces.pop((start, end))
            whole = [start, *dict.fromkeys(vertex for vertex in row if vertex not in {start, end}), end]
            self.add(pairwise(whole), line)

    def _crossings(self) -> tuple[Longs, Longs, Longs, Floats]:
        """Pieces, or segments of the contour behind them, that cross between their ends; all ends; the points."""
        points = np.asarray(self._vertices)
        ends = np.concatenate([np.array(list(self._pieces), dtype=np.int64).reshape(-1, 2), self._contour])
        tree = shapely.STRtree(shapely.linestrings(points[ends]))
        one, other = tree.query(tree.geometries[: len(self._pieces)], predicate="intersects")
        first = (one < other) & ~(ends[one][:, :, None] == ends[other][:, None, :]).any(axis=(1, 2))
        one, other = one[first], other[first]
        return longs(one), longs(other), longs(ends), _meeting(points[ends[one]], points[ends[other]])


def _meeting(one: Floats, other: Floats) -> Floats:
    """(K, 2) points where straight pieces, (K, 2, 2) ends, cross; the middle of the first where they lie in line."""
    way, opposite = one[:, 1] - one[:, 0], other[:, 1] - other[:, 0]
    sine, across = _cross(way, opposite), _cross(other[:, 0] - one[:, 0], opposite)
    share = np.divide(across, sine, out=np.full_like(sine, 0.5), where=sine != 0)
    return floats(one[:, 0] + share[:, None] * way)


def _cross(one: Floats, other: Floats) -> Floats:
    return floats(one[:, 0] * other[:, 1] - one[:, 1] * other[:, 0])


def _firsts(points: Floats, distance: float) -> Longs:
    """(K,) for each point the first one that it is within a distance of, or itself."""
    dots = shapely.points(points)
    one, other = shapely.STRtree(dots).query(dots, predicate="dwithin", distance=distance)
    first = np.arange(len(points))
    for i, j in sorted(zip(one[one < other].tolist(), other[one < other].tolist(), strict=True)):
        if first[i] == i and first[j] == j:
            first[j] = i
    return longs(first)
