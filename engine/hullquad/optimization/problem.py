"""A mesh as a minimiser sees it: free nodes first, each with the directions it may move in."""

import attrs
import numpy as np

from hullquad.arrays import Bools, Floats, Ints, Longs, bools, floats, ints, longs
from hullquad.mesh import Mesh
from hullquad.optimization.facets import NO_FACETS, Facets, facets
from hullquad.optimization.order import FEW, along_a_curve
from hullquad.optimization.sliding import ends_of, line_directions, on_lines
from hullquad.topology import half_edges, paired_sides

_UP = (0.0, 0.0, 1.0)
_CREASE = np.cos(np.radians(30.0))
"""Cosine of the angle between two elements from which on the edge between them is one of the shape."""


@attrs.frozen(eq=False, kw_only=True)
class Problem:
    """Nodes, the movable ones first, and the elements that contain one of these.

    A mesh on a plane is seen in the plane's own coordinates; nodes on followed lines move along these. Without a
    surface it is seen in space: its nodes move in the tangent planes of its own facets and are brought back onto
    them, and those on lines stay. What is far from every movable node is left out: it can neither move nor change.
    """

    mesh: Mesh
    nodes: Longs = attrs.field(converter=longs)
    """(K,) their rows in the mesh."""
    movable: int
    """Number of nodes that may move: the first ones."""
    points: Floats = attrs.field(converter=floats)
    """(K, 3) [mm]"""
    elements: Ints = attrs.field(converter=ints)
    """(E, 4) quads first; a triangle ends with -1."""
    quads: int
    """How many of them are quads."""
    rows: Longs = attrs.field(converter=longs)
    """(E,) their rows in the mesh."""
    turned: Bools = attrs.field(converter=bools)
    """(E,) elements of the mesh that run against their neighbours and are seen here the other way round."""
    surface: Facets
    """What nodes are brought back onto; of a plane there are none."""

    @property
    def size(self) -> float:
        """Length of an element [mm]."""
        return self.mesh.target_size

    def mesh_at(self, points: Floats) -> Mesh:
        """The mesh with the movable nodes at `points`; every other node keeps its bits."""
        moved = self.nodes[: self.movable]
        if self.mesh.parameters is None or self.mesh.surface is None:
            places = np.array(self.mesh.points)
            places[moved] = points[: self.movable]
            return attrs.evolve(self.mesh, points=places, reference_areas=self.mesh.areas)
        parameters = np.array(self.mesh.parameters)
        parameters[moved] = points[: self.movable, :2]
        return self.mesh.with_parameters(on_lines(self.mesh, parameters))

    @property
    def _slides(self) -> Longs:
        """(S,) which of the movable nodes slide along lines."""
        return np.flatnonzero(self.mesh.topology.slides[self.nodes[: self.movable]])

    def slides(self) -> tuple[Ints, Floats]:
        """(S,) movable nodes that slide along lines, and (S, 2, 3) ends between which they stay."""
        slides, ends = self._slides, np.zeros((0, 2, 3))
        if len(slides):
            ends = np.concatenate([ends_of(self.mesh, self.nodes[slides]), np.zeros((len(slides), 2, 1))], axis=2)
        return ints(slides), floats(ends)

    def directions(self) -> tuple[Floats, Floats]:
        """Unit vectors (movable, 2, 3) that nodes may move along at first, and (1 or E, 3) element normals.

        Where there is only one way to go the second vector is zero. Both arrays may be written to.
        """
        if len(self.surface.triangles) == 0:
            ways = np.zeros((self.movable, 2, 3))
            ways[:, 0, 0] = ways[:, 1, 1] = 1.0
            slides = self._slides
            if len(slides):
                lines = self.mesh.topology.node_lines[self.nodes[slides]]
                ways[slides, 0, :2], ways[slides, 1] = line_directions(self.mesh)[lines], 0.0
            return ways, np.array([_UP])
        normals = self.surface.normals[self.nodes]
        padded = np.concatenate([normals, np.zeros((1, 3))])
        return _tangents(normals[: self.movable]), _units(padded[self.elements].sum(axis=1))


def problem(mesh: Mesh, chosen: Bools | None = None) -> Problem:
    """The problem of a mesh; of `chosen` nodes (N,) alone, if they are given."""
    may_move, flat = mesh.topology.is_free, mesh.parameters if mesh.surface is not None else None
    if chosen is not None:
        may_move = may_move & chosen
    if flat is None:
        may_move = may_move & ~_on_creases(mesh) & ~mesh.topology.slides
    turned, elements = _facing_alike(mesh)
    touched = np.flatnonzero(np.append(may_move, False)[elements].any(axis=1))
    elements, all_elements = elements[touched], elements
    is_used = np.zeros(len(may_move) + 1, dtype=bool)
    is_used[elements] = True
    is_used = is_used[:-1]  # the last one is that which triangles do not have
    may_move = may_move & is_used
    points = mesh.points if flat is None else np.concatenate([flat, np.zeros((len(flat), 1))], axis=1)
    nodes = np.concatenate([_ordered(points, may_move), _ordered(points, is_used & ~may_move)])
    rows = np.full(len(points) + 1, -1, dtype=np.int32)
    rows[nodes] = np.arange(len(nodes))
    renumbered = rows[elements]
    quads, triangles = _sorted(renumbered[:, 3] >= 0, renumbered), _sorted(renumbered[:, 3] < 0, renumbered)
    order = np.concatenate([quads, triangles])
    return Problem(
        mesh=mesh,
        nodes=nodes,
        movable=int(may_move.sum()),
        points=points[nodes],
        elements=renumbered[order],
        quads=len(quads),
        rows=touched[order],
        turned=turned,
        surface=facets(mesh.points, all_elements) if flat is None else NO_FACETS,
    )


def _facing_alike(mesh: Mesh) -> tuple[Bools, Ints]:
    """(E,) elements that run against their neighbours, and (E, 4) all of them, those the other way round."""
    elements = mesh.topology.elements
    turned = mesh.topology.is_reversed if mesh.is_bare else np.zeros(len(elements), dtype=bool)
    return turned, np.where(turned[:, None], _other_way_round(elements), elements) if turned.any() else elements


def _on_creases(mesh: Mesh) -> Bools:
    """(N,) nodes of edges at which the elements meet at an angle: moving them would cut a corner off the shape."""
    elements = mesh.topology.elements
    a, b, c, d = (mesh.points[elements[:, corner]] for corner in range(4))
    areas = _units(np.cross(c - a, np.where(elements[:, 3:] < 0, a, d) - b))
    sides, owners = half_edges(elements)
    one, other = paired_sides(sides)
    sense = np.where(sides[one, 0] == sides[other, 0], -1.0, 1.0)
    is_sharp = sense * (areas[owners[one]] * areas[owners[other]]).sum(axis=1) < _CREASE
    found = np.zeros(len(mesh.points), dtype=bool)
    found[sides[one[is_sharp]]] = True
    return found


def _other_way_round(elements: Ints) -> Ints:
    """(E, 4) the same elements, their nodes in the opposite order."""
    quads = elements[:, [0, 3, 2, 1]]
    return np.where(elements[:, 3:] < 0, elements[:, [0, 2, 1, 3]], quads)


def _ordered(points: Floats, chosen: Bools) -> Longs:
    """Rows of the chosen nodes along a curve that keeps neighbours together."""
    rows = np.flatnonzero(chosen)
    return rows[along_a_curve(points[rows])]


def _sorted(chosen: Bools, elements: Ints) -> Longs:
    """Rows of the chosen elements in the order of their first node: what is near in space is near in memory."""
    rows = np.flatnonzero(chosen)
    if len(rows) <= FEW:
        return rows
    nodes = elements[rows]
    first = nodes[:, :3].min(axis=1, initial=len(chosen) * 4)
    return longs(rows[np.argsort(np.where(nodes[:, 3] >= 0, np.minimum(first, nodes[:, 3]), first), kind="stable")])


def _tangents(normals: Floats) -> Floats:
    """(M, 2, 3) two unit vectors across each normal and each other; zero where there is no normal."""
    across = np.eye(3)[np.abs(normals).argmin(axis=1)]
    first = _units(np.cross(normals, across))
    return np.stack([first, np.cross(normals, first)], axis=1)


def _units(vectors: Floats) -> Floats:
    """The vectors over their lengths; the zero vector stays zero."""
    lengths = np.linalg.norm(vectors, axis=-1, keepdims=True)
    return np.asarray(vectors / np.where(lengths > 0, lengths, 1.0))
