"""A mesh as a minimiser sees it: free nodes first, each with the directions it may move in."""

import attrs
import numpy as np

from hullquad.arrays import Bools, Floats, Ints, Longs, floats, ints, longs
from hullquad.errors import MeshError
from hullquad.mesh import Mesh
from hullquad.optimization.order import along_a_curve
from hullquad.topology import NodeState

_UP = (0.0, 0.0, 1.0)


@attrs.frozen(eq=False, kw_only=True)
class Problem:
    """Nodes in the plane's own coordinates, the movable ones first, and the elements that contain one of these.

    What is far from every movable node is left out: it can neither move nor change.
    """

    mesh: Mesh
    nodes: Longs = attrs.field(converter=longs)
    """(K,) their rows in the mesh."""
    movable: int
    """Number of nodes that may move: the first ones."""
    points: Floats = attrs.field(converter=floats)
    """(K, 3) [mm]"""
    tangents: Floats = attrs.field(converter=floats)
    """(movable, 2, 3) unit vectors along which a node moves with its two unknowns; zero where it must not."""
    quads: Ints = attrs.field(converter=ints)
    """(Q, 4)"""
    triangles: Ints = attrs.field(converter=ints)
    """(T, 3)"""
    normals: Floats = attrs.field(converter=floats)
    """(1, 3) or (Q + T, 3) directions that quads, then triangles must face."""

    @property
    def size(self) -> float:
        """Length of an element [mm]."""
        return self.mesh.target_size

    def mesh_at(self, points: Floats) -> Mesh:
        """The mesh with the movable nodes at `points`; every other node keeps its bits."""
        moved = self.nodes[: self.movable]
        parameters = np.array(self.mesh.parameters)
        parameters[moved] = points[: self.movable, :2]
        return self.mesh.with_parameters(parameters)


def problem(mesh: Mesh, chosen: Bools | None = None) -> Problem:
    """The problem of a mesh on a plane; of `chosen` nodes (N,) alone, if they are given.

    Raises
    ------
    MeshError
        E_CURVED: the mesh lies on no known surface.
    """
    if mesh.surface is None or mesh.parameters is None:
        raise MeshError("E_CURVED", mesh.plate_id or "mesh", "optimize")
    states = mesh.topology.node_states
    may_move = (states == NodeState.FREE) if chosen is None else (states == NodeState.FREE) & chosen
    elements = _touched(mesh.topology.elements, may_move)
    may_move = may_move & _are_used(elements, len(may_move))
    points = np.concatenate([mesh.parameters, np.zeros((len(mesh.points), 1))], axis=1)
    nodes = _ordered(points, may_move, elements)
    rows = np.full(len(mesh.points), -1, dtype=np.int32)
    rows[nodes] = np.arange(len(nodes))
    renumbered = np.where(elements < 0, -1, rows[elements])
    is_triangle = elements[:, 3] < 0
    movable = int(may_move.sum())
    return Problem(
        mesh=mesh,
        nodes=nodes,
        movable=movable,
        points=points[nodes],
        tangents=np.broadcast_to(np.eye(3)[:2], (movable, 2, 3)),
        quads=_sorted(renumbered[~is_triangle]),
        triangles=_sorted(renumbered[is_triangle, :3]),
        normals=[_UP],
    )


def _touched(elements: Ints, may_move: Bools) -> Ints:
    """Elements with a movable node."""
    return elements[(may_move[elements] & (elements >= 0)).any(axis=1)]


def _ordered(points: Floats, may_move: Bools, elements: Ints) -> Longs:
    """Nodes of the elements: the movable ones along a curve that keeps neighbours together, then the others."""
    movable, held = np.flatnonzero(may_move), np.flatnonzero(_are_used(elements, len(points)) & ~may_move)
    return np.concatenate([movable[along_a_curve(points[movable])], held[along_a_curve(points[held])]])


def _are_used(elements: Ints, nodes: int) -> Bools:
    """(N,) which nodes an element has."""
    is_used = np.zeros(nodes, dtype=bool)
    is_used[elements[elements >= 0]] = True
    return is_used


def _sorted(elements: Ints) -> Ints:
    """Elements in the order of their first node: what is near in space is near in memory."""
    return elements[np.argsort(elements.min(axis=1, initial=2**31 - 1), kind="stable")]
