"""Values in bins, and the worst elements with their figures."""

import attrs
import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from hullquad.histogram import axis_edges, histogram
from hullquad.metrics import METRICS, metric
from hullquad.quality import Quality, quality
from hullquad.ranking import ranking, worst_rows

FLOATS = st.lists(st.floats(0, 1), min_size=1, max_size=50)


def judged(values, key="stretch", limit=None, valid=None):
    """Quality of quads with given values."""
    row = metric(key)
    values = np.array(values, dtype=float)
    band = row.band if limit is None else row.opened((limit, limit))
    valid = np.ones(len(values), dtype=bool) if valid is None else np.array(valid)
    return Quality(
        metric=row,
        band=band,
        values=values,
        valid=valid,
        failing=~(row.is_within(band, values) & valid),
        is_triangle=np.zeros(len(values), dtype=bool),
    )


@given(values=FLOATS)
def test_every_element_is_in_one_bin(values):
    found = histogram(judged(values))
    assert found.counts.sum() == len(values)
    gathered = np.concatenate([found.rows(number) for number in range(len(found.totals))])
    assert sorted(gathered.tolist()) == list(range(len(values)))


@given(values=FLOATS)
def test_a_value_lies_between_the_ends_of_its_bin(values):
    found = histogram(judged(values))
    for value, number in zip(values, found.bins.tolist(), strict=True):
        low, high = found.bounds(number)
        assert low - 1e-9 <= value <= high


def test_failing_and_passing_elements_of_one_bin_are_counted_apart():
    found = histogram(judged([0.251, 0.259, 0.262], limit=0.26))
    assert found.counts[:, 10].tolist() == [0, 2, 1]
    assert found.grades[1, 10] < 0 < found.grades[2, 10]


def test_elements_that_are_not_valid_are_counted_apart():
    found = histogram(judged([0.0, 0.1, 0.9], valid=[False, True, True]))
    assert found.counts.sum(axis=1).tolist() == [1, 1, 1]


@pytest.mark.parametrize("row", METRICS, ids=lambda row: row.key)
def test_limits_of_the_table_are_ends_of_bins(row):
    edges = axis_edges(row, row.band)
    assert 24 <= len(edges) - 1 <= 40
    for limit in row.limits(row.band):
        assert np.isclose(edges, limit).any() or limit < edges[1]


def test_infinite_values_are_in_the_last_bin():
    found = histogram(judged([1.0, 12.0, np.inf], "aspect_ratio"))
    assert found.totals[-1] == 2
    assert found.bounds(len(found.totals) - 1) == (pytest.approx(9.75), np.inf)


def test_values_below_the_axis_are_in_the_first_bin():
    found = histogram(judged([-0.8, 0.9], "scaled_jacobian", valid=[False, True]))
    assert found.bounds(0) == (-np.inf, pytest.approx(0.025))
    assert found.counts[0, 0] == 1


def test_a_negative_limit_is_on_the_axis():
    assert axis_edges(metric("scaled_jacobian"), (-0.1, np.inf))[0] == -1


def test_a_large_limit_is_on_the_axis():
    assert 20 < axis_edges(metric("aspect_ratio"), (-np.inf, 20.0))[-1] < 40


def test_equal_values_fill_one_bin():
    assert np.count_nonzero(histogram(judged([0.5] * 7)).totals) == 1


def test_a_mesh_without_elements_has_empty_bins():
    assert histogram(judged([])).totals.sum() == 0


@given(values=st.lists(st.sampled_from([0.1, 0.2, 0.3, np.inf]), min_size=1, max_size=30), most=st.integers(1, 30))
@pytest.mark.parametrize("key", ["stretch", "aspect_ratio"])
def test_the_worst_rows_are_the_first_of_all_in_order(key, values, most):
    valid = np.arange(len(values)) % 3 > 0
    whole = judged(values, key, valid=valid)
    assert worst_rows(whole, most).tolist() == whole.worst_first[:most].tolist()


def test_a_ranking_agrees_with_the_quality_of_the_whole_mesh(reference_mesh):
    mesh = reference_mesh("hopper_seg")
    found = ranking(mesh, quality(mesh, metric("stretch")), 20)
    angles = quality(mesh, metric("min_angle")).values
    np.testing.assert_array_equal(found.min_angles, angles[found.rows])
    assert len(found.aspect_ratios) == 20


def test_a_ranking_of_a_small_mesh_has_every_element(dented):
    assert len(ranking(dented, quality(dented, metric("shape")), 200).rows) == 9


def test_triangles_are_counted_by_their_own_limit(reference_mesh):
    mesh = reference_mesh("hopper_seg")
    by_angle = quality(mesh, metric("min_angle"))
    found = histogram(by_angle)
    assert found.counts[:2].sum() == by_angle.failing_count


def test_edges_can_be_those_of_another_quality():
    edges = axis_edges(metric("stretch"), (0.25, np.inf))
    other = histogram(attrs.evolve(judged([0.5]), band=(0.4, np.inf)), edges)
    assert other.edges.tolist() == edges.tolist()
