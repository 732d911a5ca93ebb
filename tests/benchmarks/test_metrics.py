"""Metrics per second beside VTK's, one thread, kernels loaded; what gradients and a cold start cost."""

import os
import subprocess
import sys
from collections.abc import Callable
from functools import partial
from statistics import median
from time import perf_counter

import numpy as np
import pytest
import pyvista
from vtkmodules.vtkCommonCore import vtkSMPTools
from vtkmodules.vtkFiltersVerdict import vtkCellQuality, vtkMeshQuality

from hullquad import pipeline
from hullquad.arrays import floats
from hullquad.metrics import METRICS, Metric, metric
from hullquad.metrics.kernels import judge
from hullquad.metrics.program import Program, rows_for
from hullquad.metrics.programs import slopes_program, values_program
from hullquad.metrics.values import all_judged, judged_values, value_gradients

QUADS = 1_000_000
ROUNDS = 9
OF_VTK = {
    "stretch": "Stretch", "scaled_jacobian": "ScaledJacobian", "shape": "Shape", "min_angle": "MinAngle",
    "max_angle": "MaxAngle", "taper": "Taper", "warpage": "Warpage", "condition": "Condition", "shear": "Shear",
    "relative_size": "RelativeSizeSquared", "shear_and_size": "ShearAndSize", "shape_and_size": "ShapeAndSize",
    "distortion": "Distortion",
}  # fmt: skip
TABLE_1_AND_ANSYS = METRICS[:21]

Work = Callable[[], object]


def seconds(work: Work) -> float:
    """Wall time [s]."""
    start = perf_counter()
    work()
    return perf_counter() - start


def beside(first: Work, second: Work, rounds: int = ROUNDS) -> tuple[float, float, float]:
    """Median wall times of two works done by turns [s], and the median of their quotients: both are warm."""
    first(), second()
    times = [(seconds(first), seconds(second)) for _ in range(rounds)]
    return median(a for a, _ in times), median(b for _, b in times), median(a / b for a, b in times)


@pytest.fixture(scope="module")
def mesh(shaken_grid):
    pipeline.prepare_judging()
    return shaken_grid(QUADS)


@pytest.fixture(scope="module")
def grid(mesh):
    vtkSMPTools.Initialize(1)
    quads = mesh.topology.elements
    cells = np.insert(quads, 0, 4, axis=1)
    made = pyvista.UnstructuredGrid(cells.ravel(), np.full(len(quads), pyvista.CellType.QUAD), mesh.points)
    assert made.points.dtype == np.float64
    return made


def of_vtk(grid, measure: str) -> Work:
    judge_cells = vtkCellQuality()
    judge_cells.SetInputData(grid)
    getattr(judge_cells, "SetQualityMeasureTo" + measure)()
    return partial(again, judge_cells)


def edge_ratio_of_vtk(grid) -> Work:
    judge_mesh = vtkMeshQuality()
    judge_mesh.SetInputData(grid)
    judge_mesh.SetQuadQualityMeasureToEdgeRatio()
    return partial(again, judge_mesh)


def again(filter_) -> None:
    filter_.Modified()
    filter_.Update()


@pytest.mark.parametrize(("key", "times"), [("scaled_jacobian", 3), ("shape", 3), ("condition", 3), ("stretch", 8)])
def test_one_metric_beside_vtk(mesh, grid, key, times):
    args = metric(key), mesh.points, mesh.topology.elements, mesh.normals, mesh.areas
    theirs, here, ratio = beside(of_vtk(grid, OF_VTK[key]), lambda: judged_values(*args))
    print(f"\n{key}: {1e3 * here:.1f} ms, vtkCellQuality {1e3 * theirs:.1f} ms: {ratio:.1f} x (wanted: {times})")


def test_all_in_one_pass_beside_the_sum_of_vtk(mesh, grid):
    works = [*(of_vtk(grid, measure) for measure in OF_VTK.values()), edge_ratio_of_vtk(grid)]
    args = mesh.points, mesh.topology.elements, mesh.normals, mesh.areas
    theirs, here, ratio = beside(lambda: [work() for work in works], lambda: all_judged(*args, TABLE_1_AND_ANSYS), 5)
    print(f"\nall 21: {1e3 * here:.0f} ms, VTK's 14 {1e3 * theirs:.0f} ms: {ratio:.1f} x (wanted: 5)")
    print(f"all {len(METRICS)}: {1e3 * median(seconds(lambda: all_judged(*args)) for _ in range(5)):.0f} ms")


def into_arrays_at_hand(mesh, row: Metric, program: Program) -> Work:
    """Run the kernel; what it takes the system to find memory for the results is not counted."""
    count, quads = len(program.outputs) - 1, mesh.topology.elements
    values, valid = np.empty((count, len(quads))), np.empty(len(quads), dtype=bool)
    factors, bounds = floats(np.full(count, row.factor)), floats(np.tile(row.invalid, (count, 1)))
    rows = rows_for(program, float(mesh.areas[0]))
    return lambda: judge(
        program, rows, False, mesh.points, quads, mesh.normals, factors, bounds, values, valid
    )  # fmt: skip


@pytest.mark.parametrize("row", TABLE_1_AND_ANSYS, ids=lambda row: row.key)
def test_a_gradient_beside_the_value(mesh, row):
    programs = slopes_program(row, 4), values_program((row,), 4)
    both, value, ratio = beside(*(into_arrays_at_hand(mesh, row, program) for program in programs))
    args = row, mesh.points, mesh.topology.elements, mesh.normals, mesh.areas
    *_, whole = beside(lambda: value_gradients(*args), lambda: judged_values(*args), 3)
    figures = f"value {1e3 * value:.1f} ms, with gradient {1e3 * both:.1f} ms: {ratio:.1f} x"
    print(f"\n{row.key}: {figures} (wanted: 3); {whole:.1f} x with fresh memory for the results")


def test_a_cold_start(tmp_path):
    """Each part in a process of its own, from its start to its end; what was compiled before is there."""
    for cache in ("cold", "warm"):
        for part in ("judging", "meshing", "optimizing"):
            command = [sys.executable, "-c", f"from hullquad import pipeline; pipeline.prepare_{part}()"]
            env = os.environ | {"NUMBA_CACHE_DIR": str(tmp_path)}
            took = seconds(lambda: subprocess.run(command, check=True, env=env))  # noqa: B023  called at once
            print(f"\n{part} prepared on a {cache} cache: {took:.2f} s" + " (wanted: 10)" * (part == "judging"), end="")
