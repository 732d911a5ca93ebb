"""What will not be good where elements follow lines, told before there is a mesh."""

from collections.abc import Iterator

import numpy as np
import shapely

from hullquad.arrays import Floats, Longs
from hullquad.plate import Notice
from hullquad.surface import Plane
from hullquad.triangulation.divided import Contour, Followed
from hullquad.triangulation.following import NEAREST, PROBES
from hullquad.triangulation.sizes import rounded_down

_NARROW = 0.2
"""Part of the element size below which a strip is too narrow for elements, and a piece too short."""
_ROUNDING = 1e-9
"""Relative; what is just as wide as it must be is not too narrow."""
_AWAY = 2.0
"""A strip goes on for so many times its width, also past the ends of a piece: what only meets it is nearer to them."""
_FAILING = np.radians(29.999)
"""Corners of regions below this angle have no acceptable quad."""


def line_concerns(contour: Contour) -> Iterator[Notice]:
    """Warnings about followed lines: of every kind the worst one."""
    if contour.followed is None:
        return
    yield from _odd_parts(contour)
    if not contour.followed.places or not isinstance(surface := contour.plate.surface, Plane):
        return
    ends = surface.parameters(contour.followed.ends.reshape(-1, 3)).reshape(-1, 2, 2)
    yield from _left_out(contour.followed, ends, contour.size)
    yield from _narrow(contour, contour.followed, ends[: contour.followed.count])
    yield from _short(contour.followed, ends[: contour.followed.count], contour.size)
    yield from _sharp(contour, contour.followed)


def _odd_parts(contour: Contour) -> Iterator[Notice]:
    """Regions that stay odd, where the contour as a whole does not tell that one does."""
    around = contour.sides
    if len(around.odd) <= contour.edge_count % 2:
        return
    counts = np.bincount(around.regions)
    for region in around.odd.tolist():
        row = around.row(int(np.argmax(around.regions == region)))
        inside = shapely.Polygon(around.nodes[around.ends[row, 0]]).buffer(0).representative_point()
        numbers = {"u": inside.x, "v": inside.y, "count": int(counts[region])}
        yield Notice("W_ODD_PART", contour.plate.place, "", numbers)


def _left_out(own: Followed, ends: Floats, size: float) -> Iterator[Notice]:
    """Pieces that are not followed."""
    pieces = np.arange(own.count, len(ends))
    for i, count in _worst(own, pieces, -np.hypot(*(ends[pieces, 1] - ends[pieces, 0]).T)):
        (u, v), (to_u, to_v) = ends[pieces[i]].tolist()
        numbers = {"u": u, "v": v, "to_u": to_u, "to_v": to_v, "least": NEAREST * size, "count": count}
        yield Notice("W_LINE_BESIDE", own.places[pieces[i]], "", numbers)


def _narrow(contour: Contour, own: Followed, ends: Floats) -> Iterator[Notice]:
    """Strips between a line and the contour, or another line, that are too narrow for elements."""
    size = contour.size
    least = _NARROW * size * (1 - _ROUNDING)
    pieces, segments = shapely.linestrings(ends), shapely.linestrings(contour.nodes[contour.segments])
    others = np.concatenate([pieces, segments])
    probes = ends[:, :1] + PROBES[:, None] * (ends[:, 1:] - ends[:, :1])
    probed = np.concatenate([pieces, shapely.points(probes.reshape(-1, 2))])
    owners = np.concatenate([np.arange(len(pieces)), np.repeat(np.arange(len(pieces)), len(PROBES))])
    probe, other = shapely.STRtree(others).query(probed, predicate="dwithin", distance=least)
    piece = owners[probe]
    gaps = shapely.get_coordinates(shapely.shortest_line(probed[probe], others[other])).reshape(-1, 2, 2)
    widths = np.hypot(*(gaps[:, 1] - gaps[:, 0]).T)
    clear = np.hypot(*np.moveaxis(gaps[:, :1] - ends[piece], 2, 0)).min(axis=1)
    strips = (piece != other) & (widths > 0) & (clear > _AWAY * widths)
    piece, other, gaps, widths = piece[strips], other[strips], gaps[strips], widths[strips]
    for i, count in _worst(own, piece, widths):
        (u, v), width = gaps[i, 0].tolist(), float(widths[i])
        case = "contour" if other[i] >= len(pieces) else "line"
        numbers = {"u": u, "v": v, "width": width, "size": size, "helping": rounded_down(width / _NARROW)}
        numbers["count"] = count
        yield Notice("W_LINE_NEAR", own.places[piece[i]], case, numbers)


def _short(own: Followed, ends: Floats, size: float) -> Iterator[Notice]:
    """Pieces shorter than elements."""
    lengths = np.hypot(*(ends[:, 1] - ends[:, 0]).T)
    short = np.flatnonzero(lengths < _NARROW * size)
    for i, count in _worst(own, short, lengths[short]):
        u, v = ends[short[i]].mean(axis=0).tolist()
        numbers = {"u": u, "v": v, "length": float(lengths[short[i]]), "least": _NARROW * size, "count": count}
        yield Notice("W_LINE_SHORT", own.places[short[i]], "", numbers)


def _sharp(contour: Contour, own: Followed) -> Iterator[Notice]:
    """Corners between a line and something else where no quad is acceptable."""
    around, edges = contour.sides, max(1, len(contour.line_edges))
    arriving = np.empty_like(around.following)
    arriving[around.following] = np.arange(len(arriving))
    is_of_line = np.stack([np.arange(len(arriving)), arriving]) >= around.contour
    sharp = np.flatnonzero((around.angles < _FAILING) & is_of_line.any(axis=0))
    side = np.where(is_of_line[0, sharp], sharp, arriving[sharp])
    piece = own.edge_pieces[(side - around.contour) % edges]
    sharp, piece = sharp[piece >= 0], piece[piece >= 0]
    for i, count in _worst(own, piece, around.angles[sharp]):
        (u, v), angle = around.nodes[around.ends[sharp[i], 0]].tolist(), float(around.angles[sharp[i]])
        numbers = {"u": u, "v": v, "angle": np.degrees(angle), "best": np.sin(angle), "count": count}
        yield Notice("W_LINE_ANGLE", own.places[piece[i]], "", numbers)


def _worst(own: Followed, pieces: Longs, values: Floats) -> Iterator[tuple[int, int]]:
    """Row of the least value of some pieces, if there is any, and of how many lines they are."""
    if len(pieces):
        yield int(np.argmin(values)), len({own.places[piece] for piece in pieces.tolist()})
