"""VTK's XML unstructured grid, the format of ParaView: points in mm, float64, with all that a mesh knows.

What stands in which array is told in `mesh_arrays`. A file of another program, without these arrays, is judged by
`imported`. Quads and triangles are read in whatever way VTK writes them: as text, base64 or raw, in place or appended,
compressed with zlib or not, with either size of header and either byte order.
"""

from collections.abc import Mapping
from pathlib import Path
from xml.etree.ElementTree import Element

import attrs
import numpy as np

import hullquad
from hullquad import worker
from hullquad.arrays import Floats, floats, longs
from hullquad.formats import atomic, imported, source
from hullquad.formats.vtu import cells, mesh_arrays, writer
from hullquad.formats.vtu.data_arrays import reals
from hullquad.formats.vtu.document import Document, arrays, child, count, document
from hullquad.formats.vtu.writer import Chunks, element, numbers, text
from hullquad.mesh import Mesh

_KIND = "UnstructuredGrid"
_SECONDS = 120.0
_OWN_CELL_ARRAYS = {"element label"}


def read(path: Path) -> Mesh:
    """The mesh in the file.

    Raises
    ------
    FileError, MeshError
        The file cannot be read, is damaged, or holds no mesh of quads and triangles.
    WorkerError
        It takes too long or too much memory.
    """
    place = str(path)
    mesh = worker.call(parse, source.content(path), place, seconds=_SECONDS, place=place)
    # what comes from another process has forgotten that its arrays are read-only: made anew, it knows
    surface = None if mesh.surface is None else attrs.evolve(mesh.surface)
    return attrs.evolve(mesh, surface=surface, topology=attrs.evolve(mesh.topology))


def parse(content: bytes, place: str) -> Mesh:
    """The mesh in the bytes of a file, read in this process; errors name `place`."""
    file = document(content, _KIND, place)
    grid = child(file.root, _KIND, file)
    piece = child(grid, "Piece", file)
    nodes, rows = count(piece, "NumberOfPoints", file), count(piece, "NumberOfCells", file)
    points = _points(piece, nodes, file)
    elements = cells.elements(child(piece, "Cells", file), rows, nodes, file)
    found = mesh_arrays.sections(grid, piece)
    if mesh_arrays.are_ours(found):
        return mesh_arrays.mesh(points, elements, found, file)
    return imported.bare_mesh(points, elements, file.place)


def write(mesh: Mesh, path: Path, cell_values: Mapping[str, Floats] | None = None) -> None:
    """Put the mesh into a file; `cell_values` are (E,) values of the elements, for the colours of ParaView.

    The same mesh gives the same bytes.

    Raises
    ------
    FileError
        The file cannot be written; an existing one is as it was.
    """
    if (mesh.surface is None) != (mesh.parameters is None):
        raise ValueError("a surface and the nodes' parameters on it come together")
    values = cell_values or {}
    if _OWN_CELL_ARRAYS & values.keys():
        raise ValueError(f"{_OWN_CELL_ARRAYS} are the mesh's own")
    if any(np.shape(column) != (len(mesh.topology.elements),) for column in values.values()):
        raise ValueError("there must be one value per element")
    piece = element(
        "Piece",
        _node_data(mesh),
        element("CellData", numbers("element label", mesh.topology.element_labels), *_columns(values)),
        element("Points", numbers("Points", mesh.points)),
        _cells(mesh),
        NumberOfPoints=len(mesh.points),
        NumberOfCells=len(mesh.topology.elements),
    )
    atomic.write(path, writer.file(_KIND, element(_KIND, _field_data(mesh), piece)))


def _points(piece: Element, nodes: int, file: Document) -> Floats:
    found = list(arrays(child(piece, "Points", file)).values())
    if not found:
        raise file.refusal("no_array", name="Points")
    return reals(found[0], nodes, 3, file)


def _node_data(mesh: Mesh) -> Chunks:
    known = mesh.topology
    parameters = [] if mesh.parameters is None else [numbers("parameters", mesh.parameters)]
    return element(
        "PointData",
        numbers("node label", known.node_labels),
        numbers("node state", known.node_states),
        numbers("node line", known.node_lines),
        *parameters,
    )


def _columns(values: Mapping[str, Floats]) -> list[Chunks]:
    return [numbers(name, floats(column)) for name, column in values.items()]


def _cells(mesh: Mesh) -> Chunks:
    corners = mesh.topology.elements
    is_triangle = mesh.topology.is_triangle
    return element(
        "Cells",
        numbers("connectivity", corners[corners >= 0].astype(np.int64)),
        numbers("offsets", np.cumsum(np.where(is_triangle, 3, 4), dtype=np.int64)),
        numbers("types", np.where(is_triangle, cells.TRIANGLE, cells.QUAD).astype(np.uint8)),
    )


def _field_data(mesh: Mesh) -> Chunks:
    plane = mesh.surface
    parts = [
        text(mesh_arrays.VERSION, hullquad.__version__),
        text("plate id", mesh.plate_id),
        text("input hash", mesh.input_hash),
        numbers("target size", floats([mesh.target_size]), is_field=True),
    ]
    if mesh.thickness is not None:
        parts.append(numbers("thickness", floats([mesh.thickness]), is_field=True))
    if mesh.reference_areas is not None:
        parts.append(numbers("reference areas", mesh.reference_areas, is_field=True))
    if mesh.unavoidable is not None:
        parts.append(numbers("unavoidable triangles", longs([mesh.unavoidable]), is_field=True))
    if plane is not None:
        parts.append(numbers("plane", np.stack([plane.origin, plane.u, plane.v]), is_field=True))
    if len(mesh.lines):
        parts.append(numbers("lines", mesh.lines.reshape(-1, 6), is_field=True))
    return element("FieldData", *parts)
