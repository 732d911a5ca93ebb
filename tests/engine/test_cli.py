"""The commands: what they write, print and refuse, and with which exit code."""

import contextlib
import json
import os
import re
import signal
import subprocess
import sys
import time
from collections.abc import Callable
from pathlib import Path
from typing import Any

import attrs
import numpy as np
import pytest

from hullquad import pipeline
from hullquad.cli import main
from hullquad.formats import read_mesh, read_plates
from hullquad.optimizers import OPTIMIZERS
from hullquad.topology import NodeState
from hullquad.triangulation.contour import Contour, attempts
from hullquad.triangulation.refusals import expected_triangles, sound_region

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
def several(tmp_path) -> Callable[..., Path]:
    """Write the hopper partition several times into a document, each with what is changed in it."""

    def write(*changes: dict[str, Any]) -> Path:
        document = json.loads((PLATES / "hopper_partition.json").read_text(encoding="utf-8"))
        document["plates"] = [document["plates"][0] | {"id": f"P{i}"} | change for i, change in enumerate(changes)]
        path = tmp_path / "several.json"
        path.write_text(json.dumps(document), encoding="utf-8")
        return path

    return write


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


@pytest.mark.parametrize(("mesher", "count"), [("paper", 1), ("best", 0)])
def test_it_is_told_which_triangles_are_left_beside_the_unavoidable_ones(mesher, count, tmp_path, capsys):
    arguments = (
        "mesh",
        PLATES / "floor_manholes.json",
        "-o",
        tmp_path / "o.vtu",
        "--mesher",
        mesher,
        "--size",
        "coarse",
    )
    code, _, complaints = run(capsys, *arguments, "--optimizer", "none")
    assert code == 0
    assert complaints.count("warning W_TRIANGLES at /plates/0: ") == count
    assert complaints.count("the paper's mesher leaves those that find no partner") == count


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
    assert complaints.startswith("error E_CURVED at /plates/2: plate BL: curved surfaces: not yet")
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
        ["mesh", "plate.json", "-o", "out.vtu", "--size", "1e155"],
        ["mesh", "plate.json", "-o", ""],
        ["quality", "mesh.vtu", "--csv", "-", "--json"],
        ["quality", "mesh.vtu", "--csv", ""],
        ["quality", "mesh.vtu", "--rules", ""],
        ["quality", "mesh.vtu", "--fail-on", "ok"],
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

    mesh_really = pipeline.best_mesh

    def crash_once(contour, *settings):
        if contour.plate.id == "B2":
            raise WorkerError("E_CRASH", contour.plate.place, ending="signal 11")
        return mesh_really(contour, *settings)

    monkeypatch.setattr(pipeline, "best_mesh", crash_once)
    out = tmp_path / "block.vtu"
    code, _, complaints = run(capsys, "mesh", PLATES / "hopper_block.json", "-o", out, "--optimizer", "none")
    assert code == 1
    (crash,) = [line for line in complaints.splitlines() if "E_CRASH" in line]
    assert re.match(r"error E_CRASH at /plates/\d+: plate B2: the computation crashed", crash)
    assert len(list(tmp_path.iterdir())) == 12


def test_a_bad_plate_is_refused_and_the_others_are_meshed(several, tmp_path, capsys):
    plates = several({"thickness": 0, "target_size": 0}, {}, {"outer": []}, {"thickness": 7})
    out = tmp_path / "out.vtu"
    code, printed, complaints = run(capsys, "mesh", plates, "-o", out, "--optimizer", "none", "--json")
    assert code == 1
    assert [figures["plate"] for figures in json.loads(printed)] == ["P1", "P3"]
    first, second = complaints.splitlines()
    assert re.match(r"error E_THICKNESS at /plates/0/thickness: plate P0: .*\(and 1 more error\)$", first)
    assert second.startswith("error E_OUTER at /plates/2/outer: plate P2: ")
    assert sorted(path.name for path in tmp_path.glob("*.vtu")) == ["out-P1.vtu", "out-P3.vtu"]


def test_a_plate_asked_for_does_not_suffer_from_the_others(several, tmp_path, capsys):
    plates = several({"thickness": 0}, {})
    out = tmp_path / "out.vtu"
    arguments = ["mesh", plates, "-o", out, "--optimizer", "none", "--json", "--plate"]
    code, printed, complaints = run(capsys, *arguments, "P1")
    assert (code, complaints, json.loads(printed)["plate"]) == (0, "", "P1")
    out.unlink()
    code, printed, complaints = run(capsys, *arguments, "P0")
    assert (code, printed, complaints.count("\n"), out.exists()) == (1, "", 1, False)


def test_what_concerns_the_whole_document_refuses_all_plates(several, tmp_path, capsys):
    plates = several({}, {"id": "P0"})
    code, printed, complaints = run(capsys, "mesh", plates, "-o", tmp_path / "out.vtu")
    assert (code, printed, complaints.count("\n")) == (1, "", 1)
    assert complaints.startswith("error E_DUP_ID at /plates/1/id")
    assert not list(tmp_path.glob("*.vtu"))


def test_a_plate_of_several_that_alone_is_sound_is_still_listed(several, tmp_path, capsys):
    _, printed, _ = run(capsys, "mesh", several({}, {"thickness": 0}), "-o", tmp_path / "out.vtu", "--json")
    assert [figures["plate"] for figures in json.loads(printed)] == ["P0"]


def test_warnings_are_those_of_the_size_asked_for(several, tmp_path, capsys):
    plates, out = several({}), tmp_path / "out.vtu"
    codes = {}
    for size in ("790", "800"):
        _, _, complaints = run(capsys, "mesh", plates, "-o", out, "--size", size, "--optimizer", "none")
        codes[size] = re.findall(r"W_ODD.* with segments of (\d+) mm", complaints)
    assert codes == {"790": ["790"], "800": []}


@pytest.mark.parametrize("size", ["1", "0.001"])
def test_too_small_a_size_is_told_one_that_works(size, tmp_path, capsys):
    plate, out = PLATES / "hopper_block.json", tmp_path / "out.vtu"
    code, _, complaints = run(capsys, "mesh", plate, "-o", out, "--plate", "G2", "--size", size)
    assert code == 1
    told = re.match(r"error E_TOO_BIG at --size: plate G2: .* choose (\S+) mm or more", complaints)[1]
    contour = attempts(read_plates(plate), float(told))["G2"]
    assert isinstance(contour, Contour)
    assert pipeline_limit_holds(contour)


def pipeline_limit_holds(contour: Contour) -> bool:
    region = sound_region(contour.nodes, contour.loop_starts, "")
    return expected_triangles(region, pipeline.TRIANGLE_AREA * contour.size**2) < pipeline._MOST_TRIANGLES


def test_the_kernels_are_loaded_once_for_all_plates(several, tmp_path, capsys, monkeypatch):
    prepared = []
    prepare = pipeline.prepare
    monkeypatch.setattr(pipeline, "prepare", lambda: prepared.append(prepare()))
    _, printed, _ = run(capsys, "mesh", several({}, {}), "-o", tmp_path / "out.vtu", "--json", "--iterations", "1")
    assert len(prepared) == 1
    first, second = (figures["seconds"] for figures in json.loads(printed))
    assert first["prepare"] > second["prepare"] == 0
    assert min(first["mesh"], second["mesh"], second["optimize"]) > 0


def command(*arguments: object) -> list[str]:
    return [sys.executable, "-m", "hullquad", *map(str, arguments)]


def test_a_reader_who_leaves_does_not_stop_the_work(several, tmp_path):
    arguments = command("mesh", several(*[{}] * 12), "-o", tmp_path / "m.vtu", "--optimizer", "none")
    running = subprocess.Popen(arguments, stdout=subprocess.PIPE, stderr=subprocess.PIPE)
    running.stdout.readline()
    running.stdout.close()
    assert running.stderr.read().count(b"error") == 0
    assert running.wait(60) == 0
    assert len(list(tmp_path.glob("*.vtu"))) == 12
    running.stderr.close()


@pytest.mark.parametrize(("redirected", "code"), [(">&-", 0), ("2>&-", 0), (">&- 2>&- <&-", 0), (">/dev/full", 1)])
def test_streams_that_are_closed_or_full_do_not_stop_the_work(redirected, code, meshed, tmp_path):
    out = tmp_path / "out.vtu"
    arguments = command("optimize", meshed, "-o", out, "--iterations", "1")
    done = subprocess.run(["sh", "-c", f'"$@" {redirected}', "sh", *arguments], capture_output=True)
    assert done.returncode == code
    assert len(read_mesh(out).points)
    said = done.stderr.decode().splitlines()
    assert [line.startswith("error E_FILE at standard output: ") for line in said] == [True] * code


def test_help_to_a_full_disk_is_one_message():
    done = subprocess.run(["sh", "-c", '"$@" >/dev/full', "sh", *command("--help")], capture_output=True)
    assert (done.returncode, done.stderr.count(b"\n")) == (1, 1)


@pytest.mark.parametrize("encoding", ["ascii", "cp1252", "utf-8"])
def test_every_name_can_be_printed_in_every_encoding(encoding, several, tmp_path):
    out = tmp_path / "out.vtu"
    arguments = command("mesh", several({"id": "ГÖ_Ω"}), "-o", out, "--optimizer", "none")
    done = subprocess.run(arguments, capture_output=True, env={**os.environ, "PYTHONIOENCODING": encoding})
    assert (done.returncode, done.stderr) == (0, b"")
    assert out.exists()
    assert done.stdout.startswith("ГÖ_Ω: ".encode(encoding, "backslashreplace"))


def interrupted(running: subprocess.Popen) -> bytes:
    """What a program has to say when it is interrupted until it ends: Python loses an interrupt now and then."""
    for _ in range(10):
        running.send_signal(signal.SIGINT)
        with contextlib.suppress(subprocess.TimeoutExpired):
            return running.communicate(timeout=1)[1]
    raise AssertionError("it goes on")


@pytest.mark.parametrize("after", [0.15, 0.3, 0.45, 0.6])
def test_an_interrupt_while_libraries_load_is_quiet(after, tmp_path):
    arguments = command("mesh", PLATES / "hopper_block.json", "-o", tmp_path / "out.vtu", "--size", "fine")
    running = subprocess.Popen(
        arguments,
        stdout=subprocess.DEVNULL,
        stderr=subprocess.PIPE,
        preexec_fn=lambda: signal.signal(signal.SIGINT, signal.default_int_handler),
    )
    time.sleep(after)
    complaints = interrupted(running)
    lines = complaints.decode().splitlines()
    assert (running.returncode, [line for line in lines if not line.startswith("warning W_ODD")]) == (130, [])


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


@pytest.mark.parametrize("mesher", ["best", "paper"])
def test_a_terminal_is_told_what_goes_on_and_left_clean(mesher, tmp_path, capsys, monkeypatch):
    monkeypatch.setattr("hullquad.cli.streams.Stream.isatty", lambda stream: True)
    monkeypatch.setattr("hullquad.cli.output._PAUSE", 0.0)
    plate = PLATES / "hopper_partition.json"
    code, _, told = run(capsys, "mesh", plate, "-o", tmp_path / "a.vtu", "--mesher", mesher, "--optimizer", "none")
    assert code == 0
    lines = [line.removesuffix("\x1b[K") for line in told.split("\r")]
    doing = [line for line in lines if line.endswith(" …")]
    assert [line.split()[0] for line in doing] == ["reading", "dividing", "preparing;", "hopper_partition:"]
    candidates = [line for line in lines if re.fullmatch(r"hopper_partition: meshing, candidate \d of \d, \d+ s", line)]
    assert bool(candidates) == (mesher == "best")
    assert all(told.startswith("\x1b[K", told.index("\r", told.index(title) + 1) + 1) for title in doing[:3])
    assert lines[-1] == "" or lines[-1].startswith("\x1b[Kwarning ")


def test_nothing_goes_on_where_nobody_watches(tmp_path, capsys):
    plate = PLATES / "hopper_partition.json"
    assert run(capsys, "mesh", plate, "-o", tmp_path / "a.vtu", "--optimizer", "none")[2] == ""


@pytest.mark.parametrize("optimizer", [row.key for row in OPTIMIZERS])
def test_every_optimizer_improves_a_mesh(optimizer, meshed, tmp_path, capsys):
    words = ["optimize", meshed, "-o", tmp_path / "out.vtu", "--optimizer", optimizer, "--metric", "shape", "--json"]
    code, printed, _ = run(capsys, *words, *(["--rules", "bv"] if optimizer == "rules" else []))
    told = json.loads(printed)
    assert code == 0
    assert told["inverted"] == 0
    assert told["stop"] is not None
    assert (
        read_mesh(tmp_path / "out.vtu").topology.node_states.tolist() == read_mesh(meshed).topology.node_states.tolist()
    )
    if optimizer in {"default", "fine", "paper"}:
        assert told["objective_after"] > told["objective_before"]
    if optimizer in {"worst", "worst_quad"}:
        assert told["worst_after"] >= told["worst_before"]


@pytest.mark.parametrize(
    ("words", "complaint"),
    [
        (["--metric", "stretch=0"], "weight 0 is no number above 0"),
        (["--metric", "corner_angle"], "the sum of this metric tells nothing"),
        (["--floor", "1.5"], "'1.5' is not a scaled Jacobian"),
        (["--time", "-1"], "'-1' is not a time"),
        (["--optimizer", "rules"], "--optimizer rules needs --rules"),
        (["--optimizer", "worst", "--no-guard"], "--no-guard goes with --optimizer paper"),
    ],
)
def test_options_of_a_run_that_make_no_sense_are_wrong_usage(words, complaint, meshed, tmp_path, capsys):
    code, _, complaints = run(capsys, "optimize", meshed, "-o", tmp_path / "out.vtu", *words)
    assert code == 2
    assert complaint in complaints
    assert not (tmp_path / "out.vtu").exists()


def test_an_unknown_rule_set_is_refused_with_the_known_ones(meshed, tmp_path, capsys):
    words = ["optimize", meshed, "-o", tmp_path / "out.vtu", "--optimizer", "rules", "--rules", "lloyds"]
    code, _, complaints = run(capsys, *words)
    assert code == 1
    assert "csr_fine" in complaints


def test_a_run_without_time_gives_its_input_back(meshed, tmp_path, capsys):
    code, printed, _ = run(capsys, "optimize", meshed, "-o", tmp_path / "out.vtu", "--time", "0", "--json")
    assert (code, json.loads(printed)["stop"]) == (0, "time")
    np.testing.assert_array_equal(read_mesh(tmp_path / "out.vtu").points, read_mesh(meshed).points)


@pytest.mark.parametrize(("mesher", "has_triangles"), [("best", False), ("paper", True)])
def test_the_mesher_is_chosen(mesher, has_triangles, tmp_path, capsys):
    out, plates = tmp_path / "out.vtu", PLATES / "floor_manholes.json"
    code, said, _ = run(capsys, "mesh", plates, "-o", out, "--mesher", mesher, "--optimizer", "none", "--json")
    assert code == 0
    assert (json.loads(said)["triangles"] > 0) is has_triangles


@pytest.mark.parametrize("mesher", ["best", "paper"])
def test_elements_follow_stiffeners_when_asked_to(mesher, tmp_path, capsys):
    out = tmp_path / "out.vtu"
    plate = PLATES / "hatch_corner.json"
    arguments = ("mesh", plate, "-o", out, "--mesher", mesher, "--follow-stiffeners", "--optimizer", "none", "--json")
    code, printed, _ = run(capsys, *arguments)
    assert code == 0
    assert json.loads(printed)["triangles_unavoidable"] == 0
    assert (read_mesh(out).topology.node_states == NodeState.ON_LINE).any()


@pytest.mark.parametrize("value", ["0", "3", "steep"])
def test_a_grading_that_is_none_is_wrong_usage(value, tmp_path, capsys):
    code, _, complaints = run(
        capsys, "mesh", PLATES / "floor_manholes.json", "-o", tmp_path / "out.vtu", "--grading", value
    )
    assert code == 2
    assert f"'{value}' is no number from 0.05 to 2" in complaints
