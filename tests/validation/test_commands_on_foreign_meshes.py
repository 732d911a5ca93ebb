"""The commands on meshes that another program (VTK) has written."""

import json
from pathlib import Path

import numpy as np
import pytest
import pyvista

from hullquad.cli import main
from hullquad.formats import read_mesh
from hullquad.metrics import METRICS
from hullquad.optimization.facets import facets
from hullquad.optimization.footing import bring_back, footing
from hullquad.topology import NodeState

SQUARES = 6


def run(capsys, *arguments) -> tuple[int, str, str]:
    """Exit code, standard output and standard error of a command."""
    code = main([str(argument) for argument in arguments])
    printed = capsys.readouterr()
    return code, printed.out, printed.err


def figures(capsys, *arguments) -> dict[str, object]:
    code, printed, _ = run(capsys, *arguments, "--json")
    assert code == 0
    return json.loads(printed)


def squares() -> tuple[np.ndarray, np.ndarray]:
    """Points and quads of a flat mesh with displaced nodes inside."""
    x, y = np.meshgrid(np.arange(SQUARES + 1.0), np.arange(SQUARES + 1.0))
    points = 100 * np.stack([x.ravel(), y.ravel(), 0 * x.ravel()], axis=1)
    inner = ((points[:, :2] > 0) & (points[:, :2] < 100 * SQUARES)).all(axis=1)
    points[inner, :2] += np.random.default_rng(1).uniform(-30, 30, (inner.sum(), 2))
    corner = np.arange(len(points)).reshape(x.shape)
    quads = np.stack([corner[:-1, :-1], corner[:-1, 1:], corner[1:, 1:], corner[1:, :-1]], axis=-1).reshape(-1, 4)
    return points, quads


def saved(path: Path, points: np.ndarray, quads: np.ndarray) -> Path:
    cells = np.insert(quads, 0, 4, axis=1).ravel()
    pyvista.UnstructuredGrid(cells, np.full(len(quads), pyvista.CellType.QUAD), points).save(path)
    return path


def test_warped_quads_are_judged_and_optimised_on_their_own_facets(tmp_path, capsys):
    points, quads = squares()
    points[:, 2] = np.random.default_rng(3).uniform(0, 9, len(points))
    warped, out = saved(tmp_path / "warped.vtu", points, quads), tmp_path / "out.vtu"
    told = figures(capsys, "quality", warped)
    assert (told["quads"], told["inverted"], told["triangles_unavoidable"]) == (SQUARES**2, 0, None)
    assert told["metrics"].keys() == {row.key for row in METRICS}
    run_told = figures(capsys, "optimize", warped, "-o", out)
    assert run_told["objective_after"] > run_told["objective_before"]
    before, after = read_mesh(warped), read_mesh(out)
    feet, count = after.points.copy(), len(after.points)
    surface = facets(before.points, before.topology.elements)
    bring_back(surface, footing(surface, np.arange(count), count), feet)
    away = np.linalg.norm(feet - after.points, axis=1)
    assert away.max() < 1e-3 * before.target_size
    held = ~before.topology.is_free
    np.testing.assert_array_equal(after.points[held], before.points[held])


def test_the_papers_method_wants_a_flat_mesh(tmp_path, capsys):
    points, quads = squares()
    points[:, 2] = np.random.default_rng(3).uniform(0, 9, len(points))
    warped = saved(tmp_path / "warped.vtu", points, quads)
    code, _, complaints = run(capsys, "optimize", warped, "-o", tmp_path / "out.vtu", "--optimizer", "paper")
    assert code == 1
    assert complaints.startswith(f"error E_CURVED at {warped}: the mesh is not flat")


@pytest.mark.parametrize("height", [0.0, 5000.0])
def test_points_without_elements_stay_and_do_not_count(height, tmp_path, capsys):
    points, quads = squares()
    mesh = saved(tmp_path / "mesh.vtu", np.vstack([points, [[50, 50, height]]]), quads)
    told = figures(capsys, "optimize", mesh, "-o", tmp_path / "out.vtu")
    assert told["free"] == (SQUARES - 1) ** 2
    assert told["objective_after"] > told["objective_before"]
    assert read_mesh(tmp_path / "out.vtu").points[-1].tolist() == [50, 50, height]


def test_a_mesh_of_which_only_an_unused_point_could_move_has_no_free_nodes(tmp_path, capsys):
    points, _ = squares()
    mesh = saved(tmp_path / "mesh.vtu", points, np.array([[0, 1, SQUARES + 2, SQUARES + 1]]))
    told = figures(capsys, "optimize", mesh, "-o", tmp_path / "out.vtu")
    assert (told["free"], told["stop"]) == (0, "no_free_nodes")


@pytest.mark.parametrize("turned", [(), (7, 14, 21, 28)])
def test_a_run_tells_of_a_bare_mesh_what_quality_tells(turned, tmp_path, capsys):
    points, quads = squares()
    quads[list(turned)] = quads[list(turned), ::-1]
    mesh, out = saved(tmp_path / "mesh.vtu", points, quads), tmp_path / "out.vtu"
    told = figures(capsys, "optimize", mesh, "-o", out, "--iterations", "30")
    before, after = figures(capsys, "quality", mesh), figures(capsys, "quality", out)
    assert told["objective_after"] > told["objective_before"]
    assert told["worst_before"] == before["metrics"]["stretch"]["worst"]
    assert told["worst_after"] == after["metrics"]["stretch"]["worst"]
    assert told["failing_before"] == before["metrics"]["stretch"]["failing"]
    for key in ("inverted", "reversed", "triangles_unavoidable", "free"):
        assert told[key] == after[key] == before[key]
    assert (told["inverted"], told["reversed"]) == (0, len(turned))
    assert read_mesh(out).surface is None
    assert (read_mesh(out).topology.node_states == NodeState.CONTOUR).sum() == 4 * SQUARES
