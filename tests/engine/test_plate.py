"""Plates as values: where on them an error is."""

from pathlib import Path

import numpy as np
import pytest

from hullquad.errors import PlateError
from hullquad.formats import read_plates
from hullquad.plate import Notice

PLATES = Path(__file__).parents[2] / "assets" / "plates"


@pytest.fixture(scope="module")
def plate():
    """A plate with holes, arcs and stiffeners."""
    return next(plate for plate in read_plates(PLATES / "floor_manholes.json").plates if plate.holes)


def where(plate, place, **numbers):
    return plate.place_of(PlateError("E_COARSE", place, **numbers))


def in_space(plate, points):
    return plate.surface.points(np.asarray(points, dtype=float))


def test_an_error_that_quotes_a_point_is_there(plate):
    np.testing.assert_allclose(where(plate, plate.holes[0].place, u=300.0, v=400.0), in_space(plate, [[300, 400]]))


def test_an_error_of_a_hole_is_all_around_it(plate):
    shown = where(plate, plate.holes[0].place)
    np.testing.assert_allclose(shown[:-1], in_space(plate, plate.outlines[1]))
    np.testing.assert_array_equal(shown[0], shown[-1])


def test_an_error_of_an_edge_is_along_it(plate):
    edge = plate.outer.curves[2]
    for place in (plate.outer.edge_place(2), f"{plate.outer.edge_place(2)}/bulge"):
        shown = where(plate, place)
        np.testing.assert_allclose(shown[[0, -1]], in_space(plate, [edge.start, edge.end]))


def test_an_error_of_a_line_is_along_it(plate):
    line = plate.lines[0]
    np.testing.assert_allclose(where(plate, f"{line.place}/a"), in_space(plate, [line.a, line.b]))


@pytest.mark.parametrize("below", ["", "/thickness"])
def test_an_error_of_the_whole_plate_is_nowhere(plate, below):
    assert where(plate, plate.place + below).shape == (0, 3)


def test_a_notice_is_where_its_remedy_is(plate):
    edge = plate.outer.curves[2]
    notice = Notice("W_ODD", plate.place, "edge", {"where": plate.outer.edge_place(2)})
    np.testing.assert_allclose(plate.place_of(notice)[[0, -1]], in_space(plate, [edge.start, edge.end]))


def test_an_error_of_a_curved_plate_is_nowhere():
    (plate, *_) = read_plates(PLATES / "bilge_shell.json").plates
    assert where(plate, plate.outer.place).shape == (0, 3)
