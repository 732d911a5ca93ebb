"""The surface of a mesh that lies on no known one: its own facets, as they were when it was read."""

from typing import NamedTuple

import numpy as np

from hullquad.arrays import Floats, Ints, floats, ints


class Facets(NamedTuple):
    """Triangles in space with a normal at each node; a quad is two, cut along its shorter diagonal."""

    points: Floats
    """(N, 3) [mm]"""
    triangles: Ints
    """(F, 3) nodes; none where the surface is a plane, which nobody can leave."""
    normals: Floats
    """(N, 3) unit normals at the nodes; zero where no facet has an area."""
    starts: Ints
    """(N + 1,) where the facets around each node begin in `around`."""
    around: Ints
    """(3 F,) facets, node by node."""


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
    counts = np.bincount(parts.ravel(), minlength=len(points))
    return Facets(
        floats(points),
        ints(parts),
        floats(normals / np.where(lengths > 0, lengths, 1.0)),
        ints(np.concatenate([[0], np.cumsum(counts)])),
        ints(np.argsort(parts.ravel(), kind="stable") // 3),
    )


_NOTHING = np.empty((0, 3))
NO_FACETS = Facets(floats(_NOTHING), ints(_NOTHING), floats(_NOTHING), ints([0]), ints([]))
"""Those of a plane."""
