"""Grades: one scale for the values of any metric, of either sense or two-sided."""

import attrs
import numpy as np
import pytest

from hullquad.grades import graded, value_of_grade
from hullquad.metrics import METRICS, Sense, metric

ROWS = [*METRICS, attrs.evolve(metric("max_angle"), key="two_sided", sense=Sense.NEARER)]
ROWS[-1] = attrs.evolve(ROWS[-1], quads=attrs.evolve(ROWS[-1].quads, low=0.0, acceptable=(45.0, 135.0)))


def values_around(row):
    """Values all over the range and beyond it, close about its ends, and everything at which a grade may turn."""
    turns = [*row.band, *row.quads.acceptable, row.quads.ideal, row.quads.low, row.quads.high, 0.0]
    near = [np.nextafter(turn, way) for turn in turns if np.isfinite(turn) for way in (-np.inf, np.inf)]
    about = [turn + side * np.geomspace(1e-15, 1e3, 60) for turn in turns if np.isfinite(turn) for side in (-1, 1)]
    return np.concatenate([turns, near, *about, np.linspace(-1, 400, 4001), np.linspace(-1, 2, 3001), [1e300, -1e300]])


@pytest.mark.parametrize("row", ROWS, ids=lambda row: row.key)
def test_an_end_of_the_band_is_0_and_the_ideal_1(row):
    limits = row.limits(row.band)
    assert len(limits) == (2 if row.is_two_sided else 1)
    np.testing.assert_array_equal(graded(row, np.array(limits), row.band), 0.0)
    assert graded(row, np.array([row.quads.ideal]), row.band) == 1.0


@pytest.mark.parametrize("row", ROWS, ids=lambda row: row.key)
def test_a_worse_value_has_no_better_grade_and_the_sign_tells_the_failing_ones(row):
    values = values_around(row)
    ordered = values[np.argsort(row.badness(values), kind="stable")]
    grades = graded(row, ordered, row.band)
    assert (np.abs(grades) <= 1).all()
    assert (grades[row.is_within(row.band, ordered)] >= 0).all()
    assert (grades[~row.is_within(row.band, ordered)] <= 0).all()
    if not row.is_two_sided:
        assert (np.diff(grades) <= 1e-12).all()


@pytest.mark.parametrize("row", [row for row in METRICS if not row.is_two_sided], ids=lambda row: row.key)
def test_a_value_is_found_by_its_grade(row):
    grades = np.concatenate([np.linspace(-0.999, 1, 5000), [0.0, -1e-300, 1e-300, -1e-12, 1e-12]])
    values = value_of_grade(row, grades, row.band)
    np.testing.assert_allclose(graded(row, values, row.band), grades, atol=1e-9)


def test_a_limit_at_the_worst_value_leaves_nothing_to_fail():
    row = metric("stretch")
    assert (graded(row, np.array([0.0, 0.5, 1.0]), (0.0, np.inf)) >= 0).all()


def test_the_nearer_end_of_a_two_sided_band_is_moved():
    row = ROWS[-1]
    assert row.moved(row.band, 50.0) == (50.0, 135.0)
    assert row.moved(row.band, 120.0) == (45.0, 120.0)
    assert metric("max_angle").moved(metric("max_angle").band, 120.0) == (-np.inf, 120.0)
