"""Regions with four sides, opposite ones of equally many segments: laid out as grids by transfinite interpolation.

W. J. Gordon, C. A. Hall, "Construction of curvilinear co-ordinate systems and applications to mesh generation",
Int. J. Numer. Meth. Engng 7:461 (1973).
"""

from collections import deque

import numpy as np
import shapely

from hullquad.arrays import Floats, Ints, Longs, floats, ints
from hullquad.quads.draft import draft, finished
from hullquad.quads.log import Log
from hullquad.quads.making import Task
from hullquad.quads.smoothing import relaxed
from hullquad.triangulation.cutting import Cut
from hullquad.triangulation.divided import Contour

_SWEEPS = 40
_NEAR = 0.001
"""Smoothing ends when no node moves farther than this part of the element size."""

Sides4 = tuple[Longs, ...]


def grids(contour: Contour, task: Task) -> tuple[Floats, Ints]:
    """Nodes and quads of all regions that can be grids, smoothed."""
    nodes, elements = _laid_out(contour.cut)
    made = draft(nodes, elements, task.given, task.rim_ideal)
    deque(relaxed(made, _SWEEPS, _NEAR * task.size, Log(is_watched=False)), maxlen=0)
    return finished(made, task.given)


def _laid_out(cut: Cut) -> tuple[Floats, Ints]:
    """Nodes and quads of all regions that can be grids: the nodes of the cut plate, then those inside the grids."""
    nodes, elements, count = [cut.nodes], [np.empty((0, 4), dtype=np.int32)], len(cut.nodes)
    for four in _mappable(cut):
        numbers = _rim(four, count)
        places = _interpolated(cut.nodes, numbers)[1:-1, 1:-1].reshape(-1, 2)
        nodes.append(places)
        count += len(places)
        corners = (numbers[:-1, :-1], numbers[1:, :-1], numbers[1:, 1:], numbers[:-1, 1:])
        elements.append(np.stack([corner.ravel() for corner in corners], axis=1).astype(np.int32))
    return floats(np.concatenate(nodes)), ints(np.concatenate(elements))


def _mappable(cut: Cut) -> list[Sides4]:
    """Sides of the regions that can be grids, from corner to corner; none with a node that is given inside."""
    found = [
        four for four in cut.around.four_sided.values() if len(four[0]) == len(four[2]) and len(four[1]) == len(four[3])
    ]
    alone = cut.nodes[len(cut.around.ends) :]
    if not len(alone) or not found:
        return found
    rims = [shapely.Polygon(cut.nodes[np.concatenate(four)]) for four in found]
    taken = set(shapely.STRtree(rims).query(shapely.points(alone), predicate="intersects")[1].tolist())
    return [four for i, four in enumerate(found) if i not in taken]


def _rim(four: Sides4, first: int) -> Longs:
    """(m + 1, n + 1) numbers of a grid's nodes: those of the rim, and those inside counted from a first one."""
    below, right, above, left = four
    m, n = len(below), len(right)
    numbers = np.empty((m + 1, n + 1), dtype=np.int64)
    numbers[1:-1, 1:-1] = first + np.arange((m - 1) * (n - 1)).reshape(m - 1, n - 1)
    numbers[:-1, 0], numbers[-1, :-1] = below, right
    numbers[:0:-1, -1], numbers[0, :0:-1] = above, left
    return numbers


def _interpolated(nodes: Floats, numbers: Longs) -> Floats:
    """(m + 1, n + 1, 2) places of a grid's nodes, from those of its rim."""
    m, n = numbers.shape[0] - 1, numbers.shape[1] - 1
    u, v = (np.arange(m + 1) / m)[:, None, None], (np.arange(n + 1) / n)[None, :, None]
    below, above = nodes[numbers[:, 0]][:, None], nodes[numbers[:, -1]][:, None]
    left, right = nodes[numbers[0]][None], nodes[numbers[-1]][None]
    across = (1 - v) * below + v * above
    along = (1 - u) * left + u * right
    both = (1 - v) * ((1 - u) * below[0] + u * below[-1]) + v * ((1 - u) * above[0] + u * above[-1])
    return floats(across + along - both)
