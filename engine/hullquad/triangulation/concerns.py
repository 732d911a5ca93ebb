"""What will not be good in the mesh of a plate at one element size, told before there is a mesh."""

from collections.abc import Iterator

import attrs
import numpy as np
import shapely

from hullquad.plate import JOIN, Document, Loop, Notice, Plate
from hullquad.triangulation.contour import Contour
from hullquad.triangulation.gaps import gaps
from hullquad.triangulation.line_concerns import line_concerns
from hullquad.triangulation.necks import necks
from hullquad.triangulation.neighbours import neighbours
from hullquad.triangulation.remedies import edge_place, remedy
from hullquad.triangulation.sizes import rounded_down

_DECIMALS = 1e-3
"""Coordinates in fewer decimals are not exact; a move of so little is none [mm]."""
_SHORT = 0.2
_NEAR = 0.1
_NARROW = 0.2
"""Parts of the element size."""
_ROUNDING = 1e-9
"""Relative; what is just as long as it must be is not too short."""


def concerns_of(document: Document, size: float | str | None, contour: Contour) -> Iterator[Notice]:
    """Warnings about a plate of a document that is meshed from this contour, which was divided for a size."""
    change = remedy(document, contour.plate.id, size) if contour.is_odd else None
    told = {} if change is None else attrs.asdict(change) | {"where": edge_place(document, change)}
    case = "" if change is None else "shared" if change.neighbours else "edge"
    for notice in division_concerns(contour):
        is_odd = notice.code == "W_ODD"
        yield attrs.evolve(notice, case=case, numbers=notice.numbers | told) if is_odd else notice


def division_concerns(contour: Contour) -> Iterator[Notice]:
    """Those that need no other plate."""
    yield from size_concerns(contour.plate, contour.size)
    if contour.is_odd and contour.triangles_unavoidable == 1:
        yield Notice("W_ODD", contour.plate.place, "", {"count": contour.edge_count, "size": contour.size})
    yield from line_concerns(contour)
    yield from _snapped(contour)
    yield from _near_contour(contour)


def size_concerns(plate: Plate, size: float) -> Iterator[Notice]:
    """Those of the warnings that need no contour, so that curved plates have them too."""
    if plate.is_parametric:
        return  # no lengths before the surface can tell them
    extent = float(np.ptp(plate.box, axis=0).max())
    if size > extent:
        yield Notice("W_SIZE", plate.place, "", {"size": size, "extent": extent})
        size = extent  # elements are no larger
    for loop in plate.loops:
        yield from _short_edges(loop, size)
    yield from _ligaments(plate, size)
    for hole, outline in zip(plate.holes, plate.outlines[1:], strict=True):
        width = float(np.ptp(outline, axis=0).max())
        if width < size - 2 * plate.chord_error:
            numbers = {"width": width, "size": size, "helping": rounded_down(width)}
            yield Notice("W_SMALL_HOLE", hole.place, "", numbers)


def gap_concerns(document: Document) -> Iterator[Notice]:
    """Warnings about edges that lie beside other plates and are not joined to them."""
    shared = neighbours(tuple(plate for plate in document.plates if plate.is_plane))
    for gap in gaps(shared):
        wire = shared.frame.wires[gap.wire]
        plate, other = shared.frame.plates[wire.plate], shared.frame.plates[gap.plate]
        place = plate.loops[wire.loop].edge_place(wire.edge)
        yield Notice("W_GAP", place, "", {"neighbour": other.id, "distance": gap.distance, "most": JOIN})


def _snapped(contour: Contour) -> Iterator[Notice]:
    """What was moved, unless it is by the decimals that the document gives."""
    for snap in contour.snaps:
        (u, v), case = snap.node, "neighbour" if snap.neighbour else ""
        numbers = {"u": u, "v": v, "distance": snap.distance, "neighbour": snap.neighbour}
        if snap.distance > _DECIMALS:
            yield Notice("W_SNAP", snap.place, case, numbers)


def _near_contour(contour: Contour) -> Iterator[Notice]:
    """Fixed nodes so near to the contour or to each other that the elements between them are slivers."""
    rim = shapely.multilinestrings([shapely.linearrings(ring) for ring in contour.rings])
    inside = contour.inside[: len(contour.inside_places)]
    points = shapely.points(inside)
    away = shapely.distance(rim, points)
    if len(inside) > 1:
        near = shapely.STRtree(points).query(points, predicate="dwithin", distance=_NEAR * contour.size).T
        one, other = near[near[:, 0] != near[:, 1]].T
        np.minimum.at(away, one, shapely.distance(points[one], points[other]))
    for i in np.flatnonzero(away < _NEAR * contour.size):
        u, v = inside[i]
        numbers = {"u": u, "v": v, "distance": float(away[i]), "size": contour.size}
        yield Notice("W_NEAR", contour.inside_places[i], "", numbers)


def _ligaments(plate: Plate, size: float) -> Iterator[Notice]:
    """Strips beside holes, and necks, that are too narrow for elements of the size."""
    least = _NARROW * size * (1 - _ROUNDING)
    for neck in necks(plate, least):
        u, v = neck.point
        helping = rounded_down(neck.width / _NARROW)
        yield Notice(
            "W_LIGAMENT", neck.place, "neck", {"width": neck.width, "size": size, "helping": helping, "u": u, "v": v}
        )
    rim = shapely.linearrings(plate.outlines[0])
    rings = np.array([rim, *(shapely.linearrings(ring) for ring in plate.outlines[1:])])
    tree = shapely.STRtree(rings)
    near = tree.query(rings, predicate="dwithin", distance=least).T
    for other, hole in sorted((min(pair), max(pair)) for pair in map(tuple, near.tolist()) if pair[0] < pair[1]):
        width = float(shapely.distance(rings[hole], rings[other]))
        u, v = shapely.get_coordinates(shapely.shortest_line(rings[hole], rings[other]))[0]
        numbers = {"width": width, "size": size, "helping": rounded_down(width / _NARROW)}
        numbers |= {"hole": other - 1, "u": u, "v": v}
        yield Notice("W_LIGAMENT", plate.holes[hole - 1].place, "hole" if other else "contour", numbers)


def _short_edges(loop: Loop, size: float) -> Iterator[Notice]:
    """One warning per loop: the shortest edge, and how many there are."""
    lengths = np.array([curve.length for curve in loop.curves])
    count = int((lengths < _SHORT * size * (1 - _ROUNDING)).sum())
    if count:
        shortest = int(np.lexsort((loop.edges, lengths))[0])
        length = float(lengths[shortest])
        numbers = {"length": length, "size": size, "helping": rounded_down(length / _SHORT), "count": count}
        yield Notice("W_SHORT_EDGE", loop.edge_place(shortest), "", numbers)
