"""The element below the cursor is found without OpenGL."""

from time import perf_counter

import numpy as np
import pytest

from hullquad.mesh import Mesh
from hullquad.sight import plan
from hullquad.topology import rim_states, topology
from hullquad_app.canvas.camera import Camera
from hullquad_app.canvas.picker import Picker, corners, nodes_of
from hullquad_app.canvas.tip import tip


@pytest.fixture
def plan_view(coarse):
    right, up = plan(coarse)
    return Camera().turned(right, up).fitted(coarse.points, 600, 400, 20)


def centroids(mesh):
    return np.array([corners(mesh, row).mean(axis=0) for row in range(len(mesh.topology.elements))])


def picked(mesh, camera, picker=None):
    """Rows found at the centroids."""
    picker = picker or Picker()
    places = (camera.place(x, y) for x, y in camera.pixels(centroids(mesh)))
    return [picker.element_at(mesh, camera, place) for place in places]


@pytest.mark.parametrize("turn", [(0, 0), (70, -40), (450, 0)], ids=["plan", "oblique", "behind"])
def test_every_element_is_found_at_its_centroid(coarse, plan_view, turn):
    camera = plan_view.orbited(*turn, plan_view.centre)
    assert picked(coarse, camera) == list(range(len(coarse.topology.elements)))


def test_moved_nodes_are_seen_at_once(coarse, moved, plan_view):
    picker = Picker()
    picked(coarse, plan_view, picker)
    assert picked(moved, plan_view, picker) == picked(moved, plan_view)


def test_there_is_nothing_to_find_without_a_mesh(plan_view):
    assert Picker().element_at(None, plan_view, np.zeros(2)) == -1


def test_the_nodes_of_a_triangle_are_three(coarse):
    row = int(np.flatnonzero(coarse.topology.is_triangle)[0])
    assert len(corners(coarse, row)) == len(nodes_of(coarse, [row])) == 3


def test_an_element_is_found_quickly_among_a_hundred_thousand():
    x, y = np.meshgrid(np.arange(317.0), np.arange(317.0))
    first = np.array([row * 317 + column for row in range(316) for column in range(316)])
    elements = (first[:, None] + np.array([0, 1, 318, 317])).astype(np.int32)
    points = np.stack([x.ravel(), y.ravel(), 0 * x.ravel()], axis=1)
    mesh = Mesh(points=points, topology=topology(elements, rim_states(elements, len(points))), target_size=1)
    camera, picker = Camera(), Picker()
    times = []
    for _ in range(3):
        start = perf_counter()
        assert picker.element_at(mesh, camera.turned(camera.right.copy(), camera.up), np.array([5.5, 2.5])) == 637
        times.append(perf_counter() - start)
    assert min(times) < 0.1  # 10 ms on an idle machine


def test_a_tip_names_kind_metric_and_failure(give, coarse, folded):
    quality = give(coarse).quality
    triangle = int(np.flatnonzero(coarse.topology.is_triangle)[0])
    assert tip(coarse.topology, quality, 0) == f"element 1 · quad · stretch {quality.values[0]:.3f}"
    assert tip(coarse.topology, quality, triangle).startswith(f"element {triangle + 1} · triangle · shape 0.")
    bad = give(folded).quality
    inverted = int(np.flatnonzero(~bad.valid)[0])
    assert tip(folded.topology, bad, inverted) == f"element {inverted + 1} · quad · INVERTED"
