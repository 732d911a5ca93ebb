"""The surface of a mesh that lies on no known one: its own facets, as they were when it was read."""

from functools import cached_property
from typing import TYPE_CHECKING

import attrs
import numpy as np

from hullquad.arrays import Floats, Ints, Longs, floats, ints

if TYPE_CHECKING:
    from scipy.spatial import cKDTree

_FIRST = 12
"""Facets that are looked at first for each point: those with the nearest centroids."""


@attrs.frozen(eq=False, kw_only=True)
class Facets:
    """Triangles in space with a normal at each node; a quad is two, cut along its shorter diagonal."""

    points: Floats = attrs.field(converter=floats)
    """(N, 3) [mm]"""
    triangles: Ints = attrs.field(converter=ints)
    """(F, 3) nodes"""
    normals: Floats = attrs.field(converter=floats)
    """(N, 3) unit normals at the nodes; zero where no facet has an area."""

    @cached_property
    def _corners(self) -> Floats:
        """(F, 3, 3) their corners."""
        return self.points[self.triangles]

    @cached_property
    def _centroids(self) -> "cKDTree":
        from scipy.spatial import cKDTree  # noqa: PLC0415  a quarter of a second

        return cKDTree(self._corners.mean(axis=1))

    @cached_property
    def _reach(self) -> float:
        """Longest way from a centroid to a corner of its facet [mm]."""
        return float(np.linalg.norm(self._corners - self._corners.mean(axis=1, keepdims=True), axis=2).max())

    def feet(self, points: Floats) -> tuple[Floats, Floats]:
        """Nearest points on the facets (M, 3) of points (M, 3), and the unit normals there (M, 3).

        Exact: a facet that is nearer than the nearest one found has its centroid within that distance and its own
        reach, so the search goes on until no other centroid is there.
        """
        feet, normals = np.empty_like(points), np.empty_like(points)
        left, count = np.arange(len(points)), min(_FIRST, len(self.triangles))
        while len(left):
            found = self._centroids.query(points[left], k=np.arange(1, count + 1))
            away, facets = (np.asarray(part) for part in found)
            shares = _shares(points[left, None], self._corners[facets])
            places = np.einsum("mki,mkij->mkj", shares, self._corners[facets])
            distances = np.linalg.norm(places - points[left, None], axis=2)
            nearest = distances.argmin(axis=1)
            rows = np.arange(len(left))
            feet[left] = places[rows, nearest]
            normals[left] = self._normals_at(facets[rows, nearest], shares[rows, nearest])
            is_open = (away[:, -1] < distances[rows, nearest] + self._reach) & (count < len(self.triangles))
            left, count = left[is_open], min(4 * count, len(self.triangles))
        return feet, normals

    def _normals_at(self, facets: Longs, shares: Floats) -> Floats:
        """(M, 3) unit normals between those of the nodes."""
        sums = np.einsum("mi,mij->mj", shares, self.normals[self.triangles[facets]])
        lengths = np.linalg.norm(sums, axis=1, keepdims=True)
        return np.asarray(sums / np.where(lengths > 0, lengths, 1.0))


def facets(points: Floats, elements: Ints) -> Facets:
    """The facets of elements (E, 4) on points (N, 3); a triangle ends with -1."""
    quads, triangles = elements[elements[:, 3] >= 0], elements[elements[:, 3] < 0, :3]
    a, b, c, d = (points[quads[:, corner]] for corner in range(4))
    is_split_at_a = ((c - a) ** 2).sum(axis=1) <= ((d - b) ** 2).sum(axis=1)
    halves = np.where(is_split_at_a[:, None, None], quads[:, [[0, 1, 2], [0, 2, 3]]], quads[:, [[1, 2, 3], [1, 3, 0]]])
    parts = np.concatenate([halves.reshape(-1, 3), triangles]).astype(np.int32)
    corners = points[parts]
    areas = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    normals = np.zeros_like(points)
    np.add.at(normals, parts, areas[:, None])
    lengths = np.linalg.norm(normals, axis=1, keepdims=True)
    return Facets(points=points, triangles=parts, normals=normals / np.where(lengths > 0, lengths, 1.0))


def _shares(points: Floats, corners: Floats) -> Floats:
    """(…, 3) shares of a triangle's corners (…, 3, 3) in its point that is nearest to each of `points` (…, 3).

    The nearest of the foot on its plane, if that is inside, and of the feet on its three sides.
    """
    best, shares = None, None
    for found in (_inside(points, corners), *(_on_side(points, corners, side) for side in range(3))):
        away = ((np.einsum("...i,...ij->...j", found, corners) - points) ** 2).sum(axis=-1)
        away = np.where((found >= 0).all(axis=-1), away, np.inf)
        if best is None or shares is None:
            best, shares = away, found
        else:
            is_nearer = away < best
            best, shares = np.where(is_nearer, away, best), np.where(is_nearer[..., None], found, shares)
    assert shares is not None  # there are four
    return shares


def _inside(points: Floats, corners: Floats) -> Floats:
    """Shares of the foot on the plane of the triangle; negative where it is outside, or there is no plane."""
    u, v, w = (
        corners[..., 1, :] - corners[..., 0, :],
        corners[..., 2, :] - corners[..., 0, :],
        points - corners[..., 0, :],
    )
    normal = np.cross(u, v)
    square = (normal**2).sum(axis=-1)
    with np.errstate(divide="ignore", invalid="ignore"):
        second = (np.cross(w, v) * normal).sum(axis=-1) / square
        third = (np.cross(u, w) * normal).sum(axis=-1) / square
    found = np.stack([1.0 - second - third, second, third], axis=-1)
    return np.where(np.isfinite(found).all(axis=-1, keepdims=True), found, -1.0)


def _on_side(points: Floats, corners: Floats, side: int) -> Floats:
    """Shares of the nearest point on one side of the triangle."""
    start, along = corners[..., side, :], corners[..., (side + 1) % 3, :] - corners[..., side, :]
    square = (along**2).sum(axis=-1)
    share = ((points - start) * along).sum(axis=-1) / np.where(square > 0, square, 1.0)
    share = np.clip(share, 0.0, 1.0)
    shares = np.zeros((*share.shape, 3))
    shares[..., side], shares[..., (side + 1) % 3] = 1.0 - share, share
    return shares
