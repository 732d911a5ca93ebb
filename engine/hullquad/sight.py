"""A mesh as it is seen from one direction: from where it is best looked at, and which element is at a place."""

from functools import cached_property

import attrs
import numpy as np

from hullquad.arrays import Bools, Floats, Ints, Longs, floats, ints
from hullquad.mesh import Mesh

_FLAT = 1e-3
"""Part of its area that a surface must turn to one side for that side to be its front."""


@attrs.frozen(eq=False, kw_only=True)
class Sight:
    """Elements in parallel projection."""

    elements: Ints
    """(E, 4) as of `Topology`."""
    places: Floats
    """(N, 2) nodes across the direction of view: to the right, up [mm]."""
    heights: Floats
    """(N,) nodes towards the viewer [mm]."""

    @cached_property
    def corners(self) -> Longs:
        """(E, 4) nodes of each element; a triangle repeats its first."""
        return _closed(self.elements)

    @cached_property
    def boxes(self) -> Floats:
        """(4, E) left, right, lower and upper end of each element."""
        corners = np.ascontiguousarray(self.corners.T)  # corner by corner is ten times as fast
        across, along = self.places[:, 0][corners], self.places[:, 1][corners]
        return np.stack([across.min(axis=0), across.max(axis=0), along.min(axis=0), along.max(axis=0)])

    def element_at(self, place: Floats) -> int:
        """Row of the element that is seen at a place (2,), the nearest of several; -1 where there is none."""
        left, right, low, high = self.boxes
        x, y = place
        rows = np.flatnonzero((left <= x) & (x <= right) & (low <= y) & (y <= high))
        corners = self.corners[rows]
        hit = _contains(self.places[corners] - place)
        if not hit.any():
            return -1
        height = _height(self.places[corners[hit]] - place, self.heights[corners[hit]])
        return int(rows[hit][height.argmax()])


def sight(points: Floats, elements: Ints, right: Floats, up: Floats) -> Sight:
    """The elements on `points` (N, 3), seen against ``right x up``, both (3,) unit vectors."""
    across, along, towards = (_along(points, axis) for axis in (right, up, np.cross(right, up)))
    return Sight(elements=elements, places=floats(np.stack([across, along], axis=1)), heights=floats(towards))


def _along(points: Floats, axis: Floats) -> Floats:
    """(N,) coordinates; by hand, as BLAS would wait for its threads: 30 ms instead of 0.3 beside a busy worker."""
    x, y, z = axis
    return np.asarray(points[:, 0] * x + points[:, 1] * y + points[:, 2] * z)


def plan(mesh: Mesh) -> tuple[Floats, Floats]:
    """Unit vectors (3,) to the right and up in the plan view: those of the plate's plane.

    A mesh that is not flat is seen against its mean normal, upright, and from above, front and side at once
    when it has no front.
    """
    if mesh.surface is not None:
        return mesh.surface.u, mesh.surface.v
    corners = mesh.points[_closed(mesh.topology.elements)]
    areas = np.cross(corners[:, 2] - corners[:, 0], corners[:, 3] - corners[:, 1])
    normal = areas.sum(axis=0)
    if np.hypot.reduce(normal) <= _FLAT * np.hypot.reduce(areas, axis=1).sum():
        normal = np.array([1.0, -1.0, 1.0])
    normal = normal / np.hypot.reduce(normal)
    upright = np.array([0.0, 1.0, 0.0]) if abs(normal[2]) > 0.9 else np.array([0.0, 0.0, 1.0])
    right = np.cross(upright, normal)
    right /= np.hypot.reduce(right)
    return floats(right), floats(np.cross(normal, right))


def from_notch(points: Floats, elements: Ints) -> Ints:
    """The elements (E, 4) on `points` (N, 3), a concave quad beginning at its notch: so a fan of triangles fills it."""
    corners = points[_closed(elements)]
    area = np.cross(corners[:, 2] - corners[:, 0], corners[:, 3] - corners[:, 1])
    ahead, back = np.roll(corners, -1, axis=1) - corners, np.roll(corners, 1, axis=1) - corners
    turns = (np.cross(ahead, back) * area[:, None]).sum(axis=2)
    is_notched = ((turns < 0).sum(axis=1) == 1) & (elements[:, 3] >= 0)
    first = np.where(is_notched, turns.argmin(axis=1), 0)
    return ints(np.take_along_axis(elements, (first[:, None] + np.arange(4)) % 4, axis=1))


def _closed(elements: Ints) -> Longs:
    return np.where(elements < 0, elements[:, :1], elements).astype(np.int64)


def _contains(corners: Floats) -> Bools:
    """(K,) whether the origin lies in each polygon of (K, 4, 2) corners, of any shape: crossings to the right."""
    x, y = corners[..., 0], corners[..., 1]
    next_x, next_y = np.roll(x, -1, axis=1), np.roll(y, -1, axis=1)
    passes = (y > 0) != (next_y > 0)
    rise = np.where(passes, next_y - y, 1.0)
    is_right = x - y * (next_x - x) / rise > 0
    odd: Bools = (passes & is_right).sum(axis=1) % 2 == 1
    return odd


def _height(corners: Floats, heights: Floats) -> Floats:
    """(K,) height at the origin of polygons with (K, 4, 2) corners and their (K, 4) heights: of the mean plane."""
    diagonals = corners[:, 2:] - corners[:, :2]
    rises = heights[:, 2:] - heights[:, :2]
    determinant = diagonals[:, 0, 0] * diagonals[:, 1, 1] - diagonals[:, 0, 1] * diagonals[:, 1, 0]
    safe = np.where(determinant == 0, np.inf, determinant)
    slope_x = (rises[:, 0] * diagonals[:, 1, 1] - rises[:, 1] * diagonals[:, 0, 1]) / safe
    slope_y = (rises[:, 1] * diagonals[:, 0, 0] - rises[:, 0] * diagonals[:, 1, 0]) / safe
    centre = corners.mean(axis=1)
    return np.asarray(heights.mean(axis=1) - slope_x * centre[:, 0] - slope_y * centre[:, 1])
