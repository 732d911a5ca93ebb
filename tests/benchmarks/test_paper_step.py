"""One step of the paper's optimisation beside the sixteen evaluations of the metric that it stands for."""

from itertools import islice

import numpy as np
import pytest

from hullquad.mesh import Mesh
from hullquad.metrics import metric
from hullquad.optimization.paper import paper_iterates
from hullquad.surface import Plane
from hullquad.topology import rim_states, topology

STEPS = 10
SIZES = (200, 2000, 20_000)


def shaken_grid(quads: int) -> Mesh:
    """About so many quads of 100 mm, their inner nodes displaced by up to a quarter of that."""
    across = round(np.sqrt(quads))
    x, y = np.meshgrid(np.arange(across + 1.0), np.arange(across + 1.0))
    nodes = 100 * np.stack([x.ravel(), y.ravel()], axis=1)
    corner = (np.arange(across)[:, None] * (across + 1) + np.arange(across)).reshape(-1, 1)
    elements = (corner + np.array([0, 1, across + 2, across + 1])).astype(np.int32)
    states = rim_states(elements, len(nodes))
    shift = np.random.default_rng(quads).uniform(-25, 25, nodes.shape)
    nodes = np.where(states[:, None] == 0, nodes + shift, nodes)
    ground = Plane([0, 0, 0], [1, 0, 0], [0, 1, 0])
    return Mesh(
        points=ground.points(nodes),
        topology=topology(elements, states),
        target_size=100.0,
        surface=ground,
        parameters=nodes,
    )


def stretch(points: np.ndarray, quads: np.ndarray) -> float:
    """Sum of stretch in plain NumPy."""
    corners = points[quads]
    edges = np.roll(corners, -1, axis=1) - corners
    diagonals = corners[:, 2:] - corners[:, :2]
    shortest = np.einsum("qki,qki->qk", edges, edges).min(axis=1)
    longest = np.einsum("qki,qki->qk", diagonals, diagonals).max(axis=1)
    return float(np.sqrt(2 * shortest / longest).sum())


@pytest.mark.parametrize("quads", SIZES)
def test_ten_paper_steps(benchmark, quads):
    benchmark.group = f"{quads} quads, {STEPS} steps"
    mesh, row = shaken_grid(quads), metric("stretch")
    last = benchmark(lambda: list(islice(paper_iterates(mesh, row), STEPS + 1))[-1])
    assert last.number == STEPS


@pytest.mark.parametrize("quads", SIZES)
def test_ten_times_sixteen_evaluations_in_numpy(benchmark, quads):
    benchmark.group = f"{quads} quads, {STEPS} steps"
    mesh = shaken_grid(quads)
    total = benchmark(
        lambda: [stretch(mesh.points, mesh.topology.quads) for _ in range(16 * STEPS)],
    )
    assert total[0] == pytest.approx(next(paper_iterates(mesh, metric("stretch"))).objective)
