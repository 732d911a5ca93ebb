"""A ring of points one step inside the sides of small regions: so narrow a corner has nodes, too, that may move."""

import numpy as np
import shapely

from hullquad.arrays import Floats, floats
from hullquad.triangulation.divided import Contour

MOST = 100
"""Sides of a small region: larger ones have other places for nodes."""
_APART = 0.5
"""Least distance between points, over their depth."""


def inset_points(contour: Contour, regions: list[int], others: Floats, depth: float) -> Floats:
    """(P, 2) points along the sides of some regions, and of other points those that are not near them [mm].

    They lie so far inside, over the shorter of the two sides that meet there.
    """
    around = contour.sides
    small = np.bincount(around.regions)[regions] <= MOST
    chosen = np.flatnonzero(np.isin(around.regions, np.array(regions)[small]))
    arriving = np.empty_like(around.following)
    arriving[around.following] = np.arange(len(arriving))
    lengths = np.hypot(*(around.nodes[around.ends[:, 1]] - around.nodes[around.ends[:, 0]]).T)
    depths = depth * np.minimum(lengths[chosen], lengths[arriving[chosen]])
    middle = around.headings[chosen] + around.angles[chosen] / 2
    points = around.nodes[around.ends[chosen, 0]] + depths[:, None] * np.stack([np.cos(middle), np.sin(middle)], axis=1)
    rim = shapely.multilinestrings(shapely.linestrings(around.nodes[around.ends[chosen]]))
    width = depths * np.sin(np.minimum(around.angles[chosen], np.pi) / 2)
    clear = shapely.distance(rim, shapely.points(points)) > _APART * width
    clear &= shapely.contains_xy(contour.region, points[:, 0], points[:, 1])
    kept: list[int] = []
    for i in np.flatnonzero(clear).tolist():
        if all(np.hypot(*(points[i] - points[j])) > _APART * min(depths[i], depths[j]) for j in kept):
            kept.append(i)
    tree = shapely.STRtree(shapely.points(points[kept]))
    near, _ = tree.query(shapely.points(others), predicate="dwithin", distance=float(depths.max(initial=0.0)))
    return floats(np.concatenate([np.delete(others, np.unique(near), axis=0), points[kept]]))
