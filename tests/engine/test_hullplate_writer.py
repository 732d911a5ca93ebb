"""What is written of plates is read again, bit for bit."""

import json
import struct
from pathlib import Path

import attrs
import numpy as np
import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from hullquad import __version__
from hullquad.errors import FileError
from hullquad.formats import hullplate, read_plates, write_plates
from hullquad.triangulation.edges import redivided

PLATES = sorted((Path(__file__).parents[2] / "assets" / "plates").glob("*.json"))
QUIET = {"deadline": None, "suppress_health_check": [HealthCheck.function_scoped_fixture]}


def bits(value):
    """All of a document that its file tells, to the last bit."""
    if attrs.has(type(value)):
        names = [field.name for field in attrs.fields(type(value)) if field.name not in {"input_hash", "warnings"}]
        return type(value).__name__, {name: bits(getattr(value, name)) for name in names}
    if isinstance(value, np.ndarray):
        return value.shape, value.tobytes()
    if isinstance(value, float | int):
        return struct.pack("d", value)
    if isinstance(value, dict):
        return {key: bits(item) for key, item in value.items()}
    return [bits(item) for item in value] if isinstance(value, tuple | list) else value


def keys(value):
    if isinstance(value, dict):
        return {key: keys(item) for key, item in value.items() if item not in ("", [], {})}
    return [keys(item) for item in value] if isinstance(value, list) else None


@pytest.mark.parametrize("file", PLATES, ids=lambda file: file.stem)
def test_sample_plates_are_read_again_as_they_were(file, tmp_path):
    before = read_plates(file)
    write_plates(before, tmp_path / "again.json")
    again = read_plates(tmp_path / "again.json")
    assert bits(again) == bits(before)
    assert [str(notice) for notice in again.warnings] == [str(notice) for notice in before.warnings]
    write_plates(again, tmp_path / "third.json")
    assert (tmp_path / "third.json").read_bytes() == (tmp_path / "again.json").read_bytes()


@pytest.mark.parametrize("file", PLATES, ids=lambda file: file.stem)
def test_the_numbers_of_sample_plates_are_written_as_they_were(file, tmp_path):
    write_plates(read_plates(file), tmp_path / "again.json")
    before, again = (json.loads(path.read_text(encoding="utf-8")) for path in (file, tmp_path / "again.json"))
    assert again.pop("program") == f"hullquad {__version__}"
    for one, other in zip(before["plates"], again["plates"], strict=True):
        assert [vertex["p"] for vertex in one["outer"]] == [vertex["p"] for vertex in other["outer"]]
        assert one["frame"]["origin"] == other["frame"]["origin"]
        for key in other.keys() - {"frame", "sizes", "param", "outer", "holes"}:
            assert one[key] == other[key], key


NUMBERS = st.floats(-900, 900) | st.integers(-900, 900) | st.just(-0.0)
TEXTS = st.text(st.characters(exclude_categories=["Cs"]), max_size=8)


def near(value):
    """A number beside a value, with all its digits."""
    return st.floats(value - 20, value + 20)


@st.composite
def loops(draw, u, v, size):
    """Vertices of a four-cornered loop, some of its edges round, run through either way."""
    corners = [(u - size, v - size), (u + size, v - size), (u + size, v + size), (u - size, v + size)]
    vertices = [{"p": [draw(near(x)), draw(near(y))]} for x, y in corners]
    for vertex in vertices:
        if draw(st.booleans()):
            vertex["bulge"] = draw(st.floats(-0.1, 0.1))
    return vertices[::-1] if draw(st.booleans()) else vertices


@st.composite
def documents(draw):
    """A document with every key that one can have, in either unit."""
    length, angle = draw(st.sampled_from(["mm", "m"])), draw(st.sampled_from(["deg", "rad"]))
    a, b, turn = draw(st.floats(60, 90)), draw(st.floats(40, 60)), draw(st.floats(-3, 3))
    oval = {"c": [700, 0], "a": a, "b": b, "rot": turn if angle == "rad" else np.degrees(turn), "cw": True}
    way = np.array([a * np.cos(turn), a * np.sin(turn)])
    ends = [list(np.array([700, 0]) + sign * way) for sign in (1, -1)]
    plate = {
        "id": draw(st.from_regex(r"[\w.\-]{1,9}", fullmatch=True)),
        "title": draw(TEXTS),
        "notes": draw(TEXTS),
        "thickness": draw(st.floats(1, 40)),
        "material": "St",
        "frame": {"origin": draw(st.lists(NUMBERS, min_size=3, max_size=3)), "u": [0, 1, 0], "v": [0, 0, 1]},
        "outer": draw(loops(0, 0, 1000)),
        "holes": [draw(loops(0, 0, 100)), [{"p": end, "ellipse": oval} for end in ends]],
        "stiffeners": [{"a": [draw(near(400)), draw(near(-400))], "b": [-400, 400], "profile": draw(TEXTS)}],
        "seams": [{"a": [-600, draw(near(0))], "b": [-600, 500]}],
        "fixed": [[draw(near(-500)), draw(near(-500))]],
        "target_size": draw(st.floats(50, 2000)),
        "sizes": draw(st.dictionaries(st.sampled_from(["coarse", "fine", "very_fine"]), st.floats(20, 900))),
    }
    if draw(st.booleans()):
        plate["divisions"] = {"outer": [draw(st.none() | st.integers(1, 30)) for _ in range(4)]}
    if draw(st.booleans()):
        plate["divisions"] = {"holes": [[1, None, 3, 2], [5, 6]]}
    if draw(st.booleans()):
        plate["surface"] = {"type": "cylinder", "radius": draw(st.floats(900, 9000)), "start_angle": turn, "note": "n"}
    factor = 1000 if length == "m" else 1
    material = {"E": draw(st.floats(1e4, 3e5)), "nu": draw(st.floats(0.1, 0.4)), "rho": draw(st.floats(1, 9))}
    plate = {key: divided(item, factor) if key in LENGTHS else item for key, item in plate.items()}
    plate["frame"]["origin"] = divided(plate["frame"]["origin"], factor)
    return {
        "format": "hullplate",
        "version": 1,
        "name": "ä" + draw(TEXTS),
        "units": {"length": length, "angle": angle},
        "materials": {"St": material, "AH36": material | {"ReH": 355}},
        "plates": [plate],
    }


LENGTHS = {"thickness", "outer", "holes", "stiffeners", "seams", "fixed", "target_size", "sizes"}
PLAIN = {"bulge", "ellipse", "profile", "rot", "cw"}


def divided(value, factor):
    if isinstance(value, list):
        return [divided(item, factor) for item in value]
    if isinstance(value, dict):
        rows = {key: item if key in PLAIN else divided(item, factor) for key, item in value.items()}
        if "ellipse" in rows:
            oval = rows["ellipse"]
            rows["ellipse"] = oval | {key: divided(oval[key], factor) for key in ("c", "a", "b")}
        return rows
    return value / factor


@given(documents())
@settings(max_examples=40, **QUIET)
def test_any_document_is_read_again_as_it_was(tmp_path, described):
    described = json.loads(json.dumps(described))
    (tmp_path / "one.json").write_text(json.dumps(described), encoding="utf-8")
    before = hullplate.read(tmp_path / "one.json")
    hullplate.write(before, tmp_path / "two.json")
    again = hullplate.read(tmp_path / "two.json")
    assert bits(again) == bits(before)
    told = json.loads((tmp_path / "two.json").read_text(encoding="utf-8"))
    assert told["units"] == described["units"]
    plate = keys(described["plates"][0])
    assert {key for key in plate if key not in told["plates"][0]} <= {"sizes"}


def test_an_edit_is_in_the_file(tmp_path):
    before = read_plates(PLATES[-1])
    edited = redivided(before, before.plates[0].id, 0, 1, 9)
    write_plates(edited, tmp_path / "edited.json")
    assert bits(read_plates(tmp_path / "edited.json")) == bits(edited) != bits(before)


def test_an_edited_document_is_signed_as_its_file_will_be(tmp_path):
    before = read_plates(PLATES[-1])
    edited = hullplate.signed(redivided(before, before.plates[0].id, 0, 1, 9))
    write_plates(edited, tmp_path / "edited.json")
    assert read_plates(tmp_path / "edited.json").input_hash == edited.input_hash != before.input_hash


def test_a_failed_write_leaves_the_old_file(tmp_path, monkeypatch):
    file = tmp_path / "plates.json"
    file.write_text("precious", encoding="utf-8")

    def full(*_: object) -> None:
        raise OSError(28, "No space left on device")

    monkeypatch.setattr("os.replace", full)
    with pytest.raises(FileError, match="nothing was changed"):
        write_plates(read_plates(PLATES[0]), file)
    assert file.read_text(encoding="utf-8") == "precious"
    assert [path.name for path in tmp_path.iterdir()] == ["plates.json"]


def test_plates_are_not_written_to_mesh_files(tmp_path):
    with pytest.raises(FileError, match=r"no plates are written to files with the ending \.vtu"):
        write_plates(read_plates(PLATES[0]), tmp_path / "plates.vtu")


def test_a_written_document_is_laid_out_for_people(tmp_path):
    write_plates(read_plates(PLATES[-1]), tmp_path / "plates.json")
    lines = (tmp_path / "plates.json").read_text(encoding="utf-8").splitlines()
    assert max(map(len, lines)) < 130
    assert len(lines) < 80
