"""Every way of moving nodes but the paper's: what holds of all their runs."""

import attrs
import numpy as np
import pytest

from hullquad.mesh import Mesh
from hullquad.optimization.facets import facets
from hullquad.optimization.iterate import outcome
from hullquad.optimization.modes import untangle_iterates
from hullquad.optimization.objective import objective
from hullquad.optimization.settings import SearchSettings
from hullquad.topology import NodeState, rim_states, topology

SHAPE = objective("shape")


def with_states(mesh: Mesh, states: np.ndarray) -> Mesh:
    return attrs.evolve(mesh, topology=attrs.evolve(mesh.topology, node_states=states))


@pytest.fixture
def shaken_shell(bent) -> Mesh:
    """A quarter of a cylinder without a known surface, its inner nodes displaced on it."""
    points, elements = bent(14)
    states = rim_states(elements, len(points))
    size = float(np.sqrt(800 * 500 * np.pi / 2 / 13**2))
    is_free = states == NodeState.FREE
    shaken = points.copy()
    shaken[is_free] += np.random.default_rng(0).normal(size=(is_free.sum(), 3)) * 0.3 * size
    shaken = np.where(is_free[:, None], facets(points, elements).feet(shaken)[0], points)
    return Mesh(points=shaken, topology=topology(elements, states), target_size=size)


def test_a_tangled_mesh_is_opened_and_evened_out(reference_mesh):
    run = outcome(untangle_iterates(reference_mesh("hopper_fine_tangled"), SHAPE))
    assert run.first.quality.inverted_count > 0
    assert run.best.quality.inverted_count == 0
    assert run.best.quality.worst > 0.5
    assert run.last.stop.name == "gain"


def test_iterates_tell_their_stage_and_number(reference_mesh):
    iterates = list(untangle_iterates(reference_mesh("hopper_fine_tangled"), SHAPE))
    assert [iterate.number for iterate in iterates] == list(range(len(iterates)))
    assert list(dict.fromkeys(iterate.stage for iterate in iterates)) == ["", "untangle", "even out"]
    assert all(iterate.stop is None for iterate in iterates[:-1])
    assert all(iterate.displacement > 0 for iterate in iterates[1:])


def test_the_way_is_the_same_however_often_somebody_looks(reference_mesh):
    mesh = reference_mesh("hopper_fine_tangled")
    watched, quick = (
        outcome(untangle_iterates(mesh, SHAPE, SearchSettings(stride=stride))).last.mesh for stride in (1, 1000)
    )
    np.testing.assert_array_equal(watched.points, quick.points)


def test_a_run_that_gains_nothing_says_so_and_gives_its_input_back(reference_mesh):
    mesh = outcome(untangle_iterates(reference_mesh("web_L"), SHAPE)).best.mesh
    while True:
        run = outcome(untangle_iterates(mesh, SHAPE))
        if run.last.stop.name == "no_gain":
            break
        mesh = run.best.mesh
    assert run.best is run.first
    assert run.best.mesh is mesh


@pytest.mark.parametrize("iterations", [0, 1, 5])
def test_iterations_can_be_limited(reference_mesh, iterations):
    run = outcome(untangle_iterates(reference_mesh("web_L"), SHAPE, SearchSettings(iterations=iterations, stride=7)))
    assert run.last.number == iterations
    assert run.last.stop.name == "iterations"


def test_time_can_be_limited(reference_mesh):
    run = outcome(untangle_iterates(reference_mesh("web_L"), SHAPE, SearchSettings(seconds=0.0)))
    assert run.last.number == 0
    assert run.last.stop.name == "time"


def test_a_mesh_without_free_nodes_is_told(reference_mesh):
    mesh = reference_mesh("web_L")
    run = outcome(untangle_iterates(with_states(mesh, np.full(len(mesh.points), NodeState.FIXED)), SHAPE))
    assert run.last.stop.name == "no_free_nodes"
    assert run.best.number == 0


def test_what_stays_folded_is_named(reference_mesh):
    mesh = reference_mesh("hopper_seg")
    places, states = np.array(mesh.parameters), np.array(mesh.topology.node_states)
    first, second = mesh.topology.elements[0, :2]
    places[[first, second]] = places[[second, first]]
    states[mesh.topology.elements[0]] = NodeState.FIXED
    crossed = attrs.evolve(with_states(mesh, states), parameters=places, points=mesh.surface.points(places))
    stop = outcome(untangle_iterates(crossed, SHAPE)).last.stop
    assert stop.name == "folded"
    assert " 1" in stop.reason


def test_isolated_nodes_and_separate_parts_do_no_harm(reference_mesh):
    mesh = reference_mesh("web_L")
    count = len(mesh.points)
    elements = mesh.topology.elements
    elements = np.concatenate([elements, np.where(elements < 0, -1, elements + count)])
    places = np.concatenate([mesh.parameters, mesh.parameters + 1e4, [[5e4, 5e4]]])
    states = np.concatenate([mesh.topology.node_states] * 2 + [np.array([NodeState.FREE])])
    double = attrs.evolve(
        mesh,
        points=mesh.surface.points(places),
        parameters=places,
        topology=topology(elements.astype(np.int32), states.astype(np.int8)),
    )
    after = outcome(untangle_iterates(double, SHAPE)).best.mesh
    np.testing.assert_array_equal(after.points[-1], double.points[-1])
    assert (after.points[:count] != double.points[:count]).any()
    assert (after.points[count:-1] != double.points[count:-1]).any()


def test_a_curved_mesh_keeps_its_shape(shaken_shell):
    run = outcome(untangle_iterates(shaken_shell, SHAPE, SearchSettings(stride=5)))
    assert run.best.quality.mean > run.first.quality.mean + 0.1
    assert run.best.quality.inverted_count == 0
    surface = facets(shaken_shell.points, shaken_shell.topology.elements)
    away = np.linalg.norm(surface.feet(run.best.mesh.points)[0] - run.best.mesh.points, axis=1)
    assert away.max() < 1e-9 * shaken_shell.target_size
    held = ~shaken_shell.topology.is_free
    np.testing.assert_array_equal(run.best.mesh.points[held], shaken_shell.points[held])


def test_a_crease_stays_where_it_is():
    """A roof: nodes on its ridge may not slide off it."""
    x, y = np.meshgrid(np.arange(9.0), np.arange(9.0))
    points = np.stack([x, y, 4 - np.abs(x - 4)], axis=-1).reshape(-1, 3) * 100
    corner = (np.arange(8)[:, None] * 9 + np.arange(8)).reshape(-1, 1)
    elements = (corner + np.array([0, 1, 10, 9])).astype(np.int32)
    states = rim_states(elements, 81)
    on_ridge = (x.ravel() == 4) & (states == NodeState.FREE)
    slid = (states == NodeState.FREE) & ~on_ridge & (y.ravel() == 3)
    points[slid, 1] += 40
    mesh = Mesh(points=points, topology=topology(elements, states), target_size=100.0)
    after = outcome(untangle_iterates(mesh, SHAPE, SearchSettings(stride=5))).best.mesh
    np.testing.assert_array_equal(after.points[on_ridge], points[on_ridge])
    np.testing.assert_allclose(after.points[:, 2], 400 - np.abs(after.points[:, 0] - 400), atol=1e-6)
    assert (after.points[slid] != points[slid]).any()
