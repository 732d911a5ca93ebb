"""A mesh from outside, judged before anybody computes with it; what it does not tell is found out."""

import numpy as np

from hullquad.arrays import Floats, Ints, Longs
from hullquad.errors import MeshError
from hullquad.mesh import Mesh
from hullquad.surface import Plane
from hullquad.topology import Topology, half_edges, rim_states

FLATNESS = 1e-6
"""Nodes are on a plane when none is farther from it than this part of the mesh's diameter."""
FARTHEST = 1e15
"""No coordinate is larger [mm]: the limit of plate documents too; squares and cubes of it do not overflow."""
_EXACT = 1e-9  # a normal this near to a global axis, or plane, is meant to be in it


def bare_mesh(points: Floats, elements: Ints, place: str) -> Mesh:
    """The mesh of (N, 3) points [mm] and (E, 4) elements of which nothing else is known.

    Nodes on edges without two elements are contour, the rest free; labels count from 1; the target size is
    the mean length of the edges; the surface is the plane through all nodes, if there is one.
    """
    node_labels, element_labels = np.arange(1, len(points) + 1), np.arange(1, len(elements) + 1)
    judge(points, elements, node_labels, element_labels, place)
    size = _mean_edge_length(points, elements)
    if size == 0.0:
        raise MeshError("E_MESH", place, "no_size")
    plane = fitted_plane(points, elements)
    known = Topology(
        elements=elements,
        node_labels=node_labels,
        element_labels=element_labels,
        node_states=rim_states(elements, len(points)),
        node_lines=np.full(len(points), -1),
    )
    parameters = None if plane is None else plane.parameters(points)
    return Mesh(points=points, topology=known, target_size=size, surface=plane, parameters=parameters)


def judge(points: Floats, elements: Ints, node_labels: Longs, element_labels: Longs, place: str) -> None:
    """Refuse a mesh without elements, with nodes nowhere, or with elements that use a node twice.

    Raises
    ------
    MeshError
        It names the first node or element by its label.
    """
    if not len(elements):
        raise MeshError("E_EMPTY_MESH", place)
    lost = np.flatnonzero(~(np.abs(points) <= FARTHEST).all(axis=1))
    if len(lost):
        raise MeshError("E_MESH", place, "coordinate", node=int(node_labels[lost[0]]), count=len(lost))
    corners = np.sort(elements, axis=1)
    double = np.flatnonzero(((corners[:, 1:] == corners[:, :-1]) & (corners[:, 1:] >= 0)).any(axis=1))
    if len(double):
        raise MeshError("E_MESH", place, "double_node", element=int(element_labels[double[0]]), count=len(double))


def fitted_plane(points: Floats, elements: Ints) -> Plane | None:
    """The plane of the nodes, most elements counter-clockwise on it; None when the mesh is not flat.

    The origin is the foot of the global origin; `u` is the global x projected (y for a plane across x): a mesh
    drawn in x and y has these as parameters.
    """
    centre = points.mean(axis=0)
    normal = _tidied(np.linalg.svd(points - centre, full_matrices=False)[2][2])
    if np.abs((points - centre) @ normal).max() > FLATNESS * diameter(points):
        return None
    a, b, c, d = (points[elements[:, i]] for i in range(4))
    d = np.where(elements[:, 3:] < 0, a, d)
    turns = np.sign(np.cross(c - a, d - b) @ normal).sum()
    upright = normal * (-1.0 if turns < 0 or (turns == 0 and normal[np.abs(normal).argmax()] < 0) else 1.0)
    axis = np.eye(3)[0 if abs(upright[0]) < 0.9 else 1]
    u = axis - (axis @ upright) * upright
    u /= np.linalg.norm(u)
    return Plane(origin=upright * (centre @ upright) + 0.0, u=u, v=np.cross(upright, u) + 0.0)  # + 0.0: no minus zero


def diameter(points: Floats) -> float:
    """Diagonal of the box around the points [mm]."""
    return float(np.linalg.norm(np.ptp(points, axis=0)))


def _tidied(normal: Floats) -> Floats:
    kept = np.where(np.abs(normal) < _EXACT, 0.0, normal)
    return np.asarray(kept / np.linalg.norm(kept))


def _mean_edge_length(points: Floats, elements: Ints) -> float:
    """Mean length of the edges, each counted once [mm]."""
    sides, _ = half_edges(elements)
    # a number per edge sorts ten times faster than a row, and than numpy's hashing finds the different ones
    keys = np.sort(sides.min(axis=1) * np.int64(len(points)) + sides.max(axis=1))
    edges = keys[np.diff(keys, prepend=-1) > 0]
    starts, ends = np.divmod(edges, len(points))
    return float(np.linalg.norm(points[starts] - points[ends], axis=1).mean())
