"""The facets of a mesh as a surface: nodes are brought back to the nearest point of it, wherever they have got to."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from hullquad.optimization.facets import Facets, facets
from hullquad.optimization.footing import bring_back, footing

CHANCE = np.random.default_rng(5)


def brought_back(surface: Facets, nodes: np.ndarray, points: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Where nodes come to stand that have moved to `points`, and the unit normals there."""
    standing, places = footing(surface, nodes, len(nodes)), np.array(points, dtype=float)
    bring_back(surface, standing, places)
    lengths = np.linalg.norm(standing.trial_normals, axis=1, keepdims=True)
    return places, standing.trial_normals / np.where(lengths > 0, lengths, 1.0)


def brute(surface: Facets, point: np.ndarray) -> float:
    """Nearest distance by many points of every facet."""
    u, v = np.meshgrid(np.linspace(0, 1, 40), np.linspace(0, 1, 40))
    inside = u + v <= 1 + 1e-12
    u, v = u[inside], v[inside]
    corners = surface.points[surface.triangles]
    places = (
        (1 - u - v)[:, None, None] * corners[:, 0] + u[:, None, None] * corners[:, 1] + v[:, None, None] * corners[:, 2]
    )
    return np.linalg.norm(places - point, axis=2).min()


@pytest.fixture(scope="module")
def arched(bent):
    """Facets of a quarter of a cylinder, six points across."""
    return facets(*bent(6))


def test_nodes_that_have_not_moved_stay(bent):
    surface = facets(*bent(12))
    nodes = np.unique(surface.triangles)
    places, _ = brought_back(surface, nodes, surface.points[nodes])
    np.testing.assert_allclose(places, surface.points[nodes], atol=1e-9)


@given(node=st.integers(0, 35), move=st.tuples(*[st.floats(-150, 150)] * 3))
def test_no_point_of_a_facet_is_nearer_than_where_a_node_comes_to_stand(arched, node, move):
    point = arched.points[node] + move
    (place,), _ = brought_back(arched, np.array([node]), point[None])
    found = np.linalg.norm(place - point)
    assert found <= brute(arched, point) + 1e-9
    assert found >= brute(arched, point) - 10.0  # the many points are 10 mm apart


def test_a_node_walks_over_many_facets(bent):
    surface = facets(*bent(14))
    nodes, goals = CHANCE.integers(0, 196, 20), CHANCE.integers(0, 196, 20)
    middle = 0.7 * surface.points[goals] + 0.3 * surface.points[nodes]
    places, _ = brought_back(surface, nodes, middle)
    for place, point in zip(places, middle, strict=True):
        assert np.linalg.norm(place - point) <= brute(surface, point) + 1e-9


def test_a_node_does_not_jump_to_another_part_that_is_near():
    """Two sheets one above the other."""
    corners = np.array([[0.0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0]])
    points = np.concatenate([corners, corners + np.array([0, 0, 0.1])])
    surface = facets(points, np.array([[0, 1, 2, 3], [4, 5, 6, 7]], dtype=np.int32))
    places, _ = brought_back(surface, np.array([0, 4]), np.array([[0.5, 0.5, 0.09], [0.5, 0.5, 0.01]]))
    np.testing.assert_allclose(places, [[0.5, 0.5, 0.0], [0.5, 0.5, 0.1]], atol=1e-12)


def test_normals_are_those_of_the_cylinder(bent):
    surface = facets(*bent(40))
    inner = np.flatnonzero((np.abs(surface.points[:, 1] - 400) < 350) & (surface.points[:, [0, 2]].min(axis=1) > 30))
    moved = surface.points[inner] + CHANCE.uniform(-12, 12, (len(inner), 3))
    places, normals = brought_back(surface, inner, moved)
    radial = places * [1, 0, 1] / np.hypot(places[:, 0], places[:, 2])[:, None]
    assert np.abs((normals * radial).sum(axis=1)).min() > 0.999
    np.testing.assert_allclose(np.hypot(places[:, 0], places[:, 2]), 500.0, atol=0.2)


def test_facets_without_area_do_no_harm(bent):
    points, elements = bent(5)
    points[7] = points[6]
    places, normals = brought_back(facets(points, elements), np.arange(25), points + 3.0)
    assert np.isfinite(places).all()
    assert np.isfinite(normals).all()


@pytest.mark.parametrize("count", [1, 2])
def test_a_surface_may_be_a_single_facet(count):
    surface = facets(np.array([[0.0, 0, 0], [1, 0, 0], [0, 1, 0]]), np.array([[0, 1, 2, -1]] * count, dtype=np.int32))
    places, normals = brought_back(surface, np.array([0, 1]), np.array([[0.25, 0.25, 7.0], [5.0, 0.0, 1.0]]))
    np.testing.assert_allclose(places, [[0.25, 0.25, 0], [1, 0, 0]])
    np.testing.assert_allclose(normals, [[0, 0, 1], [0, 0, 1]])
