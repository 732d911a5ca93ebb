"""A mesh goes into a VTU file and comes back; whatever else is in a file, one sentence tells."""

import gzip
import re
import zlib
from base64 import b64encode
from pathlib import Path

import attrs
import numpy as np
import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as some

from hullquad.errors import HullquadError
from hullquad.formats import vtu
from hullquad.mesh import Mesh
from hullquad.placement import fitted_plane, placed, unplaced
from hullquad.surface import Plane
from hullquad.topology import NodeState, Topology

in_one_folder = settings(max_examples=40, deadline=None, suppress_health_check=[HealthCheck.function_scoped_fixture])


def parsed(path: Path) -> Mesh:
    """The mesh in a file, read in this process, which is quicker than in the worker."""
    return vtu.parse(path.read_bytes(), str(path))


def lengths(most: float = 1e6):
    return some.floats(min_value=-most, max_value=most)


@some.composite
def planes(draw) -> Plane:
    axes, _ = np.linalg.qr(np.random.default_rng(draw(some.integers(0, 99))).normal(size=(3, 3)))
    origin = draw(some.lists(lengths(), min_size=3, max_size=3))
    return draw(some.sampled_from([Plane(origin, axes[0], axes[1]), Plane(origin, [0.0, 1.0, 0.0], [0.0, 0.0, 1.0])]))


@some.composite
def meshes(draw) -> Mesh:
    nodes = draw(some.integers(4, 12))
    corners = some.lists(some.integers(0, nodes - 1), min_size=3, max_size=4, unique=True)
    elements = [(*row, -1)[:4] for row in draw(some.lists(corners, min_size=1, max_size=9))]
    random = np.random.default_rng(draw(some.integers(0, 999)))
    lines = draw(some.integers(0, 3))
    states = random.integers(0, 5 if lines else 3, nodes)
    parameters = random.normal(scale=1e3, size=(nodes, 2))
    plane = draw(some.none() | planes())
    return Mesh(
        points=random.normal(scale=1e3, size=(nodes, 3)) if plane is None else plane.points(parameters),
        topology=Topology(
            elements=elements,
            node_labels=random.permutation(nodes) * draw(some.sampled_from([1, 7, 2**55])),
            element_labels=random.permutation(len(elements)) + 1,
            node_states=states,
            node_lines=np.where(states == NodeState.ON_LINE, lines - 1, -1),
        ),
        target_size=draw(some.floats(1e-3, 1e4)),
        surface=plane,
        parameters=None if plane is None else parameters,
        lines=random.normal(size=(lines, 2, 3)),
        unavoidable=draw(some.none() | some.integers(0, len(elements))),
        plate_id=draw(some.text(some.characters(exclude_categories=["Cs"]), max_size=12)),
        thickness=draw(some.none() | some.floats(1e-3, 1e3)),
        input_hash=draw(some.sampled_from(["", "9f" * 32])),
    )


def bits(value: object) -> object:
    """Everything in a value, so that two of them can be compared with ==."""
    if isinstance(value, np.ndarray):
        return value.dtype.str, value.shape, value.tobytes(), value.flags.writeable
    if attrs.has(type(value)):
        return {field.name: bits(getattr(value, field.name)) for field in attrs.fields(type(value))}
    return value


@in_one_folder
@given(mesh=meshes())
def test_every_bit_of_a_mesh_comes_back(mesh, tmp_path):
    vtu.write(mesh, tmp_path / "mesh.vtu")
    assert bits(parsed(tmp_path / "mesh.vtu")) == bits(mesh)


@in_one_folder
@given(mesh=meshes())
def test_the_same_mesh_gives_the_same_bytes(mesh, tmp_path):
    vtu.write(mesh, tmp_path / "one.vtu")
    vtu.write(parsed(tmp_path / "one.vtu"), tmp_path / "other.vtu")
    assert (tmp_path / "one.vtu").read_bytes() == (tmp_path / "other.vtu").read_bytes()


# -- a valid file, and what can be wrong with it

POINTS = "0 0 0  1 0 0  2 0 0  0 1 0  1 1 0  2 1 0"
ELEMENTS = ((0, 1, 4, 3), (1, 2, 5), (1, 5, 4))


def numbers(name: str, kind: str, content: str, **more: object) -> str:
    attributes = "".join(f' {key}="{value}"' for key, value in more.items())
    return f'<DataArray{attributes} Name="{name}" type="{kind}">{content}</DataArray>'


def grid(
    points: str = numbers("Points", "Float64", POINTS, NumberOfComponents=3),
    connectivity: str = numbers("connectivity", "Int32", "0 1 4 3 1 2 5 1 5 4"),
    offsets: str = numbers("offsets", "Int64", "4 7 10"),
    types: str = numbers("types", "UInt8", "9 5 5"),
    counts: str = 'NumberOfPoints="6" NumberOfCells="3"',
    head: str = 'type="UnstructuredGrid" version="0.1"',
    before: str = "",
    more: str = "",
) -> str:
    return (
        f"{before}<VTKFile {head}><UnstructuredGrid><Piece {counts}><Points>{points}</Points>"
        f"<Cells>{types}{connectivity}{offsets}</Cells></Piece></UnstructuredGrid>{more}</VTKFile>"
    )


@pytest.fixture
def file(tmp_path):
    def written(content: str | bytes) -> Path:
        path = tmp_path / "some.vtu"
        path.write_bytes(content if isinstance(content, bytes) else content.encode())
        return path

    return written


def packed(content: bytes, stated: int | None = None) -> str:
    body = zlib.compress(content)
    size = len(content) if stated is None else stated
    header = np.array([1, size, size, len(body)], "<u4").tobytes()
    return b64encode(header).decode() + b64encode(body).decode()


PACKED = 'type="UnstructuredGrid" compressor="vtkZLibDataCompressor"'
BOMB = numbers("Points", "Float64", packed(bytes(10**7), 144), NumberOfComponents=3, format="binary")
OWN_BOMB = numbers("Points", "Float64", packed(bytes(10**7)), NumberOfComponents=3, format="binary")
LAUGHS = '<!DOCTYPE l [<!ENTITY a "ha"><!ENTITY b "&a;&a;&a;&a;&a;&a;&a;&a;&a;&a;">]>'
AT = numbers("Points", "Float64", "", NumberOfComponents=3, format="appended", offset="{}")
RAW = '<AppendedData encoding="raw">_{}</AppendedData>'


def points(content: str, kind: str = "Float64", **more: object) -> str:
    return numbers("Points", kind, content, **({"NumberOfComponents": 3} | more))


WRONG: dict[str, tuple[str | bytes, str]] = {
    "nothing": ("", "E_VTU:empty"),
    "gzip": (gzip.compress(grid().encode()), "E_VTU:gzip"),
    "legacy": ("# vtk DataFile Version 3.0\nplate\nASCII\nDATASET UNSTRUCTURED_GRID", "E_VTU:legacy"),
    "no XML": ("solid plate", "E_VTU:xml"),
    "cut off": (grid()[:-40], "E_VTU:xml"),
    "deep": ("<a>" * 100_000, "E_VTU:deep"),
    "laughs": (grid(before=LAUGHS), "E_VTU:doctype"),
    "other XML": ("<svg/>", "E_VTU:not_vtk"),
    "PolyData": (grid(head='type="PolyData"'), "E_VTU:kind"),
    "LZ4": (grid(head='type="UnstructuredGrid" compressor="vtkLZ4DataCompressor"'), "E_VTU:unknown"),
    "byte order": (grid(head='type="UnstructuredGrid" byte_order="Middle"'), "E_VTU:unknown"),
    "header": (grid(head='type="UnstructuredGrid" header_type="Float32"'), "E_VTU:unknown"),
    "no grid": ('<VTKFile type="UnstructuredGrid"/>', "E_VTU:no_part"),
    "two pieces": (grid().replace("</Piece>", '</Piece><Piece NumberOfPoints="0"/>'), "E_VTU:parts"),
    "no count": (grid(counts='NumberOfCells="3"'), "E_VTU:count"),
    "huge count": (grid(counts='NumberOfPoints="1000000000000000000" NumberOfCells="3"'), "E_VTU:count"),
    "endless count": (grid(counts=f'NumberOfPoints="{"9" * 9999}" NumberOfCells="3"'), "E_VTU:count"),
    "negative count": (grid(counts='NumberOfPoints="-6" NumberOfCells="3"'), "E_VTU:count"),
    "count in words": (grid(counts='NumberOfPoints="six" NumberOfCells="3"'), "E_VTU:count"),
    "other count": (grid(counts='NumberOfPoints="7" NumberOfCells="3"'), "E_VTU:length"),
    "no points": (grid(points=""), "E_VTU:no_array"),
    "no types": (grid(types=""), "E_VTU:no_array"),
    "two columns": (grid(points=points(POINTS, NumberOfComponents=2)), "E_VTU:columns"),
    "letters": (grid(points=points("0 0 zero")), "E_VTU:damaged"),
    "Float16": (grid(points=points(POINTS, "Float16")), "E_VTU:unknown"),
    "NaN": (grid(points=points(POINTS.replace("2 1 0", "2 nan 0"))), "E_MESH:coordinate"),
    "infinity": (grid(points=points(POINTS.replace("2 1 0", "2 1e999 0"))), "E_MESH:coordinate"),
    "far": (grid(points=points(POINTS.replace("2 1 0", "2 1e300 0"))), "E_MESH:coordinate"),
    "far for Float32": (grid(points=points(POINTS.replace("2 1 0", "2 1e300 0"), "Float32")), "E_MESH:coordinate"),
    "whole number too large": (grid(types=numbers("types", "Int8", f"9 5 {9**30}")), "E_VTU:damaged"),
    "one place": (grid(points=points("1 " * 18)), "E_MESH:no_size"),
    "no base64": (grid(points=points("????" * 60, format="binary")), "E_VTU:damaged"),
    "short base64": (grid(points=points(b64encode(bytes([144, 0, 0, 0, 1])).decode(), format="binary")), "E_VTU:short"),
    "other size": (grid(points=points(b64encode(bytes([9, 0, 0, 0, 1])).decode(), format="binary")), "E_VTU:length"),
    "bomb in a block": (grid(head=PACKED, points=BOMB), "E_VTU:damaged"),
    "bomb announced": (grid(head=PACKED, points=OWN_BOMB), "E_VTU:length"),
    "no zlib": (grid(head=PACKED, points=BOMB.replace("eJ", "fK")), "E_VTU:damaged"),
    "offset outside": (grid(points=AT.format(99), more=RAW.format("1234")), "E_VTU:offset"),
    "offset negative": (grid(points=AT.format(-1), more=RAW.format("1234")), "E_VTU:offset"),
    "offset in words": (grid(points=AT.format("one"), more=RAW.format("1234")), "E_VTU:offset"),
    "short appended": (grid(points=AT.format(0), more=RAW.format("abc")), "E_VTU:short"),
    "open appended": (grid(points=AT.format(0), more=RAW.format("1234")[:-15]), "E_VTU:truncated"),
    "tetra": (grid(types=numbers("types", "UInt8", "9 10 5")), "E_VTU:cell"),
    "unknown cell": (grid(types=numbers("types", "UInt8", "9 250 5")), "E_VTU:cell"),
    "float types": (grid(types=numbers("types", "Float32", "9 5 5")), "E_VTU:not_whole"),
    "few types": (grid(types=numbers("types", "UInt8", "9 5")), "E_VTU:length"),
    "offsets fall": (grid(offsets=numbers("offsets", "Int64", "4 2 10")), "E_VTU:corners"),
    "offsets huge": (grid(offsets=numbers("offsets", "Int64", f"4 {2**63 - 1} 10")), "E_VTU:corners"),
    "offsets low": (grid(offsets=numbers("offsets", "Int64", f"{-(2**63)} {2**63 - 1} 3")), "E_VTU:corners"),
    "pentagon": (
        grid(offsets=numbers("offsets", "Int64", "5 8 11"), types=numbers("types", "UInt8", "7 5 5")),
        "E_VTU:corners",
    ),
    "no such node": (grid(connectivity=numbers("connectivity", "Int32", "0 1 4 3 1 2 6 1 5 4")), "E_VTU:no_node"),
    "node -1": (grid(connectivity=numbers("connectivity", "Int32", "0 1 4 -1 1 2 5 1 5 4")), "E_VTU:no_node"),
    "few corners": (grid(connectivity=numbers("connectivity", "Int32", "0 1 4 3 1 2 5 1 5")), "E_VTU:length"),
    "node twice": (grid(connectivity=numbers("connectivity", "Int32", "0 1 4 3 1 2 1 1 5 4")), "E_MESH:double_node"),
    "no elements": (
        grid(
            counts='NumberOfPoints="6" NumberOfCells="0"',
            connectivity=numbers("connectivity", "Int32", ""),
            offsets=numbers("offsets", "Int64", ""),
            types=numbers("types", "UInt8", ""),
        ),
        "E_EMPTY_MESH",
    ),
}


@pytest.mark.parametrize("name", WRONG)
def test_a_wrong_file_is_refused_with_one_sentence(name, file):
    content, key = WRONG[name]
    path = file(content)
    with pytest.raises(HullquadError) as caught:
        parsed(path)
    assert caught.value.key == key
    assert caught.value.place == str(path)
    assert 10 < len(caught.value.text) < 300


def test_the_refused_cell_is_named(file):
    with pytest.raises(HullquadError, match="element 2 is a vtkTetra"):
        parsed(file(grid(types=numbers("types", "UInt8", "9 10 5"))))


def test_missing_files_and_folders_are_told(tmp_path):
    with pytest.raises(HullquadError, match="E_FILE"):
        vtu.read(tmp_path / "no.vtu")
    with pytest.raises(HullquadError, match="folder"):
        vtu.read(tmp_path)


# -- meshes of other programs


def test_a_bare_mesh_is_judged(file):
    mesh = parsed(file(grid()))
    assert [tuple(row[row >= 0]) for row in mesh.topology.elements] == list(ELEMENTS)
    assert mesh.topology.node_states.tolist() == [NodeState.CONTOUR] * 6
    assert mesh.topology.node_labels.tolist() == [1, 2, 3, 4, 5, 6]
    assert mesh.target_size == pytest.approx((7 + np.sqrt(2)) / 8)
    assert mesh.surface is None
    assert bits(placed(mesh).surface) == bits(Plane([0, 0, 0], [1, 0, 0], [0, 1, 0]))
    assert placed(mesh).parameters.tolist() == mesh.points[:, :2].tolist()


def test_most_elements_of_a_bare_mesh_are_counter_clockwise(file):
    clockwise = numbers("connectivity", "Int32", "3 4 1 0 5 2 1 4 5 1")
    assert placed(parsed(file(grid(connectivity=clockwise)))).surface.normal.tolist() == [0.0, 0.0, -1.0]


def test_a_bare_mesh_that_is_not_flat_has_no_place(file):
    mesh = parsed(file(grid(points=points(POINTS.replace("2 1 0", "2 1 0.01")))))
    with pytest.raises(HullquadError, match="E_CURVED"):
        placed(mesh)


@given(plane=planes())
def test_the_plane_of_a_bare_mesh_holds_its_nodes(plane):
    parameters = np.array([[0, 0], [900, 30], [800, 700], [-20, 600.0]])
    nodes = plane.points(parameters)
    found = fitted_plane(nodes, np.array([[0, 1, 2, 3]], dtype=np.int32))
    assert found is not None
    np.testing.assert_allclose(found.points(found.parameters(nodes)), nodes, atol=1e-5)
    np.testing.assert_allclose(found.normal, plane.normal, atol=1e-9)


@pytest.mark.parametrize("height", [0.0, 5.0])
def test_points_of_no_element_are_kept_and_neither_moved_nor_looked_at(file, height):
    counts = 'NumberOfPoints="7" NumberOfCells="3"'
    mesh = placed(parsed(file(grid(counts=counts, points=points(f"{POINTS} 5 5 {height}")))))
    assert mesh.topology.node_states[6] == NodeState.FIXED
    assert mesh.points[6].tolist() == [5.0, 5.0, height]
    assert mesh.surface.normal.tolist() == [0.0, 0.0, 1.0]
    assert bits(unplaced(mesh).surface) is None


def test_pixels_and_polygons_become_quads_and_triangles(file):
    text = grid(
        connectivity=numbers("connectivity", "Int32", "0 1 3 4 1 2 5 1 5 4"), types=numbers("types", "UInt8", "8 7 5")
    )
    mesh = parsed(file(text))
    assert [tuple(row[row >= 0]) for row in mesh.topology.elements] == list(ELEMENTS)


def test_raw_data_may_hold_anything_that_looks_like_xml(file):
    place = np.frombuffer(b"<a></Points></AppendedData>\0&&&&", "<f8")
    body = np.concatenate([place, np.arange(18 - len(place))]).astype("<f8").tobytes()
    head, tail = grid(points=AT.format(0), more=RAW).split("{}")
    mesh = file(head.encode() + b"\x90\0\0\0" + body + tail.encode())
    with pytest.raises(HullquadError) as caught:
        parsed(mesh)
    assert caught.value.key == "E_MESH:coordinate"


# -- the worker


def test_a_mesh_read_by_the_worker_is_the_same_to_the_bit(ours, file):
    assert bits(vtu.read(file(ours))) == bits(parsed(file(ours)))


def test_an_error_of_the_worker_names_the_file(file):
    path = file(grid()[:-40])
    with pytest.raises(HullquadError) as caught:
        vtu.read(path)
    assert (caught.value.key, caught.value.place) == ("E_VTU:xml", str(path))


# -- our own arrays


@pytest.fixture
def ours(tmp_path) -> str:
    plane = Plane([0.0, 0.0, 5.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0])
    parameters = np.array([[0, 0], [1, 0], [2, 0], [0, 1], [1, 1], [2, 1.0]])
    mesh = Mesh(
        points=plane.points(parameters),
        parameters=parameters,
        surface=plane,
        topology=Topology(
            elements=[(*row, -1)[:4] for row in ELEMENTS],
            node_labels=np.arange(11, 17),
            element_labels=[5, 6, 7],
            node_states=[1, 1, 2, 1, 3, 0],
            node_lines=[-1, -1, -1, -1, 0, -1],
        ),
        target_size=1.0,
        lines=[[[1, 0, 5], [1, 1, 5]]],
        thickness=12.0,
    )
    vtu.write(mesh, tmp_path / "ours.vtu", {"stretch <%>": np.array([0.5, np.inf, np.nan])})
    return (tmp_path / "ours.vtu").read_text()


def with_array(text: str, name: str, content: str) -> str:
    """The file with other numbers in one of its arrays."""
    found = re.search(rf'<DataArray ([^>]*Name="{name}"[^>]*) format="binary">\n.*?\n</DataArray>', text, re.DOTALL)
    assert found is not None
    return text.replace(found[0], f'<DataArray {found[1]} format="ascii">{content}</DataArray>')


@pytest.mark.parametrize(
    ("name", "content", "key"),
    [
        ("node state", "1 1 2 1 3 5", "E_VTU:range"),
        ("node state", "1 1 2 1 3 -1", "E_VTU:range"),
        ("node state", "1 1 2 1 3", "E_VTU:length"),
        ("node state", "3 1 2 1 3 0", "E_VTU:no_line"),
        ("node line", "-1 -1 -1 -1 1 -1", "E_VTU:range"),
        ("node line", "-2 -1 -1 -1 0 -1", "E_VTU:range"),
        ("node label", "1 2 3 4 5 5", "E_VTU:label"),
        ("element label", "1 2 1", "E_VTU:label"),
        ("element label", "1 2", "E_VTU:length"),
        ("parameters", "0 0 1 0 2 0 0 1 1 1 nan 1", "E_VTU:not_finite"),
        ("parameters", "0 0 1 0 2 0 0 1 1 1 2 2", "E_VTU:moved"),
        ("Points", POINTS, "E_VTU:moved"),
        ("plane", "0 0 5 1 0 0 0 2 0", "E_VTU:axes"),
        ("plane", "0 0 5 1e300 0 0 0 1 0", "E_VTU:not_finite"),
        ("lines", "1 0 5 1 1 inf", "E_VTU:not_finite"),
        ("thickness", "0", "E_VTU:length_value"),
        ("target size", "nan", "E_VTU:length_value"),
        ("target size", "1e155", "E_VTU:length_value"),
        ("connectivity", "0 1 4 3 1 2 5 1 5 5", "E_MESH:double_node"),
    ],
)
def test_own_arrays_are_trusted_only_after_a_check(ours, file, name, content, key):
    with pytest.raises(HullquadError) as caught:
        parsed(file(with_array(ours, name, content)))
    assert caught.value.key == key


def test_an_element_is_named_by_its_label(ours, file):
    with pytest.raises(HullquadError, match="element 7 uses a node twice"):
        parsed(file(with_array(ours, "connectivity", "0 1 4 3 1 2 5 1 5 5")))


@pytest.mark.parametrize(
    "name", ["node label", "node state", "node line", "parameters", "element label", "target size"]
)
def test_a_missing_own_array_is_named(ours, file, name):
    with pytest.raises(HullquadError, match=f"'{name}' of HullQuad is missing"):
        parsed(file(ours.replace(f'Name="{name}"', 'Name="other"')))


@settings(max_examples=300, deadline=None, suppress_health_check=[HealthCheck.function_scoped_fixture])
@given(data=some.data())
def test_a_damaged_file_gives_a_mesh_or_an_error_that_tells(ours, file, data):
    content = bytearray(ours.encode())
    for _ in range(data.draw(some.integers(0, 3))):
        content[data.draw(some.integers(0, len(content) - 1))] = data.draw(some.integers(0, 255))
    cut = data.draw(some.just(len(content)) | some.integers(0, len(content)))
    try:
        parsed(file(bytes(content[:cut])))
    except HullquadError as error:
        assert error.text  # noqa: PT017 - either outcome is right


def test_values_of_elements_are_written_for_others_and_ignored_here(ours, file):
    assert 'Name="stretch &lt;%&gt;"' in ours
    assert parsed(file(ours)).topology.element_labels.tolist() == [5, 6, 7]


def test_what_sizes_are_relative_to_comes_back(dented, tmp_path):
    moved = dented.with_parameters(dented.parameters)
    vtu.write(moved, tmp_path / "moved.vtu")
    np.testing.assert_array_equal(vtu.read(tmp_path / "moved.vtu").reference_areas, [10_000.0, 0.0])
    vtu.write(dented, tmp_path / "dented.vtu")
    assert vtu.read(tmp_path / "dented.vtu").reference_areas is None
