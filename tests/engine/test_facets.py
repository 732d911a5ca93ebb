"""The facets of a mesh as a surface: nearest points are exact, and on curved meshes where they should be."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from hullquad.optimization.facets import facets

CHANCE = np.random.default_rng(5)


def brute(surface, point):
    """Nearest distance by many points of every facet."""
    u, v = np.meshgrid(np.linspace(0, 1, 60), np.linspace(0, 1, 60))
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


def test_points_of_the_mesh_are_their_own_feet(bent):
    surface = facets(*bent(12))
    feet, _ = surface.feet(surface.points[np.unique(surface.triangles)])
    np.testing.assert_allclose(feet, surface.points[np.unique(surface.triangles)], atol=1e-9)


@given(place=st.tuples(st.floats(-200, 900), st.floats(-200, 1000), st.floats(-200, 900)))
def test_no_point_of_a_facet_is_nearer_than_the_foot(arched, place):
    surface = arched
    point = np.array([place])
    (foot,), _ = surface.feet(point)
    found = np.linalg.norm(foot - point[0])
    assert found <= brute(surface, point[0]) + 1e-9
    assert found >= brute(surface, point[0]) - 10.0  # the many points are 10 mm apart


def test_normals_are_those_of_the_cylinder(bent):
    points, elements = bent(40)
    surface = facets(points, elements)
    angles, along = CHANCE.uniform(0.1, 1.4, 200), CHANCE.uniform(50, 750, 200)
    radial = np.stack([np.cos(angles), np.zeros(200), np.sin(angles)], axis=1)
    feet, normals = surface.feet(510.0 * radial + along[:, None] * [0, 1, 0])
    assert np.abs((normals * radial).sum(axis=1)).min() > 0.999
    np.testing.assert_allclose(np.hypot(feet[:, 0], feet[:, 2]), 500.0, atol=0.2)


def test_facets_without_area_do_no_harm(bent):
    points, elements = bent(5)
    points[7] = points[6]
    feet, normals = facets(points, elements).feet(points + 3.0)
    assert np.isfinite(feet).all()
    assert np.isfinite(normals).all()


@pytest.mark.parametrize("count", [1, 2])
def test_a_surface_may_be_a_single_facet(count):
    surface = facets(np.array([[0.0, 0, 0], [1, 0, 0], [0, 1, 0]]), np.array([[0, 1, 2, -1]] * count, dtype=np.int32))
    feet, normals = surface.feet(np.array([[0.25, 0.25, 7.0], [5.0, 0.0, 1.0]]))
    np.testing.assert_allclose(feet, [[0.25, 0.25, 0], [1, 0, 0]])
    np.testing.assert_allclose(normals, [[0, 0, 1], [0, 0, 1]])
