"""Meshes that several benchmarks use."""

from collections.abc import Callable

import numpy as np
import pytest

from hullquad.mesh import Mesh
from hullquad.surface import Plane
from hullquad.topology import rim_states, topology


@pytest.fixture(scope="session")
def shaken_grid() -> Callable[[int], Mesh]:
    """Make about so many quads of 100 mm, their inner nodes displaced by up to a quarter of that."""

    def make(quads: int) -> Mesh:
        across = round(np.sqrt(quads))
        x, y = np.meshgrid(np.arange(across + 1.0), np.arange(across + 1.0))
        nodes = 100 * np.stack([x.ravel(), y.ravel()], axis=1)
        corner = (np.arange(across)[:, None] * (across + 1) + np.arange(across)).reshape(-1, 1)
        elements = (corner + np.array([0, 1, across + 2, across + 1])).astype(np.int32)
        states = rim_states(elements, len(nodes))
        shift = np.random.default_rng(quads).uniform(-25, 25, nodes.shape)
        nodes = np.where(states[:, None] == 0, nodes + shift, nodes)
        ground = Plane([0, 0, 0], [1, 0, 0], [0, 1, 0])
        known = topology(elements, states)
        return Mesh(points=ground.points(nodes), topology=known, target_size=100.0, surface=ground, parameters=nodes)

    return make
