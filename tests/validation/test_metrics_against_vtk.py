"""Metrics against VTK's mesh quality (Verdict) on random valid elements, planar and warped."""

import numpy as np
import pytest
import pyvista
from numpy.testing import assert_allclose
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkFiltersVerdict import vtkMeshQuality

from hullquad.metrics import METRICS, metric
from hullquad.metrics.values import judged_values

COUNT = 10_000
LEAST_ANGLE = 1.0
"""[degrees]; VTK takes angles by the arc cosine, which loses digits below."""

# metric -> VTK's name of the same definition; skew has none (Knupp's, not the cosine of the mid-lines)
SAME_BY_DEFINITION = {
    "stretch": ("Stretch", None),
    "aspect_ratio": ("EdgeRatio", "EdgeRatio"),
    "scaled_jacobian": ("ScaledJacobian", "ScaledJacobian"),
    "shape": ("Shape", "Shape"),
    "min_angle": ("MinAngle", "MinAngle"),
    "max_angle": ("MaxAngle", "MaxAngle"),
}
NOT_IN_VTK = {"skew"}


def random_valid(corners: int, warp: float) -> np.ndarray:
    """(COUNT, corners, 3) points of valid elements anywhere in space, of sizes from 1e-2 to 1e4."""
    rng = np.random.default_rng(corners * 1000 + int(100 * warp))
    square = np.array([[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0]], dtype=float)[:corners]
    kept = []
    while sum(map(len, kept)) < COUNT:
        points = square + rng.uniform(-0.45, 0.45, (COUNT, corners, 3)) * [1, 1, warp]
        points *= 10 ** rng.uniform(-2, 4, (COUNT, 1, 1))
        turn, _ = np.linalg.qr(rng.normal(size=(COUNT, 3, 3)))
        points = np.einsum("nij,nkj->nki", turn, points)
        elements = np.full((COUNT, 4), -1, dtype=np.int32)
        elements[:, :corners] = np.arange(COUNT * corners).reshape(COUNT, corners)
        angle, valid = judged_values(metric("min_angle"), points.reshape(-1, 3), elements)
        kept.append(points[valid & (angle > LEAST_ANGLE)])
    return np.concatenate(kept)[:COUNT]


def vtk_values(points: np.ndarray, measure: str) -> np.ndarray:
    count, corners, _ = points.shape
    cells = np.insert(np.arange(count * corners).reshape(count, corners), 0, corners, axis=1)
    kind = pyvista.CellType.QUAD if corners == 4 else pyvista.CellType.TRIANGLE
    grid = pyvista.UnstructuredGrid(cells.ravel(), np.full(count, kind), points.reshape(-1, 3))
    assert grid.points.dtype == np.float64
    judge = vtkMeshQuality()
    judge.SetInputData(grid)
    setter = "SetQuadQualityMeasureTo" if corners == 4 else "SetTriangleQualityMeasureTo"
    getattr(judge, setter + measure)()
    judge.Update()
    return vtk_to_numpy(judge.GetOutput().GetCellData().GetArray("Quality"))


def ours(points: np.ndarray, key: str) -> np.ndarray:
    count, corners, _ = points.shape
    elements = np.full((count, 4), -1, dtype=np.int32)
    elements[:, :corners] = np.arange(count * corners).reshape(count, corners)
    values, valid = judged_values(metric(key), points.reshape(-1, 3), elements)
    assert valid.all()
    return values


def test_every_metric_is_compared_or_said_to_be_absent_from_vtk():
    assert {row.key for row in METRICS} == SAME_BY_DEFINITION.keys() | NOT_IN_VTK


@pytest.mark.parametrize("warp", [0.0, 0.5], ids=["planar", "warped"])
@pytest.mark.parametrize("key", SAME_BY_DEFINITION)
def test_quads_have_vtk_value(key, warp):
    points = random_valid(4, warp)
    assert_allclose(ours(points, key), vtk_values(points, SAME_BY_DEFINITION[key][0]), rtol=1e-12)


@pytest.mark.parametrize("key", [key for key, (_, triangle) in SAME_BY_DEFINITION.items() if triangle])
def test_triangles_have_vtk_value(key):
    points = random_valid(3, 0.5)
    assert_allclose(ours(points, key), vtk_values(points, SAME_BY_DEFINITION[key][1]), rtol=1e-12)


@pytest.mark.parametrize("key", ["stretch", "skew"])
def test_triangles_without_the_metric_are_judged_by_shape(key):
    points = random_valid(3, 0.5)
    assert_allclose(ours(points, key), vtk_values(points, "Shape"), rtol=1e-12)
