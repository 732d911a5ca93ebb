"""The commands: what they write, print and refuse, and with which exit code."""

import csv
import json
import os
import signal
import subprocess
import sys
from pathlib import Path

import attrs
import numpy as np
import pytest

from hullquad.cli import main
from hullquad.formats import read_mesh, write_mesh
from hullquad.metrics import METRICS
from hullquad.topology import NodeState

PLATES = Path(__file__).parents[2] / "assets" / "plates"
BAD = Path(__file__).parents[1] / "data" / "bad-plates"
EXPECTED = json.loads((BAD / "expected.json").read_text(encoding="utf-8"))
KEYS = (
    "plate quads triangles triangles_unavoidable nodes free inverted reversed metric objective_before objective_after "
    "worst_before worst_after failing_before failing_after iterations stop seconds"
)


def run(capsys, *arguments) -> tuple[int, str, str]:
    """Exit code, standard output and standard error of a command."""
    code = main([str(argument) for argument in arguments])
    printed = capsys.readouterr()
    return code, printed.out, printed.err


@pytest.fixture
def meshed(tmp_path, capsys) -> Path:
    """The stiffened hopper partition, meshed and not optimised."""
    path = tmp_path / "meshed.vtu"
    plate = PLATES / "hopper_partition_stiffened.json"
    assert run(capsys, "mesh", plate, "-o", path, "--optimizer", "none")[0] == 0
    return path


@pytest.fixture
def warped(tmp_path, dented) -> Path:
    """A mesh of another program whose quads are not flat."""
    points = dented.points + np.random.default_rng(3).uniform(0, 9, (16, 1)) * [0, 0, 1]
    path = tmp_path / "warped.vtu"
    write_mesh(attrs.evolve(dented, points=points, surface=None, parameters=None), path)
    text = path.read_text(encoding="utf-8")
    for name in ("hullquad version", "node state", "node line"):
        text = text.replace(f'Name="{name}"', f'Name="foreign {name}"')
    path.write_text(text, encoding="utf-8")
    return path


def test_a_plate_is_meshed_and_its_figures_are_told(tmp_path, capsys):
    out = tmp_path / "out.vtu"
    code, printed, complaints = run(capsys, "mesh", PLATES / "hopper_partition.json", "-o", out, "--json")
    assert (code, complaints) == (0, "")
    figures = json.loads(printed)
    assert " ".join(figures) == KEYS
    assert list(figures["seconds"]) == ["import", "prepare", "mesh", "optimize"]
    mesh = read_mesh(out)
    assert figures["quads"] == len(mesh.topology.quads)
    assert figures["free"] == mesh.topology.is_free.sum()
    assert figures["plate"] == mesh.plate_id == "hopper_partition"
    assert figures["objective_after"] > figures["objective_before"]
    assert mesh.input_hash
    assert mesh.target_size == 1000


def test_people_are_told_the_unavoidable_triangles_first(tmp_path, capsys):
    _, printed, _ = run(capsys, "mesh", PLATES / "hopper_partition.json", "-o", tmp_path / "o.vtu", "--size", "790")
    assert printed.splitlines()[0] == "hopper_partition: 25 contour edges, unavoidable triangles: 1"


@pytest.mark.parametrize(("size", "target"), [("fine", 250), ("400", 400), ("coarse", 1000)])
def test_the_size_is_a_name_or_a_length(size, target, tmp_path, capsys):
    out = tmp_path / "out.vtu"
    plate = PLATES / "hopper_partition.json"
    assert run(capsys, "mesh", plate, "-o", out, "--size", size, "--optimizer", "none")[0] == 0
    assert read_mesh(out).target_size == target


def test_a_block_is_written_plate_by_plate_and_the_curved_one_refused(tmp_path, capsys):
    out = tmp_path / "block.vtu"
    code, printed, complaints = run(
        capsys, "mesh", PLATES / "hopper_block.json", "-o", out, "--json", "--optimizer", "none"
    )
    assert code == 1
    assert complaints.startswith("error E_CURVED at BL: curved surfaces: not yet")
    assert complaints.count("\n") == 1
    written = {path.name for path in tmp_path.iterdir()}
    plates = [figures["plate"] for figures in json.loads(printed)]
    assert len(plates) == 13
    assert written == {f"block-{plate}.vtu" for plate in plates}


def test_one_plate_of_a_block_goes_into_the_file_asked_for(tmp_path, capsys):
    out = tmp_path / "one.vtu"
    code, printed, _ = run(capsys, "mesh", PLATES / "hopper_block.json", "-o", out, "--plate", "G2", "--json")
    assert code == 0
    assert json.loads(printed)["plate"] == read_mesh(out).plate_id == "G2"
    code, _, complaints = run(capsys, "mesh", PLATES / "hopper_block.json", "-o", out, "--plate", "G9")
    assert code == 1
    assert "no plate G9" in complaints


@pytest.mark.parametrize("name", EXPECTED)
def test_a_bad_document_is_one_message_with_code_and_place(name, tmp_path, capsys):
    code, printed, complaints = run(capsys, "mesh", BAD / name, "-o", tmp_path / "out.vtu")
    assert (code, printed, complaints.count("\n")) == (1, "", 1)
    said, place = complaints.split(": ", 1)[0].removeprefix("error ").split(" at ")
    assert said in EXPECTED[name]["codes"]
    assert place == EXPECTED[name]["at"] or EXPECTED[name]["at"] == ""
    assert list(tmp_path.iterdir()) == []


@pytest.mark.parametrize("command", ["optimize", "quality", "mesh"])
@pytest.mark.parametrize("content", [None, b"", b"\xff\xfe\x00", b"<VTKFile", b"[1, 2"])
def test_a_file_that_is_none_is_one_message(command, content, tmp_path, capsys):
    path = tmp_path / ("in.json" if command == "mesh" else "in.vtu")
    if content is not None:
        path.write_bytes(content)
    output = [] if command == "quality" else ["-o", tmp_path / "out.vtu"]
    code, printed, complaints = run(capsys, command, path, *output)
    assert (code, printed, complaints.count("\n")) == (1, "", 1)
    assert complaints.startswith("error E_")
    assert not (tmp_path / "out.vtu").exists()


@pytest.mark.parametrize(
    "arguments",
    [
        [],
        ["mend"],
        ["mesh", "plate.json"],
        ["mesh", "plate.json", "-o", "out.stl"],
        ["mesh", "plate.json", "-o", "out.vtu", "--size", "0"],
        ["mesh", "plate.json", "-o", "out.vtu", "--size", "nan"],
        ["mesh", "plate.json", "-o", "out.vtu", "--metric", "beauty"],
        ["optimize", "mesh.vtu", "-o", "out.vtu", "--iterations", "-1"],
        ["optimize", "mesh.vtu", "-o", "out"],
    ],
)
def test_wrong_usage_is_told_before_any_work(arguments, capsys):
    try:
        code = main(arguments)
    except SystemExit as end:
        code = end.code
    assert code == 2
    assert capsys.readouterr().err


def test_optimizing_a_mesh_file_keeps_every_given_bit(meshed, tmp_path, capsys):
    out = tmp_path / "better.vtu"
    code, printed, _ = run(capsys, "optimize", meshed, "-o", out, "--json")
    assert code == 0
    before, after = read_mesh(meshed), read_mesh(out)
    given = before.topology.node_states != NodeState.FREE
    assert (before.topology.node_states == NodeState.FIXED).any()
    assert before.points[given].tobytes() == after.points[given].tobytes()
    assert not np.array_equal(before.points, after.points)
    for field in attrs.fields(type(before.topology)):
        np.testing.assert_array_equal(getattr(before.topology, field.name), getattr(after.topology, field.name))
    assert before.lines.tobytes() == after.lines.tobytes()
    assert (before.plate_id, before.thickness, before.input_hash) == (after.plate_id, after.thickness, after.input_hash)
    figures = json.loads(printed)
    assert figures["triangles_unavoidable"] == 0
    assert figures["objective_after"] > figures["objective_before"]


def test_a_run_that_finds_nothing_writes_its_input(meshed, tmp_path, capsys):
    out = tmp_path / "same.vtu"
    code, printed, _ = run(capsys, "optimize", meshed, "-o", out, "--iterations", "0", "--json")
    assert code == 0
    assert json.loads(printed)["stop"] == "iterations"
    assert out.read_bytes() == meshed.read_bytes()


def test_a_mesh_may_be_written_over_itself(meshed, capsys):
    before = meshed.read_bytes()
    assert run(capsys, "optimize", meshed, "-o", meshed)[0] == 0
    assert meshed.read_bytes() != before


def test_without_the_guard_inverted_elements_are_told(tmp_path, capsys):
    plate, out = PLATES / "hopper_partition_stiffened.json", tmp_path / "out.vtu"
    arguments = ["mesh", plate, "-o", out, "--size", "300", "--metric", "aspect_ratio", "--no-guard"]
    code, printed, _ = run(capsys, *arguments, "--json")
    figures = json.loads(printed)
    assert code == 0
    assert figures["inverted"] > 0
    assert figures["worst_after"] is None
    assert f"inverted elements: {figures['inverted']}" in run(capsys, *arguments)[1]


def test_warped_quads_of_another_program_are_judged_but_not_yet_optimised(warped, tmp_path, capsys):
    code, printed, _ = run(capsys, "quality", warped, "--json")
    assert code == 0
    figures = json.loads(printed)
    assert (figures["quads"], figures["inverted"], figures["triangles_unavoidable"]) == (9, 0, None)
    assert figures["metrics"].keys() == {row.key for row in METRICS}
    code, _, complaints = run(capsys, "optimize", warped, "-o", tmp_path / "out.vtu")
    assert code == 1
    assert "curved surfaces: not yet" in complaints


def test_quality_has_a_row_for_each_element(meshed, tmp_path, capsys):
    table = tmp_path / "table.csv"
    assert run(capsys, "quality", meshed, "--csv", table)[0] == 0
    rows = list(csv.DictReader(table.read_text(encoding="utf-8").splitlines()))
    mesh = read_mesh(meshed)
    assert list(rows[0]) == ["element", "type", "valid", *(row.key for row in METRICS)]
    assert [int(row["element"]) for row in rows] == mesh.topology.element_labels.tolist()
    triangles = [row for row in rows if row["type"] == "triangle"]
    assert len(triangles) == len(mesh.topology.triangles) > 0
    assert all(row["stretch"] == "" and row["shape"] and row["valid"] == "true" for row in triangles)
    _, printed, _ = run(capsys, "quality", meshed, "--csv", "-")
    assert printed == table.read_text(encoding="utf-8")


def test_quality_prints_a_table_for_people(meshed, capsys):
    code, printed, _ = run(capsys, "quality", meshed)
    assert code == 0
    assert all(row.title in printed for row in METRICS)


def test_a_failed_write_leaves_the_old_file(meshed, capsys, monkeypatch):
    before = meshed.read_bytes()

    def full(*_: object) -> None:
        raise OSError(28, "No space left on device")

    monkeypatch.setattr(os, "replace", full)
    code, _, complaints = run(capsys, "optimize", meshed, "-o", meshed)
    assert code == 1
    assert complaints.startswith("error E_FILE")
    assert meshed.read_bytes() == before
    assert [path.name for path in meshed.parent.iterdir()] == [meshed.name]


def test_a_plate_that_crashes_triangle_does_not_stop_the_next(tmp_path, capsys, monkeypatch):
    from hullquad import pipeline
    from hullquad.worker import WorkerError

    mesh_really = pipeline.paper_mesh

    def crash_once(contour, input_hash):
        if contour.plate.id == "B2":
            raise WorkerError("E_CRASH", "B2", ending="signal 11")
        return mesh_really(contour, input_hash)

    monkeypatch.setattr(pipeline, "paper_mesh", crash_once)
    out = tmp_path / "block.vtu"
    code, _, complaints = run(capsys, "mesh", PLATES / "hopper_block.json", "-o", out, "--optimizer", "none")
    assert code == 1
    assert "error E_CRASH at B2" in complaints
    assert len(list(tmp_path.iterdir())) == 12


def test_an_interrupted_command_writes_nothing(tmp_path):
    out = tmp_path / "out.vtu"
    command = [sys.executable, "-m", "hullquad", "mesh", PLATES / "hopper_partition.json", "-o", out]
    running = subprocess.Popen(
        [*command, "--size", "20", "--iterations", "100000000"],
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
    )
    running.stdout.readline()  # the first thing told, before meshing
    running.send_signal(signal.SIGINT)
    _, complaints = running.communicate(timeout=60)
    assert running.returncode == 130
    assert complaints == b""
    assert not out.exists()
