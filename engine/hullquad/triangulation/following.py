"""Contours whose stiffeners and seams are followed by elements: in pieces between vertices, each divided equally.

A piece is not followed where it runs beside the contour or beside another piece, nearer than elements can be thin:
then only the other one is.
"""

from collections.abc import Mapping, Sequence

import attrs
import numpy as np
import shapely

from hullquad.arrays import Bools, Floats, Longs, floats
from hullquad.plate import SNAP
from hullquad.surface import Surface
from hullquad.triangulation.arrangement import Arrangement, arrangement
from hullquad.triangulation.divided import Contour, Followed
from hullquad.triangulation.intervals import numbers
from hullquad.triangulation.ligaments import facing
from hullquad.triangulation.sides import sides

NEAREST = 0.02
"""Distance from what it runs beside, over the element size, below which a piece is not followed."""
_ALONG = 0.2
"""Sine of the angle up to which things run beside each other; others only meet."""
PROBES = np.array([0.25, 0.5, 0.75])
"""Where on a piece it is seen whether it runs beside something."""


@attrs.frozen(eq=False, kw_only=True)
class Plan:
    """Pieces of lines, before they are divided."""

    contour: Contour
    """Without the lines."""
    places: Sequence[str]
    """Path in the document of each line; none without a document."""
    pieces: Arrangement
    """Those that are to be followed."""
    left_out: Arrangement
    """Those that are not, because they run beside something."""


def with_lines(contour: Contour, lines: Floats) -> Contour:
    """A contour whose elements follow lines, (L, 2, 2) ends [mm], as far as they are inside."""
    return followed(plan(contour, lines), {})


def plan(contour: Contour, lines: Floats, places: Sequence[str] = ()) -> Plan:
    """What is to be followed of some lines, (L, 2, 2) ends [mm]."""
    tolerances = np.full(len(contour.nodes), SNAP)
    for snap in contour.snaps:  # lines go through a node that has been moved nevertheless
        moved = np.hypot(*(contour.nodes - snap.node).T) <= SNAP
        tolerances[moved] = np.maximum(tolerances[moved], SNAP + snap.distance)
    found = arrangement(contour.nodes, tolerances, contour.segments, contour.region, contour.rows, lines)
    not_so = found.crosses | _beside(found, contour.segments, contour.size)
    return Plan(contour=contour, places=places, pieces=found.only(~not_so), left_out=found.only(not_so))


def followed(chosen: Plan, given: Mapping[int, int]) -> Contour:
    """The contour with the lines of a plan.

    `given` are numbers of segments that cannot be chosen, by piece.
    """
    contour = chosen.contour
    stations = {piece: row for piece, row in facing(contour, chosen.pieces).items() if piece not in given}
    pieces, was = chosen.pieces.with_stations(stations)
    surface, is_row = contour.plate.surface, pieces.lines < 0
    fixed = {piece: given[source] for piece, source in enumerate(was.tolist()) if source in given}
    fixed |= dict.fromkeys(np.flatnonzero(is_row).tolist(), 1)
    around = sides(pieces.vertices, contour.segments, pieces.pieces)
    counts = numbers(pieces, around, contour.size, fixed)
    used = np.unique(np.concatenate([np.arange(len(contour.nodes)), pieces.pieces.ravel()]))
    names = np.full(len(pieces.vertices), -1)
    names[used] = np.arange(len(used))
    vertices = pieces.vertices[used]
    points = np.concatenate([contour.points, surface.points(vertices[len(contour.nodes) :])])
    order = np.argsort(is_row, kind="stable")  # rows have no line to slide on: they come last
    listing = _Listing(vertices, points)
    for row, piece in enumerate(order.tolist()):
        listing.add(names[pieces.pieces[piece]], int(counts[piece]), row)
    shown = order[: len(order) - int(is_row.sum())]
    lines = np.concatenate([pieces.lines[shown], chosen.left_out.lines])
    own = Followed(
        ends=np.concatenate([points[names[pieces.pieces[shown]]], _in_space(chosen.left_out, surface)]),
        places=tuple(chosen.places[line] for line in lines) if chosen.places else (),
        count=len(shown),
        edges=np.concatenate([np.empty((0, 2), dtype=np.int64), *listing.edges]),
        edge_pieces=np.repeat(np.where(is_row[order], -1, np.arange(len(order))), counts[order]),
        node_lines=np.concatenate(listing.node_lines),
    )
    nodes, points = np.concatenate(listing.nodes), np.concatenate(listing.points)
    return attrs.evolve(contour, nodes=nodes, points=points, followed=own)


class _Listing:
    """Nodes, one after another, and the edges between those of a piece."""

    def __init__(self, vertices: Floats, points: Floats) -> None:
        self.nodes, self.points = [vertices], [points]
        self.edges: list[Longs] = []
        self.node_lines = [np.full(len(vertices), -1)]
        self._count = len(vertices)

    def add(self, ends: Longs, number: int, row: int) -> None:
        """Add the nodes of a piece, in one direction whatever plate has it: several get the same bits."""
        first, last = ends[np.lexsort(self.points[0][ends].T[::-1])]
        share = (np.arange(1, number) / number)[:, None]
        for rows in (self.nodes, self.points):
            rows.append(rows[0][first] + share * (rows[0][last] - rows[0][first]))
        self.node_lines.append(np.full(number - 1, row))
        chain = np.concatenate([[first], self._count + np.arange(number - 1), [last]])
        self.edges.append(np.stack([chain[:-1], chain[1:]], axis=1))
        self._count += number - 1


def _in_space(pieces: Arrangement, surface: Surface) -> Floats:
    """(P, 2, 3) ends of pieces [mm]."""
    return floats(surface.points(pieces.vertices[pieces.pieces.ravel()]).reshape(-1, 2, 3))


def _beside(found: Arrangement, segments: Longs, size: float) -> Bools:
    """(P,) pieces that run beside the contour, a row of nodes, or a piece of an earlier line."""
    count, ends = len(found.pieces), found.vertices[np.concatenate([found.pieces, segments])]
    ways = ends[:, 1] - ends[:, 0]
    lengths = np.hypot(*ways.T)
    probes = (ends[:count, :1] + PROBES[:, None] * ways[:count, None]).reshape(-1, 2)
    tree = shapely.STRtree(shapely.linestrings(ends))
    probe, other = tree.query(shapely.points(probes), predicate="dwithin", distance=NEAREST * size)
    piece = probe // len(PROBES)
    sines = (ways[piece, 0] * ways[other, 1] - ways[piece, 1] * ways[other, 0]) / (lengths[piece] * lengths[other])
    feet = ((probes[probe] - ends[other, 0]) * ways[other]).sum(axis=1) / lengths[other] ** 2
    is_beside = (piece != other) & (np.abs(sines) < _ALONG) & (feet > 0) & (feet < 1)
    met: dict[int, set[int]] = {}
    for one, another in zip(piece[is_beside].tolist(), other[is_beside].tolist(), strict=True):
        met.setdefault(one, set()).add(another)
        met.setdefault(another, set()).add(one)
    beside = np.zeros(count, dtype=bool)
    for piece in np.lexsort((np.arange(count), found.lines)).tolist():
        before = [other for other in met.get(piece, ()) if other >= count or found.lines[other] < found.lines[piece]]
        beside[piece] = found.lines[piece] >= 0 and any(other >= count or not beside[other] for other in before)
    return beside
