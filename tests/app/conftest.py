import os
import sys

# The true 3-D view needs a screen (offscreen it paints garbage without an error); on Linux Xvfb is one.
if sys.platform.startswith("linux"):
    os.environ.setdefault("QT_QPA_PLATFORM", "xcb")

from itertools import islice

import numpy as np
import pytest

from hullquad.mesh import Mesh
from hullquad.metrics import metric
from hullquad.optimization.paper import paper_iterates
from hullquad.surface import Plane
from hullquad.topology import NodeState, topology
from hullquad_app.garbage import Garbage
from hullquad_app.track import Track


@pytest.fixture(scope="session", autouse=True)
def collector(qapp):
    """As in the program: sessions and windows that tests have left end in no thread but this one."""
    garbage = Garbage(qapp)
    yield
    garbage.release()


@pytest.fixture(scope="session")
def dented():
    """Three by three squares of 100 mm, the last cut into two triangles, whose inner nodes are displaced."""
    x, y = np.meshgrid(np.arange(4.0), np.arange(4.0))
    nodes = 100 * np.stack([x.ravel(), y.ravel()], axis=1)
    inner = (nodes > 0).all(axis=1) & (nodes < 300).all(axis=1)
    nodes[inner] += np.random.default_rng(1).uniform(-30, 30, (4, 2))
    first = np.array([row * 4 + column for row in range(3) for column in range(3)])
    quads = first[:-1, None] + np.array([0, 1, 5, 4])
    elements = np.concatenate([quads, [[10, 11, 15, -1], [10, 15, 14, -1]]]).astype(np.int32)
    states = np.where(inner, NodeState.FREE, NodeState.CONTOUR).astype(np.int8)
    ground = Plane([0, 0, 0], [1, 0, 0], [0, 1, 0])
    grid = topology(elements, states)
    return Mesh(points=ground.points(nodes), topology=grid, target_size=100.0, surface=ground, parameters=nodes)


@pytest.fixture(scope="session")
def walked(dented):
    """The track of twelve steps by stretch."""
    return Track(tuple(islice(paper_iterates(dented, metric("stretch")), 13)))
