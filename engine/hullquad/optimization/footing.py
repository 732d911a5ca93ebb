"""Where nodes stand on the facets of a surface, compiled: each is brought back from beside the facet it stood on."""

from typing import NamedTuple

import numpy as np

from hullquad.arrays import Floats, Ints, Longs
from hullquad.metrics.compiled import compiled, inlined
from hullquad.metrics.vectors import Vector, cross, difference, dot, moved, square, unit, vector
from hullquad.optimization.facets import Facets


class Footing(NamedTuple):
    """Where the movable nodes stand, and the surface's normals there; its arrays are written to."""

    at: Ints
    """(M,) facet of each node."""
    trial_at: Ints
    """(M,)"""
    normals: Floats
    """(K, 3) at all nodes, the movable ones first."""
    trial_normals: Floats
    """(M, 3)"""


@compiled
def bring_back(surface: Facets, footing: Footing, points: Floats) -> None:
    """Move nodes (M, 3) to the nearest point of the surface, walking there from the facet that each stands on.

    The walk goes to the nearest facet around as long as one is nearer: it never jumps to another part of the surface
    that happens to be near.
    """
    for node in range(len(footing.at)):
        facet, point = footing.at[node], vector(points, node)
        shares, away = _foot(surface, facet, point)
        here = -1
        while facet != here:
            here = facet
            for corner in range(3):
                vertex = surface.triangles[here, corner]
                for k in range(surface.starts[vertex], surface.starts[vertex + 1]):
                    other, distance = _foot(surface, surface.around[k], point)
                    if distance < away:
                        facet, shares, away = surface.around[k], other, distance
        _stand(surface, footing, points, node, facet, shares)


@inlined
def _foot(surface: Facets, facet: int, point: Vector) -> tuple[Vector, float]:
    """Shares of a facet's corners in its point nearest to another one, and the square of the distance."""
    a, b = vector(surface.points, surface.triangles[facet, 0]), vector(surface.points, surface.triangles[facet, 1])
    c = vector(surface.points, surface.triangles[facet, 2])
    u, v, w = difference(b, a), difference(c, a), difference(point, a)
    normal = cross(u, v)
    area = square(normal)
    if area > 0.0:
        second, third = dot(cross(w, v), normal) / area, dot(cross(u, w), normal) / area
        if second >= 0.0 and third >= 0.0 and second + third <= 1.0:
            return (1.0 - second - third, second, third), dot(w, normal) ** 2 / area
    (ab, to_ab), (bc, to_bc), (ca, to_ca) = _on_side(a, b, point), _on_side(b, c, point), _on_side(c, a, point)
    if to_ab <= to_bc and to_ab <= to_ca:
        return (1.0 - ab, ab, 0.0), to_ab
    if to_bc <= to_ca:
        return (0.0, 1.0 - bc, bc), to_bc
    return (ca, 0.0, 1.0 - ca), to_ca


@inlined
def _on_side(start: Vector, end: Vector, point: Vector) -> tuple[float, float]:
    """Share of the end in the point of a side that is nearest to another one, and the square of the distance."""
    along = difference(end, start)
    length = square(along)
    share = dot(difference(point, start), along) / length if length > 0.0 else 0.0
    share = min(max(share, 0.0), 1.0)
    return share, square(difference(point, moved(start, share, along)))


@inlined
def _stand(surface: Facets, footing: Footing, points: Floats, node: int, facet: int, shares: Vector) -> None:
    """Set a node on a facet."""
    footing.trial_at[node] = facet
    for axis in range(3):
        place, normal = 0.0, 0.0
        for corner in range(3):
            place += shares[corner] * surface.points[surface.triangles[facet, corner], axis]
            normal += shares[corner] * surface.normals[surface.triangles[facet, corner], axis]
        points[node, axis], footing.trial_normals[node, axis] = place, normal


@inlined
def turn(footing: Footing, tangents: Floats) -> None:
    """Make the trial the place where the nodes stand: turn what they move along (M, 2, 3) into the surface there."""
    for node in range(len(tangents)):
        footing.at[node] = footing.trial_at[node]
        normal = unit(vector(footing.trial_normals, node))
        first = vector(tangents[node], 0)
        first = unit(moved(first, -dot(first, normal), normal))
        second = cross(normal, first)
        for axis in range(3):
            footing.normals[node, axis] = normal[axis]
            tangents[node, 0, axis], tangents[node, 1, axis] = first[axis], second[axis]


@inlined
def face(elements: Ints, normals: Floats, facing: Floats) -> None:
    """Set what elements (E, 4) must face (E, 3): the mean of the normals at their nodes."""
    for i in range(len(elements)):
        for axis in range(3):
            facing[i, axis] = 0.0
            for corner in range(4):
                if elements[i, corner] >= 0:
                    facing[i, axis] += normals[elements[i, corner], axis]
        direction = unit(vector(facing, i))
        for axis in range(3):
            facing[i, axis] = direction[axis]


def footing(surface: Facets, nodes: Longs, movable: int) -> Footing:
    """Where nodes (K,) of the surface's mesh stand, the first ones movable: each on a facet of its own."""
    if len(surface.triangles) == 0:
        return Footing(np.empty(0, np.int32), np.empty(0, np.int32), np.empty((0, 3)), np.empty((0, 3)))
    at, normals = surface.around[surface.starts[nodes[:movable]]], surface.normals[nodes]
    return Footing(at, at.copy(), normals, normals[:movable].copy())
