"""Where a line runs beside the contour in a narrow strip: nodes on it that face those of the contour.

Elements across the strip have no skew then, however thin they are.
"""

import numpy as np
import shapely

from hullquad.triangulation.arrangement import Arrangement
from hullquad.triangulation.divided import Contour

NARROW = 0.2
"""Width of a narrow strip over the element size."""
_APART = 0.67
"""Least distance along the line between such nodes, and from its ends, over the element size: others would bring more
poor elements elsewhere than they mend."""
_SAME = 1e-6
"""Distance below which two of them are one [mm]."""


def facing(contour: Contour, found: Arrangement) -> dict[int, list[float]]:
    """For pieces beside segments of the contour the parts of their lengths, in order, at which they face its nodes."""
    size, segments = contour.size, contour.nodes[contour.segments]
    starts, lengths = found.vertices[found.pieces[:, 0]], found.lengths
    ways = (found.vertices[found.pieces[:, 1]] - starts) / lengths[:, None]
    tree = shapely.STRtree(shapely.linestrings(segments))
    lines = shapely.linestrings(found.vertices[found.pieces])
    piece, segment = tree.query(lines, predicate="dwithin", distance=NARROW * size)
    along = np.einsum("kec,kc->ke", segments[segment] - starts[piece, None], ways[piece])
    feet = starts[piece, None] + along[..., None] * ways[piece, None]
    widths = np.hypot(*np.moveaxis(segments[segment] - feet, 2, 0))
    u, v = ((segments[segment] + feet) / 2).mean(axis=1).T
    least = _APART * size
    faces = (widths < NARROW * size).all(axis=1) & (widths > 0).any(axis=1) & (found.lines[piece] >= 0)
    faces &= (along > least).all(axis=1) & (along < (lengths[piece] - least)[:, None]).all(axis=1)
    faces &= (np.abs(np.diff(along, axis=1)[:, 0]) > least) & shapely.contains_xy(contour.region, u, v)
    taken: dict[int, list[float]] = {}
    for i in np.flatnonzero(faces)[np.argsort(widths[faces].max(axis=1).round(6), kind="stable")]:
        row = taken.setdefault(int(piece[i]), [])
        fresh = [x for x in along[i].tolist() if all(abs(x - other) > _SAME for other in row)]
        if all(abs(x - other) > least for x in fresh for other in row):
            row += fresh
    return {number: sorted(x / float(lengths[number]) for x in row) for number, row in taken.items()}
