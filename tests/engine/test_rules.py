"""Rule sets: what they say of meshes, and where their numbers come from."""

from math import inf

import attrs
import numpy as np
import pytest
from hypothesis import given as for_all
from hypothesis import settings
from hypothesis import strategies as st

from hullquad.errors import RuleError
from hullquad.mesh import Mesh
from hullquad.metrics import METRICS, metric
from hullquad.quality import quality
from hullquad.rules import (
    NO_INVERTED,
    Elements,
    Level,
    Rule,
    RuleSet,
    Status,
    assess,
    rule_set,
    rule_sets,
)
from hullquad.topology import rim_states, topology

SETS = {found.key: found for found in rule_sets()}
KEYS = list(SETS)
QUADS, TRIANGLES, ALL = Elements.QUADS, Elements.TRIANGLES, Elements.ALL


def limits(key):
    """(measure, elements) -> (warn, error) of a set's rules."""
    return {(rule.measure, rule.elements): (rule.warn, rule.error) for rule in SETS[key].rules if rule.measure}


def at_least(value):
    return value, inf


def at_most(value):
    return -inf, value


NUMBERS = {
    "csr_coarse": {
        ("aspect_ratio", ALL): (at_most(3), None),
        ("edge_over_size", ALL): (at_most(2), None),
        ("triangle_share", ALL): (at_most(0.05), None),
    },
    "csr_fine": {
        ("longest_edge", ALL): (None, at_most(50)),
        ("aspect_ratio", ALL): (None, at_most(3)),
        ("min_angle", ALL): (at_least(45), None),
        ("max_angle", ALL): (at_most(135), None),
        ("triangle_share", ALL): (at_most(0), None),
    },
    "csr_very_fine": {
        ("edge_over_thickness", ALL): (at_most(1), None),
        ("aspect_ratio", ALL): (at_most(3), None),
        ("min_angle", ALL): (at_least(60), None),
        ("max_angle", ALL): (at_most(120), None),
        ("triangle_share", ALL): (at_most(0), None),
    },
    "csr_bc_2014_coarse": {("aspect_ratio", ALL): (None, at_most(4))},
    "csr_bc_2014_fine": {
        ("aspect_ratio", ALL): (None, at_most(3)),
        ("min_angle", ALL): (at_least(45), None),
        ("max_angle", ALL): (at_most(135), None),
    },
    "csr_ot_2014": {
        ("aspect_ratio", ALL): (at_most(3), None),
        ("triangle_share", ALL): (at_most(0.05), None),
    },
    "kr": {
        ("aspect_ratio", ALL): (at_most(3), None),
        ("min_angle", ALL): (at_least(45), None),
        ("max_angle", ALL): (at_most(135), None),
        ("triangle_share", ALL): (at_most(0.05), None),
    },
    "bv": {
        ("aspect_ratio", ALL): (at_most(2), at_most(4)),
        ("min_angle", QUADS): (at_least(60), None),
        ("max_angle", QUADS): (at_most(120), None),
        ("min_angle", TRIANGLES): (at_least(30), None),
        ("max_angle", TRIANGLES): (at_most(120), None),
    },
    "dnv": {
        ("aspect_ratio", ALL): (at_most(3), at_most(5)),
        ("min_angle", ALL): (at_least(45), None),
        ("max_angle", ALL): (at_most(135), None),
        ("triangle_share", ALL): (at_most(0.05), None),
    },
    "msc_nastran": {
        ("nastran_skew", QUADS): (at_least(30), None),
        ("nastran_taper", QUADS): (at_most(0.5), None),
        ("nastran_warp", QUADS): (at_most(0.05), None),
        ("min_angle", QUADS): (at_least(30), None),
        ("max_angle", QUADS): (at_most(150), None),
        ("nastran_skew", TRIANGLES): (at_least(10), None),
        ("max_angle", TRIANGLES): (at_most(160), None),
    },
    "autodesk_nastran": {
        ("aspect_ratio", QUADS): (at_most(100), None),
        ("min_angle", QUADS): (at_least(25), None),
        ("max_angle", QUADS): (at_most(165), None),
        ("nastran_taper", QUADS): (at_most(0.75), None),
        ("warp_angle", QUADS): (at_most(45), None),
    },
    "optistruct": {
        ("aspect_ratio", QUADS): (at_most(100), at_most(1000)),
        ("optistruct_skew", QUADS): (at_most(60), at_most(75)),
        ("warp_angle", QUADS): (at_most(30), at_most(60)),
        ("min_angle", QUADS): (at_least(15), at_least(3)),
        ("max_angle", QUADS): (at_most(165), at_most(177)),
        ("aspect_ratio", TRIANGLES): (at_most(50), at_most(500)),
        ("optistruct_skew", TRIANGLES): (at_most(75), at_most(85)),
        ("min_angle", TRIANGLES): (at_least(15), at_least(3)),
        ("max_angle", TRIANGLES): (at_most(165), at_most(177)),
    },
    "ansys": {
        ("ansys_aspect_ratio", QUADS): (at_most(20), at_most(1e6)),
        ("ansys_parallel_deviation", QUADS): (at_most(70), at_most(150)),
        ("ansys_max_corner_angle", QUADS): (at_most(155), at_most(179.9)),
        ("ansys_max_corner_angle", TRIANGLES): (at_most(165), at_most(179.9)),
        ("ansys_jacobian_ratio", QUADS): (at_most(30), at_most(1000)),
        ("ansys_warping_factor", QUADS): (at_most(1), at_most(5)),
        ("ansys_warping_over_thickness", QUADS): (at_most(1), at_most(5)),
    },
    "abaqus": {
        ("min_angle", QUADS): (at_least(10), None),
        ("max_angle", QUADS): (at_most(160), None),
        ("aspect_ratio", ALL): (at_most(10), None),
        ("abaqus_shape_factor", TRIANGLES): (at_least(0.01), None),
    },
}
"""The limits as they stand in the societies' rules and the solvers' manuals."""


@pytest.mark.parametrize("key", NUMBERS)
def test_limits_are_those_of_the_source(key):
    assert limits(key) == NUMBERS[key]


def test_every_set_is_tested_for_its_numbers():
    assert {"table_1", *NUMBERS} == set(KEYS)


def test_limits_of_table_1_are_the_bands_of_the_metrics():
    rows = [row for row in METRICS if row.group == "Kniat, Table 1"]
    assert len(rows) == 15
    of_quads = {(row.key, QUADS): (None, row.band) for row in rows}
    of_triangles = {(row.key, TRIANGLES): (None, row.triangle_band) for row in rows if row.triangles}
    assert limits("table_1") == of_quads | of_triangles


@pytest.mark.parametrize("key", KEYS)
def test_every_set_tells_its_edition_and_every_rule_its_source_and_words(key):
    found = SETS[key]
    assert found.edition
    assert found.source
    assert all(rule.text and rule.source and isinstance(rule.status, Status) for rule in found.rules)


@pytest.mark.parametrize("key", ["bv", "msc_nastran", "abaqus"])
def test_what_was_not_read_is_marked_so(key):
    assert {rule.status for rule in SETS[key].rules} == {Status.UNVERIFIED}


def test_what_was_read_of_ansys_is_told_from_what_was_not():
    status = {(rule.measure, rule.elements): rule.status for rule in SETS["ansys"].rules}
    read = {place for place, found in status.items() if found is Status.READ}
    assert {measure for measure, _ in read} == {"ansys_parallel_deviation", "ansys_max_corner_angle"}


def test_a_set_is_found_by_key_and_by_title():
    for found in SETS.values():
        assert rule_set(found.key) is found
        assert rule_set(found.title.upper()) is found


def test_an_unknown_set_is_told_the_known_ones():
    with pytest.raises(RuleError, match=r"E_RULES at csr: .*csr_coarse"):
        rule_set("csr")


@pytest.mark.parametrize("key", KEYS)
def test_levels_agree_with_the_bands(key, dented):
    found = assess(attrs.evolve(dented, thickness=90.0), SETS[key])
    for rule, finding in zip(SETS[key].rules, found.findings[1:], strict=True):
        if finding.not_evaluated or finding.metric is None:
            continue
        judged = quality(dented, finding.metric)
        if rule.measure == finding.metric.key:
            np.testing.assert_array_equal(finding.values, judged.values)
        is_error = np.zeros(9, bool) if rule.error is None else ~finding.metric.is_within(rule.error, finding.values)
        is_warned = np.zeros(9, bool) if rule.warn is None else ~finding.metric.is_within(rule.warn, finding.values)
        expected = np.where(is_error, Level.ERROR, np.where(is_warned, Level.WARN, Level.OK))
        np.testing.assert_array_equal(finding.levels, expected if rule.elements is not TRIANGLES else 0)


@settings(max_examples=20)
@for_all(seed=st.integers(0, 2**32 - 1), key=st.sampled_from(KEYS))
def test_the_order_of_the_elements_does_not_matter(seed, key, reference_mesh):
    mesh = attrs.evolve(reference_mesh("hopper_seg"), thickness=10.0, input_hash="known")
    order = np.random.default_rng(seed).permutation(len(mesh.topology.elements))
    topology = attrs.evolve(
        mesh.topology,
        elements=mesh.topology.elements[order],
        element_labels=mesh.topology.element_labels[order],
    )
    one, other = assess(mesh, SETS[key]), assess(attrs.evolve(mesh, topology=topology), SETS[key])
    np.testing.assert_array_equal(one.levels[order], other.levels)
    np.testing.assert_array_equal(one.given[order], other.given)
    assert one.counts == other.counts
    for before, after in zip(one.findings, other.findings, strict=True):
        np.testing.assert_array_equal(before.levels[order], after.levels)
        np.testing.assert_array_equal(before.given[order], after.given)


def one_rule(measure, elements=ALL, **bands):
    rule = Rule(
        measure=measure, title=measure, elements=elements, text="", source="", status=Status.UNVERIFIED, **bands
    )
    return RuleSet(key="one", title="One rule", edition="", source="", rules=(rule,))


def test_the_worst_level_counts_and_errors_come_first(dented):
    values = quality(dented, metric("aspect_ratio")).values
    least, middle = np.sort(values)[[2, 5]]
    found = assess(dented, one_rule("aspect_ratio", warn=(-inf, least), error=(-inf, middle)))
    assert found.counts == {Level.OK: 3, Level.WARN: 3, Level.ERROR: 3}
    assert found.worst is Level.ERROR
    (finding,) = found.violated
    assert finding.rows.tolist() == np.argsort(-values)[:6].tolist()
    assert (finding.count(Level.WARN), finding.count(Level.ERROR)) == (3, 3)
    np.testing.assert_array_equal(finding.mendable, (finding.levels > 0) & ~finding.given)


def test_a_rule_for_triangles_leaves_quads_alone(reference_mesh):
    mesh = reference_mesh("hopper_seg")
    is_triangle = mesh.topology.is_triangle
    for elements, chosen in ((TRIANGLES, is_triangle), (QUADS, ~is_triangle), (ALL, is_triangle | True)):
        found = assess(mesh, one_rule("min_angle", elements, error=(1000.0, inf)))
        np.testing.assert_array_equal(found.findings[1].levels == Level.ERROR, chosen)


def test_an_inverted_element_is_an_error_in_every_set(dented):
    points = dented.parameters.copy()
    points[5] = points[10] + 1.0
    folded = attrs.evolve(dented, parameters=points, points=dented.surface.points(points))
    inverted = ~quality(folded, metric("shape")).valid
    assert inverted.any()
    for found in SETS.values():
        assessment = assess(folded, found)
        assert assessment.findings[0].rule is NO_INVERTED
        np.testing.assert_array_equal(assessment.findings[0].levels == Level.ERROR, inverted)
        assert (assessment.levels[inverted] == Level.ERROR).all()


def test_squares_of_fifty_millimetres_are_fine_anywhere_in_space(dented):
    grid = np.stack(np.meshgrid(np.arange(4.0), np.arange(4.0)), axis=-1).reshape(-1, 2) * 50
    turn, _ = np.linalg.qr(np.random.default_rng(5).normal(size=(3, 3)))
    points = np.pad(grid, ((0, 0), (0, 1))) @ turn.T + [1e5, -2e5, 3e4]
    squares = attrs.evolve(dented, points=points, surface=None, parameters=None)
    assert assess(squares, SETS["csr_fine"]).counts == {Level.OK: 9, Level.WARN: 0, Level.ERROR: 0}


def test_a_size_is_judged_by_the_thickness_where_the_mesh_tells_it(dented):
    found = assess(dented, SETS["csr_very_fine"])
    unknown = {finding.rule.measure: finding.not_evaluated for finding in found.not_evaluated}
    assert unknown["edge_over_thickness"] == "the mesh does not tell the thickness of its plate"
    for thickness, is_fine in ((1000.0, True), (10.0, False)):
        finding = assess(attrs.evolve(dented, thickness=thickness), SETS["csr_very_fine"]).findings[1]
        assert finding.rule.measure == "edge_over_thickness"
        np.testing.assert_array_equal(finding.levels == Level.OK, is_fine)
        np.testing.assert_allclose(finding.values, quality(dented, metric("longest_edge")).values / thickness)


def test_a_size_is_judged_by_the_target_where_somebody_asked_for_one(dented):
    known = attrs.evolve(dented, input_hash="known", target_size=50.0)
    finding = next(f for f in assess(known, SETS["csr_coarse"]).findings if f.rule.measure == "edge_over_size")
    np.testing.assert_array_equal(finding.levels == Level.WARN, quality(dented, metric("longest_edge")).values > 100)
    unknown = assess(dented, SETS["csr_coarse"]).not_evaluated
    assert "the mesh does not tell how large its elements should be" in {f.not_evaluated for f in unknown}


def test_the_height_of_a_warped_quad_is_judged_by_the_thickness(dented):
    """A square of side 100 whose last corner is lifted by 40: an edge is 20 off the mean, the factor about 0.4."""
    points = np.array([[0, 0, 0], [100, 0, 0], [100, 100, 0], [0, 100, 40.0]])

    quad = np.array([[0, 1, 2, 3]], dtype=np.int32)
    mesh = Mesh(points=points, topology=topology(quad, rim_states(quad, 4)), target_size=100.0, thickness=8.0)
    d0, d1 = points[2] - points[0], points[3] - points[1]
    normal = np.cross(d0, d1) / np.linalg.norm(np.cross(d0, d1))
    height = abs(normal @ (points[1] - points[0]))
    finding = assess(mesh, SETS["ansys"]).findings[-1]
    assert finding.rule.measure == "ansys_warping_over_thickness"
    assert finding.values[0] == pytest.approx(height / 8.0, rel=1e-12)
    assert finding.levels[0] == Level.WARN


@pytest.mark.parametrize("key", KEYS)
def test_what_a_mesh_cannot_tell_is_told_with_a_reason(key, dented):
    found = assess(dented, SETS[key])
    assert len(found.findings) == len(SETS[key].rules) + 1
    for finding in found.findings:
        assert (finding.not_evaluated is not None) == (
            finding.metric is None and finding.rule.measure not in ("valid", "triangle_share")
        )
        if finding.not_evaluated is not None:
            assert finding.not_evaluated
            assert not finding.levels.any()


def test_a_mesh_of_triangles_only_is_judged(dented):
    quads = dented.topology.quads
    elements = np.concatenate(
        [
            np.pad(quads[:, [0, 1, 2]], ((0, 0), (0, 1)), constant_values=-1),
            np.pad(quads[:, [0, 2, 3]], ((0, 0), (0, 1)), constant_values=-1),
        ]
    )

    mesh = attrs.evolve(dented, topology=topology(elements, dented.topology.node_states))
    for found in SETS.values():
        assessment = assess(mesh, found)
        assert sum(assessment.counts.values()) == 18
    shares = [f for f in assess(mesh, SETS["csr_fine"]).findings if f.rule.measure == "triangle_share"]
    assert shares[0].count(Level.WARN) == 18
