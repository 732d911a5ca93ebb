"""Our optimisers beside Gmsh, MFEM and SciPy on the reference meshes: one table in one run, and how they converge.

    python3 run.py test tests/benchmarks/optimisation.py

Peers come from the dependency group ``peers`` (``pip install gmsh mfem``); rows of those that are not installed are
left out. Seconds are wall time with kernels loaded, the median of several runs for the smaller meshes; of peers only
their own work, of ours everything from a mesh to a mesh.

Columns: the sum of stretch and the mean shape are of the quads, as the paper's objective is. The least shape and the
least scaled Jacobian are given twice: of the quads, and of all elements, the leftover triangles among them. Each
column has the mode that is made for it; below each table stands how far that is ahead of the best peer that leaves
no element inverted, and how the times compare with those of peers that come within 1 %.
"""

import importlib.util
import statistics
from collections.abc import Callable, Iterator
from functools import partial
from pathlib import Path
from time import perf_counter, process_time

import attrs
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


@attrs.frozen
class Way:
    """A mode of ours."""

    name: str
    optimizer: str
    objective: str
    floor: float | None = 0.3


OURS = (
    Way("default, stretch, floor off", "default", "stretch", floor=None),
    Way("default, stretch", "default", "stretch"),
    Way("fine, stretch, floor off", "fine", "stretch", floor=None),
    Way("default, shape", "default", "shape"),
    Way("worst quad, shape", "worst_quad", "shape"),
    Way("worst quad, scaled Jacobian", "worst_quad", "scaled_jacobian"),
    Way("worst, shape", "worst", "shape"),
    Way("worst, scaled Jacobian", "worst", "scaled_jacobian"),
    Way("the paper's, stretch", "paper", "stretch"),
)
# column, and the mode made for it
QUALITIES = {
    "sum of stretch": "default, stretch, floor off",
    "shape mean": "default, shape",
    "shape min": "worst quad, shape",
    "SJ min": "worst quad, scaled Jacobian",
    "shape min, all": "worst, shape",
    "SJ min, all": "worst, scaled Jacobian",
}
NEAR = 0.01
"""Part of our quality within which a peer has to be slower."""
FASTEST = "Gmsh UntangleMeshGeometry"
"""The peer whose time counts for the default shape run."""
AHEAD: dict[str, dict[str, float]] = {column: {} for column in QUALITIES}
"""By column and mesh, how far ours is ahead of the best peer, over the value."""


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
    """What the columns of qualities say, and the number of inverted elements."""
    is_quad = ~mesh.topology.is_triangle
    stretch, shape, jacobian = (quality(mesh, metric(key)) for key in ("stretch", "shape", "scaled_jacobian"))
    return (
        float(stretch.values[is_quad].sum()),
        float(shape.values[is_quad].mean()),
        *(float(by.values[is_quad].min()) for by in (shape, jacobian)),
        *(float(by.values.min()) for by in (shape, jacobian)),
        shape.inverted_count,
    )


def ours(mesh: Mesh, way: Way) -> tuple[Mesh, float]:
    start = perf_counter()
    settings = SearchSettings(floor=way.floor, stride=QUICK)
    run = outcome(iterates(way.optimizer, mesh, objective(way.objective), settings))
    return run.best.mesh, perf_counter() - start


def timed(move: Callable[[Mesh], tuple[Mesh, float]], mesh: Mesh) -> tuple[Mesh, float]:
    """What comes of it, and the median time."""
    runs = [move(mesh) for _ in range(1 if len(mesh.topology.quads) > SLOW else 5)]
    return runs[-1][0], statistics.median(seconds for _, seconds in runs)


def rows_for(mesh: Mesh) -> Iterator[tuple[str, tuple[float, ...]]]:
    """Name and figures of every way, ours first."""
    for way in OURS:
        ours(mesh, way)
        moved, seconds = timed(partial(ours, way=way), mesh)
        yield way.name, (*figures(moved), seconds)
    for peer in peers_module().PEERS:
        if importlib.util.find_spec(peer.package) is not None:
            try:
                moved, seconds = timed(peer.move, mesh)
            except RuntimeError:  # MFEM's answer to a folded mesh
                yield f"{peer.name}: gave up", (*[np.nan] * len(QUALITIES), -1, np.nan)
            else:
                yield peer.name, (*figures(moved), seconds)


def verdict(name: str, rows: dict[str, tuple[float, ...]]) -> Iterator[str]:
    """How each quality compares with the best peer's, and the time with those of peers that come near."""
    own = {way.name for way in OURS}
    peers = {title: row for title, row in rows.items() if title not in own and row[-2] == 0}
    for number, (column, way) in enumerate(QUALITIES.items()):
        value, seconds = rows[way][number], rows[way][-1]
        best = max(peers, key=lambda title: peers[title][number])
        AHEAD[column][name] = (value - peers[best][number]) / value
        near = {title: row[-1] for title, row in peers.items() if row[number] >= (1.0 - NEAR) * value}
        slower = ", ".join(f"{title} takes {each / seconds:.2f} times as long" for title, each in near.items())
        yield f"{column:<16} {100 * AHEAD[column][name]:+7.2f} % ahead of {best}; within 1 %: {slower or 'nobody'}"
    if FASTEST in rows:
        share = rows["default, shape"][-1] / rows[FASTEST][-1]
        yield f"default shape run: {share:.3f} of the time of {FASTEST}"


@pytest.mark.parametrize("name", [*MESHES, *TANGLED])
def test_side_by_side(name, capsys):
    pipeline.prepare()
    mesh = reference(name)
    start = "as it was", (*figures(mesh), 0.0)
    rows = dict(rows_for(mesh))
    with capsys.disabled():
        print(f"\n{name}: {len(mesh.topology.quads)} quads, {len(mesh.topology.triangles)} triangles")
        print(f"  {'':<30}" + "".join(f"{column:>15}" for column in (*QUALITIES, "inverted", "seconds")))
        for title, (total, *least, inverted, seconds) in (start, *rows.items()):
            numbers = f"{total:>15.2f}" + "".join(f"{value:>15.4f}" for value in least)
            print(f"  {title:<30}{numbers}{inverted:>15}{seconds:>15.4f}")
        if name in MESHES:
            print("".join(f"  {line}\n" for line in verdict(name, rows)))
    if name in TANGLED:
        assert all(rows[way.name][-2] == 0 for way in OURS[:-1])


def test_all_meshes_together(capsys):
    with capsys.disabled():
        print("\nahead of the best peer, mean over the meshes and least")
        for column, by_mesh in AHEAD.items():
            if by_mesh:
                worst = min(by_mesh, key=by_mesh.__getitem__)
                mean = statistics.mean(by_mesh.values())
                print(f"  {column:<16}{100 * mean:+8.2f} % {100 * by_mesh[worst]:+8.2f} % ({worst})")


SIZES = (3000, 30_000, 300_000, 1_000_000)


def test_time_and_memory_per_quad(shaken_grid, capsys):
    """Wall time, and the processor's: the same on a machine with nothing else to do."""
    from resource import RUSAGE_SELF, getrusage

    way = next(way for way in OURS if way.name == "default, shape")
    ours(shaken_grid(200), way)
    wall, processor = {}, {}
    for quads in SIZES:
        mesh, runs = shaken_grid(quads), []
        before, count = getrusage(RUSAGE_SELF).ru_maxrss, len(mesh.topology.quads)
        for _ in range(1 if quads > 30 * SLOW else 5):
            busy = process_time()
            moved, seconds = ours(mesh, way)
            runs.append((seconds / count, (process_time() - busy) / count))
        wall[quads], processor[quads] = (statistics.median(each) for each in zip(*runs, strict=True))
        memory = (getrusage(RUSAGE_SELF).ru_maxrss - before) * 1024 / count
        shape = quality(moved, metric("shape")).mean
        with capsys.disabled():
            print(f"\n{count:>9} quads: {wall[quads] * count:8.3f} s, {1e6 * wall[quads]:6.2f} us a quad", end="")
            print(f" ({1e6 * processor[quads]:.2f} of the processor's time), {memory:5.0f} bytes a quad", end="")
            print(f" more at the peak, shape mean {shape:.4f}", end="")
    with capsys.disabled():
        shares = (times[300_000] / times[3000] for times in (wall, processor))
        print("\ntime per quad at 300 000 over that at 3000: {:.2f} ({:.2f})".format(*shares))


def test_convergence_picture(capsys):
    """Objective and worst element against time, into assets/docs/convergence.svg."""
    pipeline.prepare()
    mesh = reference("hopper_fine")
    ways = (("default", "default", "#0B62A4"), ("worst", "worst", "#B2182B"), ("the paper's", "paper", "#5B6776"))
    lines = []
    for title, key, colour in ways:
        ours(mesh, Way(title, key, "shape"))
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
