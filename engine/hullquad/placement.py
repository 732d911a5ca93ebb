"""The plane that a flat mesh of unknown origin lies on."""

import attrs
import numpy as np

from hullquad.arrays import Floats, Ints
from hullquad.errors import MeshError
from hullquad.mesh import Mesh
from hullquad.surface import Plane

FLATNESS = 1e-6
"""Nodes are on a plane when none is farther from it than this part of the mesh's diameter."""
_EXACT = 1e-9  # a normal this near to a global axis, or plane, is meant to be in it


def placed(mesh: Mesh) -> Mesh:
    """The mesh on its surface: the one it has, or the plane through the nodes of its elements.

    Raises
    ------
    MeshError
        E_CURVED: it has none, and is not flat.
    """
    if mesh.surface is not None:
        return mesh
    plane = fitted_plane(mesh.points, mesh.topology.elements)
    if plane is None:
        raise MeshError("E_CURVED", mesh.plate_id or "mesh", "optimize")
    return attrs.evolve(mesh, surface=plane, parameters=plane.parameters(mesh.points))


def unplaced(mesh: Mesh) -> Mesh:
    """The mesh without a surface: what it was before a plane was fitted to it."""
    return attrs.evolve(mesh, surface=None, parameters=None)


def fitted_plane(points: Floats, elements: Ints) -> Plane | None:
    """The plane of the elements' nodes, most elements counter-clockwise on it; None when the mesh is not flat.

    The origin is the foot of the global origin; `u` is the global x projected (y for a plane across x): a mesh
    drawn in x and y has these as parameters.
    """
    used = points[np.unique(elements[elements >= 0])]
    centre = used.mean(axis=0)
    normal = _tidied(np.linalg.svd(used - centre, full_matrices=False)[2][2])
    if np.abs((used - centre) @ normal).max() > FLATNESS * diameter(used):
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
