"""The metrics: closed forms, what any metric must not depend on, and how invalid elements are judged."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from numpy.testing import assert_allclose

from hullquad.errors import HullquadError
from hullquad.metrics import METRICS, metric
from hullquad.metrics.row import MILLIMETRES
from hullquad.metrics.values import all_judged, difference_gradient, judged_values, raw_values

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


def value(row, points, order=(0, 1, 2, 3)) -> float:
    return float(raw_values(row, points, np.array([order], dtype=np.int32))[0])


@pytest.mark.parametrize("row", METRICS, ids=KEYS)
@settings(max_examples=30, deadline=None)
@given(points=corners, angles=st.tuples(*[st.floats(-3, 3)] * 3), scale=st.floats(1e-3, 1e5))
def test_place_size_numbering_and_mirroring_change_nothing(row, points, angles, scale):
    before = value(row, points)
    turn = np.eye(3)
    for axis, angle in enumerate(angles):
        c, s = np.cos(angle), np.sin(angle)
        plane = [i for i in range(3) if i != axis]
        step = np.eye(3)
        step[np.ix_(plane, plane)] = [[c, -s], [s, c]]
        turn = step @ turn
    factor = scale if row.unit == MILLIMETRES else 1.0
    moved = scale * (points @ turn.T) + scale * np.array(angles)
    assert_allclose(value(row, moved), factor * before, rtol=1e-9, atol=1e-7)
    assert_allclose(value(row, points, (1, 2, 3, 0)), before, rtol=1e-12, atol=1e-12)
    assert_allclose(value(row, points * [-1, 1, 1], (3, 2, 1, 0)), before, rtol=1e-12, atol=1e-12)


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
