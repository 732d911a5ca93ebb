"""The energies of the modes: their gradients, their least values, and what the floor does."""

import numpy as np
import pytest

from hullquad.arrays import floats, ints
from hullquad.errors import HullquadError
from hullquad.metrics import OBJECTIVES, metric
from hullquad.metrics.values import raw_values
from hullquad.optimization.course import Course
from hullquad.optimization.descent import Ways, descent, look
from hullquad.optimization.energies import merit, winslow
from hullquad.optimization.energy import Elements, Energy
from hullquad.optimization.facets import NO_FACETS
from hullquad.optimization.footing import footing
from hullquad.optimization.objective import Objective, Term, objective
from hullquad.optimization.problem import problem

UP = np.array([[0.0, 0.0, 1.0]])
AREAS = np.array([300.0**2, 150.0**2])
WITH_STAND_IN = [row for row in OBJECTIVES if row.group in {"Kniat, Table 1", "ANSYS"}]


def facing_up(elements: np.ndarray, quads: int) -> Elements:
    """Elements that face up and count once."""
    return Elements(ints(elements), quads, UP, floats(np.ones(len(elements))))


def of(points: np.ndarray, elements: Elements, energy: Energy) -> tuple[float, np.ndarray, np.ndarray]:
    """Energy, gradient and openness."""
    held = Ways(
        np.empty((0, 2, 3)),
        ints([]),
        floats(np.empty((0, 2, 3))),
        NO_FACETS,
        footing(NO_FACETS, np.arange(len(points)), 0),
    )
    run = descent(points, 0, len(elements.nodes))
    return look(run, held, elements, energy), run.node_gradient, run.openness


def parts(mesh, warp: float) -> tuple[np.ndarray, Elements]:
    given = problem(mesh)
    points = given.points + [0, 0, warp] * np.random.default_rng(3).normal(size=given.points.shape)
    return points, facing_up(given.elements, given.quads)


def energies():
    yield pytest.param(winslow(300.0, 1.0), 20.0, id="Winslow, regularised")
    yield pytest.param(winslow(300.0, 1e-3), 20.0, id="Winslow")
    for row in WITH_STAND_IN:
        for doublings in (0, 3):
            energy = merit(Objective((Term(row),)), 300.0, AREAS, doublings, 0.6)
            yield pytest.param(energy, 3.0, id=f"{row.key}, p = {2**doublings}")


@pytest.mark.parametrize(("energy", "warp"), list(energies()))
def test_the_gradient_is_that_of_the_energy(reference_mesh, energy, warp):
    points, elements = parts(reference_mesh("web_L"), warp)
    value, gradient, _ = of(points, elements, energy)
    assert np.isfinite(value)
    direction, step = np.random.default_rng(4).normal(size=points.shape), 2e-5
    near = [of(points + k * step * direction, elements, energy)[0] for k in (-2, -1, 1, 2)]
    slope = (near[0] - 8 * near[1] + 8 * near[2] - near[3]) / (12 * step)
    assert (gradient * direction).sum() == pytest.approx(slope, rel=2e-5, abs=1e-9 * abs(value))


def test_a_square_and_an_equilateral_triangle_cost_least():
    points = np.array([[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0], [0.5, np.sqrt(0.75), 0]])
    points = points.astype(float)
    only_quad = of(points, facing_up(np.array([[0, 1, 2, 3]]), 1), winslow(1.0, 1e-9))
    only_triangle = of(points, facing_up(np.array([[0, 1, 4, -1]]), 0), winslow(1.0, 1e-9))
    assert only_quad[0] == pytest.approx(1.0)
    assert only_triangle[0] == pytest.approx(0.5)
    for _, gradient, openness in (only_quad, only_triangle):
        np.testing.assert_allclose(gradient, 0.0, atol=1e-12)
        assert openness.tolist() == [pytest.approx(1.0)]


@pytest.mark.parametrize("row", WITH_STAND_IN, ids=lambda row: row.key)
def test_without_a_floor_the_exact_energy_is_the_sum_of_the_metric(reference_mesh, row):
    mesh = reference_mesh("hopper_seg")
    course = Course(problem(mesh), 0, 0.0, 1)
    aim = Objective((Term(row),))
    total = raw_values(row, mesh.points, mesh.topology.quads, mesh.normals, AREAS).sum() / row.factor
    energy = merit(aim, mesh.target_size, AREAS, None, None)
    assert course.value(energy) == pytest.approx(-float(aim.gains[0]) * total, rel=1e-12)


def test_gains_count_the_way_from_limit_to_ideal_alike():
    assert Objective((Term(metric("stretch")),)).gains.tolist() == [pytest.approx(1.0)]
    assert Objective((Term(metric("aspect_ratio"), 2.0),)).gains.tolist() == [pytest.approx(-0.5)]


def test_the_floor_costs_only_what_is_below_it(reference_mesh):
    mesh = reference_mesh("web_L")
    course, aim = Course(problem(mesh), 0, 0.0, 1), objective("shape")
    plain, floored, low = (
        course.value(merit(aim, mesh.target_size, AREAS, None, floor)) for floor in (None, 0.9, 0.01)
    )
    assert plain == pytest.approx(low)
    assert floored > plain + 1.0


def test_the_energy_does_not_depend_on_the_order_of_the_elements(reference_mesh):
    points, elements = parts(reference_mesh("web_L"), 0.0)
    quads, triangles = elements.nodes[: elements.quads], elements.nodes[elements.quads :]
    other = facing_up(np.concatenate([np.roll(quads, 1, axis=1)[::-1], triangles[::-1]]), elements.quads)
    energy = merit(objective("shape"), 300.0, AREAS, 3, 0.3)
    assert of(points, other, energy)[0] == pytest.approx(of(points, elements, energy)[0], rel=1e-12)


def test_an_objective_is_written_by_keys_and_weights():
    aim = objective("stretch=2, shape")
    assert [(term.metric.key, term.weight) for term in aim.terms] == [("stretch", 2.0), ("shape", 1.0)]
    assert aim.metric.key == "stretch"


@pytest.mark.parametrize("text", ["strech", "corner_angle", "stretch=0", "stretch=-1", "stretch=x", "stretch=nan", ""])
def test_an_objective_that_makes_no_sense_is_refused(text):
    with pytest.raises(HullquadError, match=r"E_METRIC|E_OBJECTIVE"):
        objective(text)
