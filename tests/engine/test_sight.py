"""Elements are found where they are seen, from any side and however they are shaped."""

import attrs
import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from scipy.spatial.transform import Rotation

from hullquad.mesh import Mesh
from hullquad.sight import from_notch, plan, sight
from hullquad.topology import rim_states, topology

RIGHT, UP = np.eye(3)[:2]
TURNS = st.tuples(*[st.floats(-3, 3)] * 3)


def bare(points, elements, size=100.0):
    """A mesh of which nothing else is known."""
    elements = np.array(elements, dtype=np.int32)
    return Mesh(
        points=points, topology=topology(elements, rim_states(elements, len(points))), target_size=size, surface=None
    )


def seen(mesh, place, right=RIGHT, up=UP):
    return sight(mesh.points, mesh.topology.elements, right, up).element_at(np.array(place, dtype=float))


@pytest.fixture
def tiles():
    """A square of 100 mm at the origin, a triangle to its right."""
    points = [[0, 0, 0], [100, 0, 0], [100, 100, 0], [0, 100, 0], [200, 0, 0]]
    return bare(points, [[0, 1, 2, 3], [1, 4, 2, -1]])


def test_quads_and_triangles_are_found_at_their_places(tiles):
    assert seen(tiles, (50, 50)) == 0
    assert seen(tiles, (120, 30)) == 1


def test_there_is_nothing_beside_the_plate(tiles):
    assert seen(tiles, (180, 90)) == -1  # in the triangle's box, but not in it
    assert seen(tiles, (-1, 50)) == -1


@given(turn=TURNS)
def test_elements_are_found_from_any_side(turn):
    """Centroids of a warped sheet of quads, seen from its front."""
    x, y = np.meshgrid(np.arange(6.0), np.arange(6.0))
    points = 100 * np.stack([x.ravel(), y.ravel(), 0.2 * np.sin(x.ravel())], axis=1)
    first = np.array([row * 6 + column for row in range(5) for column in range(5)])
    mesh = bare(points, first[:, None] + np.array([0, 1, 7, 6]))
    rotation = Rotation.from_rotvec(turn)
    right, up = rotation.apply(np.array([RIGHT, UP]))
    turned = attrs.evolve(mesh, points=rotation.apply(points))
    centroids = turned.points[turned.topology.elements].mean(axis=1)
    across = sight(turned.points, turned.topology.elements, right, up)
    assert [across.element_at(np.array([centre @ right, centre @ up])) for centre in centroids] == list(range(25))


def test_the_nearer_of_two_elements_is_found():
    square = np.array([[0, 0], [100, 0], [100, 100], [0, 100]])
    low, high = np.insert(square, 2, 0, axis=1), np.insert(square, 2, 10, axis=1)
    mesh = bare(np.concatenate([low, high]), [[0, 1, 2, 3], [4, 5, 6, 7]])
    assert seen(mesh, (50, 50)) == 1
    assert seen(mesh, (-50, 50), right=-RIGHT) == 0  # from behind


def test_nearer_is_told_at_the_place_and_not_by_the_middle():
    level = [[0, 0, 10], [100, 0, 10], [100, 100, 10], [0, 100, 10]]
    slope = [[0, 0, 0], [100, 0, 30], [100, 100, 30], [0, 100, 0]]
    mesh = bare(level + slope, [[0, 1, 2, 3], [4, 5, 6, 7]])
    assert seen(mesh, (10, 50)) == 0
    assert seen(mesh, (90, 50)) == 1


def test_the_notch_of_a_concave_quad_is_not_in_it():
    mesh = bare([[0, 0, 0], [100, 50, 0], [0, 100, 0], [40, 50, 0]], [[0, 1, 2, 3]])
    assert seen(mesh, (20, 50)) == -1
    assert seen(mesh, (60, 50)) == 0


@pytest.mark.parametrize("start", range(4))
def test_a_concave_quad_begins_at_its_notch(start):
    mesh = bare([[0, 0, 0], [100, 50, 0], [0, 100, 0], [40, 50, 0]], [np.roll([0, 1, 2, 3], start)])
    assert from_notch(mesh.points, mesh.topology.elements).tolist() == [[3, 0, 1, 2]]


def test_convex_and_crossed_quads_and_triangles_stay_as_they_are(tiles):
    crossed = [[0, 2, 1, 3]]
    elements = np.concatenate([tiles.topology.elements, crossed]).astype(np.int32)
    np.testing.assert_array_equal(from_notch(tiles.points, elements), elements)


def test_the_plan_of_a_plate_is_its_own_plane(dented):
    right, up = plan(dented)
    np.testing.assert_array_equal([right, up], [dented.surface.u, dented.surface.v])


@given(turn=TURNS)
def test_a_mesh_without_a_plane_is_seen_from_its_front(turn):
    square = np.array([[0, 0, 0], [100, 0, 0], [100, 100, 0], [0, 100, 0], [200, 0, 0.0]])
    rotation = Rotation.from_rotvec(turn)
    right, up = plan(bare(rotation.apply(square), [[0, 1, 2, 3], [1, 4, 2, -1]]))
    np.testing.assert_allclose(np.cross(right, up), rotation.apply([0, 0, 1]), atol=1e-9)
    np.testing.assert_allclose([right @ right, up @ up, right @ up], [1, 1, 0], atol=1e-9)


def test_a_closed_mesh_is_seen_from_its_corner():
    points = [[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1]]
    right, up = plan(bare(points, [[0, 2, 1, -1], [0, 1, 3, -1], [1, 2, 3, -1], [2, 0, 3, -1]]))
    np.testing.assert_allclose(np.cross(right, up), np.array([1, -1, 1]) / np.sqrt(3))
