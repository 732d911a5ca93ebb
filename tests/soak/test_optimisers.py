"""A minute of random meshes for every optimiser: none gets worse, folds an element, or moves what it must not.

``python3 run.py test tests/soak/test_optimisers.py``; the case that failed is told and can be run by itself with
``-k`` and its number in `CASES`.
"""

import time
from collections.abc import Iterator
from itertools import count
from pathlib import Path

import attrs
import numpy as np
import pytest

from hullquad.mesh import Mesh
from hullquad.metrics import OBJECTIVES, metric
from hullquad.metrics.values import corner_values, raw_values
from hullquad.optimization.iterate import Iterate, outcome
from hullquad.optimization.objective import Objective, Term
from hullquad.optimization.settings import FINE, QUICK, PaperSettings, SearchSettings
from hullquad.optimizers import OPTIMIZERS, iterates
from hullquad.quality import quality
from hullquad.rules import Level, RuleSet, assess, rule_set
from hullquad.surface import Plane
from hullquad.topology import NodeState, rim_states, topology

SECONDS = 60.0
CASES: tuple[int, ...] = ()
"""Only these, if there are any."""
MESHES = Path(__file__).parents[1] / "data" / "meshes"
NAMES = ("hopper_coarse20", "hopper_seg", "web_L")
RULES = ("bv", "csr_fine", "msc_nastran", "ansys")
FLOOR_WEIGHT = 2.0


@attrs.frozen(eq=False)
class Case:
    """A mesh, and what is to be done with it."""

    mesh: Mesh
    optimizer: str
    objective: Objective
    search: SearchSettings
    paper: PaperSettings
    rules: RuleSet


def case(number: int) -> Case:
    """One of endlessly many."""
    chance = np.random.default_rng(number)
    mesh = shaken(chance, with_lines(chance, placed(chance, outline(chance))))
    chosen = chance.random(len(mesh.points)) < 0.5 if chance.random() < 0.2 else None
    floor = (None, 0.3, 0.6)[chance.integers(3)]
    terms = [OBJECTIVES[row] for row in chance.choice(len(OBJECTIVES), size=chance.integers(1, 3), replace=False)]
    return Case(
        mesh=mesh,
        optimizer=OPTIMIZERS[chance.integers(len(OPTIMIZERS))].key,
        objective=Objective(tuple(Term(row, float(chance.uniform(0.1, 3.0))) for row in terms)),
        search=SearchSettings(
            floor=floor,
            schedule=(QUICK, FINE)[chance.integers(2)],
            iterations=int(chance.integers(1, 200)),
            stride=int(chance.choice([1, 7, 25, 1000])),
            chosen=chosen,
        ),
        paper=PaperSettings(iterations=30, step=float(chance.choice([0.001, 0.003, 0.03]))),
        rules=rule_set(RULES[chance.integers(len(RULES))]),
    )


def outline(chance: np.random.Generator) -> tuple[np.ndarray, np.ndarray, np.ndarray, float]:
    """Places (N, 2), elements, states and size: a reference mesh, or a skew grid with triangles."""
    if chance.random() < 0.4:
        with np.load(MESHES / f"{chance.choice(NAMES)}.npz") as arrays:
            triangles = np.pad(arrays["tris"], ((0, 0), (0, 1)), constant_values=-1)
            elements = np.concatenate([arrays["quads"], triangles]).astype(np.int32)
            return arrays["points"], elements, rim_states(elements, len(arrays["points"])), float(arrays["h"])
    columns, rows = chance.integers(3, 9, 2)
    x, y = np.meshgrid(np.arange(float(columns)), np.arange(float(rows)))
    places = np.stack([x.ravel(), y.ravel()], axis=1) @ chance.uniform(-0.4, 0.4, (2, 2)) + np.stack(
        [x.ravel() * chance.uniform(0.5, 3.0), y.ravel()], axis=1
    )
    corner = (np.arange(rows - 1)[:, None] * columns + np.arange(columns - 1)).reshape(-1, 1)
    elements = corner + np.array([0, 1, columns + 1, columns])
    halved = chance.random(len(elements)) < chance.choice([0.0, 0.2, 1.0], p=[0.4, 0.5, 0.1])
    second = np.pad(elements[halved][:, [0, 2, 3]], ((0, 0), (0, 1)), constant_values=-1)
    elements[halved, 3] = -1
    elements = np.concatenate([elements, second]).astype(np.int32)
    return places, elements, rim_states(elements, len(places)), 1.0


def placed(chance: np.random.Generator, made: tuple[np.ndarray, np.ndarray, np.ndarray, float]) -> Mesh:
    """The mesh in space, of any size: on a plane that lies anyhow, or warped and without a known one."""
    places, elements, states, size = made
    scale = 10.0 ** chance.uniform(-3, 4) / size
    places = places * scale
    u, v = np.linalg.qr(chance.normal(size=(3, 3)))[0][:, :2].T
    plane = Plane(chance.uniform(-5, 5, 3) * size * scale, u, v)
    points = plane.points(places)
    label = "" if chance.random() < 0.5 else "made by hand"
    known = topology(elements, states)
    if chance.random() < 0.25:
        way = places / np.ptp(places, axis=0)
        points = (
            points + (chance.uniform(0, 0.3) * np.ptp(places) * np.sin(2 * way).prod(axis=1))[:, None] * plane.normal
        )
        return Mesh(points=points, topology=known, target_size=size * scale)
    return Mesh(
        points=points, topology=known, target_size=size * scale, surface=plane, parameters=places, input_hash=label
    )


def with_lines(chance: np.random.Generator, mesh: Mesh) -> Mesh:
    """Some nodes pinned, some on lines that they may slide on."""
    states, lines = np.array(mesh.topology.node_states), np.full(len(mesh.points), -1)
    free = np.flatnonzero(states == NodeState.FREE)
    states[free[chance.random(len(free)) < chance.choice([0.0, 0.15, 1.0], p=[0.5, 0.45, 0.05])]] = NodeState.PINNED
    ends = np.empty((0, 2, 3))
    slides = np.flatnonzero(states == NodeState.FREE)
    if mesh.surface is not None and chance.random() < 0.3 and len(slides):
        slides = slides[chance.random(len(slides)) < 0.3]
        ways = mesh.surface.points(chance.normal(size=(len(slides), 2))) - mesh.surface.origin
        reach = mesh.target_size * chance.uniform(0.1, 2.0, (len(slides), 2, 1)) * ways[:, None]
        ends = mesh.points[slides, None] + reach * np.array([[-1.0], [1.0]])
        states[slides], lines[slides] = NodeState.ON_LINE, np.arange(len(slides))
    known = attrs.evolve(mesh.topology, node_states=states, node_lines=lines)
    return attrs.evolve(mesh, topology=known, lines=ends)


def shaken(chance: np.random.Generator, mesh: Mesh) -> Mesh:
    """The mesh with its free nodes displaced; seldom so much that elements fold."""
    movable, reach = np.flatnonzero(mesh.topology.node_states == NodeState.FREE), chance.choice([0.5, 0.3, 0.1, 0.0])
    for amplitude in (reach, 0.3 * reach, 0.1 * reach, 0.0):
        move = np.zeros((len(mesh.points), 2))
        move[movable] = chance.uniform(-amplitude, amplitude, (len(movable), 2)) * mesh.target_size
        if mesh.surface is not None and mesh.parameters is not None:
            moved = mesh.with_parameters(mesh.parameters + move)
            if chance.random() < 0.1 or not quality(moved, metric("shape")).inverted_count:
                return moved
    return mesh


def loss(mesh: Mesh, case: Case, floor: float | None) -> float:
    """What the run makes smaller: worked out from the metrics' own values, without any of the optimiser's code."""
    quads, facing = mesh.topology.quads, mesh.normals
    total = 0.0
    for gain, term in zip(case.objective.gains.tolist(), case.objective.terms, strict=True):
        values = raw_values(term.metric, mesh.points, quads, facing, case.mesh.areas)
        total -= gain * float(values.sum()) / term.metric.factor
    if floor is not None:
        corners = corner_values(metric("scaled_jacobian"), mesh.points, mesh.topology.elements, facing)
        low = corners[corners < floor]
        total += FLOOR_WEIGHT * float((floor / low + low / floor - 2.0).sum())
    return total


def rank(mesh: Mesh, case: Case) -> tuple[float, ...]:
    """How good a mesh is by the mode's own measure, the greater the better; the last number is of a sum."""
    key, search, aim = case.optimizer, case.search, case.objective.metric
    judged = quality(mesh, aim)
    folded = -float(judged.inverted_count)
    if key == "paper":
        sense = 1.0 if aim.higher_is_better else -1.0
        sums = raw_values(aim, mesh.points, mesh.topology.quads, mesh.normals, mesh.reference_areas)
        return folded, sense * float(sums.sum())
    if key == "untangle":
        return (folded,)
    if key in {"worst", "worst_quad"}:
        worst = judged.worst if key == "worst" else judged.worst_quad
        floor = None if key == "worst" else max(search.floor or 0.0, 0.05)
        return folded, -float(aim.badness(np.array(worst))), -loss(mesh, case, floor)
    if key == "rules":
        counts = assess(mesh, case.rules).counts
        violations = (-float(counts[level]) for level in (Level.ERROR, Level.WARN))
        return folded, *violations, -loss(mesh, case, search.floor)
    return folded, -loss(mesh, case, search.floor)


def is_no_worse(after: tuple[float, ...], before: tuple[float, ...]) -> bool:
    """Compared number by number; sums up to rounding errors."""
    *first, total = after
    *first_before, total_before = before
    if first != first_before:
        return first > first_before
    return not total < total_before - 1e-9 * (1.0 + abs(total_before))


def run(case: Case, stride: int) -> list[Iterate]:
    search = attrs.evolve(case.search, stride=stride)
    return list(iterates(case.optimizer, case.mesh, case.objective, search, case.paper, case.rules))


def check(case: Case) -> None:
    mesh, made = case.mesh, run(case, case.search.stride)
    best = outcome(made).best
    may_move = (
        mesh.topology.is_free
        if case.search.chosen is None or case.optimizer == "paper"
        else (mesh.topology.is_free & case.search.chosen)
    )
    folded = quality(mesh, metric("shape")).inverted_count
    for iterate in made:
        assert np.isfinite(iterate.mesh.points).all()
        assert iterate.mesh.points[~may_move].tobytes() == mesh.points[~may_move].tobytes(), "a node that must stay"
        if not folded:
            assert iterate.quality.inverted_count == 0, "folded"
    assert is_no_worse(rank(best.mesh, case), rank(mesh, case)), (rank(best.mesh, case), rank(mesh, case))
    assert made[-1].stop is not None
    assert [each.number for each in made] == sorted({each.number for each in made})
    if best.number == 0:
        assert best.mesh is mesh
    again = outcome(run(case, 11)).best
    assert again.number == best.number
    assert again.mesh.points.tobytes() == best.mesh.points.tobytes(), "another result when looked at otherwise"


def numbers() -> Iterator[int]:
    yield from CASES or count()


@pytest.mark.filterwarnings("error")
def test_no_optimiser_does_harm():
    end, done = time.monotonic() + SECONDS, 0
    for number in numbers():
        if time.monotonic() > end:
            break
        one = case(number)
        if one.optimizer == "paper" and one.mesh.surface is None:
            continue
        try:
            check(one)
        except Exception as error:
            key, by = one.optimizer, ", ".join(term.metric.key for term in one.objective.terms)
            raise AssertionError(f"case {number}: {key} by {by} on {one.mesh}, {one.search}: {error}") from error
        done += 1
    assert done > 100 or CASES
