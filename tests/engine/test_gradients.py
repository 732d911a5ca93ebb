"""Gradients of metrics, exact and smooth: against differences of high order, and what the smooth ones tend to."""

from itertools import pairwise

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from numpy.testing import assert_allclose

from hullquad.metrics import METRICS, OBJECTIVES, metric
from hullquad.metrics.values import judged_values, smooth_gradients, value_gradients

COUNT = 2000
SQUARE = np.array([[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0]], dtype=float)
AREAS = np.array([0.9, 0.45])
STEP = 1e-3
SIXTH_ORDER, EIGHTH_ORDER = (3 / 4, -3 / 20, 1 / 60), (4 / 5, -1 / 5, 4 / 105, -1 / 280)
AT_THEIR_BEST_WHERE_FLAT = {"warpage", "ansys_warping_factor", "nastran_warp", "warp_angle"}
WITH_TRIANGLES = [row for row in METRICS if row.triangles is not None]


def elements_of(points: np.ndarray) -> np.ndarray:
    count, corners, _ = points.shape
    return np.arange(count * corners, dtype=np.int32).reshape(count, corners)


def random_valid(corners: int, warp: float) -> np.ndarray:
    """(COUNT, corners, 3) points of open elements of about size 1, turned anywhere."""
    rng = np.random.default_rng(corners + int(10 * warp))
    kept: list[np.ndarray] = []
    while sum(map(len, kept)) < COUNT:
        points = SQUARE[:corners] + rng.uniform(-0.35, 0.35, (COUNT, corners, 3)) * [1, 1, warp]
        turn, _ = np.linalg.qr(rng.normal(size=(COUNT, 3, 3)))
        points = np.einsum("nij,nkj->nki", turn, points)
        padded = np.pad(elements_of(points), ((0, 0), (0, 4 - corners)), constant_values=-1)
        openness, _ = judged_values(metric("scaled_jacobian"), points.reshape(-1, 3), padded)
        kept.append(points[openness > 0.2])
    return np.concatenate(kept)[:COUNT]


def worked_out(row, points: np.ndarray, exponent: float) -> tuple[np.ndarray, np.ndarray]:
    return smooth_gradients(row, exponent, points.reshape(-1, 3), elements_of(points), areas=AREAS)


def assert_slopes_are_those_of_differences(
    row, points: np.ndarray, exponent: float = np.inf, least: float = 0.6
) -> None:
    """Along a random direction; where differences of two orders disagree, a kink is near and there is no slope."""
    along = np.random.default_rng(5).normal(size=points.shape)
    along /= np.linalg.norm(along, axis=(1, 2), keepdims=True)
    ahead = [worked_out(row, points + k * STEP * along, exponent)[0] for k in range(1, 5)]
    back = [worked_out(row, points - k * STEP * along, exponent)[0] for k in range(1, 5)]
    sixth, eighth = (
        sum(weight * (a - b) for weight, a, b in zip(weights, ahead, back, strict=False)) / STEP
        for weights in (SIXTH_ORDER, EIGHTH_ORDER)
    )
    gradients = worked_out(row, points, exponent)[1]
    size = np.linalg.norm(gradients, axis=(1, 2)) + 1e-6
    has_slope = np.abs(sixth - eighth) < 2e-8 * size
    assert has_slope.mean() >= least, "hardly an element without a kink"
    found = (gradients * along).sum(axis=(1, 2))
    assert (np.abs(found - eighth) / size)[has_slope].max() < 1e-7


@pytest.mark.parametrize("row", METRICS, ids=lambda row: row.key)
def test_gradients_of_warped_quads_are_those_of_differences(row):
    assert_slopes_are_those_of_differences(row, random_valid(4, 1.0))


@pytest.mark.parametrize(
    "row", [row for row in METRICS if row.key not in AT_THEIR_BEST_WHERE_FLAT], ids=lambda row: row.key
)
def test_gradients_of_planar_quads_are_those_of_differences(row):
    assert_slopes_are_those_of_differences(row, random_valid(4, 0.0))


@pytest.mark.parametrize("row", WITH_TRIANGLES, ids=lambda row: row.key)
def test_gradients_of_triangles_are_those_of_differences(row):
    assert_slopes_are_those_of_differences(row, random_valid(3, 1.0))


@pytest.mark.parametrize("exponent", [1, 4, 256])
@pytest.mark.parametrize("row", OBJECTIVES, ids=lambda row: row.key)
def test_gradients_of_smooth_metrics_are_those_of_differences(row, exponent):
    assert_slopes_are_those_of_differences(row, random_valid(4, 1.0), exponent, least=0.9 if exponent < 10 else 0.6)


@pytest.mark.parametrize("exponent", [4, 256])
@pytest.mark.parametrize("row", [row for row in OBJECTIVES if row.triangles], ids=lambda row: row.key)
def test_gradients_of_smooth_metrics_of_triangles_are_those_of_differences(row, exponent):
    assert_slopes_are_those_of_differences(row, random_valid(3, 1.0), exponent)


@pytest.mark.parametrize("row", OBJECTIVES, ids=lambda row: row.key)
def test_smooth_metrics_tend_to_the_metric_as_the_exponent_grows(row):
    points = random_valid(4, 0.5)
    exact = worked_out(row, points, np.inf)[0]
    away = [np.abs(worked_out(row, points, 2.0**doublings)[0] - exact).max() for doublings in range(11)]
    assert all(later <= sooner + 1e-12 for sooner, later in pairwise(away[2:]))
    assert away[-1] <= 5e-3 * np.abs(exact).max()


@settings(max_examples=50)
@given(numbers=st.lists(st.floats(1e-3, 1e3), min_size=4, max_size=4), doublings=st.integers(0, 10))
def test_a_smooth_least_is_within_the_bounds_of_a_power_mean(numbers, doublings):
    lengths = np.array(numbers)
    box = np.zeros((1, 4, 3))
    box[0, 1:, 0] = np.cumsum(lengths[:3])  # edges in line: their lengths are the numbers, but for the closing one
    exact, smooth = (
        float(worked_out(metric("longest_edge"), box, exponent)[0][0]) for exponent in (np.inf, 2.0**doublings)
    )
    assert 4 ** (-0.5 / 2**doublings) * exact * (1 - 1e-12) <= smooth <= exact * (1 + 1e-12)


@pytest.mark.parametrize("row", METRICS, ids=lambda row: row.key)
def test_moving_an_element_as_a_whole_changes_nothing(row):
    points = random_valid(4, 1.0)
    gradients = worked_out(row, points, 16)[1]
    assert_allclose(gradients.sum(axis=1), 0, atol=1e-10 * (1 + np.abs(gradients).max()))
    turning = np.cross(points, gradients).sum(axis=1)
    assert_allclose(turning, 0, atol=1e-9 * (1 + np.abs(gradients).max()))


@pytest.mark.parametrize("row", METRICS, ids=lambda row: row.key)
def test_the_gradient_at_a_square_is_the_one_between_the_one_sided_ones(row):
    """Corners share the extreme: by symmetry no node may be drawn sideways."""
    _, gradients = value_gradients(row, SQUARE, np.array([[0, 1, 2, 3]], dtype=np.int32), areas=AREAS)
    outwards = SQUARE - SQUARE.mean(axis=0)
    assert_allclose(np.cross(gradients[0], outwards), 0, atol=1e-12 * (1 + np.abs(gradients).max()))


@pytest.mark.parametrize("key", sorted(AT_THEIR_BEST_WHERE_FLAT))
def test_measures_of_warp_draw_no_node_out_of_a_flat_quad(key):
    """All but the fold have a kink there; rounding makes a few quads lie on one side of it."""
    flat = np.round(SQUARE + np.random.default_rng(1).uniform(-0.3, 0.3, (COUNT, 4, 3)) * [1, 1, 0], 6)
    _, gradients = worked_out(metric(key), flat, np.inf)
    assert_allclose(gradients, 0, atol=1e-15)


DEGENERATE = {
    "all nodes in one place": np.ones((4, 3)),
    "nodes in line": np.array([[0, 0, 0], [1, 0, 0], [2, 0, 0], [3, 0, 0.0]]),
    "collapsed edge": np.array([[0, 0, 0], [0, 0, 0], [1, 1, 0], [0, 1, 0.0]]),
    "bow-tie": np.array([[0, 0, 0], [1, 0, 0], [0, 1, 0], [1, 1, 0.0]]),
    "not a number": np.array([[np.nan, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0.0]]),
    "infinite": np.array([[np.inf, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0.0]]),
}


@pytest.mark.parametrize("exponent", [np.inf, 4])
@pytest.mark.parametrize("points", DEGENERATE.values(), ids=DEGENERATE)
def test_degenerate_elements_have_finite_gradients(points, exponent):
    for row in METRICS:
        _, gradients = worked_out(row, points[None], exponent)
        assert np.isfinite(gradients).all(), row.key


@pytest.mark.parametrize("exponent", [0.5, 3, 6.0])
def test_an_exponent_that_is_no_power_of_2_is_refused(exponent):
    with pytest.raises(ValueError, match="power of 2"):
        worked_out(metric("shape"), SQUARE[None], exponent)
