"""Quality of a mesh by a metric: what fails, what is worst, and what runs against its neighbours."""

import attrs
import numpy as np
import pytest

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
