"""One element by itself says what the whole mesh says of it."""

from math import inf

import attrs
import numpy as np
import pytest

from hullquad.anatomy import Anatomy
from hullquad.given import given
from hullquad.mesh import Mesh
from hullquad.metrics import METRICS, metric
from hullquad.metrics.values import corner_values
from hullquad.quality import quality
from hullquad.topology import NodeState, topology

POINTS = np.array([[0, 0, 0], [100, 0, 0], [100, 50, 0], [0, 50, 0], [130, 90, 0], [20, 80, 0]], dtype=float)
ELEMENTS = np.array([[0, 1, 2, 3], [1, 4, 2, -1], [3, 2, 4, 5]], dtype=np.int32)


@pytest.fixture
def mesh():
    states = np.full(6, NodeState.CONTOUR, dtype=np.int8)
    states[2] = NodeState.FREE
    return Mesh(points=POINTS, topology=topology(ELEMENTS, states), target_size=50.0)


def test_edges_and_corners_of_a_rectangle(mesh):
    found = Anatomy(mesh, 0)
    np.testing.assert_allclose(found.edge_lengths, [100, 50, 100, 50])
    np.testing.assert_allclose(found.corner_angles, 90)


def test_a_triangle_has_three(mesh):
    found = Anatomy(mesh, 1)
    assert len(found.edge_lengths) == len(found.corner_angles) == 3
    assert found.corner_angles.sum() == pytest.approx(180)


def test_a_concave_corner_is_above_180(mesh):
    points = POINTS.copy()
    points[2] = [20, 10, 0]
    found = Anatomy(attrs.evolve(mesh, points=points), 0)
    assert found.corner_angles.max() > 180
    assert found.corner_angles.sum() == pytest.approx(360)
    assert found.worst_corner(metric("max_angle")) == 2


@pytest.mark.parametrize("row", range(3))
def test_every_metric_says_what_it_says_of_the_whole_mesh(mesh, row):
    bands = {"stretch": (0.9, inf), "corner_angle": (60.0, 100.0)}
    for judged, is_given in Anatomy(mesh, row).judged(bands):
        whole = quality(mesh, judged.metric, bands.get(judged.metric.key))
        assert judged.values[0] == pytest.approx(whole.values[row], rel=1e-12)
        assert judged.failing[0] == whole.failing[row]
        assert is_given[0] == given(mesh, whole)[row]


def test_every_metric_is_asked(mesh):
    assert [judged.metric for judged, _ in Anatomy(mesh, 0).judged({})] == list(METRICS)


@pytest.mark.parametrize("by", METRICS, ids=lambda by: by.key)
def test_the_worst_corner_has_the_value_of_the_element(mesh, by):
    worst = Anatomy(mesh, 2).worst_corner(by)
    assert (worst is not None) == by.is_of_corners
    if worst is not None:
        values = corner_values(by, mesh.points, ELEMENTS[[2]])[0]
        assert values[worst] == pytest.approx(quality(mesh, by).values[2])


def test_a_triangle_has_no_worst_corner_by_a_metric_of_quads(mesh):
    assert Anatomy(mesh, 1).worst_corner(metric("shear")) is None
