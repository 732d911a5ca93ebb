"""The metrics: closed forms, what any metric must not depend on, and how invalid elements are judged."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from numpy.testing import assert_allclose

from hullquad.errors import HullquadError
from hullquad.metrics import METRICS, OBJECTIVES, formulas, metric
from hullquad.metrics.row import MILLIMETRES
from hullquad.metrics.values import all_judged, corner_values, difference_gradient, judged_values, raw_values

UP = np.array([[0.0, 0.0, 1.0]])
KEYS = [row.key for row in METRICS]
SQUARE = ((0, 0), (1, 0), (1, 1), (0, 1))

# (nodes, metric, value): worked by hand
CLOSED_FORMS = [
    (((0, 0), (2, 0), (2, 1), (0, 1)), "stretch", np.sqrt(2 / 5)),
    (((0, 0), (2, 0), (2, 1), (0, 1)), "aspect_ratio", 2.0),
    (((0, 0), (2, 0), (2, 1), (0, 1)), "scaled_jacobian", 1.0),
    (((0, 0), (2, 0), (2, 1), (0, 1)), "shape", 0.8),
    (((0, 0), (1, 0), (1.5, np.sqrt(0.75)), (0.5, np.sqrt(0.75))), "scaled_jacobian", np.sqrt(0.75)),
    (((0, 0), (1, 0), (1.5, np.sqrt(0.75)), (0.5, np.sqrt(0.75))), "skew", np.sqrt(0.75)),
    (((0, 0), (1, 0), (1.5, np.sqrt(0.75)), (0.5, np.sqrt(0.75))), "min_angle", 60.0),
    (((0, 0), (1, 0), (1.5, np.sqrt(0.75)), (0.5, np.sqrt(0.75))), "max_angle", 120.0),
    (((0, 0), (1, 0), (1.5, np.sqrt(0.75)), (0.5, np.sqrt(0.75))), "stretch", np.sqrt(2 / 3)),
    (((0, 0), (4, 0), (3, 1), (1, 1)), "aspect_ratio", 4 / np.sqrt(2)),
    (((0, 0), (4, 0), (3, 1), (1, 1)), "min_angle", 45.0),
    (((0, 0), (1, 0), (0.5, np.sqrt(0.75))), "shape", 1.0),
    (((0, 0), (1, 0), (0.5, np.sqrt(0.75))), "scaled_jacobian", 1.0),
    (((0, 0), (1, 0), (0.5, np.sqrt(0.75))), "min_angle", 60.0),
    (((0, 0), (3, 0), (0, 4)), "aspect_ratio", 5 / 3),
    (((0, 0), (1, 0), (0, 1)), "shape", np.sqrt(0.75)),
    (((0, 0), (1, 0), (0, 1)), "max_angle", 90.0),
]


def judged(key: str, *elements, normals=UP) -> np.ndarray:
    points, rows = [], []
    for element in elements:
        rows.append([*range(len(points), len(points) + len(element)), -1][:4])
        points += [(*node, 0.0)[:3] for node in element]
    return judged_values(metric(key), np.array(points, dtype=float), np.array(rows, dtype=np.int32), normals)[0]


@pytest.mark.parametrize(("nodes", "key", "value"), CLOSED_FORMS)
def test_closed_forms(nodes, key, value):
    assert_allclose(judged(key, nodes), value, rtol=1e-14)


RELATIVE = {"relative_size", "shear_and_size", "shape_and_size"}
FREE_OF_SIZE = [row for row in METRICS if row.unit != MILLIMETRES]
DIFFERENT = [row for row in METRICS if row.key not in {
    "condition", "shear", "ansys_max_corner_angle", "nastran_taper", "optistruct_skew", "patran_aspect_ratio",
}]  # fmt: skip
"""Metrics less those that are the same quantity as another one, as their formulas say."""


@pytest.mark.parametrize("row", FREE_OF_SIZE, ids=lambda row: row.key)
def test_a_square_is_ideal(row):
    assert_allclose(judged(row.key, SQUARE), row.quads.ideal, atol=1e-15)


@pytest.mark.parametrize("row", [row for row in FREE_OF_SIZE if row.triangles], ids=lambda row: row.key)
def test_an_equilateral_triangle_is_ideal(row):
    third = np.sqrt(0.75)
    assert_allclose(judged(row.key, ((0, 0), (1, 0), (0.5, third))), row.triangles.ideal, rtol=1e-14, atol=1e-14)


def test_titles_tell_the_metrics_apart():
    assert len({row.title for row in METRICS}) == len(METRICS)


INVALID = {
    "concave": ((0, 0), (2, 0), (0.5, 0.5), (0, 2)),
    "bow-tie": ((0, 0), (1, 0), (0, 1), (1, 1)),
    "lopsided bow-tie": ((0, 0), (1, 0), (0, 1), (1.5, 1)),
    "against the plate": SQUARE[::-1],
    "collapsed edge": ((0, 0), (0, 0), (1, 1), (0, 1)),
    "all nodes in one place": ((1, 1),) * 4,
    "nodes in line": ((0, 0), (1, 0), (2, 0), (3, 0)),
    "corner of 180 degrees": ((0, 0), (1, 0), (2, 0), (0, 2)),
    "triangle against the plate": ((0, 0), (0, 1), (1, 0)),
    "triangle in line": ((0, 0), (1, 0), (2, 0)),
    "triangle in one place": ((0, 0),) * 3,
}


@pytest.mark.parametrize("row", METRICS, ids=KEYS)
@pytest.mark.parametrize("nodes", INVALID.values(), ids=INVALID)
def test_an_invalid_element_is_never_better_than_the_worst_valid_one(nodes, row):
    (value,) = judged(row.key, nodes)
    assert not np.isnan(value)
    judge = row if len(nodes) == 4 else row.triangle_metric
    assert value <= 0 if judge.higher_is_better else value >= (180 if judge.invalid[0] == 180 else np.inf)


@pytest.mark.parametrize("row", METRICS, ids=KEYS)
def test_without_a_frame_an_element_is_judged_by_its_own_sense(row):
    assert judged(row.key, SQUARE[::-1], normals=np.zeros((1, 3))) == judged(row.key, SQUARE)


def test_every_row_of_the_table_has_its_own_formula():
    points = np.array([(0, 0, 0), (3, 0, 0.1), (2.5, 2, 0), (0.2, 1.5, 0.2)])
    values, _ = all_judged(points, ONE_QUAD, UP, np.array([9.0, 1.0]), DIFFERENT)
    assert np.isfinite(values).all()
    assert len(np.unique(values)) == len(DIFFERENT) - 1  # skewness and corner angle deviate at other corners


def test_stretch_rewards_a_bow_tie_when_raw():
    points = np.array([(0, 0, 0), (1, 0, 0), (0.02, 0.01, 0), (1, 0.02, 0)], dtype=float)
    quad = np.array([[0, 1, 2, 3]], dtype=np.int32)
    assert raw_values(metric("stretch"), points, quad, UP)[0] > 0
    assert judged_values(metric("stretch"), points, quad, UP)[0] == 0


def test_an_unknown_metric_is_answered_with_the_known_ones():
    with pytest.raises(HullquadError, match=r"E_METRIC at strech: .*stretch, aspect_ratio"):
        metric("strech")


inner = st.floats(-0.4, 0.4)
corners = st.tuples(*[st.tuples(inner, inner, st.floats(-0.1, 0.1))] * 4).map(
    lambda shifts: np.array([(*node, 0.0) for node in SQUARE]) + np.array(shifts)
)
ONE_QUAD = np.array([[0, 1, 2, 3]], dtype=np.int32)


def turned(points: np.ndarray, rng: np.random.Generator) -> np.ndarray:
    """Each element turned anywhere."""
    turns, _ = np.linalg.qr(rng.normal(size=(len(points), 3, 3)))
    turns[np.linalg.det(turns) < 0, :, 0] *= -1
    return np.einsum("nij,nkj->nki", turns, points)


def raw(row, points: np.ndarray, order=(0, 1, 2, 3)) -> np.ndarray:
    """Values of (Q, 4, 3) quads, their nodes in some order."""
    numbers = np.arange(points.size // 3, dtype=np.int32).reshape(-1, 4)
    return raw_values(row, points.reshape(-1, 3), numbers[:, order], areas=np.array([0.9, 1.0]))


@pytest.mark.parametrize("row", METRICS, ids=KEYS)
def test_place_size_numbering_and_mirroring_change_nothing(row):
    rng = np.random.default_rng(3)
    shifts = rng.uniform(-0.4, 0.4, (500, 4, 3)) * [1, 1, 0.25]
    shifts[:50] *= rng.choice([0.0, 1.0], (50, 4, 1))  # some nodes of the square stay where they are
    shifts[50:100, :, 2] = 0.0
    points = np.array([(*node, 0.0) for node in SQUARE]) + shifts
    before = raw(row, points)
    scale = np.exp(rng.uniform(np.log(1e-3), np.log(1e5), (500, 1, 1)))
    moved = scale * (turned(points, rng) + rng.uniform(-3, 3, (500, 1, 3)))
    factor = scale[:, 0, 0] if row.unit == MILLIMETRES else 1.0
    if row.key not in RELATIVE:
        assert_allclose(raw(row, moved), factor * before, rtol=1e-9, atol=1e-7)
    assert_allclose(raw(row, turned(points, rng)), before, rtol=1e-9, atol=1e-7)
    assert_allclose(raw(row, points, (1, 2, 3, 0)), before, rtol=1e-12, atol=1e-12)
    assert_allclose(raw(row, points * [-1, 1, 1], (3, 2, 1, 0)), before, rtol=1e-12, atol=1e-12)


@settings(max_examples=30, deadline=None)
@given(points=corners, row=st.sampled_from(METRICS))
def test_valid_elements_stay_within_the_range_of_the_table(points, row):
    values, valid = judged_values(row, points * [1, 1, 0], ONE_QUAD, UP)
    if valid[0]:
        assert row.quads.low - 1e-12 <= values[0] <= row.quads.high + 1e-12


@pytest.mark.parametrize("row", METRICS, ids=KEYS)
def test_differences_follow_the_sum_along_any_direction(row, dented):
    quads, tangents = dented.topology.quads, dented.surface.tangents(dented.parameters)
    areas = np.array([9000.0, 1.0])
    gradient = difference_gradient(row, dented.points, quads, tangents, 1e-4, UP, areas)
    direction = np.random.default_rng(0).normal(size=gradient.shape)
    ahead, back = (
        raw_values(row, dented.surface.points(dented.parameters + step * direction), quads, UP, areas).sum()
        for step in (1e-4, -1e-4)
    )
    assert_allclose((gradient * direction).sum(), (ahead - back) / 2e-4 / row.factor, rtol=1e-5)


def repeated(points: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """A quad among others that are sound, more of them than are worked on at once."""
    sound = np.array([(*node, 0.0) for node in SQUARE])
    return np.concatenate([*[sound] * 100, points]), np.arange(404, dtype=np.int32).reshape(101, 4)


BROKEN = {
    "not a number": ((np.nan, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0)),
    "infinite": ((0, 0, 0), (np.inf, 0, 0), (1, 1, 0), (0, 1, 0)),
    "infinite both ways": ((-np.inf, 0, 0), (np.inf, 0, 0), (1, np.inf, 0), (0, 1, np.nan)),
    "too large for a float": ((-1e308, 0, 0), (1e308, 0, 0), (1e308, 1e308, 0), (-1e308, 1e308, 0)),
    "repeated node": ((0, 0, 0), (1, 0, 0), (1, 0, 0), (0, 1, 0)),
    "folded onto itself": ((0, 0, 0), (1, 0, 0), (0, 0, 0), (1, 0, 0)),
}


@pytest.mark.parametrize("nodes", BROKEN.values(), ids=BROKEN)
def test_broken_elements_are_the_worst_there_are_and_spoil_no_other(nodes):
    points, quads = repeated(np.array(nodes, dtype=float))
    values, valid = all_judged(points, quads, np.zeros((1, 3)), np.array([1.0, 1.0]))
    assert valid[:100].all()
    assert not valid[100]
    assert not np.isnan(values).any()
    for row, sound, broken in zip(METRICS, values[0], values[100], strict=True):
        assert row.is_worse(broken, sound), row.key
        assert broken <= 0 if row.higher_is_better else broken >= 180


@pytest.mark.parametrize("row", FREE_OF_SIZE, ids=lambda row: row.key)
@pytest.mark.parametrize("size", [1e-300, 1e-160, 1e-20, 1e12, 1e150])
def test_no_size_is_too_small_or_too_large(size, row):
    points = np.array([(0, 0, 0), (3, 0, 0.1), (2.5, 2, 0), (0.2, 1.5, 0.2)])
    area = np.array([7.0, 1.0])
    if row.key in RELATIVE:
        size = np.clip(size, 1e-140, 1e140)  # the mean area is a float, too
    values, valid = judged_values(row, size * points, ONE_QUAD, UP, size**2 * area)
    assert valid.all()
    assert_allclose(values, judged_values(row, points, ONE_QUAD, UP, area)[0], rtol=1e-12, atol=1e-12)


def test_a_mesh_of_triangles_alone_and_one_without_elements_are_judged():
    points = np.array([(0, 0, 0), (3, 0, 0), (1, 2, 0.0)])
    values, valid = all_judged(points, np.array([[0, 1, 2, -1]] * 70, dtype=np.int32), UP)
    assert valid.all()
    assert np.isfinite(values).all()
    values, valid = all_judged(points, np.empty((0, 4), dtype=np.int32), UP)
    assert values.shape == (0, len(METRICS))
    assert valid.shape == (0,)


def test_one_pass_gives_what_each_metric_gives_alone(reference_mesh):
    mesh = reference_mesh("hopper_seg")
    together, valid = all_judged(mesh.points, mesh.topology.elements, mesh.normals)
    for row, column in zip(METRICS, together.T, strict=True):
        alone, valid_alone = judged_values(row, mesh.points, mesh.topology.elements, mesh.normals)
        np.testing.assert_array_equal(column, alone)
        np.testing.assert_array_equal(valid, valid_alone)


def test_an_element_has_the_same_values_wherever_it_stands_among_the_others(reference_mesh):
    mesh = reference_mesh("hopper_seg")
    elements = np.tile(mesh.topology.elements, (3, 1))
    normals = np.tile(mesh.normals, (len(elements), 1))
    values, valid = all_judged(mesh.points, elements, normals, mesh.areas)
    order = np.random.default_rng(0).permutation(len(elements))
    shuffled, valid_too = all_judged(mesh.points, elements[order], normals, mesh.areas)
    np.testing.assert_array_equal(shuffled, values[order])
    np.testing.assert_array_equal(valid_too, valid[order])
    one_by_one = [all_judged(mesh.points, row[None], UP, mesh.areas) for row in mesh.topology.elements]
    np.testing.assert_array_equal(np.concatenate([value for value, _ in one_by_one]), values[: len(one_by_one)])


@pytest.mark.parametrize("key", ["stretch", "scaled_jacobian", "shape", "ansys_skewness"])
def test_a_power_of_2_changes_no_digit(key):
    """Sizes that are worked on as they are and those that are shrunk first have the same values."""
    points = np.array([(*node, 0.0) for node in SQUARE]) + np.random.default_rng(2).uniform(-0.3, 0.3, (300, 4, 3))
    expected = raw(metric(key), points)
    for power in (-300, -61, -59, -1, 59, 61, 300):
        np.testing.assert_array_equal(raw(metric(key), np.ldexp(points, power)), expected)


@pytest.mark.parametrize("row", [row for row in METRICS if row.is_of_corners], ids=lambda row: row.key)
def test_a_metric_of_corners_is_the_worst_of_its_corners(row, reference_mesh):
    mesh = reference_mesh("hopper_seg")
    corners = corner_values(row, mesh.points, mesh.topology.elements, mesh.normals)
    values, _ = judged_values(row, mesh.points, mesh.topology.elements, mesh.normals)
    has_corners = ~np.isnan(corners).all(axis=1)
    assert has_corners[~mesh.topology.is_triangle].all()
    ideals = np.where(mesh.topology.is_triangle, (row.triangles or row.quads).ideal, row.quads.ideal)
    worst = np.nanargmax(row.badness(corners[has_corners], ideals[has_corners, None]), axis=1)
    found = np.take_along_axis(corners[has_corners], worst[:, None], axis=1)[:, 0]
    assert_allclose(found, values[has_corners], rtol=1e-12, atol=1e-12)


def test_the_table_tells_which_metrics_are_of_corners():
    assert {row.key for row in METRICS if row.is_of_corners} == set(formulas.OF_CORNERS)


def test_what_cannot_be_made_better_is_no_objective():
    assert {row.key for row in METRICS} - {row.key for row in OBJECTIVES} == {"corner_angle", "abaqus_shape_factor"}
