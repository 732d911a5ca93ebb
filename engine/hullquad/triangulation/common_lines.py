"""Pieces of lines that several plates have in common: each is divided once, by the least of the plates' sizes."""

from collections.abc import Sequence

import numpy as np
import shapely

from hullquad.arrays import Floats, floats
from hullquad.plate import JOIN
from hullquad.triangulation import division
from hullquad.triangulation.following import Plan
from hullquad.triangulation.wireframe import seen


def common_numbers(plans: Sequence[Plan]) -> list[dict[int, int]]:
    """For each plan the numbers of segments of the pieces that another one has, too."""
    owners = np.repeat(np.arange(len(plans)), [len(chosen.pieces.pieces) for chosen in plans])
    ends = np.concatenate([np.empty((0, 2, 3)), *map(_ends, plans)])
    found: list[dict[int, int]] = [{} for _ in plans]
    first_rows = np.searchsorted(owners, np.arange(len(plans)))
    for group in _groups(ends, owners):
        length = float(np.linalg.norm(ends[group[0], 1] - ends[group[0], 0]))
        number = division.equal(length, min(plans[owners[row]].contour.size for row in group))
        for row in group:
            found[owners[row]][row - int(first_rows[owners[row]])] = number
    return found


def _ends(chosen: Plan) -> Floats:
    """(P, 2, 3) ends of the pieces in space, in one direction whatever plate has them [mm]."""
    contour, pieces = chosen.contour, chosen.pieces
    added = contour.plate.surface.points(pieces.vertices[len(contour.points) :])
    points = np.concatenate([contour.points, added])[pieces.pieces]
    return floats(points)


def _groups(ends: Floats, owners: np.ndarray) -> list[list[int]]:
    """Rows of pieces of different plates that lie upon each other."""
    middles = ends.mean(axis=1)
    dots = shapely.points(seen(middles))
    one, other = shapely.STRtree(dots).query(dots, predicate="dwithin", distance=JOIN)
    kept = (one < other) & (owners[one] != owners[other])
    one, other = one[kept], other[kept]
    straight, turned = (
        np.linalg.norm(ends[one] - there, axis=2).max(axis=1) <= JOIN for there in (ends[other], ends[other, ::-1])
    )
    same = straight | turned
    groups: dict[int, list[int]] = {}
    head: dict[int, int] = {}
    for i, j in sorted(zip(one[same].tolist(), other[same].tolist(), strict=True)):
        first = head.setdefault(i, i)
        if head.setdefault(j, first) == first and j not in groups.setdefault(first, [first]):
            groups[first].append(j)
    return [group for group in groups.values() if len(group) > 1]
