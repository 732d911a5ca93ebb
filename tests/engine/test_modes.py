"""Every way of moving nodes but the paper's: what holds of all their runs."""

import attrs
import numpy as np
import pytest

from hullquad.given import given
from hullquad.mesh import Mesh
from hullquad.metrics import OBJECTIVES, metric
from hullquad.optimization.course import Course
from hullquad.optimization.energies import merit
from hullquad.optimization.facets import Facets, facets
from hullquad.optimization.footing import bring_back, footing
from hullquad.optimization.iterate import outcome
from hullquad.optimization.modes import default_iterates, untangle_iterates, worst_iterates
from hullquad.optimization.objective import Objective, objective
from hullquad.optimization.problem import problem
from hullquad.optimization.selection import rings
from hullquad.optimization.settings import FINE, QUICK, SearchSettings
from hullquad.optimization.untangle import evenness
from hullquad.optimizers import iterates
from hullquad.quality import quality
from hullquad.rules import Level, assess, rule_set
from hullquad.rules.chase import rules_iterates
from hullquad.topology import NodeState, rim_states, topology

SHAPE = objective("shape")


def with_states(mesh: Mesh, states: np.ndarray) -> Mesh:
    return attrs.evolve(mesh, topology=attrs.evolve(mesh.topology, node_states=states))


def on_surface(surface: Facets, nodes: np.ndarray, points: np.ndarray) -> np.ndarray:
    """Points of the surface nearest to where its nodes have got to."""
    places = np.array(points)
    bring_back(surface, footing(surface, nodes, len(nodes)), places)
    return places


@pytest.fixture
def shaken_shell(bent) -> Mesh:
    """A quarter of a cylinder without a known surface, its inner nodes displaced on it."""
    points, elements = bent(14)
    states = rim_states(elements, len(points))
    size = float(np.sqrt(800 * 500 * np.pi / 2 / 13**2))
    is_free = states == NodeState.FREE
    nodes, shaken = np.flatnonzero(is_free), points.copy()
    shaken[is_free] += np.random.default_rng(0).normal(size=(is_free.sum(), 3)) * 0.3 * size
    shaken[is_free] = on_surface(facets(points, elements), nodes, shaken[is_free])
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


@pytest.mark.parametrize("stride", [1, 4, 1000])
def test_the_end_of_a_stage_is_looked_at(reference_mesh, stride):
    """Also of one that ends because no further step leads anywhere, right after somebody has looked."""
    mesh = reference_mesh("hopper_coarse20")
    course, energy = (
        Course(problem(mesh), 1000, 60.0, stride),
        merit(objective("max_angle"), mesh.target_size, mesh.areas, None, None),
    )
    looks = [course.is_at_check for _ in course.stage(energy, 1000, 0.0)]
    assert looks[-1]


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
    surface, nodes = facets(shaken_shell.points, shaken_shell.topology.elements), np.arange(len(shaken_shell.points))
    away = np.linalg.norm(on_surface(surface, nodes, run.best.mesh.points) - run.best.mesh.points, axis=1)
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


MODES = {
    "untangle": untangle_iterates,
    "default": default_iterates,
    "worst": worst_iterates,
    "rules": lambda mesh, aim, settings: rules_iterates(mesh, aim, rule_set("bv"), settings),
}
QUICK_RUN = SearchSettings(iterations=150, stride=25)


def rank_of(name: str, mesh: Mesh, aim: Objective) -> tuple[float, ...]:
    """What a mode makes better, worked out anew from the mesh."""
    course = Course(problem(mesh), 0, 0.0, 1)
    judged = quality(mesh, aim.metric)
    floor = None if name == "worst" else QUICK_RUN.floor
    loss = course.value(merit(aim, mesh.target_size, mesh.areas, None, floor))
    if name == "untangle":
        loss = evenness(course)
    extra = {
        "worst": lambda: [-float(aim.metric.badness(np.array(judged.worst)))],
        "rules": lambda: [-float(assess(mesh, rule_set("bv")).counts[level]) for level in (Level.ERROR, Level.WARN)],
    }
    return (-float(judged.inverted_count), *extra.get(name, list)(), -loss)


@pytest.fixture(scope="module")
def some_mesh(reference_mesh):
    """Make a valid mesh of a few elements whose nodes lie anywhere, some of them pinned."""

    def make(seed: int) -> Mesh:
        chance = np.random.default_rng(seed)
        mesh = reference_mesh(("hopper_coarse20", "hopper_seg")[seed % 2])
        shaken = mesh
        for amplitude in (0.5, 0.3, 0.1, 0.03):
            shift = amplitude * mesh.target_size * chance.uniform(-1, 1, mesh.parameters.shape)
            shaken = mesh.with_parameters(mesh.parameters + shift)
            if quality(shaken, metric("shape")).inverted_count == 0:
                break
        states = np.array(shaken.topology.node_states)
        free = np.flatnonzero(states == NodeState.FREE)
        states[chance.choice(free, size=len(free) // 6, replace=False)] = NodeState.PINNED
        return with_states(shaken, states)

    return make


WITH_STAND_IN = [row.key for row in OBJECTIVES if row.group in {"Kniat, Table 1", "ANSYS"}]


@pytest.mark.parametrize("name", MODES)
@pytest.mark.parametrize("key", WITH_STAND_IN)
def test_no_run_ends_worse_than_it_began(some_mesh, name, key):
    mesh, aim = some_mesh(WITH_STAND_IN.index(key)), objective(key)
    iterates = list(MODES[name](mesh, aim, QUICK_RUN))
    best = outcome(iterates).best.mesh
    assert rank_of(name, best, aim) >= rank_of(name, mesh, aim)
    held = ~mesh.topology.is_free
    for iterate in iterates:
        np.testing.assert_array_equal(iterate.mesh.points[held], mesh.points[held])
        assert iterate.quality.inverted_count == 0
    if iterates[-1].stop.name == "no_gain":
        assert best is mesh


@pytest.mark.parametrize("name", MODES)
def test_the_result_does_not_depend_on_how_often_somebody_looks(some_mesh, name):
    mesh = some_mesh(2)
    watched, quick = (
        outcome(MODES[name](mesh, SHAPE, SearchSettings(iterations=300, stride=stride))).best for stride in (1, 1000)
    )
    assert watched.number == quick.number
    np.testing.assert_array_equal(watched.mesh.points, quick.mesh.points)


@pytest.mark.parametrize("name", MODES)
def test_the_same_input_gives_the_same_output(some_mesh, name):
    mesh = some_mesh(3)
    first, again = (outcome(MODES[name](mesh, SHAPE, QUICK_RUN)).best.mesh for _ in range(2))
    np.testing.assert_array_equal(first.points, again.points)


REFERENCES = {"hopper_coarse20": 13.215, "hopper_seg": 23.51, "web_L": 207.71, "hopper_fine": 476.59}
"""Best sums of stretch that an interior-point method found."""


@pytest.mark.parametrize("name", REFERENCES)
@pytest.mark.parametrize(("schedule", "share"), [(QUICK, 0.97), (FINE, 0.995)], ids=["quick", "fine"])
def test_the_reachable_gain_is_reached(reference_mesh, name, schedule, share):
    mesh = reference_mesh(name)
    settings = SearchSettings(floor=None, schedule=schedule, stride=1000)
    run = outcome(default_iterates(mesh, objective("stretch"), settings))
    assert run.best.objective - run.first.objective >= share * (REFERENCES[name] - run.first.objective)


@pytest.mark.parametrize("name", [*REFERENCES, "web_L_2k"])
@pytest.mark.parametrize(("floor", "least"), [(0.3, 0.27), (0.6, 0.5)])
def test_the_floor_holds(reference_mesh, name, floor, least):
    run = outcome(
        default_iterates(reference_mesh(name), objective("stretch"), SearchSettings(floor=floor, stride=1000))
    )
    judged = quality(run.best.mesh, metric("scaled_jacobian"), (least, np.inf))
    assert judged.values[~given(run.best.mesh, judged)].min() >= least


@pytest.mark.parametrize("key", ["shape", "scaled_jacobian"])
def test_the_worst_quad_is_raised_beyond_what_triangles_allow(reference_mesh, key):
    mesh = reference_mesh("hopper_coarse20")
    of_all, of_quads = (outcome(iterates(mode, mesh, objective(key))).best for mode in ("worst", "worst_quad"))
    assert of_quads.quality.worst_quad > of_all.quality.worst_quad + 0.02
    held = quality(of_quads.mesh, metric("scaled_jacobian")).values
    assert held[mesh.topology.is_triangle].min() >= 0.27


WORST_BY_OTHERS = {"hopper_coarse20": 0.708, "hopper_seg": 0.732, "web_L": 0.696, "hopper_fine": 0.688}
"""Least shape that Gmsh's UntangleMeshGeometry leaves."""


@pytest.mark.parametrize("name", WORST_BY_OTHERS)
def test_the_worst_element_is_raised(reference_mesh, name):
    run = outcome(worst_iterates(reference_mesh(name), SHAPE, SearchSettings(stride=1000)))
    assert run.best.quality.worst_quad > WORST_BY_OTHERS[name]


def test_fewer_elements_break_the_rules(reference_mesh):
    mesh, rules = reference_mesh("web_L"), rule_set("bv")
    plain = outcome(default_iterates(mesh, SHAPE, SearchSettings(stride=1000))).best.mesh
    chased = outcome(rules_iterates(mesh, SHAPE, rules, SearchSettings(stride=1000))).best.mesh
    assert assess(chased, rules).counts[Level.WARN] < 0.8 * assess(plain, rules).counts[Level.WARN]


def test_weights_decide_between_metrics(reference_mesh):
    mesh = reference_mesh("web_L")
    settings = SearchSettings(stride=1000)
    by_stretch, by_shape = (
        outcome(default_iterates(mesh, objective(text), settings)).best.mesh
        for text in ("stretch=10,shape", "stretch,shape=10")
    )
    for key, better, other in (("stretch", by_stretch, by_shape), ("shape", by_shape, by_stretch)):
        assert quality(better, metric(key)).mean > quality(other, metric(key)).mean


def test_only_a_selection_is_optimised(reference_mesh):
    mesh = reference_mesh("web_L")
    chosen = rings(mesh, [10], 1)
    assert 0 < (chosen & mesh.topology.is_free).sum() < mesh.topology.is_free.sum()
    after = outcome(default_iterates(mesh, SHAPE, SearchSettings(chosen=chosen))).best.mesh
    moved = (after.points != mesh.points).any(axis=1)
    assert moved.any()
    assert not moved[~chosen].any()
