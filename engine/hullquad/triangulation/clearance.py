"""How near points come to the segments of closed polygons."""

import re
from collections.abc import Sequence

import numpy as np
import shapely

from hullquad.arrays import Floats, Longs, floats


def segments(nodes: int, loop_starts: Sequence[int]) -> Longs:
    """(E, 2) ends of the segments of closed loops, by node: loop i is ``nodes[loop_starts[i]:loop_starts[i + 1]]``."""
    numbers = np.arange(nodes)
    following = numbers + 1
    following[np.array(loop_starts[1:]) - 1] = loop_starts[:-1]
    return np.stack([numbers, following], axis=1)


def near_segments(points: Floats, nodes: Floats, loop_starts: Sequence[int], distance: float) -> Longs:
    """(M, 2) pairs of a point and a segment of closed loops nearer than a distance, but for its own segments."""
    ends = nodes[segments(len(nodes), loop_starts)]
    tree = shapely.STRtree(shapely.linestrings(ends))
    point, segment = tree.query(shapely.points(points), predicate="dwithin", distance=distance)
    own = (ends[segment] == points[point, None]).all(axis=2).any(axis=1)
    return np.stack([point[~own], segment[~own]], axis=1)


def crossing(polygon: shapely.Polygon) -> Floats:
    """(2,) a point where an invalid polygon crosses or touches itself."""
    found = re.search(r"\[(\S+) (\S+)\]", shapely.is_valid_reason(polygon))
    return floats([float(found[1]), float(found[2])] if found else polygon.exterior.coords[0])
