"""Metrics per second beside VTK's, one thread, kernels loaded; and what a cold start costs."""

import os
import subprocess
import sys
from collections.abc import Callable
from time import perf_counter

import numpy as np
import pytest
import pyvista
from vtkmodules.vtkCommonCore import vtkSMPTools
from vtkmodules.vtkFiltersVerdict import vtkCellQuality, vtkMeshQuality

from hullquad import pipeline
from hullquad.metrics import METRICS, metric
from hullquad.metrics.values import all_judged, judged_values, value_gradients

QUADS = 1_000_000
ROUNDS = 5
OF_VTK = {
    "stretch": "Stretch", "scaled_jacobian": "ScaledJacobian", "shape": "Shape", "min_angle": "MinAngle",
    "max_angle": "MaxAngle", "taper": "Taper", "warpage": "Warpage", "condition": "Condition", "shear": "Shear",
    "relative_size": "RelativeSizeSquared", "shear_and_size": "ShearAndSize", "shape_and_size": "ShapeAndSize",
    "distortion": "Distortion",
}  # fmt: skip
TABLE_1_AND_ANSYS = METRICS[:21]


def best(work: Callable[[], object]) -> float:
    """Least wall time of some rounds [s]."""
    times = []
    for _ in range(ROUNDS):
        start = perf_counter()
        work()
        times.append(perf_counter() - start)
    return min(times)


@pytest.fixture(scope="module")
def mesh(shaken_grid):
    pipeline.prepare()
    return shaken_grid(QUADS)


@pytest.fixture(scope="module")
def grid(mesh):
    vtkSMPTools.Initialize(1)
    quads = mesh.topology.elements
    cells = np.insert(quads, 0, 4, axis=1)
    made = pyvista.UnstructuredGrid(cells.ravel(), np.full(len(quads), pyvista.CellType.QUAD), mesh.points)
    assert made.points.dtype == np.float64
    return made


def vtk_time(grid, measure: str) -> float:
    judge = vtkCellQuality()
    judge.SetInputData(grid)
    getattr(judge, "SetQualityMeasureTo" + measure)()

    def work() -> None:
        judge.Modified()
        judge.Update()

    return best(work)


def edge_ratio_time(grid) -> float:
    judge = vtkMeshQuality()
    judge.SetInputData(grid)
    judge.SetQuadQualityMeasureToEdgeRatio()

    def work() -> None:
        judge.Modified()
        judge.Update()

    return best(work)


def our_time(mesh, key: str) -> float:
    row, elements, normals = metric(key), mesh.topology.elements, mesh.normals
    return best(lambda: judged_values(row, mesh.points, elements, normals, mesh.areas))


@pytest.mark.parametrize(("key", "times"), [("scaled_jacobian", 3), ("shape", 3), ("condition", 3), ("stretch", 8)])
def test_one_metric_beside_vtk(mesh, grid, key, times):
    theirs, here = vtk_time(grid, OF_VTK[key]), our_time(mesh, key)
    print(
        f"\n{key}: {1e3 * here:.1f} ms, vtkCellQuality {1e3 * theirs:.1f} ms: {theirs / here:.1f} x (wanted: {times})"
    )


def test_all_in_one_pass_beside_the_sum_of_vtk(mesh, grid):
    theirs = sum(vtk_time(grid, measure) for measure in OF_VTK.values()) + edge_ratio_time(grid)
    args = mesh.points, mesh.topology.elements, mesh.normals, mesh.areas
    here = best(lambda: all_judged(*args, TABLE_1_AND_ANSYS))
    print(f"\nall 21: {1e3 * here:.0f} ms, VTK's 14 {1e3 * theirs:.0f} ms: {theirs / here:.1f} x (wanted: 5)")
    print(f"all {len(METRICS)}: {1e3 * best(lambda: all_judged(*args)):.0f} ms")


@pytest.mark.parametrize("row", TABLE_1_AND_ANSYS, ids=lambda row: row.key)
def test_a_gradient_beside_the_value(mesh, row):
    value = our_time(mesh, row.key)
    args = mesh.points, mesh.topology.quads, mesh.normals, mesh.areas
    both = best(lambda: value_gradients(row, *args))
    print(
        f"\n{row.key}: value {1e3 * value:.1f} ms, with gradient {1e3 * both:.1f} ms: {both / value:.1f} x (wanted: 3)"
    )


def test_a_cold_start(tmp_path):
    code = "from hullquad import pipeline; pipeline.prepare()"
    times = []
    for _ in range(2):
        start = perf_counter()
        env = os.environ | {"NUMBA_CACHE_DIR": str(tmp_path)}
        subprocess.run([sys.executable, "-c", code], check=True, env=env)
        times.append(perf_counter() - start)
    print(f"\nprepare: {times[0]:.1f} s on a cold cache (wanted: 10), {times[1]:.2f} s on a warm one")
