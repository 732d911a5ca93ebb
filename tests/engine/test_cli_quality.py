"""The command quality: what it tells of a mesh, by metrics and by rules, and what it refuses."""

import csv
import io
import json
import subprocess
import sys
from pathlib import Path

import attrs
import numpy as np
import pytest
from hypothesis import given as for_all
from hypothesis import strategies as st

from hullquad.cli import main
from hullquad.cli.decimals import powers_of_ten, put_number, put_whole
from hullquad.cli.element_table import BLOCK
from hullquad.formats import read_mesh, write_mesh
from hullquad.given import given
from hullquad.mesh import Mesh
from hullquad.metrics import METRICS
from hullquad.quality import quality
from hullquad.rules import Level, assess, rule_set, rule_sets
from hullquad.topology import topology

PLATES = Path(__file__).parents[2] / "assets" / "plates"
TABLE_1 = [row for row in METRICS if row.group == "Kniat, Table 1"]


def run(capsys, *arguments) -> tuple[int, str, str]:
    """Exit code, standard output and standard error of a command."""
    code = main([str(argument) for argument in arguments])
    printed = capsys.readouterr()
    return code, printed.out, printed.err


def told(capsys, *arguments):
    code, printed, complaints = run(capsys, "quality", *arguments, "--json")
    assert (code, complaints) == (0, "")
    return json.loads(printed)


def rows_of(text):
    return list(csv.DictReader(io.StringIO(text)))


@pytest.fixture
def meshed(tmp_path, capsys) -> Path:
    """The stiffened hopper partition, meshed and not optimised: many elements fail, some of them given."""
    path = tmp_path / "meshed.vtu"
    plate = PLATES / "hopper_partition_stiffened.json"
    assert run(capsys, "mesh", plate, "-o", path, "--size", "fine", "--mesher", "paper", "--optimizer", "none")[0] == 0
    return path


@pytest.fixture
def squares(tmp_path) -> Path:
    """Squares of 50 mm."""
    path = tmp_path / "squares.vtu"
    write_mesh(grid(3, 50.0), path)
    return path


def grid(across, size, shake=0.0):
    x, y = np.meshgrid(np.arange(across + 1.0), np.arange(across + 1.0))
    points = size * np.stack([x.ravel(), y.ravel(), np.zeros(x.size)], axis=1)
    points += np.random.default_rng(1).uniform(-shake, shake, points.shape) * [1, 1, 0]
    corner = (np.arange(across)[:, None] * (across + 1) + np.arange(across)).reshape(-1, 1)
    elements = (corner + np.array([0, 1, across + 2, across + 1])).astype(np.int32)
    return Mesh(points=points, topology=topology(elements, np.ones(len(points), np.int8)), target_size=size)


def test_the_table_has_a_row_for_each_element(meshed, tmp_path, capsys):
    table = tmp_path / "table.csv"
    assert run(capsys, "quality", meshed, "--csv", table)[0] == 0
    rows = rows_of(table.read_text(encoding="utf-8"))
    mesh = read_mesh(meshed)
    assert list(rows[0]) == ["element", "type", "valid", *(row.key for row in METRICS), "given"]
    assert [int(row["element"]) for row in rows] == mesh.topology.element_labels.tolist()
    triangles = [row for row in rows if row["type"] == "triangle"]
    assert len(triangles) == len(mesh.topology.triangles) > 0
    assert all(row["stretch"] == "" and row["shape"] and row["valid"] == "true" for row in triangles)
    _, printed, _ = run(capsys, "quality", meshed, "--csv", "-")
    assert printed == table.read_text(encoding="utf-8")


def test_values_in_the_table_are_those_of_the_metrics_to_the_last_bit(meshed, capsys):
    rows = rows_of(run(capsys, "quality", meshed, "--csv", "-")[1])
    mesh = read_mesh(meshed)
    for row in METRICS:
        expected = quality(mesh, row).values.tolist()
        kinds = mesh.topology.is_triangle if row.triangles is None else np.zeros(len(expected), bool)
        written = ["" if is_blank else repr(value) for value, is_blank in zip(expected, kinds, strict=True)]
        assert [line[row.key] for line in rows] == written


def test_the_table_goes_on_over_its_blocks(tmp_path, capsys):
    across = int(np.sqrt(2.5 * BLOCK)) + 1
    path = tmp_path / "large.vtu"
    mesh = grid(across, 100.0, shake=20.0)
    write_mesh(mesh, path)
    rows = run(capsys, "quality", path, "--csv", "-")[1].splitlines()
    assert len(rows) == across**2 + 1
    column = rows[0].split(",").index("relative_size")  # relative to all elements, not to those of the block
    expected = quality(mesh, METRICS[column - 3]).values
    assert [float(row.split(",")[column]) for row in rows[1:]] == expected.tolist()


def test_the_table_tells_what_is_given_and_the_verdict(meshed, capsys):
    mesh = read_mesh(meshed)
    found = assess(mesh, rule_set("csr_bc_2014_fine"))
    rows = rows_of(run(capsys, "quality", meshed, "--csv", "-", "--rules", "csr_bc_2014_fine")[1])
    assert list(rows[0])[-2:] == ["given", "verdict"]
    assert [row["verdict"] for row in rows] == [Level(level).name.lower() for level in found.levels]
    assert [row["given"] == "true" for row in rows] == found.given.tolist()
    assert {row["given"] for row in rows} == {"true", "false"}
    plain = rows_of(run(capsys, "quality", meshed, "--csv", "-")[1])
    stuck = np.any([given(mesh, quality(mesh, row)) for row in TABLE_1], axis=0)
    outside = np.any([quality(mesh, row).failing for row in TABLE_1], axis=0)
    assert [row["given"] == "true" for row, is_out in zip(plain, outside, strict=True) if is_out] == stuck[
        outside
    ].tolist()


def test_people_get_a_table_of_all_metrics(meshed, capsys):
    code, printed, _ = run(capsys, "quality", meshed)
    assert code == 0
    assert all(row.title in printed for row in METRICS)
    assert max(len(line) for line in printed.splitlines()) <= 130


def test_people_are_told_violations_by_rule_and_what_was_not_evaluated(meshed, capsys):
    _, printed, _ = run(capsys, "quality", meshed, "--rules", "csr_fine")
    found = assess(read_mesh(meshed), rule_set("csr_fine"))
    for finding in found.findings:
        assert finding.rule.title in printed
    assert " ".join(printed.split()).count("the mesh does not tell") == 3
    (line,) = [
        line for line in printed.splitlines() if line.startswith("  Longest edge [mm]") and line.endswith("read")
    ]
    longest = found.findings[1]
    label = read_mesh(meshed).topology.element_labels[longest.rows[0]]
    assert line.split()[-6:] == [
        "0",
        str(longest.count(Level.ERROR)),
        str(int(longest.given.sum())),
        f"{longest.values[longest.rows[0]]:.4g}",
        str(label),
        "read",
    ]


def test_limits_that_were_not_read_are_marked(meshed, capsys):
    _, printed, _ = run(capsys, "quality", meshed, "--rules", "bv")
    marked = [line for line in printed.splitlines() if line.endswith("unverified")]
    assert len(marked) == sum(1 for rule in rule_set("bv").rules if rule.measure)


def test_programs_are_told_the_spread_by_every_metric(meshed, capsys):
    figures = told(capsys, meshed)
    mesh = read_mesh(meshed)
    assert list(figures["metrics"]) == [row.key for row in METRICS]
    assert list(figures["seconds"]) == ["import", "prepare", "judge"]
    for row in METRICS:
        judged, found = quality(mesh, row), figures["metrics"][row.key]
        shown = np.sort(judged.values[judged.is_on_scale])
        label = mesh.topology.element_labels.tolist().index(found["worst_element"])
        assert judged.values[label] == judged.worst == found["worst"]
        assert (found["min"], found["max"], found["mean"]) == (shown[0], shown[-1], pytest.approx(judged.mean))
        assert (shown < found["p05"]).mean() <= 0.05 <= (shown <= found["p05"]).mean() + 1 / len(shown)
        assert (shown < found["p95"]).mean() <= 0.95 <= (shown <= found["p95"]).mean() + 1 / len(shown)
        assert found["failing"] == judged.failing_count
        assert found["failing_share"] == judged.failing_count / len(judged.values)
        assert found["given"] == given(mesh, judged).sum()


@pytest.mark.parametrize("key", [found.key for found in rule_sets()])
def test_programs_are_told_what_the_rules_say(key, meshed, capsys):
    figures = told(capsys, meshed, "--rules", key)
    found = assess(read_mesh(meshed), rule_set(key))
    rules = figures["rules"]
    assert (rules["key"], rules["title"]) == (key, rule_set(key).title)
    assert figures["elements"] == {level.name.lower(): count for level, count in found.counts.items()}
    assert figures["given"] == found.given.sum()
    for told_of, finding in zip(rules["rules"], found.findings, strict=True):
        assert told_of["status"] == finding.rule.status.value
        assert told_of["not_evaluated"] == finding.not_evaluated
        assert (told_of["warnings"], told_of["errors"], told_of["given"]) == (
            finding.count(Level.WARN), finding.count(Level.ERROR), finding.given.sum(),
        )  # fmt: skip


def test_violations_end_with_three_only_where_that_was_asked_for(meshed, squares, capsys):
    for path, rules, fail_on, code in (
        (meshed, "csr_fine", None, 0),
        (meshed, "csr_fine", "error", 3),
        (meshed, "msc_nastran", "error", 0),
        (meshed, "msc_nastran", "warn", 3),
        (meshed, None, "error", 3),
        (squares, "csr_fine", "warn", 0),
        (squares, None, "error", 0),
        (squares, None, "warn", 0),
    ):
        options = [*(["--rules", rules] if rules else []), *(["--fail-on", fail_on] if fail_on else [])]
        assert run(capsys, "quality", path, *options)[0] == code, (path.stem, options)


def test_given_elements_count_when_the_command_fails(tmp_path, capsys):
    """A corner of 34 degrees that no mesh can make larger is still a violation, and is told apart."""
    mesh = grid(1, 100.0)
    points = mesh.points.copy()
    points[[1, 3]] += [0, -150, 0]
    path = tmp_path / "sharp.vtu"
    write_mesh(attrs.evolve(mesh, points=points), path)
    code, printed, _ = run(capsys, "quality", path, "--rules", "kr", "--fail-on", "warn", "--json")
    figures = json.loads(printed)
    assert (code, figures["elements"]["warn"], figures["given"]) == (3, 1, 1)


def test_a_set_of_ones_own_is_taken_from_a_file(squares, tmp_path, capsys):
    yard = tmp_path / "yard.json"
    rules = {"format": "hullquad rules", "version": 1, "title": "Yard", "rules": [
        {"measure": "longest_edge", "error": [None, 40]}]}  # fmt: skip
    yard.write_text(json.dumps(rules), encoding="utf-8")
    assert told(capsys, squares, "--rules", yard)["elements"] == {"ok": 0, "warn": 0, "error": 9}
    assert run(capsys, "quality", squares, "--rules", yard, "--fail-on", "error")[0] == 3


@pytest.mark.parametrize(
    ("rules", "message"),
    [
        ("csr", "error E_RULES at csr: there is no rule set of this name, nor such a file; the rule sets are table_1,"),
        ("none.json", "error E_FILE at none.json: there is no such file"),
        (
            "bad.json",
            "error E_BAND at bad.json#/rules/0/warn: the least acceptable value (2) is above the greatest (1)",
        ),
    ],
)
def test_a_set_that_is_none_is_one_message(rules, message, squares, tmp_path, monkeypatch, capsys):
    monkeypatch.chdir(tmp_path)
    faulty = {"format": "hullquad rules", "version": 1, "title": "x", "rules": [{"measure": "taper", "warn": [2, 1]}]}
    Path("bad.json").write_text(json.dumps(faulty), encoding="utf-8")
    code, printed, complaints = run(capsys, "quality", squares, "--rules", rules)
    assert (code, printed, complaints.count("\n")) == (1, "", 1)
    assert complaints.startswith(message)


FILE = """<VTKFile type="UnstructuredGrid" version="1.0"><UnstructuredGrid>
<Piece NumberOfPoints="{count}" NumberOfCells="{quads}">
<Points><DataArray type="Float64" NumberOfComponents="3" format="ascii">{points}</DataArray></Points>
<Cells><DataArray type="Int64" Name="connectivity" format="ascii">{nodes}</DataArray>
<DataArray type="Int64" Name="offsets" format="ascii">{offsets}</DataArray>
<DataArray type="UInt8" Name="types" format="ascii">{types}</DataArray></Cells>
</Piece></UnstructuredGrid></VTKFile>"""
SQUARE = "0 0 0 1 0 0 1 1 0 0 1 0"


def saved(path, points, nodes):
    """A file of quads with these coordinates and nodes."""
    quads = len(nodes.split()) // 4
    offsets, types = (" ".join(map(str, numbers)) for numbers in (range(4, 4 * quads + 1, 4), [9] * quads))
    filled = {"points": points, "nodes": nodes, "count": len(points.split()) // 3, "quads": quads}
    path.write_text(FILE.format(**filled, offsets=offsets, types=types), encoding="utf-8")
    return path


@pytest.mark.parametrize(
    ("points", "nodes", "message"),
    [
        (SQUARE, "0 1 2 4", "error E_VTU at {path}: element 1 uses point 4"),
        (SQUARE, "0 1 2 -1", "error E_VTU at {path}: element 1 uses point -1"),
        (SQUARE, "0 1 2 2", "error E_MESH at {path}: element 1 uses a node twice"),
        (SQUARE.replace("1 1 0", "1 nan 0"), "0 1 2 3", "error E_MESH at {path}: node 3 has a coordinate"),
        (SQUARE.replace("1 1 0", "1 inf 0"), "0 1 2 3", "error E_MESH at {path}: node 3 has a coordinate"),
        (" ".join(["7 7 7"] * 4), "0 1 2 3", "error E_MESH at {path}: all nodes of the elements are in one place"),
    ],
)
def test_a_mesh_that_is_none_is_one_message_that_names_the_element(points, nodes, message, tmp_path, capsys):
    path = saved(tmp_path / "bad.vtu", points, nodes)
    code, printed, complaints = run(capsys, "quality", path, "--rules", "ansys", "--csv", tmp_path / "t.csv")
    assert (code, printed, complaints.count("\n")) == (1, "", 1)
    assert complaints.startswith(message.format(path=path))
    assert not (tmp_path / "t.csv").exists()


def test_one_element_is_not_told_as_several(tmp_path, capsys):
    printed = run(capsys, "quality", saved(tmp_path / "square.vtu", SQUARE, "0 1 2 3"))[1]
    assert printed.startswith("1 quad, 0 triangles, 4 nodes, 0 inverted, 0 reversed\n")


def test_an_empty_mesh_is_one_message(tmp_path, capsys):
    path = tmp_path / "empty.vtu"
    mesh = grid(1, 1.0)
    write_mesh(attrs.evolve(mesh, topology=topology(np.empty((0, 4), np.int32), np.ones(4, np.int8))), path)
    code, printed, complaints = run(capsys, "quality", path)
    assert (code, printed) == (1, "")
    assert complaints.startswith(f"error E_EMPTY_MESH at {path}")


ODD = {
    "repeated": "0 0 0 0 0 0 1 1 0 0 1 0",
    "collapsed": "0 0 0 1 0 0 1 0 0 0 0 0",
    "collinear": "0 0 0 1 0 0 2 0 0 3 0 0",
    "bow-tie": "0 0 0 1 1 0 1 0 0 0 1 0",
    "concave": "0 0 0 4 0 0 1 1 0 0 4 0",
    "tiny": "0 0 0 1e-20 0 0 1e-20 1e-20 0 0 1e-20 0",
    "huge": "0 0 0 1e12 0 0 1e12 1e12 0 0 1e12 0",
}


def judged(capsys, path, names, rules):
    """Rows of a table; they have a value for every metric, and are errors where the quad is none."""
    code, printed, complaints = run(capsys, "quality", path, "--csv", "-", "--rules", rules)
    assert (code, complaints) == (0, "")
    assert "nan" not in printed
    rows = rows_of(printed)
    for name, row in zip(names, rows, strict=True):
        is_square = name in ("tiny", "huge")
        assert row["valid"] == str(is_square).lower()
        assert (row["verdict"] == "error") >= (not is_square)
        assert all(row[metric.key] for metric in METRICS)
        assert float(row["scaled_jacobian"]) == 1.0 or not is_square
    return rows


@pytest.mark.parametrize("name", ODD)
def test_an_odd_element_alone_has_defined_values(name, tmp_path, capsys):
    path = saved(tmp_path / "odd.vtu", ODD[name], "0 1 2 3")
    judged(capsys, path, [name], "table_1")
    json.loads(run(capsys, "quality", path, "--json")[1])


def test_odd_elements_have_defined_values_by_every_set_of_rules(tmp_path, capsys):
    path = saved(tmp_path / "odd.vtu", " ".join(ODD.values()), " ".join(map(str, range(4 * len(ODD)))))
    for found in rule_sets():
        judged(capsys, path, ODD, found.key)


def test_a_mesh_of_triangles_only_is_judged(tmp_path, capsys):
    mesh = grid(3, 100.0)
    corners = mesh.topology.quads
    halves = [np.pad(corners[:, part], ((0, 0), (0, 1)), constant_values=-1) for part in ([0, 1, 2], [0, 2, 3])]
    path = tmp_path / "triangles.vtu"
    write_mesh(attrs.evolve(mesh, topology=topology(np.concatenate(halves), np.ones(16, np.int8))), path)
    figures = told(capsys, path, "--rules", "csr_fine")
    assert (figures["quads"], figures["triangles"]) == (0, 18)
    assert figures["metrics"]["stretch"]["worst"] == pytest.approx(figures["metrics"]["shape"]["worst"])
    code, printed, _ = run(capsys, "quality", path)
    assert code == 0
    assert "nan" not in printed
    share = next(rule for rule in figures["rules"]["rules"] if rule["measure"] == "triangle_share")
    assert (share["warnings"], share["worst"]) == (18, 1.0)


def written(values):
    text = np.empty(40, dtype=np.uint8)
    bits = np.asarray(values, dtype=np.float64).view(np.uint64)
    return [text[: put_number(word, powers_of_ten(), text, 0)].tobytes().decode() for word in bits]


def test_numbers_read_back_as_they_are():
    rng = np.random.default_rng(4)
    values = rng.integers(0, 2**64, 12_000, dtype=np.uint64).view(np.float64)  # of every size
    lengths = np.round(rng.uniform(-1e4, 1e4, 6000), 3)  # as people write them
    values = np.concatenate([values[~np.isnan(values)], lengths, rng.uniform(0, 1, 6000)])
    for value, text in zip(values.tolist(), written(values), strict=True):
        assert float(text) == value
        assert text == repr(value) or abs(value) <= 1e-320


def test_numbers_where_digits_change_are_written_like_pythons():
    powers = 2.0 ** np.arange(-1060, 1024)
    tens = np.array([float(f"1e{power}") for power in range(-300, 300)])
    for values in (powers, np.nextafter(powers, np.inf), np.nextafter(powers, 0), tens, np.arange(3000) / 1000):
        assert written(values) == [repr(value) for value in values.tolist()]


def test_what_is_no_number_is_left_empty():
    assert written([np.nan, np.inf, -np.inf, -0.0]) == ["", "inf", "-inf", "-0.0"]


@for_all(st.integers(-(2**63) + 1, 2**63 - 1))
def test_whole_numbers_are_written_whole(number):
    text = np.empty(40, dtype=np.uint8)
    assert text[: put_whole(np.int64(number), text, 0)].tobytes().decode() == str(number)


def test_a_reader_who_has_seen_enough_is_no_error(meshed):
    command = f"{sys.executable} -m hullquad quality {meshed} --csv - | head -1"
    done = subprocess.run(["sh", "-c", command], capture_output=True, text=True, check=True)
    assert (done.stdout[:8], done.stderr) == ("element,", "")
