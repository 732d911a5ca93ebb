"""Part of a mesh: some elements, and those around them."""

from collections.abc import Iterable

import numpy as np

from hullquad.arrays import Bools
from hullquad.mesh import Mesh


def rings(mesh: Mesh, rows: Iterable[int], count: int) -> Bools:
    """(N,) nodes of some elements and of `count` rings of elements around them."""
    elements = mesh.topology.elements
    found = np.zeros(len(mesh.points), dtype=bool)
    nodes = elements[list(rows)]
    found[nodes[nodes >= 0]] = True
    for _ in range(count):
        nodes = elements[(found[elements] & (elements >= 0)).any(axis=1)]
        found[nodes[nodes >= 0]] = True
    return found
