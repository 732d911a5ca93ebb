"""The untangler: whatever lies where it should not is opened again."""

import attrs
import numpy as np
import pytest

from hullquad.mesh import Mesh
from hullquad.metrics.values import valid_elements
from hullquad.optimization.course import Course
from hullquad.optimization.problem import problem
from hullquad.optimization.untangle import evenness, relaxing, untangling
from hullquad.topology import NodeState

MESHES = ("hopper_coarse20", "hopper_seg", "web_L", "hopper_fine")
CHANCE = np.random.default_rng


def opened(mesh: Mesh, stride: int = 1000) -> Mesh:
    course = Course(problem(mesh), iterations=10_000, seconds=60.0, stride=stride)
    for _ in untangling(course):
        pass
    return course.mesh()


def inverted(mesh: Mesh) -> int:
    return int((~valid_elements(mesh.points, mesh.topology.elements, mesh.normals)).sum())


def dragged(mesh: Mesh, chance: np.random.Generator) -> np.ndarray:
    """One node pulled through three elements."""
    places = np.array(mesh.parameters)
    node = chance.choice(np.flatnonzero(mesh.topology.is_free))
    places[node] += 3.0 * mesh.target_size * np.array([0.8, 0.6])
    return places


def turned_over(mesh: Mesh) -> np.ndarray:
    """The layer along the contour folded over it: its inner nodes mirrored at the nearest contour node."""
    places, is_free = np.array(mesh.parameters), mesh.topology.is_free
    for element in mesh.topology.elements:
        nodes = element[element >= 0]
        held = nodes[~is_free[nodes]]
        if len(held):
            for node in nodes[is_free[nodes]]:
                places[node] = 2.0 * mesh.parameters[held[0]] - mesh.parameters[node]
    return places


TANGLES = {
    "shaken": lambda mesh: mesh.parameters + CHANCE(0).normal(size=mesh.parameters.shape) * mesh.target_size,
    "thrown": lambda mesh: mesh.parameters + CHANCE(0).normal(size=mesh.parameters.shape) * 10.0 * mesh.target_size,
    "all in one place": lambda mesh: np.broadcast_to(mesh.parameters.mean(axis=0), mesh.parameters.shape),
    "beside the plate": lambda mesh: mesh.parameters + np.array([30.0 * mesh.target_size, 0.0]),
    "mirrored": lambda mesh: 2.0 * mesh.parameters.mean(axis=0) - mesh.parameters,
    "dragged": lambda mesh: dragged(mesh, CHANCE(0)),
    "turned over": turned_over,
}


@pytest.mark.parametrize("tangle", TANGLES.values(), ids=TANGLES)
@pytest.mark.parametrize("name", MESHES)
def test_every_tangle_is_opened(reference_mesh, name, tangle):
    mesh = reference_mesh(name)
    tangled = mesh.with_parameters(tangle(mesh))
    after = opened(tangled)
    assert inverted(tangled) > 0
    assert inverted(after) == 0
    held = ~mesh.topology.is_free
    np.testing.assert_array_equal(after.points[held], mesh.points[held])


@pytest.mark.parametrize("name", ["hopper_fine_tangled", "web_L_2k_tangled"])
def test_the_tangled_reference_meshes_are_opened(reference_mesh, name):
    assert inverted(opened(reference_mesh(name))) == 0


def test_it_matters_not_how_often_somebody_looks(reference_mesh):
    tangled = reference_mesh("hopper_fine_tangled")
    np.testing.assert_array_equal(opened(tangled, stride=1).points, opened(tangled, stride=1000).points)


def test_an_open_mesh_is_left_alone(reference_mesh):
    mesh = reference_mesh("web_L")
    np.testing.assert_array_equal(opened(mesh).points, mesh.points)


def test_pinned_nodes_stay(reference_mesh):
    tangled = reference_mesh("hopper_fine_tangled")
    states = np.array(tangled.topology.node_states)
    pinned = np.flatnonzero(states == NodeState.FREE)[::7]
    states[pinned] = NodeState.PINNED
    mesh = attrs.evolve(tangled, topology=attrs.evolve(tangled.topology, node_states=states))
    np.testing.assert_array_equal(opened(mesh).points[pinned], mesh.points[pinned])


def test_what_cannot_be_opened_does_not_keep_the_rest_folded(reference_mesh):
    """A quad whose four nodes are given, crosswise."""
    tangled = reference_mesh("hopper_fine_tangled")
    quad = tangled.topology.elements[40]
    states, places = np.array(tangled.topology.node_states), np.array(tangled.parameters)
    middle = places[quad].mean(axis=0)
    places[quad] = middle + 0.5 * tangled.target_size * np.array([[-1, -1], [1, 1], [1, -1], [-1, 1]])
    states[quad] = NodeState.PINNED
    topology = attrs.evolve(tangled.topology, node_states=states)
    points = tangled.surface.points(places)
    mesh = attrs.evolve(tangled, topology=topology, parameters=places, points=points)
    assert 1 <= inverted(opened(mesh)) <= 12


def test_a_relaxed_mesh_is_more_even(reference_mesh):
    mesh = reference_mesh("web_L")
    course = Course(problem(mesh), iterations=1000, seconds=60.0, stride=10)
    numbers = list(relaxing(course, 60))
    assert numbers == sorted(set(numbers))
    assert evenness(course) < evenness(Course(problem(mesh), 0, 0.0, 1))


def test_only_chosen_nodes_move(reference_mesh):
    mesh = reference_mesh("web_L")
    chosen = mesh.parameters[:, 0] < np.median(mesh.parameters[:, 0])
    course = Course(problem(mesh, chosen), iterations=100, seconds=60.0, stride=100)
    for _ in relaxing(course, 60):
        pass
    moved = (course.mesh().points != mesh.points).any(axis=1)
    assert moved.any()
    assert not moved[~chosen].any()
