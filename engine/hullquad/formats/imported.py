"""A mesh from outside, judged before anybody computes with it; what it does not tell is found out."""

import numpy as np

from hullquad.arrays import Floats, Ints, Longs
from hullquad.errors import MeshError
from hullquad.mesh import Mesh
from hullquad.topology import edges, refuse_unknown_nodes, rim_states, topology

FARTHEST = 1e15
"""No coordinate is larger [mm]: the limit of plate documents too; squares and cubes of it do not overflow."""


def bare_mesh(points: Floats, elements: Ints, place: str) -> Mesh:
    """The mesh of (N, 3) points [mm] and (E, 4) elements of which nothing else is known.

    Nodes on edges without two elements are contour, the rest free; labels count from 1; the target size is
    the mean length of the edges. On which surface the nodes lie is not known, even where they are flat.
    """
    node_labels, element_labels = np.arange(1, len(points) + 1), np.arange(1, len(elements) + 1)
    judge(points, elements, node_labels, element_labels, place)
    size = _mean_edge_length(points, elements)
    if size == 0.0:
        raise MeshError("E_MESH", place, "no_size")
    known = topology(elements, rim_states(elements, len(points)))
    return Mesh(points=points, topology=known, target_size=size)


def judge(points: Floats, elements: Ints, node_labels: Longs, element_labels: Longs, place: str) -> None:
    """Refuse a mesh without elements, with nodes nowhere, or with elements of a node that is none or there twice.

    Raises
    ------
    MeshError
        It names the first node or element by its label.
    """
    if not len(elements):
        raise MeshError("E_EMPTY_MESH", place)
    refuse_unknown_nodes(elements, len(points), element_labels, place)
    lost = np.flatnonzero(~(np.abs(points) <= FARTHEST).all(axis=1))
    if len(lost):
        raise MeshError("E_MESH", place, "coordinate", node=int(node_labels[lost[0]]), count=len(lost))
    corners = np.sort(elements, axis=1)
    double = np.flatnonzero(((corners[:, 1:] == corners[:, :-1]) & (corners[:, 1:] >= 0)).any(axis=1))
    if len(double):
        raise MeshError("E_MESH", place, "double_node", element=int(element_labels[double[0]]), count=len(double))


def _mean_edge_length(points: Floats, elements: Ints) -> float:
    """Mean length of the edges, each counted once [mm]."""
    starts, ends = edges(elements)[0].T
    return float(np.linalg.norm(points[starts] - points[ends], axis=1).mean())
