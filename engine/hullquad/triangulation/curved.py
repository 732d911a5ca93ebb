"""What a curved plate, which cannot be meshed yet, has in common with the plane ones of its document."""

import numpy as np

from hullquad.errors import MeshingError
from hullquad.plate import JOIN, Document, Plate
from hullquad.triangulation.neighbours import neighbours

_ALONG = 3
"""Points of an outline that lie on an edge, if it runs along it: one or two are at a corner."""


def curved_refusal(document: Document, plate: Plate) -> MeshingError:
    """Why a curved plate is not meshed, and whose nodes its edges have."""
    shared = plane_neighbours(document, plate)
    if not shared:
        return MeshingError("E_CURVED", plate.place)
    return MeshingError("E_CURVED", plate.place, "shared", neighbours=", ".join(shared))


def plane_neighbours(document: Document, plate: Plate) -> tuple[str, ...]:
    """Ids of the plane plates along whose edges a curved one runs, in the order of the document."""
    plane = tuple(other for other in document.plates if other.is_plane)
    if not plane:
        return ()
    frame, found = neighbours(plane).frame, set()
    for rim in plate.rims:
        wires, counts = np.unique(frame.near(rim, JOIN)[1], return_counts=True)
        found |= {frame.wires[wire].plate for wire in wires[counts >= _ALONG].tolist()}
    return tuple(plane[number].id for number in sorted(found))
