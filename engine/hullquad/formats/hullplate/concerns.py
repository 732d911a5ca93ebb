"""What is allowed in a plate, but probably not meant, or not good for any mesh of it."""

from collections.abc import Iterator

import numpy as np
import shapely

from hullquad.plate import Loop, Notice, Plate

_THICKEST = 150
_SHARPEST, _FAILING = 20, 30
"""Angles of corners [degrees]: with less than the one no mesh is good, with less than the other no quad passes."""
_SMALLEST_BOX, _LARGEST_BOX = 50, 500_000


def concerns(plate: Plate) -> Iterator[Notice]:
    """Warnings about a sound plate, whatever the size of its elements."""
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


def _cut_lines(plate: Plate) -> Iterator[Notice]:
    pairs = shapely.STRtree(plate.openings).query(plate.rows, predicate="intersects").T
    for row, hole in sorted(map(tuple, pairs)):
        if shapely.length(shapely.intersection(plate.rows[row], plate.openings[hole])) > plate.snap:
            yield Notice("W_LINE_HOLE", plate.lines[row].place, "", {"hole": int(hole)})


def _sharp_corners(loop: Loop) -> Iterator[Notice]:
    """Corners of the plate's material that no mesh can mend; the plate is on the left of its loops."""
    leaving = np.array([curve.headings(np.zeros(1))[0] for curve in loop.curves])
    arriving = np.array([curve.headings(np.array([curve.length]))[0] for curve in loop.curves])
    angles = np.degrees((np.pi - (leaving - np.roll(arriving, 1))) % (2 * np.pi))
    # a cusp comes out as nearly nothing, or as nearly a full turn by a rounding error: that one is a slit
    for i in np.flatnonzero(angles < _FAILING):
        (u, v), case = loop.curves[i].start, "" if angles[i] < _SHARPEST else "failing"
        numbers = {"u": u, "v": v, "angle": float(angles[i]), "best": float(np.sin(np.radians(angles[i])))}
        yield Notice("W_CORNER", loop.vertex_place(int(i)), case, numbers)
