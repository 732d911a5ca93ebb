"""Our optimisers beside Gmsh, MFEM and SciPy on the reference meshes: one table in one run, and how they converge.

    python3 run.py test tests/benchmarks/optimisation.py

Peers come from the dependency group ``peers`` (``pip install gmsh mfem``); rows of those that are not installed are
left out. Seconds are wall time with kernels loaded, the median of three runs for the smaller meshes.
"""

import importlib.util
import statistics
from collections.abc import Callable
from pathlib import Path
from time import perf_counter

import numpy as np
import pytest

from hullquad import pipeline
from hullquad.mesh import Mesh
from hullquad.metrics import metric
from hullquad.optimization.iterate import outcome
from hullquad.optimization.objective import objective
from hullquad.optimization.settings import SearchSettings
from hullquad.optimizers import iterates
from hullquad.quality import quality
from hullquad.surface import Plane
from hullquad.topology import NodeState, topology

_FOLDER = Path(__file__).parent
MESHES = ("hopper_coarse20", "hopper_seg", "web_L", "hopper_fine", "web_L_2k", "web_L_big")
TANGLED = ("hopper_fine_tangled", "web_L_2k_tangled")
QUICK = 1_000_000
"""Iterations from one look to the next: nobody watches."""
SLOW = 10_000
"""Quads from which on one run is enough."""

# name, optimiser, objective, floor
OURS = (
    ("default, stretch, floor off", "default", "stretch", None),
    ("default, stretch", "default", "stretch", 0.3),
    ("fine, stretch, floor off", "fine", "stretch", None),
    ("default, shape", "default", "shape", 0.3),
    ("worst, shape", "worst", "shape", 0.3),
    ("worst, scaled Jacobian", "worst", "scaled_jacobian", 0.3),
    ("the paper's, stretch", "paper", "stretch", 0.3),
)
COLUMNS = ("sum of stretch", "shape mean", "shape min", "SJ min", "inverted", "seconds")


def peers_module():
    spec = importlib.util.spec_from_file_location("smoothing_peers", _FOLDER / "smoothing_peers.py")
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


def reference(name: str) -> Mesh:
    """A reference mesh in the plane z = 0."""
    with np.load(_FOLDER.parent / "data" / "meshes" / f"{name}.npz") as arrays:
        triangles = np.pad(arrays["tris"], ((0, 0), (0, 1)), constant_values=-1)
        elements = np.concatenate([arrays["quads"], triangles]).astype(np.int32)
        states = np.where(arrays["fixed"], NodeState.CONTOUR, NodeState.FREE).astype(np.int8)
        places, size = arrays["points"], float(arrays["h"])
    ground = Plane([0, 0, 0], [1, 0, 0], [0, 1, 0])
    points = ground.points(places)
    return Mesh(points=points, topology=topology(elements, states), target_size=size, surface=ground, parameters=places)


def figures(mesh: Mesh) -> tuple[float, ...]:
    """Sum of stretch, mean and least shape, least scaled Jacobian of the quads; inverted elements."""
    is_quad = ~mesh.topology.is_triangle
    by_stretch, by_shape, by_jacobian = (quality(mesh, metric(key)) for key in ("stretch", "shape", "scaled_jacobian"))
    shapes = by_shape.values[is_quad]
    return (
        float(by_stretch.values[is_quad].sum()),
        float(shapes.mean()),
        float(shapes.min()),
        float(by_jacobian.values[is_quad].min()),
        by_shape.inverted_count,
    )


def ours(mesh: Mesh, key: str, aim: str, floor: float | None) -> tuple[Mesh, float]:
    start = perf_counter()
    run = outcome(iterates(key, mesh, objective(aim), SearchSettings(floor=floor, stride=QUICK)))
    return run.best.mesh, perf_counter() - start


def timed(move: Callable[[Mesh], tuple[Mesh, float]], mesh: Mesh) -> tuple[Mesh, float]:
    """What comes of it, and the median time."""
    runs = [move(mesh) for _ in range(1 if len(mesh.topology.quads) > SLOW else 3)]
    return runs[-1][0], statistics.median(seconds for _, seconds in runs)


def rows_for(mesh: Mesh):
    """Name and figures of every way."""
    for name, key, aim, floor in OURS:
        ours(mesh, key, aim, floor)
        moved, seconds = timed(lambda given, k=key, a=aim, f=floor: ours(given, k, a, f), mesh)
        yield name, (*figures(moved), seconds)
    module = peers_module()
    for peer in module.PEERS:
        if importlib.util.find_spec(peer.package) is not None:
            try:
                moved, seconds = timed(peer.move, mesh)
            except RuntimeError:  # MFEM's answer to a folded mesh
                yield f"{peer.name}: gave up", (*[np.nan] * 4, -1, np.nan)
            else:
                yield peer.name, (*figures(moved), seconds)


@pytest.mark.parametrize("name", [*MESHES, *TANGLED])
def test_side_by_side(name, capsys):
    pipeline.prepare()
    mesh = reference(name)
    rows = [("as it was", (*figures(mesh), 0.0)), *rows_for(mesh)]
    with capsys.disabled():
        print(f"\n{name}: {len(mesh.topology.quads)} quads, {len(mesh.topology.triangles)} triangles")
        print(f"  {'':<30}" + "".join(f"{column:>15}" for column in COLUMNS))
        for title, (total, mean, least, jacobian, inverted, seconds) in rows:
            numbers = f"{total:>15.2f}{mean:>15.4f}{least:>15.4f}{jacobian:>15.4f}{inverted:>15}{seconds:>15.4f}"
            print(f"  {title:<30}{numbers}")
    if name in TANGLED:
        assert all(row[4] == 0 for title, row in rows if title in {ours_row[0] for ours_row in OURS[:-1]})


@pytest.mark.parametrize("quads", [3000, 30_000, 300_000, 1_000_000])
def test_time_and_memory_per_quad(quads, shaken_grid, capsys):
    import resource

    mesh = shaken_grid(quads)
    ours(shaken_grid(200), "default", "shape", 0.3)
    before = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss
    moved, seconds = ours(mesh, "default", "shape", 0.3)
    count = len(mesh.topology.quads)
    memory = (resource.getrusage(resource.RUSAGE_SELF).ru_maxrss - before) * 1024 / count
    shape = quality(moved, metric("shape")).mean
    with capsys.disabled():
        print(f"\n{count:>9} quads: {seconds:8.2f} s, {1e6 * seconds / count:6.2f} us a quad, shape mean {shape:.4f}, ")
        print(f"{'':>16} {memory:7.0f} bytes a quad more at the peak")


def test_convergence_picture(capsys):
    """Objective and worst element against time, into assets/docs/convergence.svg."""
    pipeline.prepare()
    mesh = reference("hopper_fine")
    ways = (("default", "default", "#0B62A4"), ("worst", "worst", "#B2182B"), ("the paper's", "paper", "#5B6776"))
    lines = []
    for title, key, colour in ways:
        ours(mesh, key, "shape", 0.3)
        start, count = perf_counter(), len(mesh.topology.quads)
        run = iterates(key, mesh, objective("shape"), SearchSettings(stride=5))
        course = [(perf_counter() - start, one.objective / count, one.quality.worst) for one in run]
        lines.append((title, colour, np.array(course)))
    target = _FOLDER.parents[1] / "assets" / "docs" / "convergence.svg"
    target.write_text(_svg(lines), encoding="utf-8")
    with capsys.disabled():
        for title, _, course in lines:
            print(f"\n{title}: {course[-1][0]:.3f} s, mean shape {course[-1][1]:.4f}, worst {course[-1][2]:.4f}")


_WIDTH, _HEIGHT, _MARGIN, _GAP = 420, 260, 48, 60


def _svg(lines) -> str:
    """Two frames side by side: mean and worst shape over the logarithm of time."""
    least = min(course[1:, 0].min() for *_, course in lines)
    most = max(course[:, 0].max() for *_, course in lines)
    decades = np.log10([least, most])
    size = f"{2 * _WIDTH + _GAP + 2 * _MARGIN} {_HEIGHT + 2 * _MARGIN}"
    parts = [f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {size}" font-family="sans-serif" font-size="13">']
    parts.append('<rect width="100%" height="100%" fill="#FFFFFF"/>')
    for frame, (column, title) in enumerate(((1, "mean shape of the quads"), (2, "shape of the worst element"))):
        left = _MARGIN + frame * (_WIDTH + _GAP)
        values = np.concatenate([course[:, column] for *_, course in lines])
        low, high = float(values.min()), float(values.max())
        parts.append(_frame(left, title, low, high, decades))
        for row, (name, colour, course) in enumerate(lines):
            x = left + _WIDTH * (np.log10(np.maximum(course[:, 0], least)) - decades[0]) / (decades[1] - decades[0])
            y = _MARGIN + _HEIGHT * (high - course[:, column]) / (high - low)
            path = " ".join(f"{a:.1f},{b:.1f}" for a, b in zip(x, y, strict=True))
            parts.append(f'<polyline points="{path}" fill="none" stroke="{colour}" stroke-width="2"/>')
            parts.append(
                f'<text x="{left + _WIDTH - 8}" y="{_MARGIN + _HEIGHT - 10 - 18 * row}" fill="{colour}" '
                f'text-anchor="end">{name}</text>'
            )
    return "\n".join([*parts, "</svg>"]) + "\n"


def _frame(left: float, title: str, low: float, high: float, decades: np.ndarray) -> str:
    bottom = _MARGIN + _HEIGHT
    parts = [
        f'<text x="{left}" y="{_MARGIN - 14}" fill="#1B2430" font-weight="bold">{title}</text>',
        f'<rect x="{left}" y="{_MARGIN}" width="{_WIDTH}" height="{_HEIGHT}" fill="none" stroke="#D5DBE1"/>',
    ]
    for value, at in ((high, _MARGIN + 5), (low, bottom)):
        parts.append(f'<text x="{left - 6}" y="{at}" text-anchor="end" fill="#5B6776">{value:.2f}</text>')
    for decade in range(int(np.ceil(decades[0])), int(np.floor(decades[1])) + 1):
        x = left + _WIDTH * (decade - decades[0]) / (decades[1] - decades[0])
        label = f"{10.0**decade * 1000:g} ms" if decade < 0 else f"{10**decade} s"
        parts.append(f'<path d="M{x:.1f} {_MARGIN}V{bottom}" stroke="#D5DBE1"/>')
        parts.append(f'<text x="{x:.1f}" y="{bottom + 18}" text-anchor="middle" fill="#5B6776">{label}</text>')
    return "\n".join(parts)
