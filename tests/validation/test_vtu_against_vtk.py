"""VTK reads what we write, and we read what VTK writes, in all its ways."""

from itertools import product
from pathlib import Path

import numpy as np
import pytest
from vtkmodules.util.numpy_support import numpy_to_vtk, vtk_to_numpy
from vtkmodules.vtkCommonCore import vtkCommand, vtkPoints
from vtkmodules.vtkCommonDataModel import vtkUnstructuredGrid
from vtkmodules.vtkIOXML import vtkXMLUnstructuredGridReader, vtkXMLUnstructuredGridWriter

from hullquad.errors import FileError
from hullquad.formats import vtu
from hullquad.mesh import Mesh
from hullquad.surface import Plane
from hullquad.topology import rim_states, topology

ASCII, BINARY, APPENDED = range(3)
VTK_QUAD, VTK_TRIANGLE, VTK_TETRA = 9, 5, 10


@pytest.fixture(scope="module")
def mesh() -> Mesh:
    """Quads and triangles in alternation, more of them than fit into one block of VTK's compression."""
    columns = 60
    corner = np.arange(columns * columns).reshape(columns, columns)
    quads = np.stack([corner[:-1, :-1], corner[:-1, 1:], corner[1:, 1:], corner[1:, :-1]], axis=-1).reshape(-1, 4)
    a, b, c, d = quads[1::2].T
    halves = np.stack([[a, b, c, 0 * a - 1], [a, c, d, 0 * a - 1]]).transpose(2, 0, 1).reshape(-1, 4)
    elements = np.concatenate([quads[::2], halves]).astype(np.int32)
    elements = elements[np.random.default_rng(1).permutation(len(elements))]
    parameters = np.random.default_rng(2).normal(scale=1e3, size=(columns * columns, 2))
    plane = Plane([3.0, 0.0, -7.0], [0.6, 0.0, 0.8], [0.0, 1.0, 0.0])
    return Mesh(
        points=plane.points(parameters),
        parameters=parameters,
        surface=plane,
        topology=topology(elements, rim_states(elements, len(parameters))),
        target_size=25.0,
        plate_id="Płyta 7 <dno>",
        thickness=12.5,
        lines=np.arange(12.0).reshape(2, 2, 3),
    )


def parsed(path: Path) -> Mesh:
    """The mesh in a file, read in this process, which is quicker than in the worker."""
    return vtu.parse(path.read_bytes(), str(path))


def vtk_grid(mesh: Mesh, points: np.ndarray) -> vtkUnstructuredGrid:
    grid = vtkUnstructuredGrid()
    nodes = vtkPoints()
    nodes.SetData(numpy_to_vtk(points, deep=True))
    grid.SetPoints(nodes)
    for corners in mesh.topology.elements.tolist():
        count = 3 if corners[3] < 0 else 4
        grid.InsertNextCell(VTK_TRIANGLE if count == 3 else VTK_QUAD, count, corners[:count])
    return grid


def write_by_vtk(grid: vtkUnstructuredGrid, path: Path, **ways: object) -> None:
    writer = vtkXMLUnstructuredGridWriter()
    writer.SetInputData(grid)
    writer.SetFileName(str(path))
    for name, value in ways.items():
        getattr(writer, f"Set{name}")(value)
    assert writer.Write() == 1


def read_by_vtk(path: Path) -> vtkUnstructuredGrid:
    """What VTK reads; a warning is an error."""
    complaints: list[str] = []
    reader = vtkXMLUnstructuredGridReader()

    def complain(_: object, event: str) -> None:
        complaints.append(event)

    for event in (vtkCommand.WarningEvent, vtkCommand.ErrorEvent):
        reader.AddObserver(event, complain)
    reader.SetFileName(str(path))
    reader.Update()
    assert not complaints
    return reader.GetOutput()


def test_vtk_reads_every_number_that_we_write(mesh, tmp_path):
    stretch = np.linspace(0.0, 1.0, len(mesh.topology.elements))
    vtu.write(mesh, tmp_path / "mesh.vtu", {"stretch": stretch})
    grid = read_by_vtk(tmp_path / "mesh.vtu")
    known = mesh.topology
    cells, nodes, whole = grid.GetCellData(), grid.GetPointData(), grid.GetFieldData()
    corners = known.elements
    read = {
        "points": (vtk_to_numpy(grid.GetPoints().GetData()), mesh.points),
        "corners": (vtk_to_numpy(grid.GetCells().GetConnectivityArray()), corners[corners >= 0]),
        "node label": (vtk_to_numpy(nodes.GetArray("node label")), known.node_labels),
        "node state": (vtk_to_numpy(nodes.GetArray("node state")), known.node_states),
        "node line": (vtk_to_numpy(nodes.GetArray("node line")), known.node_lines),
        "parameters": (vtk_to_numpy(nodes.GetArray("parameters")), mesh.parameters),
        "element label": (vtk_to_numpy(cells.GetArray("element label")), known.element_labels),
        "stretch": (vtk_to_numpy(cells.GetArray("stretch")), stretch),
        "lines": (vtk_to_numpy(whole.GetArray("lines")), mesh.lines.reshape(-1, 6)),
        "thickness": (vtk_to_numpy(whole.GetArray("thickness")), [mesh.thickness]),
    }
    for name, (found, expected) in read.items():
        np.testing.assert_array_equal(found, expected, err_msg=name)
    kinds = [grid.GetCellType(i) for i in range(grid.GetNumberOfCells())]
    assert kinds == np.where(known.is_triangle, VTK_TRIANGLE, VTK_QUAD).tolist()
    assert whole.GetAbstractArray("plate id").GetValue(0) == mesh.plate_id


WAYS = [
    {"DataMode": mode, "HeaderType": header, "ByteOrder": order, "CompressorType": compressor}
    for mode, header, order, compressor in product([ASCII, BINARY, APPENDED], [32, 64], [0, 1], [0, 1])
] + [
    {"DataMode": APPENDED, "EncodeAppendedData": encoded, "CompressorType": compressor, "BlockSize": 800}
    for encoded, compressor in product([False, True], [0, 1])
]


@pytest.mark.parametrize("ways", WAYS, ids=lambda ways: "-".join(str(int(value)) for value in ways.values()))
@pytest.mark.parametrize("kind", [np.float64, np.float32])
def test_we_read_what_vtk_writes_in_every_way(mesh, ways, kind, tmp_path):
    points = mesh.points.astype(kind)
    write_by_vtk(vtk_grid(mesh, points), tmp_path / "mesh.vtu", **ways)
    read = parsed(tmp_path / "mesh.vtu")
    np.testing.assert_array_equal(read.points, points.astype(np.float64))
    np.testing.assert_array_equal(read.topology.elements, mesh.topology.elements)


@pytest.mark.parametrize("mode", [ASCII, BINARY, APPENDED])
def test_our_mesh_survives_being_saved_again_by_vtk(mesh, mode, tmp_path):
    vtu.write(mesh, tmp_path / "mesh.vtu")
    write_by_vtk(read_by_vtk(tmp_path / "mesh.vtu"), tmp_path / "again.vtu", DataMode=mode)
    vtu.write(parsed(tmp_path / "again.vtu"), tmp_path / "ours.vtu")
    assert (tmp_path / "ours.vtu").read_bytes() == (tmp_path / "mesh.vtu").read_bytes()


def test_a_solid_element_is_refused_by_vtk_s_name(mesh, tmp_path):
    grid = vtk_grid(mesh, mesh.points)
    grid.InsertNextCell(VTK_TETRA, 4, [0, 1, 2, 3])
    write_by_vtk(grid, tmp_path / "mesh.vtu")
    with pytest.raises(FileError, match=r"element \d+ is a vtkTetra"):
        parsed(tmp_path / "mesh.vtu")
