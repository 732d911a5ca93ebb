"""Nodes on followed lines: they move along their line, between its ends, and in their order."""

import attrs
import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from hullquad.mesh import Mesh
from hullquad.metrics import metric
from hullquad.optimization.iterate import outcome
from hullquad.optimization.modes import default_iterates
from hullquad.optimization.objective import objective
from hullquad.optimization.problem import problem
from hullquad.optimization.settings import PaperSettings, SearchSettings
from hullquad.optimizers import OPTIMIZERS, iterates
from hullquad.quality import quality
from hullquad.rules import rule_set
from hullquad.surface import Plane
from hullquad.topology import NodeState, topology

SLANTED = Plane([1e4, -2e3, 5e3], [0.6, 0.8, 0.0], [0.0, 0.0, 1.0])
COLUMNS, ROWS, SIZE = 7, 5, 100.0
AIMS = ("stretch", "shape", "scaled_jacobian", "relative_size", "max_angle")


def crossed(seed: int, shift: float = 0.3) -> Mesh:
    """Quads with two lines across that meet in a fixed node; the nodes on them are not where they ought to be."""
    chance = np.random.default_rng(seed)
    x, y = np.meshgrid(np.arange(COLUMNS), np.arange(ROWS))
    columns, rows = x.ravel(), y.ravel()
    places = SIZE * np.stack([columns + 0.2 * rows, rows + 0.1 * columns], axis=1)
    inner = (columns % (COLUMNS - 1) > 0) & (rows % (ROWS - 1) > 0)
    on_row, on_column = inner & (rows == 2) & (columns != 3), inner & (columns == 3) & (rows != 2)
    states = np.where(inner, NodeState.FREE, NodeState.CONTOUR).astype(np.int8)
    states[inner & (rows == 2) & (columns == 3)] = NodeState.FIXED
    states[on_row | on_column] = NodeState.ON_LINE
    lines = np.full(len(columns), -1)
    lines[on_row & (columns < 3)], lines[on_row & (columns > 3)], lines[on_column] = (
        0,
        1,
        np.where(rows < 2, 2, 3)[on_column],
    )
    node = {(column, row): row * COLUMNS + column for column, row in zip(columns.tolist(), rows.tolist(), strict=True)}
    ends = np.array(
        [[node[0, 2], node[3, 2]], [node[3, 2], node[6, 2]], [node[3, 0], node[3, 2]], [node[3, 2], node[3, 4]]]
    )
    moves = SIZE * chance.uniform(-shift, shift, places.shape)
    ways = places[ends[:, 1]] - places[ends[:, 0]]
    ways /= np.linalg.norm(ways, axis=1, keepdims=True)
    slides = np.flatnonzero(lines >= 0)
    moves[slides] = moves[slides, :1] * ways[lines[slides]]
    places = np.where(inner[:, None] & (states[:, None] != NodeState.FIXED), places + moves, places)
    corner = (np.arange(ROWS - 1)[:, None] * COLUMNS + np.arange(COLUMNS - 1)).reshape(-1, 1)
    return Mesh(
        points=SLANTED.points(places),
        topology=topology((corner + np.array([0, 1, COLUMNS + 1, COLUMNS])).astype(np.int32), states, lines),
        target_size=SIZE,
        surface=SLANTED,
        parameters=places,
        lines=SLANTED.points(places[ends.ravel()]).reshape(-1, 2, 3),
        input_hash="made by hand",
    )


def shares(mesh: Mesh) -> tuple[np.ndarray, np.ndarray]:
    """How far along its line each sliding node is, and how far beside it [mm]."""
    known = mesh.topology
    slides = np.flatnonzero(known.slides)
    starts, ends = mesh.lines[known.node_lines[slides]].swapaxes(0, 1)
    ways = ends - starts
    along = ((mesh.points[slides] - starts) * ways).sum(axis=1) / (ways**2).sum(axis=1)
    return along, np.linalg.norm(mesh.points[slides] - (starts + along[:, None] * ways), axis=1)


def run(key: str, mesh: Mesh, aim: str, stride: int = 7):
    search = SearchSettings(iterations=120, stride=stride)
    return list(iterates(key, mesh, objective(aim), search, PaperSettings(iterations=40), rule_set("bv")))


@pytest.mark.parametrize("key", [row.key for row in OPTIMIZERS])
@settings(max_examples=6)
@given(seed=st.integers(0, 2**32 - 1), aim=st.sampled_from(AIMS))
def test_nodes_on_lines_slide_and_do_nothing_else(key, seed, aim):
    mesh = crossed(seed)
    order = np.lexsort((shares(mesh)[0], mesh.topology.node_lines[mesh.topology.slides]))
    held = ~mesh.topology.is_free
    start = quality(mesh, metric("shape")).inverted_count
    for iterate in run(key, mesh, aim):
        along, beside = shares(iterate.mesh)
        assert beside.max() < 1e-9 * SIZE
        assert along.min() >= 0.0
        assert along.max() <= 1.0
        if start == 0:
            lines = mesh.topology.node_lines[mesh.topology.slides]
            np.testing.assert_array_equal(np.lexsort((along, lines)), order)
        assert iterate.mesh.points[held].tobytes() == mesh.points[held].tobytes()


@pytest.mark.parametrize("key", [row.key for row in OPTIMIZERS if row.key != "rules"])
def test_they_do_slide(key):
    mesh = crossed(5)
    best = outcome(run(key, mesh, "shape")).best.mesh
    moved = np.linalg.norm(best.points - mesh.points, axis=1)[mesh.topology.slides]
    assert (moved > 0.01 * SIZE).sum() > len(moved) // 2


def test_sliding_gains_more_than_staying():
    mesh = crossed(4)
    known = mesh.topology
    pinned = np.where(known.slides, NodeState.PINNED, known.node_states)
    stuck = attrs.evolve(mesh, topology=attrs.evolve(known, node_states=pinned))
    slid, stayed = (outcome(default_iterates(each, objective("shape"))).best for each in (mesh, stuck))
    assert slid.objective > stayed.objective + 0.1
    np.testing.assert_array_equal(stayed.mesh.points[known.slides], mesh.points[known.slides])


@pytest.mark.parametrize("seed", range(3))
def test_a_tangle_is_opened_along_the_lines(seed):
    """Nodes of a line changed about: they come into their order again."""
    mesh = crossed(seed, shift=0.9)
    best = outcome(run("untangle", mesh, "shape")).best
    assert quality(mesh, metric("shape")).inverted_count > 0
    assert best.quality.inverted_count == 0
    assert shares(best.mesh)[1].max() < 1e-9 * SIZE


def test_without_a_known_plane_nodes_on_lines_stay():
    mesh = crossed(1)
    lost = attrs.evolve(mesh, surface=None, parameters=None)
    assert not mesh.topology.slides[problem(lost).nodes[: problem(lost).movable]].any()
    best = outcome(default_iterates(lost, objective("shape"))).best.mesh
    np.testing.assert_array_equal(best.points[mesh.topology.slides], mesh.points[mesh.topology.slides])


def test_a_node_that_has_lost_its_line_stays():
    mesh = crossed(1)
    known = attrs.evolve(mesh.topology, node_lines=np.full(len(mesh.points), -1))
    lost = attrs.evolve(mesh, topology=known)
    best = outcome(default_iterates(lost, objective("shape"))).best.mesh
    np.testing.assert_array_equal(best.points[mesh.topology.slides], mesh.points[mesh.topology.slides])


@pytest.mark.parametrize("key", [row.key for row in OPTIMIZERS])
def test_nodes_stop_at_the_ends_of_their_lines(key):
    """Each has a short line of its own that ends between two elements."""
    mesh = crossed(6, shift=0.1)
    slides = np.flatnonzero(mesh.topology.slides)
    ways = (mesh.lines[:, 1] - mesh.lines[:, 0])[mesh.topology.node_lines[slides]]
    reach = 0.03 * SIZE * ways / np.linalg.norm(ways, axis=1, keepdims=True)
    lines = np.full(len(mesh.points), -1)
    lines[slides] = np.arange(len(slides))
    known = attrs.evolve(mesh.topology, node_lines=lines)
    ends = np.stack([mesh.points[slides] - reach, mesh.points[slides] + reach], axis=1)
    short = attrs.evolve(mesh, topology=known, lines=ends)
    made = run(key, short, "shape", stride=1)
    for iterate in made:
        along, _ = shares(iterate.mesh)
        assert along.min() > -1e-9
        assert along.max() < 1.0 + 1e-9
        assert iterate.quality.inverted_count == 0
    assert outcome(made).best.quality.mean > made[0].quality.mean
