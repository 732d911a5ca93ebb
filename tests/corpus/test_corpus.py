"""What must hold of every mesh of the best mesher, on random plates; a hundred of them, or as many as asked for.

``pytest tests/corpus --plates 2000`` goes through all of them. Every tenth one is meshed again with lines that elements
follow, and for every fiftieth there is a narrow one.
"""

import importlib.util
from pathlib import Path

import numpy as np
import pytest

from hullquad import pipeline
from hullquad.formats import read_plates
from hullquad.metrics import metric
from hullquad.metrics.values import judged_values, valid_elements
from hullquad.topology import edges

_spec = importlib.util.spec_from_file_location("corpus_plates", Path(__file__).with_name("plates.py"))
corpus = importlib.util.module_from_spec(_spec)
_spec.loader.exec_module(corpus)

HALVED = 655
"""A line of one segment goes across this plate, between regions whose chords are halved."""
NARROW = 1285
"""Lines make such narrow triangles of this plate that quads there are dearer than triangles are elsewhere."""
RING = 2050
"""A ring without room for triangles to come together in."""
TEMPLATE = next(iter(read_plates(Path(__file__).parents[2] / "assets/plates/hopper_partition.json").plates))
SCALED_JACOBIAN = metric("scaled_jacobian")


@pytest.fixture(scope="module", params=["plain", "lined", "narrow"])
def meshes(request):
    """Contours and their meshes."""
    pipeline.prepare()
    asked = request.config.getoption("--plates")
    numbers = np.linspace(0, corpus.COUNT - 1, asked).astype(int)
    chosen = {
        "plain": numbers,
        "lined": np.append(numbers[5::10], [HALVED, NARROW]),
        "narrow": np.append(corpus.COUNT + np.arange(asked // 50), RING),
    }
    contour = corpus.lined_contour if request.param == "lined" else corpus.plate_contour
    found = {int(number): contour(int(number), TEMPLATE) for number in chosen[request.param]}
    return {number: (contour, pipeline.best_mesh(contour, "corpus")) for number, contour in found.items()}


def failing(meshes, claim):
    return [number for number, (contour, mesh) in meshes.items() if not claim(contour, mesh)]


def test_every_contour_node_keeps_its_bits(meshes):
    assert not failing(meshes, lambda c, m: m.points[: len(c.points)].tobytes() == c.points.tobytes())


def test_every_mesh_is_conforming_and_has_the_contour_as_its_rim(meshes):
    def conforms(contour, mesh):
        found, counts = edges(mesh.topology.elements)
        rim = {tuple(edge) for edge in found[counts == 1].tolist()}
        return counts.max() <= 2 and rim == {tuple(sorted(edge)) for edge in contour.segments.tolist()}

    assert not failing(meshes, conforms)


def test_every_element_is_valid_and_runs_counter_clockwise(meshes):
    assert not failing(meshes, lambda c, m: valid_elements(m.points, m.topology.elements, m.normals).all())


def test_every_area_is_that_of_the_contour(meshes):
    def area(mesh):
        rows = mesh.topology.elements
        corners = mesh.parameters[np.where(rows < 0, rows[:, :1], rows)]
        corners = corners - corners[:1, :1]
        x, y = corners[..., 0], corners[..., 1]
        return 0.5 * (x * np.roll(y, -1, axis=1) - y * np.roll(x, -1, axis=1)).sum()

    assert not failing(meshes, lambda c, m: np.isclose(area(m), c.area, rtol=1e-9, atol=0))


def test_every_line_is_a_row_of_edges(meshes):
    def follows(contour, mesh):
        found = {tuple(edge) for edge in edges(mesh.topology.elements)[0].tolist()}
        return {tuple(sorted(edge)) for edge in contour.line_edges.tolist()} <= found

    assert not failing(meshes, follows)


@pytest.mark.parametrize("unavoidable", ["none", "some"])
def test_triangles_are_as_few_as_the_contour_allows(meshes, unavoidable, record_property):
    chosen = {n: (c, m) for n, (c, m) in meshes.items() if (c.triangles_unavoidable > 0) == (unavoidable == "some")}
    if not chosen:
        pytest.skip("there is none among so few plates")
    excess = {n: len(m.topology.triangles) - c.triangles_unavoidable for n, (c, m) in chosen.items()}
    record_property("corpus", figures(chosen, excess, unavoidable))
    assert max(excess.values()) <= 2, excess
    assert sum(count == 0 for count in excess.values()) >= 0.99 * len(excess), {n: e for n, e in excess.items() if e}


def figures(chosen, excess, unavoidable):
    """What is told at the end of a run."""
    least = [judged_values(SCALED_JACOBIAN, m.points, m.topology.quads, m.normals)[0] for _, m in chosen.values()]
    elements = sum(len(mesh.topology.elements) for _, mesh in chosen.values())
    more = {number: count for number, count in excess.items() if count}
    worst, mean = min(values.min(initial=1) for values in least), np.concatenate(least).mean()
    return (
        f"{len(chosen)} plates, {unavoidable} of their triangles unavoidable: {elements} elements, "
        f"{len(chosen) - len(more)} plates at the minimum, others (plate: triangles more) {more or 'none'}; "
        f"scaled Jacobian: least {worst:.3f}, mean {mean:.4f}"
    )
