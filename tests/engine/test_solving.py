"""Sparse systems, which the worker solves where they are large."""

import numpy as np
import pytest
from scipy import sparse
from scipy.sparse.linalg import splu

from hullquad import worker
from hullquad.triangulation.solving import solved


def chain(count: int) -> sparse.csc_array:
    """Stiffness of springs in a row, the first one held."""
    ones = np.ones(count)
    return sparse.diags_array([2.1 * ones, -ones[1:], -ones[1:]], offsets=[0, 1, -1]).tocsc()


@pytest.mark.parametrize("count", [5, 7000])
def test_small_and_large_systems_have_the_same_bits_as_by_themselves(count):
    matrix, right = chain(count), np.random.default_rng(1).random((count, 2))
    found = solved(matrix, right, "a plate")
    ways = {"permc_spec": "MMD_AT_PLUS_A", "diag_pivot_thresh": 0.0, "options": {"SymmetricMode": True}}
    assert found.tobytes() == splu(matrix, panel_size=1, relax=1, **ways).solve(right).tobytes()
    np.testing.assert_allclose(matrix @ found, right, atol=1e-9)


def test_large_ones_are_left_to_the_worker_that_can_be_cancelled(monkeypatch):
    def cancelled(*_, place, **__):
        raise worker.WorkerError("E_CANCELLED", place)

    monkeypatch.setattr(worker, "call", cancelled)
    with pytest.raises(worker.WorkerError, match="E_CANCELLED at a plate"):
        solved(chain(7000), np.ones(7000), "a plate")
    assert len(solved(chain(5), np.ones(5), "a plate")) == 5
