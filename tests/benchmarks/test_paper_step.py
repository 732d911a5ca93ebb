"""One step of the paper's optimisation beside the sixteen evaluations of the metric that it stands for."""

from itertools import islice

import numpy as np
import pytest

from hullquad.metrics import metric
from hullquad.optimization.paper import paper_iterates

STEPS = 10
SIZES = (200, 2000, 20_000)


def stretch(points: np.ndarray, quads: np.ndarray) -> float:
    """Sum of stretch in plain NumPy."""
    corners = points[quads]
    edges = np.roll(corners, -1, axis=1) - corners
    diagonals = corners[:, 2:] - corners[:, :2]
    shortest = np.einsum("qki,qki->qk", edges, edges).min(axis=1)
    longest = np.einsum("qki,qki->qk", diagonals, diagonals).max(axis=1)
    return float(np.sqrt(2 * shortest / longest).sum())


@pytest.mark.parametrize("quads", SIZES)
def test_ten_paper_steps(benchmark, shaken_grid, quads):
    benchmark.group = f"{quads} quads, {STEPS} steps"
    mesh, row = shaken_grid(quads), metric("stretch")
    last = benchmark(lambda: list(islice(paper_iterates(mesh, row), STEPS + 1))[-1])
    assert last.number == STEPS


@pytest.mark.parametrize("quads", SIZES)
def test_ten_times_sixteen_evaluations_in_numpy(benchmark, shaken_grid, quads):
    benchmark.group = f"{quads} quads, {STEPS} steps"
    mesh = shaken_grid(quads)
    total = benchmark(
        lambda: [stretch(mesh.points, mesh.topology.quads) for _ in range(16 * STEPS)],
    )
    assert total[0] == pytest.approx(next(paper_iterates(mesh, metric("stretch"))).objective)
