"""What is optimised: the chosen objective, else the shown metric, else one that can be."""

import pytest

from hullquad.metrics import METRICS, OBJECTIVES, metric
from hullquad_app.objectives import objective_name, optimised_by, wanted, written


@pytest.mark.parametrize("row", METRICS, ids=lambda row: row.key)
def test_there_is_always_an_objective(row):
    assert optimised_by(row) in OBJECTIVES
    assert (optimised_by(row) is row) == (row in OBJECTIVES)
    assert wanted(row).metric is optimised_by(row)


def test_what_was_chosen_is_optimised():
    assert wanted(metric("corner_angle"), "taper").metric is metric("taper")


@pytest.mark.parametrize(
    ("text", "name"), [("shape", "shape"), ("stretch=2,scaled_jacobian", "2 stretch + scaled Jacobian")]
)
def test_an_objective_is_written_as_it_is_read_and_has_a_name(text, name):
    read = wanted(metric("taper"), text)
    assert wanted(metric("taper"), written(read.terms)) == read
    assert objective_name(read) == name
