"""What is allowed in a plate, but probably not meant, or not good for its mesh."""

from collections.abc import Iterator

import numpy as np
import shapely
from scipy.spatial import cKDTree

from hullquad.errors import PlateError
from hullquad.plate import Loop, Notice, Plate
from hullquad.triangulation.contour import Contour

_THICKEST = 150
_SHARPEST = 20
_SHORT = 0.2
_NEAR = 0.1
"""Parts of the target size."""
_SMALLEST_BOX, _LARGEST_BOX = 50, 500_000


def concerns(plate: Plate) -> Iterator[Notice]:
    """Warnings about a sound plate."""
    if plate.thickness > _THICKEST:
        yield Notice("W_THICKNESS", f"{plate.place}/thickness", "", {"thickness": plate.thickness})
    yield from _cut_lines(plate)
    if plate.is_parametric:
        return  # no lengths and angles before the surface can tell them
    extent = float(np.ptp(plate.box, axis=0).max())
    if not _SMALLEST_BOX <= extent <= _LARGEST_BOX:
        yield Notice("W_UNITS", plate.outer.place, "", {"extent": extent})
    for loop in plate.loops:
        yield from _sharp_corners(loop)
        yield from _short_edges(loop, _SHORT * plate.target_size)
    for hole, outline in zip(plate.holes, plate.outlines[1:], strict=True):
        width = float(np.ptp(outline, axis=0).max())
        if width < plate.target_size - 2 * plate.chord_error:
            yield Notice("W_SMALL_HOLE", hole.place, "", {"width": width, "size": plate.target_size})


def division_concerns(plate: Plate, outcome: Contour | PlateError | None) -> Iterator[Notice]:
    """Warnings about the contour at the plate's target size; the outcome is None for a curved plate."""
    if isinstance(outcome, PlateError):
        yield Notice("W_COARSE", outcome.place, outcome.case, outcome.numbers)
    elif outcome is not None:
        if outcome.triangles_unavoidable:
            yield Notice("W_ODD", plate.place, "", {"count": outcome.edge_count, "size": plate.target_size})
        for snap in outcome.snaps:
            u, v = snap.node
            yield Notice("W_SNAP", snap.place, "", {"u": u, "v": v, "distance": snap.distance})
        yield from _near_contour(outcome)


def _near_contour(contour: Contour) -> Iterator[Notice]:
    """Fixed nodes so near to the contour or to each other that the elements between them are slivers."""
    rim = shapely.multilinestrings([shapely.linearrings(ring) for ring in contour.rings])
    away = shapely.distance(rim, shapely.points(contour.inside))
    if len(contour.inside) > 1:
        away = np.minimum(away, np.asarray(cKDTree(contour.inside).query(contour.inside, k=2)[0])[:, 1])
    for i in np.flatnonzero(away < _NEAR * contour.size):
        u, v = contour.inside[i]
        numbers = {"u": u, "v": v, "distance": float(away[i]), "size": contour.size}
        yield Notice("W_NEAR", contour.inside_places[i], "", numbers)


def _cut_lines(plate: Plate) -> Iterator[Notice]:
    pairs = shapely.STRtree(plate.openings).query(plate.rows, predicate="intersects").T
    for row, hole in sorted(map(tuple, pairs)):
        if shapely.length(shapely.intersection(plate.rows[row], plate.openings[hole])) > plate.snap:
            yield Notice("W_LINE_HOLE", plate.lines[row].place, "", {"hole": int(hole)})


def _sharp_corners(loop: Loop) -> Iterator[Notice]:
    """Corners of the plate's material under 20 degrees; the plate is on the left of its loops."""
    leaving = np.array([curve.headings(np.zeros(1))[0] for curve in loop.curves])
    arriving = np.array([curve.headings(np.array([curve.length]))[0] for curve in loop.curves])
    angles = np.degrees((np.pi - (leaving - np.roll(arriving, 1))) % (2 * np.pi))
    # a cusp comes out as nearly nothing, or as nearly a full turn by a rounding error: that one is a slit
    for i in np.flatnonzero(angles < _SHARPEST):
        u, v = loop.curves[i].start
        yield Notice("W_CORNER", loop.vertex_place(int(i)), "", {"u": u, "v": v, "angle": float(angles[i])})


def _short_edges(loop: Loop, least: float) -> Iterator[Notice]:
    """One warning per loop: the shortest edge, and how many there are."""
    lengths = np.array([curve.length for curve in loop.curves])
    count = int((lengths < least).sum())
    if count:
        shortest = int(np.lexsort((loop.edges, lengths))[0])
        numbers = {"length": float(lengths[shortest]), "least": least, "count": count}
        yield Notice("W_SHORT_EDGE", loop.edge_place(shortest), "", numbers)
