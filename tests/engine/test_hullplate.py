import copy
import json
import pickle
import re
import time
from pathlib import Path

import numpy as np
import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from hullquad.errors import FileError, HullquadError, PlateError
from hullquad.formats import hullplate
from hullquad.plate import signed_area
from hullquad.surface import Bezier, Cylinder

HERE = Path(__file__).parents[1]
PLATES = sorted((HERE.parent / "assets" / "plates").glob("*.json"))
BAD = HERE / "data" / "bad-plates"
EXPECTED = json.loads((BAD / "expected.json").read_text())


@pytest.fixture
def described():
    """Return a sound document, as its JSON value."""
    return example()


def example():
    manhole = [{"p": [700, 500], "bulge": -1}, {"p": [1300, 500], "bulge": -1}]
    slot = [{"p": [100, 100]}, {"p": [200, 100]}, {"p": [200, 300]}, {"p": [100, 300]}]
    oval = {"c": [1600, 200], "a": 100, "b": 50, "rot": 0}
    ellipse = [{"p": [1500, 200], "ellipse": dict(oval)}, {"p": [1700, 200], "ellipse": dict(oval)}]
    return {
        "format": "hullplate",
        "version": 1,
        "name": "floor",
        "units": {"length": "mm", "angle": "deg"},
        "materials": {"AH36": {"E": 206000, "nu": 0.3, "rho": 7.85e-9, "ReH": 355}},
        "plates": [
            {
                "id": "P1",
                "title": "Floor",
                "drawing": "1",
                "notes": "",
                "thickness": 12,
                "material": "AH36",
                "frame": {"origin": [0, 0, 0], "u": [1, 0, 0], "v": [0, 1, 0]},
                "outer": [{"p": [0, 0]}, {"p": [2000, 0]}, {"p": [2000, 1000]}, {"p": [0, 1000]}],
                "holes": [manhole, slot, ellipse],
                "stiffeners": [{"a": [500, 0], "b": [500, 1000], "profile": "FB"}],
                "seams": [{"a": [1500, 0], "b": [1500, 400]}],
                "fixed": [[1800, 600]],
                "divisions": {"outer": [10, 5, 10, 5], "holes": [[4, 4], [1, 2, 1, 2], [4, 4]]},
                "target_size": 100,
                "sizes": {"coarse": 100, "fine": 50, "very_fine": 20},
            }
        ],
    }


CYLINDER = {"type": "cylinder", "radius": 1800, "axis": "u", "start_angle": -90, "note": ""}
BEZIER = {"type": "bezier", "degree": [1, 1], "control": [[[0, 0, 0], [1, 0, 0]], [[0, 1, 0], [1, 1, 0]]]}


TRIANGLE = [{"p": [0, 0]}, {"p": [1, 0]}, {"p": [1, 1]}]
BARE = {"holes": [], "stiffeners": [], "seams": [], "fixed": [], "divisions": {}}
SPECIFIED = re.findall(
    r"E_\w+",
    """
    E_FILE E_JSON E_FORMAT E_VERSION E_TYPE E_KEY E_UNITS E_EMPTY E_ID E_DUP_ID E_NUMBER E_POINT E_VERTEX E_FRAME
    E_MATERIAL E_THICKNESS E_SIZE E_DIVISIONS E_OUTER E_SHORT_EDGE E_SELF_INTERSECT E_AREA E_ELLIPSE E_HOLE_OUTSIDE
    E_LIGAMENT E_HOLE_OVERLAP E_SHORT_LINE E_LINE_OUTSIDE E_POINT_OUTSIDE E_SURFACE E_TOO_BIG
    """,
)


def read(value, tmp_path):
    file = tmp_path / "plate.json"
    file.write_bytes(value if isinstance(value, bytes) else json.dumps(value).encode())
    return hullplate.read(file)


def refusal(value, tmp_path):
    with pytest.raises(HullquadError) as caught:
        read(value, tmp_path)
    assert caught.value.text
    return caught.value


def outcome(value, tmp_path):
    try:
        return read(value, tmp_path).name
    except HullquadError as error:
        return error


def put(value, place, new):
    """Set what is at a path; ... removes it."""
    *way, last = [int(step) if step.isdecimal() else step for step in place.split("/")[1:]]
    for step in way:
        value = value[step]
    if new is ...:
        del value[last]
    elif isinstance(value, list) and last == len(value):
        value.append(new)
    else:
        value[last] = new


@pytest.mark.parametrize("file", PLATES, ids=lambda file: file.stem)
def test_every_sample_plate_loads(file):
    document = hullplate.read(file)
    assert document.plates
    assert all(notice.text for notice in document.warnings)


@pytest.mark.parametrize("name", EXPECTED)
def test_every_bad_document_is_refused_at_its_place(name):
    with pytest.raises(PlateError) as caught:
        hullplate.read(BAD / name)
    assert caught.value.code in EXPECTED[name]["codes"]
    assert re.fullmatch(EXPECTED[name]["at"] or r"line \d+ column \d+", caught.value.place)


P = "/plates/0"
SQUARE = [{"p": [1400, 700]}, {"p": [1480, 700]}, {"p": [1480, 800]}, {"p": [1400, 800]}]
REFUSED = [
    ("E_FORMAT", "/format", ...),
    ("E_VERSION", "/version", ...),
    ("E_VERSION", "/version", True),
    ("E_VERSION", "/version", 2),
    ("E_TYPE", "/name", ...),
    ("E_TYPE", "/name", " "),
    ("E_TYPE", "/name", "\ud800"),
    ("E_UNITS", "/units", ...),
    ("E_TYPE", "/units", "mm"),
    ("E_UNITS", "/units/angle", "grad"),
    ("E_KEY", "/units/mass", "t"),
    ("E_MATERIAL", "/materials", ...),
    ("E_MATERIAL", "/materials/AH36/E", ...),
    ("E_MATERIAL", "/materials/AH36/nu", 0.5),
    ("E_MATERIAL", "/materials/AH36/ReH", 0),
    ("E_NUMBER", "/materials/AH36/rho", "7"),
    ("E_KEY", "/materials/AH36/Re", 1),
    ("E_EMPTY", "/plates", ...),
    ("E_TYPE", "/plates", {}),
    ("E_TYPE", P, []),
    ("E_ID", f"{P}/id", ...),
    ("E_ID", f"{P}/id", "x" * 65),
    ("E_TYPE", f"{P}/title", 5),
    ("E_THICKNESS", f"{P}/thickness", ...),
    ("E_NUMBER", f"{P}/thickness", True),
    ("E_NUMBER", f"{P}/thickness", None),
    ("E_NUMBER", f"{P}/thickness", float("inf")),
    ("E_NUMBER", f"{P}/thickness", 10**400),
    ("E_MATERIAL", f"{P}/material", ...),
    ("E_FRAME", f"{P}/frame", ...),
    ("E_FRAME", f"{P}/frame/origin", ...),
    ("E_TYPE", f"{P}/frame", []),
    ("E_POINT", f"{P}/frame/u", [1, 0]),
    ("E_NUMBER", f"{P}/frame/u/0", "1"),
    ("E_KEY", f"{P}/frame/w", [0, 0, 1]),
    ("E_OUTER", f"{P}/outer", ...),
    ("E_TYPE", f"{P}/outer", {}),
    ("E_KEY", f"{P}/outer/0/q", 1),
    ("E_POINT", f"{P}/outer/0/p", "here"),
    ("E_POINT", f"{P}/outer/0/p", [2e9, 0]),
    ("E_NUMBER", f"{P}/outer/0/bulge", 1e9),
    ("E_VERTEX", f"{P}/holes/2/0", {"p": [1500, 200], "bulge": 1, "ellipse": {"c": [1600, 200], "a": 100, "b": 50}}),
    ("E_ELLIPSE", f"{P}/holes/2/0/ellipse/a", 0),
    ("E_ELLIPSE", f"{P}/holes/2/0/ellipse/c", ...),
    ("E_ELLIPSE", f"{P}/holes/2/0/ellipse", {"c": [0, 0], "a": 1, "b": 1e9}),
    ("E_TYPE", f"{P}/holes/2/0/ellipse/cw", 1),
    ("E_TYPE", f"{P}/holes", 5),
    ("E_TYPE", f"{P}/holes/0", 5),
    ("E_OUTER", f"{P}/holes/0", []),
    ("E_SHORT_EDGE", f"{P}/holes/1/0", {"p": [200, 100]}),
    ("E_SELF_INTERSECT", f"{P}/holes/1", [SQUARE[i] for i in (0, 2, 1, 3)]),
    ("E_AREA", f"{P}/holes/1", [{"p": [100, 100]}, {"p": [200, 100]}, {"p": [150, 100]}]),
    ("E_HOLE_OUTSIDE", f"{P}/holes/1/2", {"p": [200, 1300]}, f"{P}/holes/1"),
    ("E_LIGAMENT", f"{P}/holes/1", [{"p": [0.5, 100]}, {"p": [200, 100]}, {"p": [200, 300]}]),
    ("E_LIGAMENT", f"{P}/holes/2", [{"p": [200.5, 100]}, {"p": [300, 100]}, {"p": [300, 300]}, {"p": [200.5, 300]}]),
    ("E_HOLE_OVERLAP", f"{P}/holes/1", [{"p": [750, 450]}, {"p": [800, 450]}, {"p": [800, 550]}]),
    ("E_POINT", f"{P}/stiffeners/0/a", ...),
    ("E_KEY", f"{P}/seams/0/profile", "FB"),
    ("E_SHORT_LINE", f"{P}/seams/0", {"a": [1500, 0], "b": [1500, 0.5]}),
    ("E_LINE_OUTSIDE", f"{P}/seams/0", {"a": [1500, 0], "b": [1500, -1]}),
    ("E_POINT_OUTSIDE", f"{P}/fixed/0", [1000, 500]),
    ("E_POINT", f"{P}/fixed/0", [1000]),
    ("E_DIVISIONS", f"{P}/divisions/outer/1", 1.5),
    ("E_DIVISIONS", f"{P}/divisions/outer/1", 10**9),
    ("E_NUMBER", f"{P}/divisions/outer/1", True),
    ("E_DIVISIONS", f"{P}/divisions/holes", [[4, 4]]),
    ("E_DIVISIONS", f"{P}/divisions/holes/0", [4]),
    ("E_TYPE", f"{P}/divisions/outer", 4),
    ("E_SIZE", f"{P}/target_size", ...),
    ("E_SIZE", f"{P}/sizes/fine", -1),
    ("E_TOO_BIG", f"{P}/target_size", 1e-300),
    ("E_TYPE", f"{P}/surface", "plane"),
    ("E_SURFACE", f"{P}/surface", CYLINDER | {"axis": "v"}, f"{P}/surface/axis"),
    ("E_SURFACE", f"{P}/surface", CYLINDER | {"radius": 0}, f"{P}/surface/radius"),
    ("E_SURFACE", f"{P}/surface", {"type": "cylinder", "radius": 1}, f"{P}/surface/start_angle"),
    ("E_SURFACE", f"{P}/surface", BEZIER | {"degree": [1]}, f"{P}/surface/degree"),
    ("E_SURFACE", f"{P}/surface", BEZIER | {"degree": [1, 0.5]}, f"{P}/surface/degree/1"),
    ("E_SURFACE", f"{P}/surface", BEZIER | {"control": []}, f"{P}/surface/control"),
    ("E_SURFACE", f"{P}/param", True),
    ("E_TYPE", f"{P}/param", 0),
]


@pytest.mark.parametrize(("code", "place", "new", "at"), [(*row, row[1])[:4] for row in REFUSED])
def test_a_fault_is_refused_at_its_place(described, tmp_path, code, place, new, at):
    put(described, place, new)
    if place.startswith(f"{P}/holes") and code != "E_TYPE":
        del described["plates"][0]["divisions"]
    if isinstance(new, dict) and new.get("type") == "bezier":
        described["plates"][0] = described["plates"][0] | {"outer": TRIANGLE} | BARE
    error = refusal(described, tmp_path)
    assert (error.code, error.place) == (code, at)


def test_every_code_of_the_specification_is_tested():
    tested = {row[0] for row in REFUSED} | {code for expected in EXPECTED.values() for code in expected["codes"]}
    assert set(SPECIFIED) - tested == {"E_FILE"}


def test_control_points_must_be_as_many_as_the_degree_says(described, tmp_path):
    described["plates"][0] |= {"outer": TRIANGLE, "surface": BEZIER | {"degree": [2, 1]}} | BARE
    error = refusal(described, tmp_path)
    assert (error.code, error.place) == ("E_SURFACE", f"{P}/surface/control")


def test_a_point_beside_its_patch_is_refused(described, tmp_path):
    described["plates"][0] |= {"outer": [*TRIANGLE[:2], {"p": [1, 1.1]}], "surface": BEZIER} | BARE
    error = refusal(described, tmp_path)
    assert (error.code, error.place) == ("E_POINT", f"{P}/outer/2/p")


def test_a_loop_that_nearly_touches_itself_is_refused(described, tmp_path):
    touching = [[0, 0], [2000, 0], [2000, 1000], [1000, 0.005], [0, 1000]]
    described["plates"][0] |= {"outer": [{"p": point} for point in touching]} | BARE
    error = refusal(described, tmp_path)
    assert (error.code, error.place, error.case) == ("E_SELF_INTERSECT", f"{P}/outer", "neck")


@pytest.mark.parametrize(
    ("content", "place"),
    [
        (b"", "line 1 column 1"),
        (b'{"format": "hullplate",}', "line 1 column 24"),
        (b"\x00", "line 1 column 1"),
        (b"[" * 100_000, "line 1 column 1"),
        (b'{"plates": [{"a~/": 1, "a~/": 2}]}', "/plates/0/a~0~1"),
    ],
)
def test_text_that_is_no_json_is_refused(tmp_path, content, place):
    error = refusal(content, tmp_path)
    assert (error.code, error.place) == ("E_JSON", place)


def test_a_list_is_no_document(tmp_path):
    assert refusal([1], tmp_path).code == "E_TYPE"


def test_a_file_that_is_not_utf_8_is_refused_by_its_name(tmp_path):
    error = refusal(b'{"name": "\xff"}', tmp_path)
    assert isinstance(error, FileError)
    assert error.place.endswith("plate.json")


@pytest.mark.parametrize("name", ["missing.json", ".", "a\0b"])
def test_what_is_no_file_is_refused_by_its_name(tmp_path, name):
    with pytest.raises(FileError) as caught:
        hullplate.read(tmp_path / name)
    assert caught.value.code == "E_FILE"


def test_a_byte_order_mark_is_no_fault(described, tmp_path):
    assert read(b"\xef\xbb\xbf" + json.dumps(described).encode(), tmp_path).name == "floor"


def test_numbers_beyond_floats_are_refused(described, tmp_path):
    text = json.dumps(described).replace('"thickness": 12', f'"thickness": {"9" * 5000}')
    assert refusal(text.encode(), tmp_path).place == f"{P}/thickness"


def test_the_first_fault_in_the_document_is_told_with_the_number_of_others(described, tmp_path):
    described["plates"][0]["target_size"] = -1
    described["plates"][0]["outer"] = [{"p": [0, 0]}, {"p": [2000, 1000]}, {"p": [2000, 0]}, {"p": [0, 1000]}]
    described["plates"].append({})
    error = refusal(described, tmp_path)
    assert (error.code, error.others) == ("E_SELF_INTERSECT", 7)
    assert error.text.endswith("(and 7 more errors)")
    assert str(pickle.loads(pickle.dumps(error))) == str(error)


def test_a_misspelt_key_is_told_before_the_missing_one(described, tmp_path):
    plate = described["plates"][0]
    plate["thicknes"] = plate.pop("thickness")
    error = refusal(described, tmp_path)
    assert error.code == "E_KEY"
    assert "did you mean thickness?" in error.text


def test_sound_plates_survive_their_neighbours(described, tmp_path):
    other = copy.deepcopy(described["plates"][0]) | {"id": "P2", "thickness": 0}
    described["plates"].insert(0, other)
    file = tmp_path / "two.json"
    file.write_text(json.dumps(described))
    document, refusals = hullplate.survey(file)
    assert [plate.id for plate in document.plates] == ["P1"]
    assert [(refusal.plate_id, refusal.place, refusal.error.code) for refusal in refusals] == [("P2", P, "E_THICKNESS")]


def test_each_refused_plate_counts_its_own_faults(described, tmp_path):
    one = described["plates"][0]
    described["plates"] = [
        {**one, "thickness": 0, "target_size": -1},
        {**one, "id": "P2"},
        "no plate",
        {**one, "id": "P4", "target_size": 1e-9},
    ]
    file = tmp_path / "four.json"
    file.write_text(json.dumps(described))
    document, refusals = hullplate.survey(file)
    assert [plate.id for plate in document.plates] == ["P2"]
    assert [(refusal.plate_id, refusal.error.place, refusal.error.others) for refusal in refusals] == [
        ("P1", "/plates/0/thickness", 1),
        ("", "/plates/2", 0),
        ("P4", "/plates/3/target_size", 0),
    ]
    assert refusal(described, tmp_path).others == 3


@pytest.mark.parametrize(("place", "new"), [("/name", 3), ("/units", "mm"), ("/materials", []), ("/plates/1/id", "P1")])
def test_what_concerns_all_plates_refuses_all(described, tmp_path, place, new):
    described["plates"].append({**described["plates"][0], "id": "P2"})
    put(described, place, new)
    file = tmp_path / "two.json"
    file.write_text(json.dumps(described))
    with pytest.raises(PlateError) as caught:
        hullplate.survey(file)
    assert caught.value.place == place


def test_thousands_of_faults_take_seconds(described, tmp_path):
    described["materials"] |= {f"M{i}": {"E": -1, "nu": 0.3, "rho": 1e-9} for i in range(20_000)}
    described |= {f"key {i}": 1 for i in range(5_000)}
    start = time.perf_counter()
    assert refusal(described, tmp_path).others > 24_000
    assert time.perf_counter() - start < 8


def test_a_document_without_materials_says_so(described, tmp_path):
    described["materials"] = {}
    assert "the document has none" in refusal(described, tmp_path).text


def test_of_very_many_materials_some_are_told(described, tmp_path):
    described["materials"] = {f"M{i}": described["materials"]["AH36"] for i in range(1000)}
    assert "'M19', ...," in refusal(described, tmp_path).text


@pytest.mark.parametrize(
    ("place", "new", "shown"),
    [(f"{P}/thickness", {"a": 1}, "an object"), (f"{P}/title", [1], "a list"), (f"{P}/title", True, "true or false")],
)
def test_what_stands_there_is_told_by_its_kind(described, tmp_path, place, new, shown):
    put(described, place, new)
    assert f"not {shown}" in refusal(described, tmp_path).text


def test_axes_of_few_decimals_are_made_orthonormal(described, tmp_path):
    described["plates"][0]["frame"] |= {"u": [0.7071068, 0.7071068, 0], "v": [0.0000001, 0, 0.9999999]}
    plane = read(described, tmp_path).plates[0].surface
    assert np.array([plane.u @ plane.u - 1, plane.v @ plane.v - 1, plane.u @ plane.v]) == pytest.approx(0, abs=1e-15)
    assert [*plane.u, *plane.v] == pytest.approx([0.7071068, 0.7071068, 0, 1e-7, 0, 1], abs=2e-7)


def test_exact_axes_keep_their_bits(described, tmp_path):
    turn = np.radians(33.3)
    axes = {"u": [np.cos(turn), np.sin(turn), 0.0], "v": [-np.sin(turn), np.cos(turn), 0.0]}
    described["plates"][0]["frame"] |= axes
    plane = read(described, tmp_path).plates[0].surface
    assert (plane.u.tolist(), plane.v.tolist()) == (axes["u"], axes["v"])


@pytest.mark.parametrize("v", [[1.5e-6, 1, 0], [0, 1.0000015, 0]])
def test_axes_beyond_a_millionth_are_refused(described, tmp_path, v):
    described["plates"][0]["frame"]["v"] = v
    assert refusal(described, tmp_path).code == "E_FRAME"


def test_the_values_of_a_document_are_read(described, tmp_path):
    document = read(described, tmp_path)
    plate = document.plate("P1")
    assert (plate.title, plate.drawing, plate.thickness, plate.target_size) == ("Floor", "1", 12, 100)
    assert document.materials["AH36"].yield_strength == 355
    assert plate.stiffeners[0].profile == "FB"
    assert len(document.input_hash) == 64


def test_sizes_follow_from_the_target_size(described, tmp_path):
    del described["plates"][0]["sizes"]
    sizes = read(described, tmp_path).plates[0].sizes
    assert (sizes.coarse, sizes.fine, sizes.very_fine) == (100, 25, 6.25)


def test_loops_run_with_the_plate_on_their_left_and_remember_their_numbers(described, tmp_path):
    described["plates"][0]["outer"].reverse()
    described["plates"][0]["divisions"]["outer"] = [10, 5, 10, 5]
    plate = read(described, tmp_path).plates[0]
    assert signed_area(plate.outlines[0]) > 0
    assert all(signed_area(hole) < 0 for hole in plate.outlines[1:])
    given = [vertex["p"] for vertex in described["plates"][0]["outer"]]
    for i, curve in enumerate(plate.outer.curves):
        assert list(curve.start) == given[plate.outer.vertices[i]]
        assert list(curve.end) == given[plate.outer.edges[i]]


def scaled(value, factor):
    """Return the document with its lengths divided by a factor."""
    if isinstance(value, list):
        return [scaled(item, factor) for item in value]
    lengths = {
        "thickness",
        "origin",
        "p",
        "a",
        "b",
        "c",
        "fixed",
        "target_size",
        "coarse",
        "fine",
        "very_fine",
        "radius",
    }
    if isinstance(value, dict):
        return {
            key: multiplied(item, 1 / factor) if key in lengths else scaled(item, factor) for key, item in value.items()
        }
    return value


def multiplied(value, factor):
    return [multiplied(item, factor) for item in value] if isinstance(value, list) else value * factor


def test_metres_become_millimetres(described, tmp_path):
    described["plates"][0]["surface"] = CYLINDER
    inch = scaled(described, 1000)
    inch["units"] = {"length": "m", "angle": "rad"}
    inch["materials"]["AH36"]["rho"] = 7.85
    inch["plates"][0]["surface"]["start_angle"] = -np.pi / 2
    here, there = read(described, tmp_path), read(inch, tmp_path)
    one, other = here.plates[0], there.plates[0]
    assert isinstance(one.surface, Cylinder)
    assert other.surface.radius == pytest.approx(1800)
    assert other.surface.start_angle == pytest.approx(one.surface.start_angle)
    assert other.outlines[0] == pytest.approx(one.outlines[0])
    assert other.holes[2].curves[0].length == pytest.approx(one.holes[2].curves[0].length)
    assert (other.thickness, other.sizes.fine) == pytest.approx((12, 50))
    assert there.materials["AH36"].density == pytest.approx(7.85e-9)


def test_parameters_of_a_patch_are_not_scaled(described, tmp_path):
    described["units"]["length"] = "m"
    described["plates"] = [
        {key: described["plates"][0][key] for key in ("id", "thickness", "material", "frame", "target_size")}
        | {"surface": BEZIER, "param": True, "outer": [{"p": [0, 0]}, {"p": [1, 0]}, {"p": [1, 1]}]}
    ]
    plate = read(described, tmp_path).plates[0]
    assert isinstance(plate.surface, Bezier)
    assert plate.surface.control.max() == 1000
    assert plate.box.max() == 1


def test_ligaments_of_just_the_least_width_are_accepted(described, tmp_path):
    holes = described["plates"][0]["holes"]
    holes[1] = [{"p": [1, 100]}, {"p": [200, 100]}, {"p": [200, 300]}]
    holes[2] = [{"p": [201, 100]}, {"p": [300, 100]}, {"p": [300, 300]}, {"p": [201, 300]}]
    described["plates"][0].pop("divisions")
    assert len(read(described, tmp_path).plates[0].holes) == len(holes)


def test_a_length_that_is_refused_is_told_with_its_unit(described, tmp_path):
    described["units"]["length"] = "m"
    described["plates"][0]["outer"][1]["p"] = [0.0002, 0]
    assert "0.2 mm long, the least is 1 mm" in refusal(described, tmp_path).text


@pytest.mark.parametrize(("point", "shown"), [([1000], "1"), ([1, 2, 3], "3"), (5, "5"), ({}, "an object")])
def test_a_point_of_another_kind_is_told_what_it_has(point, shown, described, tmp_path):
    described["plates"][0]["fixed"] = [point]
    assert refusal(described, tmp_path).text.endswith(f"2 coordinates in square brackets belong here, not {shown}")


def test_the_warning_of_a_short_edge_tells_the_size_and_one_that_helps(described, tmp_path):
    described["plates"][0]["target_size"] = 600
    (notice,) = [notice for notice in read(described, tmp_path).warnings if notice.code == "W_SHORT_EDGE"]
    assert "the edge is 100 mm long, less than a fifth of the element size (600 mm)" in notice.text
    assert "choose 500 mm or less" in notice.text


WARNED = [
    ("W_THICKNESS", f"{P}/thickness", "/thickness", 151),
    ("W_LINE_HOLE", f"{P}/seams/0", "/seams/0", {"a": [1000, 0], "b": [1000, 1000]}),
    ("W_CORNER", f"{P}/outer/1", "/outer/1", {"p": [9000, 0]}),
    ("W_CORNER", f"{P}/outer/1", "/outer/1", {"p": [3800, 0]}),
    ("W_SHORT_EDGE", f"{P}/holes/1/0", "/target_size", 600),
    ("W_SMALL_HOLE", f"{P}/holes/1", "/target_size", 201),
    ("W_ODD", P, "/divisions/outer/0", 11),
    ("W_SNAP", f"{P}/seams/0/a", "/seams/0/a", [1500, 0.3]),
    ("W_NEAR", f"{P}/fixed/0", "/fixed/0", [1995, 600]),
    ("W_COARSE", f"{P}/fixed/0", "/fixed/0", [2170, 230]),
    ("W_UNITS", f"{P}/outer", "/outer", [{"p": [0, 0]}, {"p": [9e5, 0]}, {"p": [9e5, 1000]}, {"p": [0, 1000]}]),
]


@pytest.mark.parametrize(("code", "at", "below", "new"), WARNED)
def test_what_is_odd_is_warned_about(described, tmp_path, code, at, below, new):
    if code == "W_COARSE":
        described["plates"][0] |= {"divisions": {}, "target_size": 2000}
        described["plates"][0]["outer"][1]["bulge"] = 0.5
    put(described, P + below, new)
    found = [notice for notice in read(described, tmp_path).warnings if notice.code == code]
    assert [notice.place for notice in found][:1] == [at]
    assert found[0].text


def test_a_sound_plate_has_no_warnings(described, tmp_path):
    described["plates"][0]["holes"].pop()
    described["plates"][0]["divisions"]["holes"].pop()
    assert [str(notice) for notice in read(described, tmp_path).warnings] == []


def test_an_edge_may_be_left_to_the_size(described, tmp_path):
    described["plates"][0]["divisions"]["outer"] = [None, 7, None, 7]
    (plate,) = read(described, tmp_path).plates
    assert plate.divisions[0] == (0, 7, 0, 7)


def test_an_odd_contour_is_told_with_the_edge_that_mends_it(described, tmp_path):
    described["plates"][0]["divisions"]["outer"] = [11, 5, 10, 5]
    (notice,) = [notice for notice in read(described, tmp_path).warnings if notice.code == "W_ODD"]
    assert "one node more or fewer on an edge makes it none" in notice.text
    assert "best 3 segments instead of 2 at /plates/0/holes/1/1" in notice.text


def test_two_plates_that_ask_for_other_numbers_of_one_edge_are_refused(described, tmp_path):
    above = copy.deepcopy(described["plates"][0]) | {"id": "P2"}
    above["frame"]["origin"] = [0, 1000, 0]
    above["divisions"]["outer"] = [8, 5, 10, 5]
    described["plates"].append(above)
    error = refusal(described, tmp_path)
    assert (error.code, error.place) == ("E_DIVISIONS", "/plates/1/divisions/outer/0")


def test_ten_thousand_vertices_take_seconds(described, tmp_path):
    angles = np.linspace(0, 2 * np.pi, 10_000, endpoint=False)
    wavy = 20_000 + 100 * np.sin(300 * angles)
    outer = np.stack([wavy * np.cos(angles), wavy * np.sin(angles)], axis=1)
    plate = described["plates"][0]
    plate |= {"outer": [{"p": list(point)} for point in outer], "divisions": {}}
    assert len(read(described, tmp_path).plates[0].outer.curves) == 10_000


def paths(value, place=()):
    yield place
    entries = value.items() if isinstance(value, dict) else enumerate(value) if isinstance(value, list) else ()
    for key, item in entries:
        yield from paths(item, (*place, key))


JUNK = st.recursive(
    st.none()
    | st.booleans()
    | st.integers()
    | st.floats()
    | st.text(max_size=5)
    | st.sampled_from([0, 1, -1, 1e308, 1e-308]),
    lambda inner: st.lists(inner, max_size=4) | st.dictionaries(st.sampled_from("pabcuv"), inner, max_size=3),
    max_leaves=6,
)
QUIET = {"deadline": None, "suppress_health_check": [HealthCheck.function_scoped_fixture]}


@given(st.data())
@settings(max_examples=250, **QUIET)
def test_junk_anywhere_is_refused_in_words_or_loads(tmp_path, data):
    value = example()
    value["plates"][0]["surface"] = data.draw(st.sampled_from([None, CYLINDER, BEZIER]))
    if value["plates"][0]["surface"] is None:
        del value["plates"][0]["surface"]
    way = data.draw(st.sampled_from([way for way in paths(value) if way]))
    value = copy.deepcopy(value)
    put(value, "/" + "/".join(map(str, way)), data.draw(JUNK))
    assert str(outcome(value, tmp_path))


@given(st.data())
@settings(max_examples=120, **QUIET)
def test_damaged_text_is_refused_in_words_or_loads(tmp_path, data):
    content = bytearray(json.dumps(example()).encode())
    for _ in range(data.draw(st.integers(1, 3))):
        content[data.draw(st.integers(0, len(content) - 1))] = data.draw(st.integers(0, 255))
    cut = data.draw(st.sampled_from([len(content), data.draw(st.integers(0, len(content)))]))
    assert str(outcome(bytes(content[:cut]), tmp_path))
