"""The paper's mesher on every plane sample plate beside the bare call of Triangle with the same input."""

from pathlib import Path

import numpy as np
import pytest
import triangle

from hullquad import pipeline
from hullquad.formats import read_plates
from hullquad.triangulation.contour import contours

PLATES = Path(__file__).parents[2] / "assets" / "plates"
CONTOURS = {
    f"{key} {size}": contour
    for file in sorted(PLATES.glob("*.json"))
    if file.stem != "hopper_block"
    for size in ("coarse", "fine")
    for key, contour in contours(read_plates(file), size).items()
}


@pytest.mark.parametrize("name", CONTOURS)
def test_plate_to_quads(benchmark, name):
    benchmark.group = name
    pipeline.prepare()
    mesh = benchmark(pipeline.paper_mesh, CONTOURS[name])
    assert len(mesh.topology.quads) > 0


@pytest.mark.parametrize("name", CONTOURS)
def test_bare_triangle_call(benchmark, name):
    benchmark.group = name
    contour = CONTOURS[name]
    given = {"vertices": contour.nodes.copy(), "segments": contour.segments.copy()}
    if len(contour.hole_points):
        given["holes"] = contour.hole_points.copy()
    area = np.format_float_positional(pipeline.TRIANGLE_AREA * contour.size**2)
    made = benchmark(triangle.triangulate, given, f"pq{pipeline.MIN_ANGLE:g}a{area}YY")
    assert len(made["triangles"]) > 0
