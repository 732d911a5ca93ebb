"""Plates and meshes that several tests use."""

from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest

from hullquad.mesh import Mesh
from hullquad.surface import Plane
from hullquad.topology import NodeState, topology

DATA = Path(__file__).parents[1] / "data"
GROUND = Plane([0, 0, 0], [1, 0, 0], [0, 1, 0])


def flat_mesh(nodes: np.ndarray, elements: np.ndarray, fixed: np.ndarray, size: float) -> Mesh:
    """A mesh in the plane z = 0; `nodes` is (N, 2)."""
    states = np.where(fixed, NodeState.CONTOUR, NodeState.FREE).astype(np.int8)
    return Mesh(
        points=GROUND.points(nodes),
        topology=topology(elements, states),
        target_size=size,
        surface=GROUND,
        parameters=nodes,
    )


@pytest.fixture(scope="session")
def reference_mesh() -> Callable[[str], Mesh]:
    """Read one of the reference meshes by name."""

    def read(name: str) -> Mesh:
        with np.load(DATA / "meshes" / f"{name}.npz") as arrays:
            triangles = np.pad(arrays["tris"], ((0, 0), (0, 1)), constant_values=-1)
            elements = np.concatenate([arrays["quads"], triangles]).astype(np.int32)
            return flat_mesh(arrays["points"], elements, arrays["fixed"], float(arrays["h"]))

    return read


@pytest.fixture(scope="session")
def dented() -> Mesh:
    """Three by three squares of 100 mm whose four inner nodes are displaced."""
    x, y = np.meshgrid(np.arange(4.0), np.arange(4.0))
    nodes = 100 * np.stack([x.ravel(), y.ravel()], axis=1)
    inner = (nodes > 0).all(axis=1) & (nodes < 300).all(axis=1)
    nodes[inner] += np.random.default_rng(1).uniform(-30, 30, (4, 2))
    first = np.array([row * 4 + column for row in range(3) for column in range(3)])
    elements = first[:, None] + np.array([0, 1, 5, 4])
    return flat_mesh(nodes, elements, ~inner, 100.0)


@pytest.fixture(scope="session")
def bent() -> Callable[[int], tuple[np.ndarray, np.ndarray]]:
    """Make points and elements of a quarter of a cylinder of 500 mm, so many points across; some are triangles."""

    def make(columns: int) -> tuple[np.ndarray, np.ndarray]:
        s, t = np.meshgrid(np.linspace(0, np.pi / 2, columns), np.linspace(0, 800, columns))
        points = np.stack([500.0 * np.cos(s), t, 500.0 * np.sin(s)], axis=-1).reshape(-1, 3)
        corner = (np.arange(columns - 1)[:, None] * columns + np.arange(columns - 1)).reshape(-1, 1)
        elements = corner + np.array([0, 1, columns + 1, columns])
        second = elements[::7][:, [0, 2, 3]]  # the other half of a quad that becomes a triangle
        elements[::7, 3] = -1
        halves = np.pad(second, ((0, 0), (0, 1)), constant_values=-1)
        return points, np.concatenate([elements, halves]).astype(np.int32)

    return make
