"""Meshes whose elements follow stiffeners and seams: what holds on sample plates, and the grids that must be found."""

from pathlib import Path

import numpy as np
import pytest

from hullquad import pipeline
from hullquad.curves import Arc, Straight
from hullquad.formats import read_mesh, read_plates, write_mesh
from hullquad.metrics.values import valid_elements
from hullquad.plate import Document, Line, Plate, Sizes, closed_loop
from hullquad.quads.stages import Step
from hullquad.surface import Plane
from hullquad.topology import NodeState, edges
from hullquad.triangulation.contour import contours

PLATES = Path(__file__).parents[2] / "assets" / "plates"
CONTOURS = {
    f"{file.stem}-{key} {size}": contour
    for file in sorted(PLATES.glob("*.json"))
    for size in ("coarse", "fine")
    for key, contour in contours(read_plates(file), size, follow_lines=True).items()
    if len(contour.line_edges)
}
SAMPLES = ("bracket_toe", "deck_transverse", "hopper_partition_stiffened", "stool_plate", "stringer_opening")
COARSE = [f"{name}-{name} coarse" for name in SAMPLES]
STIFFENED = "hopper_partition_stiffened-hopper_partition_stiffened coarse"


def described(curves, lines, size):
    return Plate(
        id="P",
        thickness=10,
        material="A",
        surface=Plane([0, 0, 500], [0, 1, 0], [0, 0, 1]),
        outer=closed_loop(curves, "/plates/0/outer", is_hole=False),
        stiffeners=tuple(Line(a, b, f"/plates/0/stiffeners/{i}") for i, (a, b) in enumerate(lines)),
        target_size=size,
        sizes=Sizes.of(size),
        place="/plates/0",
    )


def followed(curves, lines, size):
    plate = described(curves, lines, size)
    return contours(Document(name="d", materials={}, plates=(plate,)), follow_lines=True)["P"]


def straight(*corners):
    rows = [np.array(corner, dtype=float) for corner in corners]
    return [Straight(a, b) for a, b in zip(rows, [*rows[1:], rows[0]], strict=True)]


def edge_set(found):
    return {tuple(sorted(edge)) for edge in found.tolist()}


def check(mesh, contour):
    """What holds of every mesh that follows lines."""
    found, counts = edges(mesh.topology.elements)
    assert edge_set(contour.line_edges) <= edge_set(found)
    assert edge_set(found[counts == 1]) == edge_set(contour.segments)
    assert counts.max() == 2
    assert mesh.points[: len(contour.points)].tobytes() == contour.points.tobytes()
    assert valid_elements(mesh.points, mesh.topology.elements, mesh.normals).all()
    on_line = mesh.topology.node_states == NodeState.ON_LINE
    assert (on_line == (mesh.topology.node_lines >= 0)).all()
    start, end = mesh.lines[mesh.topology.node_lines[on_line]].transpose(1, 0, 2)
    away = np.linalg.norm(np.cross(mesh.points[on_line] - start, end - start), axis=1)
    assert (away <= 1e-9 * (1 + np.linalg.norm(end - start, axis=1) * np.abs(mesh.points).max())).all()


@pytest.mark.parametrize("name", COARSE)
def test_a_sample_plate_follows_its_lines_with_only_the_triangles_that_they_ask_for(name):
    contour = CONTOURS[name]
    mesh = pipeline.best_mesh(contour)
    check(mesh, contour)
    assert len(mesh.topology.triangles) == contour.triangles_unavoidable == mesh.triangles_unavoidable


def test_no_more_triangles_are_unavoidable_than_of_the_contours_alone():
    assert {name: c.triangles_unavoidable for name, c in CONTOURS.items()} == {
        name: c.edge_count % 2 for name, c in CONTOURS.items()
    }


@pytest.mark.parametrize("name", COARSE)
def test_the_paper_follows_lines_too(name):
    check(pipeline.paper_mesh(CONTOURS[name]), CONTOURS[name])


def test_every_stage_is_glued_together_along_the_lines():
    contour = CONTOURS["corrugation_face-corrugation_face coarse"]
    stages = list(pipeline.best_stages(contour))
    assert [stage.step for stage in stages if stage is not None] == [Step.MAPPED]
    contour = CONTOURS[STIFFENED]
    for stage in [stage for stage in pipeline.best_stages(contour) if stage is not None][::40]:
        mesh = stage.mesh()
        found, counts = edges(mesh.topology.elements)
        assert edge_set(found[counts == 1]) == edge_set(contour.segments)
        assert edge_set(contour.line_edges) <= edge_set(found)


def test_the_same_plate_gives_the_same_mesh():
    one, other = (pipeline.best_mesh(CONTOURS[STIFFENED]) for _ in range(2))
    assert one.points.tobytes() == other.points.tobytes()
    assert one.topology.elements.tobytes() == other.topology.elements.tobytes()


def test_bays_with_agreeing_sides_become_grids():
    lines = [((x, 0), (x, 1000 - 0.02 * x)) for x in range(400, 2000, 400)]
    contour = followed(straight((0, 0), (2000, 0), (2000, 960), (0, 1000)), lines, 100.0)
    mesh = pipeline.best_mesh(contour)
    assert len(mesh.topology.elements) == len(mesh.topology.quads)
    for a, b, c, d in contour.sides.four_sided.values():
        assert (len(a), len(b)) == (len(c), len(d))
    assert len(mesh.topology.quads) == sum(len(a) * len(b) for a, b, _, _ in contour.sides.four_sided.values())


def test_a_bay_with_a_round_side_becomes_a_grid():
    curves = [
        *straight((0, 0), (2000, 0), (2000, 1000), (0, 1000))[:2],
        Arc((2000.0, 1000.0), (1000.0, 1000.0), 0.15),
        Arc((1000.0, 1000.0), (0.0, 1000.0), 0.15),
        Straight((0.0, 1000.0), (0.0, 0.0)),
    ]
    contour = followed(curves, [((1000, 0), (1000, 1000))], 100.0)
    mesh = pipeline.best_mesh(contour)
    assert len(contour.sides.four_sided) == 2
    interior = len(mesh.points) - len(contour.points)
    sides = [(len(a) - 1) * (len(b) - 1) for a, b, _, _ in contour.sides.four_sided.values()]
    assert len(mesh.topology.triangles) == 0
    assert interior == sum(sides)


def test_a_mesh_that_follows_lines_comes_back_from_its_file(tmp_path):
    mesh = pipeline.best_mesh(CONTOURS["floor_manholes-floor_manholes coarse"], "0" * 64)
    write_mesh(mesh, tmp_path / "floor.vtu")
    again = read_mesh(tmp_path / "floor.vtu")
    assert again.topology.node_states.tobytes() == mesh.topology.node_states.tobytes()
    assert again.topology.node_lines.tobytes() == mesh.topology.node_lines.tobytes()
    assert again.lines.tobytes() == mesh.lines.tobytes()
    assert again.triangles_unavoidable == mesh.triangles_unavoidable == 0
    assert (again.topology.node_states == NodeState.ON_LINE).sum() == 11


def test_without_following_only_ends_of_lines_are_nodes():
    contour = contours(read_plates(PLATES / "floor_manholes.json"), "coarse")["floor_manholes"]
    assert not (pipeline.best_mesh(contour).topology.node_states == NodeState.ON_LINE).any()


def test_lines_that_cross_anyhow_are_followed_by_valid_elements():
    rng = np.random.default_rng(0)
    corners = (0, 0), (2000, 0), (2000, 1000), (0, 1000)
    contour = followed(straight(*corners), rng.uniform([0, 0], [2000, 1000], (25, 2, 2)), 100.0)
    mesh = pipeline.best_mesh(contour)
    check(mesh, contour)
    assert len(mesh.topology.elements) < 1500
