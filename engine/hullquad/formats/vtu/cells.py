"""Elements from the cells of a VTK unstructured grid, and back."""

from xml.etree.ElementTree import Element

import numpy as np

from hullquad.arrays import Ints, Longs, ints
from hullquad.formats.vtu.data_arrays import integers
from hullquad.formats.vtu.document import Document, arrays

TRIANGLE, POLYGON, PIXEL, QUAD = 5, 7, 8, 9
_NAMES = {
    0: "vtkEmptyCell",
    1: "vtkVertex",
    2: "vtkPolyVertex",
    3: "vtkLine",
    4: "vtkPolyLine",
    5: "vtkTriangle",
    6: "vtkTriangleStrip",
    7: "vtkPolygon",
    8: "vtkPixel",
    9: "vtkQuad",
    10: "vtkTetra",
    11: "vtkVoxel",
    12: "vtkHexahedron",
    13: "vtkWedge",
    14: "vtkPyramid",
    21: "vtkQuadraticEdge",
    22: "vtkQuadraticTriangle",
    23: "vtkQuadraticQuad",
    25: "vtkQuadraticHexahedron",
    28: "vtkBiQuadraticQuad",
    29: "vtkTriQuadraticHexahedron",
    34: "vtkBiQuadraticTriangle",
    35: "vtkCubicLine",
    42: "vtkPolyhedron",
    69: "vtkLagrangeTriangle",
    70: "vtkLagrangeQuadrilateral",
    76: "vtkBezierTriangle",
    77: "vtkBezierQuadrilateral",
}
_FEWEST_NODES = {TRIANGLE: 3, POLYGON: 3, PIXEL: 4, QUAD: 4}
_MOST_NODES = {TRIANGLE: 3, POLYGON: 4, PIXEL: 4, QUAD: 4}


def elements(section: Element, cells: int, nodes: int, file: Document) -> Ints:
    """(E, 4) elements of the section ``<Cells>``; pixels and polygons with 3 or 4 nodes become what they are."""
    found = arrays(section)
    for name in ("types", "offsets", "connectivity"):
        if name not in found:
            raise file.refusal("no_array", name=name)
    types = _types(integers(found["types"], cells, file), file)
    sizes = _sizes(integers(found["offsets"], cells, file), types, file)
    corners = integers(found["connectivity"], int(sizes.sum()), file)
    owners = np.repeat(np.arange(cells), sizes)
    outside = np.flatnonzero((corners < 0) | (corners >= nodes))
    if len(outside):
        worst = outside[0]
        raise file.refusal("no_node", element=owners[worst] + 1, found=corners[worst], nodes=nodes)
    places = np.arange(len(corners)) - np.repeat(np.cumsum(sizes) - sizes, sizes)
    table = np.full((cells, 4), -1)
    table[owners, places] = corners
    pixels = types == PIXEL
    table[pixels] = table[pixels][:, [0, 1, 3, 2]]  # a pixel counts its corners row by row
    return ints(table)


def _types(types: Longs, file: Document) -> Longs:
    strange = np.flatnonzero(~np.isin(types, list(_MOST_NODES)))
    if len(strange):
        kind = int(types[strange[0]])
        raise file.refusal("cell", element=strange[0] + 1, kind=_NAMES.get(kind, f"cell of type {kind}"))
    return types


def _sizes(offsets: Longs, types: Longs, file: Document) -> Longs:
    """(E,) numbers of nodes."""
    before = np.concatenate([[0], offsets[:-1]])
    fewest, most = (np.vectorize(table.get, otypes=[int])(types) for table in (_FEWEST_NODES, _MOST_NODES))
    # compared, not subtracted first: an offset may be anything, and a difference could overflow
    wrong = np.flatnonzero((offsets < before + fewest) | (offsets > before + most) | (before < 0))
    if len(wrong):
        first = wrong[0]
        found = int(offsets[first]) - int(before[first])
        kind = _NAMES[int(types[first])]
        raise file.refusal("corners", element=first + 1, kind=kind, found=found)
    return np.asarray(offsets - before)
