"""Curved surfaces: from the parameter plane to space."""

import numpy as np
import pytest

from hullquad.surface import Bezier, Cylinder, Plane

FRAME = Plane([10, 20, 30], [1, 0, 0], [0, 1, 0])
PARAMETERS = np.random.default_rng(1).uniform(0, 1, (50, 2))


@pytest.fixture
def patch():
    """A patch of degree 2 by 3."""
    return Bezier(np.random.default_rng(2).uniform(-1000, 1000, (3, 4, 3)))


def test_points_of_a_cylinder_are_a_radius_from_its_axis():
    points = Cylinder(FRAME, 2000.0, 0.3).points(3000 * PARAMETERS)
    np.testing.assert_allclose(np.hypot(*(points - FRAME.origin)[:, 1:].T), 2000.0)
    np.testing.assert_allclose(points[:, 0] - 10, 3000 * PARAMETERS[:, 0])


def test_the_second_parameter_of_a_cylinder_is_length_along_the_arc():
    lengths = np.linspace(0, 3000, 2000)
    points = Cylinder(FRAME, 2000.0, 0.3).points(np.stack([np.zeros(2000), lengths], axis=1))
    assert np.linalg.norm(np.diff(points, axis=0), axis=1).sum() == pytest.approx(3000, rel=1e-6)


def test_a_patch_begins_and_ends_in_its_corners(patch):
    corners = patch.points(np.array([[0.0, 0.0], [1.0, 0.0], [0.0, 1.0], [1.0, 1.0]]))
    np.testing.assert_allclose(corners, patch.control[[0, 0, -1, -1], [0, -1, 0, -1]])


def test_a_patch_agrees_with_de_casteljau(patch):
    def folded(points, part):
        while len(points) > 1:
            points = (1 - part) * points[:-1] + part * points[1:]
        return points[0]

    expected = [folded(np.array([folded(row, s) for row in patch.control]), t) for s, t in PARAMETERS]
    np.testing.assert_allclose(patch.points(PARAMETERS), expected, atol=1e-9)


@pytest.mark.parametrize("surface", [FRAME, Cylinder(FRAME, 2000.0, 0.3)], ids=["plane", "cylinder"])
def test_directions_of_a_plan_are_square(surface):
    right, up = surface.directions
    assert right @ up == pytest.approx(0)


def test_directions_of_a_patch_are_square(patch):
    right, up = patch.directions
    np.testing.assert_allclose([right @ right, up @ up, right @ up], [1, 1, 0], atol=1e-12)
