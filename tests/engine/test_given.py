"""What the contour gives: violations that no move of free nodes mends, and those that it may mend."""

import attrs
import numpy as np
import pytest

from hullquad.given import given
from hullquad.metrics import METRICS, metric
from hullquad.quality import quality
from hullquad.rules import Level, assess, rule_set
from hullquad.topology import NodeState, topology

STATES = [NodeState.FREE, NodeState.CONTOUR, NodeState.FIXED]


def moved(mesh, rng, reach):
    """The mesh with its free nodes anywhere within `reach` mm of where they are."""
    return mesh.with_parameters(mesh.parameters + rng.uniform(-reach, reach, mesh.parameters.shape))


def with_states(mesh, states):
    topology = attrs.evolve(mesh.topology, node_states=np.asarray(states, dtype=np.int8))
    return attrs.evolve(mesh, topology=topology)


def narrowed(row):
    """A band that many elements are outside of."""
    toward = row.quads.ideal
    low, high = row.band
    share = 0.8
    low = low if np.isinf(low) else low + share * (toward - low)
    high = high if np.isinf(high) else high + share * (toward - high)
    return low, high


def scattered(mesh, rng):
    """Many of the mesh, far apart, their nodes displaced and some of them held."""
    nodes, copies = len(mesh.points), 200
    places = np.stack([500.0 * np.arange(copies), np.zeros(copies)], axis=1)
    parameters = (mesh.parameters + places[:, None]).reshape(-1, 2) + rng.uniform(-60, 60, (copies * nodes, 2))
    elements = (mesh.topology.elements + nodes * np.arange(copies)[:, None, None]).reshape(-1, 4).astype(np.int32)
    known = topology(elements, rng.choice(STATES, copies * nodes, p=[0.2, 0.6, 0.2]).astype(np.int8))
    many = attrs.evolve(mesh, parameters=parameters, points=mesh.surface.points(parameters), topology=known)
    return attrs.evolve(many, reference_areas=many.areas, thickness=30.0)


@pytest.mark.parametrize("reach", [1.0, 20.0, 150.0])
@pytest.mark.parametrize("row", METRICS, ids=lambda row: row.key)
def test_what_is_given_fails_wherever_the_free_nodes_go(row, reach, dented):
    rng = np.random.default_rng(int(reach))
    mesh = scattered(dented, rng)
    judged = quality(mesh, row, narrowed(row))
    stuck = given(mesh, judged)
    assert not (stuck & ~judged.failing).any()
    assert stuck.any() == judged.failing.any()
    for _ in range(5):
        again = quality(moved(mesh, rng, reach), row, judged.band)
        assert again.failing[stuck].all()


@pytest.mark.parametrize("key", ["csr_fine", "csr_very_fine", "bv", "ansys", "msc_nastran", "optistruct", "abaqus"])
def test_no_move_takes_a_given_element_below_its_level(key, dented):
    rng = np.random.default_rng(7)
    mesh = scattered(dented, rng)
    before = assess(mesh, rule_set(key))
    assert before.given.any()
    for _ in range(5):
        after = assess(moved(mesh, rng, 50.0), rule_set(key))
        assert (after.levels >= before.levels)[before.given].all()
        for old, new in zip(before.findings, after.findings, strict=True):
            assert (new.levels >= old.levels)[old.given].all()


def corner(mesh, degrees):
    """The mesh, the corner of its first square (a node of the contour) opened to so many degrees."""
    points = mesh.parameters.copy()
    turn = np.radians(degrees)
    points[4] = points[0] + 100 * np.array([np.cos(turn), np.sin(turn)])
    return attrs.evolve(mesh, parameters=points, points=mesh.surface.points(points))


@pytest.mark.parametrize(("degrees", "is_given"), [(150, True), (136, True), (134, False), (90, False), (44, True)])
def test_a_corner_between_two_contour_edges_is_given(dented, degrees, is_given):
    judged = quality(corner(dented, degrees), metric("corner_angle"))
    assert given(corner(dented, degrees), judged)[0] == is_given


def test_a_corner_at_a_free_node_is_not_given(dented):
    mesh = corner(with_states(dented, np.full(16, NodeState.FREE)), 150)
    judged = quality(mesh, metric("max_angle"))
    assert judged.failing[0]
    assert not given(mesh, judged).any()


@pytest.mark.parametrize("state", [NodeState.ON_LINE, NodeState.PINNED])
def test_nodes_that_slide_or_were_pinned_by_the_user_give_nothing(dented, state):
    mesh = corner(with_states(dented, np.full(16, state)), 150)
    assert not given(mesh, quality(mesh, metric("max_angle"))).any()


def test_held_edges_that_are_too_unequal_are_given(dented):
    points = dented.parameters.copy()
    points[4] = points[0] + [0, 15]
    mesh = attrs.evolve(dented, parameters=points, points=dented.surface.points(points))
    for key in ("aspect_ratio", "stretch"):
        judged = quality(mesh, metric(key))
        assert judged.failing[0]
        assert given(mesh, judged).nonzero()[0].tolist() == [0]


@pytest.mark.parametrize("key", ["stretch", "aspect_ratio", "skew", "scaled_jacobian", "taper"])
def test_an_element_folded_at_the_contour_is_given_by_every_metric(dented, key):
    mesh = corner(dented, 200)
    judged = quality(mesh, metric(key))
    assert not judged.valid[0]
    assert given(mesh, judged)[0]


def test_an_element_with_held_nodes_only_is_given_whatever_the_metric(dented):
    mesh = with_states(dented, np.full(16, NodeState.FIXED))
    for row in METRICS:
        judged = quality(mesh, row, narrowed(row))
        np.testing.assert_array_equal(given(mesh, judged), judged.failing)


def test_a_concave_corner_of_a_bare_mesh_is_given(dented):
    mesh = attrs.evolve(corner(dented, 200), surface=None, parameters=None)
    judged = quality(mesh, metric("max_angle"))
    assert judged.values[0] == pytest.approx(200)
    assert given(mesh, judged)[0]


def test_triangles_of_the_contour_are_given_by_their_own_limits(reference_mesh):
    mesh = reference_mesh("hopper_seg")
    held = with_states(mesh, np.full(len(mesh.points), NodeState.CONTOUR))
    judged = quality(held, metric("stretch"))
    failing = judged.failing & judged.is_triangle
    np.testing.assert_array_equal(given(held, judged) & judged.is_triangle, failing)


def test_a_triangle_that_the_contour_forces_is_given(dented):
    rules = rule_set("csr_fine")
    share = next(i for i, rule in enumerate(rules.rules, 1) if rule.measure == "triangle_share")
    elements = dented.topology.elements.copy()
    even = attrs.evolve(dented, topology=attrs.evolve(dented.topology, elements=elements))
    assert not assess(even, rules).findings[share].rows.size
    elements[0] = [0, 1, 4, -1]
    odd = attrs.evolve(dented, topology=attrs.evolve(dented.topology, elements=elements))
    finding = assess(odd, rules).findings[share]
    assert finding.rows.tolist() == [0]
    assert (finding.levels[0], finding.given[0]) == (Level.WARN, True)
