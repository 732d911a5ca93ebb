"""Which triangles are left beside the unavoidable ones, and why."""

from pathlib import Path

import attrs
import pytest

from hullquad import pipeline
from hullquad.formats import read_plates
from hullquad.mesh import Mesh
from hullquad.quads.remaining import Cause, cause_of, remaining_triangles
from hullquad.quads.settings import Preference
from hullquad.triangulation.contour import contours

PLATES = Path(__file__).parents[2] / "assets" / "plates"


@pytest.fixture(scope="module")
def contour():
    return contours(read_plates(PLATES / "floor_manholes.json"), "coarse")["floor_manholes"]


@pytest.fixture(scope="module")
def poor(contour) -> Mesh:
    mesh = pipeline.paper_mesh(contour)
    assert len(mesh.topology.triangles) > contour.triangles_unavoidable + 1
    return mesh


def test_nothing_is_said_of_a_mesh_with_the_unavoidable_ones_only(contour):
    assert remaining_triangles(pipeline.best_mesh(contour), "/plates/0", Cause.NO_WAY) is None
    even = pipeline.paper_mesh(contour)
    content = attrs.evolve(even, unavoidable=len(even.topology.triangles))
    assert remaining_triangles(content, "/plates/0", Cause.PAPER) is None


@pytest.mark.parametrize("cause", Cause)
def test_each_is_named_with_its_place_and_it_is_told_why(poor, cause):
    notice = remaining_triangles(poor, "/plates/0", cause)
    labels = poor.topology.element_labels[poor.topology.is_triangle]
    u, v = poor.parameters[poor.topology.triangles[0]].mean(axis=0)
    assert f"elements {labels[0]} at ({u:.4g}, {v:.4g})" in notice.text
    assert f"{len(labels) - poor.triangles_unavoidable} triangles more" in notice.text
    assert {"paper": "the best mesher leaves", "quality": "prefer quads", "": "smaller size"}[
        cause.value
    ] in notice.text


def test_the_best_mesher_leaves_them_for_want_of_a_way_or_for_quality():
    assert cause_of(Preference.QUADS) is Cause.NO_WAY
    assert cause_of(Preference.QUALITY) is Cause.QUALITY
