"""Nodes that settle come to where an optimiser of the sum of shape brings them."""

from pathlib import Path

import attrs
import numpy as np
import pytest

from hullquad import pipeline
from hullquad.formats import read_plates
from hullquad.metrics import metric
from hullquad.metrics.values import judged_values, valid_elements
from hullquad.optimization.iterate import outcome
from hullquad.optimization.paper import paper_iterates
from hullquad.quads.cost import judged
from hullquad.quads.draft import draft
from hullquad.quads.energy import element_energies
from hullquad.quads.settling import AGAIN, settled
from hullquad.triangulation.contour import contours

PLATES = Path(__file__).parents[2] / "assets/plates"
SHAPE = metric("shape")


@pytest.fixture(scope="module", params=["bracket_toe", "engine_foundation", "hopper_web_ring"])
def mesh(request):
    """The best mesh of a plate; each of these has a triangle."""
    (contour,) = contours(read_plates(PLATES / f"{request.param}.json"), "coarse").values()
    return pipeline.best_mesh(contour)


def settled_mesh(mesh, *sweeps):
    given = int((~mesh.topology.is_free).sum())
    assert not mesh.topology.is_free[:given].any()
    made = draft(mesh.parameters, mesh.topology.elements, given, np.empty(0, dtype=np.int64))
    settled(made, *sweeps)
    places = made.nodes[: len(mesh.points)]
    return attrs.evolve(mesh, parameters=places, points=mesh.surface.points(places))


def total(mesh):
    return judged_values(SHAPE, mesh.points, mesh.topology.quads, mesh.normals)[0].sum()


def test_the_sum_of_shape_comes_to_what_the_paper_makes_of_it(mesh):
    start, there = total(mesh), total(outcome(paper_iterates(mesh, SHAPE)).best.mesh)
    assert there > start
    assert total(settled_mesh(mesh)) - start > 0.65 * (there - start)  # the triangle counts, too, where nodes settle


def test_given_nodes_stay_and_every_element_stays_valid(mesh):
    after = settled_mesh(mesh)
    fixed = ~mesh.topology.is_free
    assert after.parameters[fixed].tobytes() == mesh.parameters[fixed].tobytes()
    assert valid_elements(after.points, after.topology.elements, after.normals).all()


def test_a_mesh_that_has_settled_settles_again_where_it_is(mesh):
    once = settled_mesh(mesh)
    assert abs(total(settled_mesh(once, AGAIN)) - total(once)) < 0.002 * total(once)


def test_a_mesh_is_judged_where_its_nodes_settle(mesh):
    given, elements = int((~mesh.topology.is_free).sum()), mesh.topology.elements
    there = settled_mesh(mesh).parameters
    found = judged(mesh.parameters, elements, given, settles=True)
    np.testing.assert_array_equal(found, element_energies(there, elements.astype(np.int64)))
    as_it_is = judged(mesh.parameters, elements, given, settles=False)
    np.testing.assert_array_equal(as_it_is, element_energies(mesh.parameters.copy(), elements.astype(np.int64)))
    assert (found != as_it_is).any()


def test_an_element_without_area_is_left_alone():
    square = np.array([(0, 0), (2, 0), (2, 2), (0, 2), (1, -0.5)], dtype=float)  # the last node is outside: inverted
    elements = np.array([[0, 1, 4, -1], [1, 2, 4, -1], [2, 3, 4, -1], [3, 0, 4, -1]], dtype=np.int32)
    made = draft(square, elements, 4, np.empty(0, dtype=np.int64))
    settled(made)
    assert made.nodes[:5].tobytes() == square.tobytes()
