"""Metrics against VTK's mesh quality (Verdict) on random valid elements, planar and warped."""

from collections.abc import Callable

import numpy as np
import pytest
import pyvista
from numpy.testing import assert_allclose
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkFiltersVerdict import vtkCellQuality, vtkMeshQuality

from hullquad.metrics import METRICS, metric
from hullquad.metrics.values import judged_values

COUNT = 10_000
LEAST_ANGLE = 1.0
"""[degrees]; VTK takes angles by the arc cosine, which loses digits below."""

# metric -> VTK's measure of quads and of triangles of the same definition
SAME_BY_DEFINITION = {
    "stretch": ("Stretch", None),
    "aspect_ratio": ("EdgeRatio", "EdgeRatio"),
    "scaled_jacobian": ("ScaledJacobian", "ScaledJacobian"),
    "shape": ("Shape", "Shape"),
    "min_angle": ("MinAngle", "MinAngle"),
    "max_angle": ("MaxAngle", "MaxAngle"),
    "taper": ("Taper", None),
    "condition": ("Condition", "Condition"),
    "shear": ("Shear", None),
    "ansys_max_corner_angle": ("MaxAngle", "MaxAngle"),
    "cubit_aspect_ratio": ("MaxEdgeRatio", None),
    "verdict_aspect_ratio": ("AspectRatio", "AspectRatio"),
}
# metric -> VTK's measure and what ours is of it; VTK's sizes are relative to the mean area of the cells
FUNCTION_OF_VTK: dict[str, tuple[str | None, str | None, Callable[[np.ndarray], np.ndarray]]] = {
    "warpage": ("Warpage", None, np.cbrt),
    "relative_size": ("RelativeSizeSquared", "RelativeSizeSquared", np.sqrt),
    "warp_angle": ("Warpage", None, lambda cube: np.degrees(np.arccos(np.cbrt(cube)))),
}
# metric -> why VTK's measure of that name is another one where elements are warped
SAME_WHERE_PLANAR = {
    "distortion": "Distortion",  # VTK takes the determinants of its 2 x 2 matrix in the plane of the first corner
    "nastran_taper": "Distortion",  # 1 - distortion
}
NOT_IN_VTK = {
    "skew": "Knupp's; VTK's Skew is the cosine between the mid-lines, better when lower",
    "shear_and_size": "VTK's ShearAndSize has the relative size squared",
    "shape_and_size": "VTK's ShapeAndSize has the relative size squared",
    "ansys_aspect_ratio": "ANSYS's", "ansys_jacobian_ratio": "ANSYS's", "ansys_warping_factor": "ANSYS's",
    "ansys_parallel_deviation": "ANSYS's", "ansys_skewness": "ANSYS's",
    "nastran_skew": "Nastran's", "nastran_warp": "Nastran's", "optistruct_skew": "OptiStruct's",
    "patran_aspect_ratio": "Patran's", "longest_edge": "a length", "corner_angle": "two-sided",
    "abaqus_shape_factor": "of triangles only",
}  # fmt: skip


def random_valid(corners: int, warp: float) -> np.ndarray:
    """(COUNT, corners, 3) points of valid elements anywhere in space, of sizes from 1e-2 to 1e4."""
    rng = np.random.default_rng(corners * 1000 + int(100 * warp))
    square = np.array([[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0]], dtype=float)[:corners]
    kept: list[np.ndarray] = []
    while sum(map(len, kept)) < COUNT:
        points = square + rng.uniform(-0.45, 0.45, (COUNT, corners, 3)) * [1, 1, warp]
        points *= 10 ** rng.uniform(-2, 4, (COUNT, 1, 1))
        turn, _ = np.linalg.qr(rng.normal(size=(COUNT, 3, 3)))
        points = np.einsum("nij,nkj->nki", turn, points)
        angle, valid = judged_values(metric("min_angle"), points.reshape(-1, 3), elements_of(points))
        kept.append(points[valid & (angle > LEAST_ANGLE)])
    return np.concatenate(kept)[:COUNT]


def elements_of(points: np.ndarray) -> np.ndarray:
    count, corners, _ = points.shape
    elements = np.full((count, 4), -1, dtype=np.int32)
    elements[:, :corners] = np.arange(count * corners).reshape(count, corners)
    return elements


def grid_of(points: np.ndarray) -> pyvista.UnstructuredGrid:
    count, corners, _ = points.shape
    cells = np.insert(np.arange(count * corners).reshape(count, corners), 0, corners, axis=1)
    kind = pyvista.CellType.QUAD if corners == 4 else pyvista.CellType.TRIANGLE
    grid = pyvista.UnstructuredGrid(cells.ravel(), np.full(count, kind), points.reshape(-1, 3))
    assert grid.points.dtype == np.float64
    return grid


def vtk_values(points: np.ndarray, measure: str) -> np.ndarray:
    judge = vtkMeshQuality()
    judge.SetInputData(grid_of(points))
    setter = "SetQuadQualityMeasureTo" if points.shape[1] == 4 else "SetTriangleQualityMeasureTo"
    getattr(judge, setter + measure)()
    judge.Update()
    return vtk_to_numpy(judge.GetOutput().GetCellData().GetArray("Quality")).copy()


def ours(points: np.ndarray, key: str) -> np.ndarray:
    values, valid = judged_values(metric(key), points.reshape(-1, 3), elements_of(points))
    assert valid.all()
    return values


def rows_of(table: dict[str, tuple], kind: int) -> list[str]:
    return [key for key, measures in table.items() if measures[kind]]


def test_every_metric_is_compared_or_said_to_be_another_one():
    told = SAME_BY_DEFINITION.keys() | FUNCTION_OF_VTK.keys() | SAME_WHERE_PLANAR.keys() | NOT_IN_VTK.keys()
    assert told == {row.key for row in METRICS}


@pytest.mark.parametrize("warp", [0.0, 0.5], ids=["planar", "warped"])
@pytest.mark.parametrize("key", rows_of(SAME_BY_DEFINITION, 0))
def test_quads_have_vtk_value(key, warp):
    points = random_valid(4, warp)
    assert_allclose(ours(points, key), vtk_values(points, SAME_BY_DEFINITION[key][0]), rtol=1e-12, atol=1e-15)


@pytest.mark.parametrize("key", rows_of(SAME_BY_DEFINITION, 1))
def test_triangles_have_vtk_value(key):
    points = random_valid(3, 0.5)
    assert_allclose(ours(points, key), vtk_values(points, SAME_BY_DEFINITION[key][1]), rtol=1e-12)


@pytest.mark.parametrize("warp", [0.0, 0.5], ids=["planar", "warped"])
@pytest.mark.parametrize("key", ["warpage", "relative_size"])
def test_quads_have_a_function_of_vtk_value(key, warp):
    points, (measure, _, function) = random_valid(4, warp), FUNCTION_OF_VTK[key]
    assert_allclose(ours(points, key), function(vtk_values(points, measure)), rtol=1e-12)


def test_the_warp_angle_is_the_arc_cosine_of_vtk_warpage():
    points, (measure, _, function) = random_valid(4, 0.5), FUNCTION_OF_VTK["warp_angle"]
    found = ours(points, "warp_angle")
    large = found > 1.0  # below, the arc cosine has lost the digits
    assert_allclose(found[large], function(vtk_values(points, measure))[large], rtol=1e-9)


def test_triangles_have_the_root_of_vtk_relative_size():
    points = random_valid(3, 0.5)
    assert_allclose(ours(points, "relative_size"), np.sqrt(vtk_values(points, "RelativeSizeSquared")), rtol=1e-12)


@pytest.mark.parametrize("warp", [0.0, 0.5], ids=["planar", "warped"])
@pytest.mark.parametrize(("key", "measure"), [("shear_and_size", "ShearAndSize"), ("shape_and_size", "ShapeAndSize")])
def test_products_with_size_are_those_of_vtk_over_the_relative_size(key, measure, warp):
    points = random_valid(4, warp)
    expected = vtk_values(points, measure) / np.sqrt(vtk_values(points, "RelativeSizeSquared"))
    assert_allclose(ours(points, key), expected, rtol=1e-12)


@pytest.mark.parametrize("key", SAME_WHERE_PLANAR)
def test_planar_quads_have_vtk_value_and_warped_ones_another(key):
    planar, warped = random_valid(4, 0.0), random_valid(4, 0.5)
    expected = [vtk_values(points, SAME_WHERE_PLANAR[key]) for points in (planar, warped)]
    if key == "nastran_taper":
        expected = [1.0 - each for each in expected]
    assert_allclose(ours(planar, key), expected[0], rtol=1e-10, atol=1e-12)
    assert np.abs(ours(warped, key) / expected[1] - 1).max() > 1e-3


@pytest.mark.parametrize("key", ["stretch", "skew", "warpage", "ansys_parallel_deviation"])
def test_triangles_without_the_metric_are_judged_by_shape(key):
    points = random_valid(3, 0.5)
    assert_allclose(ours(points, key), vtk_values(points, "Shape"), rtol=1e-12)


@pytest.mark.parametrize("measure", ["Stretch", "ScaledJacobian", "Shape", "Condition", "Taper", "Warpage"])
def test_the_filter_that_benchmarks_measure_gives_the_same(measure):
    points = random_valid(4, 0.5)
    judge = vtkCellQuality()
    judge.SetInputData(grid_of(points))
    getattr(judge, "SetQualityMeasureTo" + measure)()
    judge.Update()
    found = vtk_to_numpy(judge.GetOutput().GetCellData().GetArray("CellQuality"))
    assert_allclose(found, vtk_values(points, measure), rtol=1e-14)
