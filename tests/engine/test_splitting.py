"""Triangles taken out by splitting the edges on a way between them, and plates that need it."""

from pathlib import Path

import numpy as np
import pytest

from hullquad import pipeline
from hullquad.formats import read_plates
from hullquad.metrics.values import valid_elements
from hullquad.quads.energy import INVALID, MOST, element_energies
from hullquad.quads.splitting import split
from hullquad.quads.stages import padded
from hullquad.topology import edges
from hullquad.triangulation.contour import Contour
from hullquad.triangulation.delaunay import triangulate

TEMPLATE = next(iter(read_plates(Path(__file__).parents[2] / "assets/plates/hopper_partition.json").plates))
NONE = np.empty((0, 2), dtype=np.int32)


def corners_of(count: int, seed: int) -> np.ndarray:
    """A star with so many corners, some of them reflex."""
    rng = np.random.default_rng(seed)
    angles = (np.arange(count) + rng.uniform(-0.3, 0.3, count)) * 2 * np.pi / count
    return rng.uniform(0.5, 1.0, count)[:, None] * np.stack([np.cos(angles), np.sin(angles)], axis=1)


def rim(elements: np.ndarray) -> set[tuple[int, ...]]:
    found, counts = edges(elements)
    assert counts.max() == 2
    return {tuple(edge) for edge in found[counts == 1].tolist()}


@pytest.mark.parametrize("count", [4, 5, 6, 9, 14])
@pytest.mark.parametrize("seed", range(4))
def test_triangles_alone_are_split_until_no_two_are_left(count, seed):
    found = triangulate(corners_of(count, seed), [0, count], area=None, place="plate")
    nodes, elements = found.nodes, padded(found.triangles)
    outline = rim(elements)
    for left in range(count - 4, -1, -2):
        nodes, elements = split(nodes, elements, NONE)
        assert (elements[:, 3] < 0).sum() == left
        assert element_energies(nodes.copy(), elements.astype(np.int64)).max() < INVALID
        assert rim(elements) == outline
    assert (elements[:, 3] < 0).sum() == count % 2
    assert split(nodes, elements, NONE) is None


def test_a_way_goes_straight_on_or_turns_through_quads():
    nodes = np.array([(0, 0), (1, 0), (2, 0), (0, 1), (1, 1), (2, 1), (-1, 0.5), (1.5, 2)], dtype=float)
    elements = np.array([[0, 1, 4, 3], [1, 2, 5, 4], [0, 3, 6, -1], [5, 7, 4, -1]], dtype=np.int32)
    nodes, elements = split(nodes, elements, NONE)
    assert len(elements) == 2 + 2 + 3
    assert (elements >= 0).all()
    assert element_energies(nodes, elements.astype(np.int64)).max() < MOST


def test_an_edge_that_must_stay_is_not_split():
    nodes = np.array([(0, 0), (1, 0), (0, 1), (1, 1), (-1, 0.5), (2, 0.5)], dtype=float)
    elements = np.array([[0, 1, 3, 2], [0, 2, 4, -1], [1, 5, 3, -1]], dtype=np.int32)
    assert split(nodes, elements, np.array([[2, 0]], dtype=np.int32)) is None
    assert split(nodes, elements, NONE) is not None


def bar(below: int, above: int, width: float) -> list[np.ndarray]:
    """A straight strip with different numbers of segments on its long sides."""
    down, up = np.linspace(0, 100 * max(below, above), below + 1), np.linspace(100 * max(below, above), 0, above + 1)
    return [np.concatenate([np.stack([down, 0 * down], axis=1), np.stack([up, 0 * up + width], axis=1)])]


def ring(outer: int, inner: int, radius: float, width: float) -> list[np.ndarray]:
    """A narrow ring."""
    turns = [sign * np.arange(count) * 2 * np.pi / count for sign, count in ((1, outer), (-1, inner))]
    radii = radius / np.cos(np.pi / outer), radius - width
    return [r * np.stack([np.cos(t), np.sin(t)], axis=1) for r, t in zip(radii, turns, strict=True)]


DART = [np.array([(-749.0, -1938.0), (-637.0, -2004.0), (-676.0, -1952.0), (-621.0, -1916.0)])]
NARROW = {
    "dart": DART,
    "bar of a tenth": bar(1, 3, 10.0),
    "bar of one long segment": bar(1, 11, 55.0),
    "bar, odd": bar(3, 8, 12.0),
    "ring of a tenth": ring(19, 19, 310.0, 12.0),
    "ring, odd": ring(20, 15, 310.0, 16.0),
    "ring, far from even": ring(24, 12, 360.0, 14.0),
}


@pytest.mark.parametrize("name", NARROW)
def test_narrow_plates_have_no_triangle_but_the_unavoidable_one(name):
    loops = NARROW[name]
    starts = np.cumsum([0, *map(len, loops)])
    contour = Contour(plate=TEMPLATE, size=100.0, nodes=np.concatenate(loops), loop_starts=starts)
    mesh = pipeline.best_mesh(contour)
    assert len(mesh.topology.triangles) == contour.triangles_unavoidable
    assert valid_elements(mesh.points, mesh.topology.elements, mesh.normals).all()
    assert mesh.points[: len(contour.points)].tobytes() == contour.points.tobytes()
    assert rim(mesh.topology.elements) == {tuple(sorted(edge)) for edge in contour.segments.tolist()}
