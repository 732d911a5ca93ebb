"""What is optimised: the chosen objective, else the shown metric, else one that can be."""

import pytest

from hullquad.metrics import METRICS, OBJECTIVES, metric
from hullquad_app.objectives import optimised_by


@pytest.mark.parametrize("row", METRICS, ids=lambda row: row.key)
def test_there_is_always_an_objective(row):
    assert optimised_by(row) in OBJECTIVES
    assert (optimised_by(row) is row) == (row in OBJECTIVES)


def test_what_was_chosen_is_optimised():
    assert optimised_by(metric("corner_angle"), "taper") is metric("taper")
