"""From real plates to improved quads: what must hold on every plane sample plate."""

import json
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest
from shapely import Polygon

from hullquad import pipeline
from hullquad.errors import MeshingError
from hullquad.formats import read_mesh, read_plates, write_mesh
from hullquad.metrics import metric
from hullquad.optimization.iterate import outcome
from hullquad.optimization.paper import PaperSettings, paper_iterates
from hullquad.topology import NodeState, edges
from hullquad.triangulation.contour import Contour, contours
from hullquad.worker import WorkerError

PLATES = Path(__file__).parents[2] / "assets" / "plates"
DOCUMENTS = {path.stem: read_plates(path) for path in sorted(PLATES.glob("*.json"))}
COARSE = {
    f"{name}-{key}" if name == "hopper_block" else name: contour
    for name, document in DOCUMENTS.items()
    for key, contour in contours(document, "coarse").items()
}


def covered_area(mesh) -> float:
    corners = mesh.topology.elements
    rows = mesh.parameters[np.where(corners < 0, corners[:, :1], corners)]
    x, y = rows[..., 0] - rows[0, 0, 0], rows[..., 1] - rows[0, 0, 1]
    return float(0.5 * (x * np.roll(y, -1, axis=1) - y * np.roll(x, -1, axis=1)).sum())


def given_area(contour: Contour) -> float:
    outer, *holes = contour.rings
    return Polygon(outer, holes).area


def test_all_plane_plates_are_here():
    assert len(COARSE) == 15 + 13


@pytest.mark.parametrize("name", COARSE)
def test_a_sample_plate_keeps_its_contour_and_its_area_from_start_to_end(name):
    contour = COARSE[name]
    mesh = pipeline.paper_mesh(contour)
    given = len(contour.points)
    assert mesh.points[:given].tobytes() == contour.points.tobytes()
    assert (mesh.topology.node_states[: contour.edge_count] == NodeState.CONTOUR).all()
    assert (mesh.topology.node_states[contour.edge_count : given] == NodeState.FIXED).all()
    assert (mesh.topology.node_states[given:] == NodeState.FREE).all()
    rim, counts = edges(mesh.topology.elements)
    assert {tuple(edge) for edge in rim[counts == 1].tolist()} == {tuple(sorted(e)) for e in contour.segments.tolist()}
    assert counts.max() <= 2
    run = outcome(paper_iterates(mesh, metric("stretch"), PaperSettings(iterations=200)))
    for iterate in (run.first, run.best, run.last):
        assert iterate.quality.inverted_count == 0
        assert iterate.mesh.points[:given].tobytes() == contour.points.tobytes()
        np.testing.assert_allclose(covered_area(iterate.mesh), given_area(contour), rtol=1e-9)
    assert run.best.objective >= run.first.objective


@pytest.mark.parametrize("name", COARSE)
def test_the_triangles_left_have_the_parity_of_the_contour(name):
    contour = COARSE[name]
    mesh = pipeline.paper_mesh(contour)
    assert len(mesh.topology.triangles) % 2 == contour.triangles_unavoidable
    assert len(mesh.topology.triangles) <= 0.25 * len(mesh.topology.elements)


@pytest.mark.parametrize("decimals", [6, 7, 8, 12])
def test_the_mesh_of_a_plate_with_a_rounded_frame_can_be_read_again(decimals, tmp_path):
    turn = np.radians(45)
    described = json.loads((PLATES / "hopper_partition.json").read_text(encoding="utf-8"))
    axes = {"u": [np.cos(turn), np.sin(turn), 0], "v": [0, 0, 1]}
    described["plates"][0]["frame"] |= {key: np.round(axis, decimals).tolist() for key, axis in axes.items()}
    (tmp_path / "turned.json").write_text(json.dumps(described), encoding="utf-8")
    (contour,) = contours(read_plates(tmp_path / "turned.json")).values()
    mesh = pipeline.paper_mesh(contour)
    write_mesh(mesh, tmp_path / "turned.vtu")
    again = read_mesh(tmp_path / "turned.vtu")
    assert again.points.tobytes() == mesh.points.tobytes()


def test_what_stops_a_plate_tells_its_place_and_its_name(monkeypatch):
    def crash(*_: object, place: str, **__: object) -> None:
        raise WorkerError("E_CRASH", place, ending="signal 11")

    monkeypatch.setattr(pipeline, "triangulate", crash)
    with pytest.raises(WorkerError, match="E_CRASH at /plates/0: plate hopper_partition: the computation crashed"):
        pipeline.paper_mesh(COARSE["hopper_partition"])


def test_curved_plates_are_told_not_yet():
    for name in ("bilge_shell", "bow_shell"):
        (plate,) = DOCUMENTS[name].plates
        with pytest.raises(MeshingError, match="curved surfaces: not yet"):
            pipeline.plane_of(plate)


def test_the_mean_element_has_the_size_asked_for():
    contour = contours(DOCUMENTS["hopper_partition"], 150.0)["hopper_partition"]
    mesh = pipeline.paper_mesh(contour)
    assert 0.8 < contour.area / len(mesh.topology.elements) / 150.0**2 < 1.25


def test_the_same_plate_gives_the_same_mesh():
    one, other = (pipeline.paper_mesh(COARSE["floor_manholes"]) for _ in range(2))
    assert one.points.tobytes() == other.points.tobytes()
    assert one.topology.elements.tobytes() == other.topology.elements.tobytes()


def test_nothing_is_left_to_compile_once_it_is_prepared():
    code = """
from pathlib import Path
from hullquad import pipeline
from hullquad.formats import read_plates
from hullquad.metrics import METRICS
from hullquad.optimization.paper import PaperSettings, paper_iterates
from hullquad.placement import placed
from hullquad.quality import quality
from hullquad.triangulation.contour import contours
import attrs, sys
pipeline.prepare()
from hullquad.metrics import kernels, machine, quad, vectors
from hullquad.quads import augment, cleanup, cost, draft, front, matching, opening, repair, shaking, smoothing, walk
from hullquad.triangulation import points
modules = (kernels, machine, quad, vectors, augment, front, matching, draft, smoothing, cleanup, walk, opening, repair,
           shaking, cost, points)
known = lambda: {(m.__name__, n): len(f.signatures) for m in modules
                 for n, f in vars(m).items() if hasattr(f, "signatures")}
before = known()
document = read_plates(Path(sys.argv[1]))
for contour in contours(document, "fine").values():
    pipeline.best_mesh(contour)
    mesh = pipeline.paper_mesh(contour)
    for row in METRICS:
        best = list(paper_iterates(mesh, row, PaperSettings(iterations=2)))[-1].mesh
        quality(placed(attrs.evolve(best, surface=None, parameters=None)), row)
        quality(attrs.evolve(best, surface=None, parameters=None), row)
assert before and known() == before, {k: v for k, v in known().items() if v != before.get(k)}
"""
    done = subprocess.run(
        [sys.executable, "-c", code, PLATES / "stringer_opening.json"], capture_output=True, text=True, check=False
    )
    assert done.returncode == 0, done.stderr
