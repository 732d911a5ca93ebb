"""Quality of a mesh by a metric: what fails, what is worst, and what runs against its neighbours."""

import attrs
import numpy as np
import pytest

from hullquad.errors import MeshError
from hullquad.formats.imported import bare_mesh
from hullquad.given import given
from hullquad.metrics import metric
from hullquad.quality import quality
from hullquad.topology import NodeState, half_edges, paired_sides, reversed_elements, rim_states, topology


def test_worst_and_failing_follow_the_sense_of_the_metric(dented):
    for row in (metric("stretch"), metric("max_angle")):
        judged = quality(dented, row)
        extreme = min if row.higher_is_better else max
        assert judged.worst == extreme(judged.values)
        assert judged.values[judged.worst_element] == judged.worst
        beyond = ~row.is_within(row.band, judged.values)
        np.testing.assert_array_equal(judged.failing, beyond)


def test_triangles_fail_by_their_own_limit(reference_mesh):
    mesh = reference_mesh("hopper_seg")
    judged = quality(mesh, metric("min_angle"))
    triangles = judged.values[mesh.topology.is_triangle]
    np.testing.assert_array_equal(judged.failing[mesh.topology.is_triangle], triangles < 30)


def test_the_limit_is_of_both_kinds_where_they_have_one_scale(reference_mesh):
    mesh = reference_mesh("hopper_seg")
    is_triangle = mesh.topology.is_triangle
    for key, limit in (("longest_edge", 850.0), ("aspect_ratio", 1.2), ("min_angle", 70.0)):
        row = metric(key)
        judged = quality(mesh, row, row.moved(row.band, limit))
        assert judged.triangle_band == (row.triangle_band if key == "min_angle" else judged.band)
        within = row.is_within(judged.triangle_band, judged.values)
        np.testing.assert_array_equal(judged.failing[is_triangle], ~within[is_triangle])
        beyond = judged.failing[is_triangle]
        assert key == "min_angle" or 0 < beyond.sum() < len(beyond)
        np.testing.assert_array_equal(judged.grades[is_triangle] < 0, beyond)


def test_an_inverted_quad_is_no_flatter_than_a_folded_one():
    points = np.array([[0, 0, 0], [1, 0, 0], [0.3, 0.3, 1], [0, 1, 0], [3, 0, 0], [4, 0, 0], [4, 0, 0], [3, 1, 0.0]])
    mesh = bare_mesh(points, np.arange(8, dtype=np.int32).reshape(2, 4), "here")
    judged = quality(mesh, metric("warpage"))
    assert judged.valid.tolist() == [True, False]
    assert judged.values[0] < 0
    assert judged.values[1] == -1
    assert judged.worst_element == 1


@pytest.mark.parametrize("element", [(0, 1, 2, 7), (0, -1, 2, 3), (0, 1, 2, -2), (0, 1, 2, 2_000_000_000)])
def test_an_element_of_a_node_that_is_none_is_named(element):
    points = np.array([[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0.0]])
    elements = np.array([(0, 1, 2, 3), element], dtype=np.int32)
    for make in (lambda: bare_mesh(points, elements, "mine"), lambda: topology(elements, np.ones(4, np.int8))):
        with pytest.raises(MeshError, match=r"E_MESH at m\w+: element 2 uses node -?\d+, but .* there are 4;"):
            make()


def test_coordinates_that_are_none_are_judged_without_a_warning(dented):
    for value in (np.nan, np.inf):
        points = dented.points.copy()
        points[5] = value
        mesh = attrs.evolve(dented, points=points)
        judged = quality(mesh, metric("stretch"))
        assert (~judged.valid).sum() == given(mesh, judged).sum() + 4 == 4


def test_an_inverted_element_fails_and_is_counted(dented):
    points = dented.points.copy()
    points[5] = points[10] + 1.0
    folded = attrs.evolve(dented, points=points)
    judged = quality(folded, metric("stretch"))
    assert judged.inverted_count > 0
    assert judged.worst == 0.0
    assert judged.failing[~judged.valid].all()


def test_an_element_against_its_neighbours_is_found(dented):
    elements = dented.topology.elements.copy()
    elements[4] = elements[4][::-1]
    assert reversed_elements(elements).nonzero()[0].tolist() == [4]
    assert not reversed_elements(dented.topology.elements).any()


def test_sides_are_paired_where_two_elements_meet():
    elements = np.array([[0, 1, 4, 3], [1, 2, 5, 4], [1, 4, 6, -1], [4, 5, 7, -1]], dtype=np.int32)
    sides, owners = half_edges(elements)
    one, other = paired_sides(sides)
    assert np.sort(sides[one], axis=1).tolist() == [[4, 5]]  # 1-4 has three elements
    assert owners[[*one, *other]].tolist() == [1, 3]


def test_nodes_without_elements_are_not_free():
    states = rim_states(np.array([[0, 1, 2, -1], [0, 2, 4, -1], [0, 4, 1, -1]], dtype=np.int32), 6)
    assert states.tolist() == [NodeState.FREE, *[NodeState.CONTOUR] * 2, NodeState.FIXED, 1, NodeState.FIXED]


def test_parts_that_touch_nowhere_are_judged_apart():
    elements = np.array([[0, 1, 2, 3], [7, 6, 5, 4]], dtype=np.int32)
    assert not reversed_elements(elements).any()


@pytest.mark.parametrize("elements", [[[0, 1, 4, 3], [1, 2, 5, 4], [1, 4, 6, -1]]])
def test_nodes_where_three_elements_meet_at_an_edge_belong_to_the_contour(elements):
    states = rim_states(np.array(elements, dtype=np.int32), 7)
    assert states.tolist() == [1] * 7


def test_labels_count_from_one():
    numbered = topology(np.array([[0, 1, 2, 3]], dtype=np.int32), np.ones(4, dtype=np.int8))
    assert numbered.node_labels.tolist() == [1, 2, 3, 4]
    assert numbered.element_labels.tolist() == [1]
