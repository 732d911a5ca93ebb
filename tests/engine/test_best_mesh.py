"""The best mesher: what holds on every plane sample plate, and the grids it must find."""

from pathlib import Path

import numpy as np
import pytest

from hullquad import pipeline
from hullquad.formats import read_plates
from hullquad.metrics import metric
from hullquad.metrics.values import judged_values, valid_elements
from hullquad.quads import making
from hullquad.quads.settings import MeshSettings, Preference
from hullquad.quads.stages import Step
from hullquad.topology import edges
from hullquad.triangulation.contour import Contour, contours

PLATES = Path(__file__).parents[2] / "assets" / "plates"
CONTOURS = {
    f"{file.stem}-{key} {size}": contour
    for file in sorted(PLATES.glob("*.json"))
    for size in ("coarse", "fine")
    for key, contour in contours(read_plates(file), size).items()
}
TEMPLATE = CONTOURS["hopper_partition-hopper_partition coarse"]


def outline(corners: list[tuple[float, float]], size: float) -> Contour:
    """Contour of a polygon whose edges are whole numbers of segments."""
    rows, ring = [], np.array(corners, dtype=float)
    for start, end in zip(ring, np.roll(ring, -1, axis=0), strict=True):
        count = round(np.hypot(*(end - start)) / size)
        rows.append(start + (np.arange(count) / count)[:, None] * (end - start))
    return of_nodes(np.concatenate(rows), size)


def of_nodes(nodes: np.ndarray, size: float) -> Contour:
    return Contour(plate=TEMPLATE.plate, size=size, nodes=nodes, loop_starts=[0, len(nodes)])


@pytest.mark.parametrize("name", CONTOURS)
def test_a_sample_plate_has_only_the_triangles_that_its_contour_asks_for(name):
    contour = CONTOURS[name]
    mesh = pipeline.best_mesh(contour)
    assert len(mesh.topology.triangles) == contour.triangles_unavoidable
    assert mesh.points[: len(contour.points)].tobytes() == contour.points.tobytes()
    assert valid_elements(mesh.points, mesh.topology.elements, mesh.normals).all()
    found, counts = edges(mesh.topology.elements)
    assert {tuple(e) for e in found[counts == 1].tolist()} == {tuple(sorted(e)) for e in contour.segments.tolist()}


@pytest.mark.parametrize(
    ("corners", "count"),
    [
        ([(0, 0), (800, 0), (800, 500), (0, 500)], 40),
        ([(0, 0), (900, 0), (900, 300), (400, 300), (400, 800), (0, 800)], 47),
    ],
    ids=["rectangle", "L"],
)
def test_rectangles_and_l_shapes_become_exact_grids(corners, count):
    mesh = pipeline.best_mesh(outline(corners, 100.0))
    assert len(mesh.topology.quads) == len(mesh.topology.elements) == count
    np.testing.assert_allclose(mesh.parameters, np.round(mesh.parameters / 100) * 100, atol=1e-3)


def test_a_rectangle_keeps_the_spacing_of_each_pair_of_sides():
    base = outline([(0, 0), (800, 0), (800, 500), (0, 500)], 100.0)
    mesh = pipeline.best_mesh(of_nodes(base.nodes * [1.0, 1.1], 100.0))
    assert len(mesh.topology.elements) == 40
    values, _ = judged_values(metric("scaled_jacobian"), mesh.points, mesh.topology.quads, mesh.normals)
    assert values.min() > 0.9999


def test_fine_seeds_do_not_flood_a_plate():
    base = outline([(0, 0), (2000, 0), (2000, 1000), (0, 1000)], 100.0)
    fine = np.stack([np.linspace(1000, 1100, 11)[1:-1], np.zeros(9)], axis=1)
    nodes = np.insert(base.nodes, 11, fine, axis=0)
    mesh = pipeline.best_mesh(of_nodes(nodes, 100.0))
    assert len(mesh.topology.elements) < 1.5 * 200


def test_a_plate_with_two_sharp_tips_has_a_triangle_in_neither():
    upper = [(706, 0), (668, 99), (631, 197), (593, 296), (555, 394), (445, 368), (334, 341), (223, 315), (111, 288)]
    lower = [(0, 262), (80, 245), (160, 228), (240, 212), (320, 195), (399, 178), (479, 162), (555, 108), (631, 54)]
    mesh = pipeline.best_mesh(of_nodes(np.array([*upper, *lower], dtype=float), 100.0))
    assert len(mesh.topology.triangles) == 0


def test_a_smaller_grading_makes_more_elements_around_fine_seeds():
    contour = CONTOURS["floor_manholes_slots-floor_manholes_slots coarse"]
    small, large = (len(pipeline.best_mesh(contour, "", MeshSettings(grading=g)).topology.elements) for g in (0.3, 0.9))
    assert small > large


def test_quality_may_be_preferred_to_the_fewest_triangles():
    contour = CONTOURS["hopper_web_ring-hopper_web_ring coarse"]

    def worst(prefer: Preference) -> float:
        mesh = pipeline.best_mesh(contour, "", MeshSettings(prefer=prefer))
        return float(judged_values(metric("shape"), mesh.points, mesh.topology.elements, mesh.normals)[0].min())

    assert worst(Preference.QUALITY) >= worst(Preference.QUADS)


def test_a_large_mesh_is_not_shaken(monkeypatch):
    contour = CONTOURS["hopper_web_ring-hopper_web_ring coarse"]

    def steps():
        return {stage.step for stage in pipeline.best_stages(contour) if stage is not None}

    assert Step.SHAKEN in steps()
    monkeypatch.setattr(making, "_LARGE", 10)
    assert Step.SHAKEN not in steps()


def test_the_same_plate_gives_the_same_best_mesh():
    one, other = (pipeline.best_mesh(CONTOURS["stool_plate-stool_plate coarse"]) for _ in range(2))
    assert one.points.tobytes() == other.points.tobytes()
    assert one.topology.elements.tobytes() == other.topology.elements.tobytes()


@pytest.fixture(scope="module")
def stages():
    """All stages of a plate that is meshed several times, without the places where it may be dropped."""
    return [stage for stage in pipeline.best_stages(CONTOURS["stool_plate-stool_plate coarse"]) if stage is not None]


def test_stages_begin_with_triangles_and_their_last_best_one_is_the_mesh(stages):
    contour = CONTOURS["stool_plate-stool_plate coarse"]
    assert stages[0].step is Step.TRIANGULATED
    assert len(stages[0].mesh().topology.quads) == 0
    best = [stage for stage in stages if stage.is_best][-1].mesh()
    alone = pipeline.best_mesh(contour)
    assert best.points.tobytes() == alone.points.tobytes()
    assert best.topology.elements.tobytes() == alone.topology.elements.tobytes()


def test_every_stage_fills_the_plate_and_keeps_the_nodes_of_its_contour(stages):
    contour = CONTOURS["stool_plate-stool_plate coarse"]
    for stage in stages:
        mesh = stage.mesh()
        assert mesh.points[: len(contour.points)].tobytes() == contour.points.tobytes()
        counts = edges(mesh.topology.elements)[1]
        assert counts.max() == 2
        assert (counts == 1).sum() == contour.edge_count


def test_every_join_is_a_stage_and_quads_at_the_contour_come_first(stages):
    first = [
        stage.mesh() for stage in stages if stage.candidate == 0 and stage.step in (Step.TRIANGULATED, Step.JOINED)
    ]
    quads = [set(map(tuple, mesh.topology.quads.tolist())) for mesh in first]
    assert [len(found) for found in quads] == list(range(len(quads)))
    rim = set(map(tuple, CONTOURS["stool_plate-stool_plate coarse"].segments.tolist()))
    sides = [zip(quad, quad[1:] + quad[:1], strict=True) for (quad,) in map(set.difference, quads[1:], quads)]
    at_rim = [not rim.isdisjoint(sides_of_one) for sides_of_one in sides]
    assert at_rim == sorted(at_rim, reverse=True)
    assert 0 < sum(at_rim) < len(at_rim)


def test_every_step_of_the_making_is_shown(stages):
    assert {stage.step for stage in stages} == set(Step) - {Step.MAPPED}


def test_a_stage_is_the_same_mesh_whenever_it_is_put_together(stages):
    for stage in stages[:: len(stages) // 10]:
        assert stage.mesh().points.tobytes() == stage.mesh().points.tobytes()


def test_the_stages_of_the_paper_lead_to_its_mesh():
    contour = CONTOURS["floor_manholes-floor_manholes coarse"]
    stages = [stage for stage in pipeline.paper_stages(contour) if stage is not None]
    quads = [len(stage.mesh().topology.quads) for stage in stages]
    assert quads == list(range(len(stages)))
    mesh, alone = stages[-1].mesh(), pipeline.paper_mesh(contour)
    assert mesh.topology.elements.tobytes() == alone.topology.elements.tobytes()
    assert mesh.points.tobytes() == alone.points.tobytes()


def test_a_mesh_that_is_not_wanted_any_more_costs_nothing_more():
    stages = pipeline.best_stages(CONTOURS["stool_plate-stool_plate fine"])
    next(stages)
    stages.close()
    assert next(stages, None) is None
