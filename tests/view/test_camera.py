"""The camera turns, moves and enlarges as the hand expects."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from hullquad_app.canvas.camera import VIEWS, Camera
from hullquad_app.canvas.ruler import nice_length, written

PIXELS = st.floats(-300, 300)
FACTORS = st.floats(0.2, 5)
CORNERS = np.array([[0, 0, 0], [4000, 0, 100], [4000, 1000, 0], [0, 1000, 50.0]])


@pytest.fixture(scope="module")
def camera():
    return Camera(centre=[2000, 500, 0], pixel=10.0)


@given(x=PIXELS, y=PIXELS, factor=FACTORS)
def test_what_is_below_the_cursor_stays_there_when_enlarged(camera, x, y, factor):
    point = camera.centre + camera.pixel * (x * camera.right + y * camera.up)
    np.testing.assert_allclose(camera.zoomed(factor, x, y).pixels(point[None]), [[x, y]], atol=1e-6)


@given(x=PIXELS, y=PIXELS)
def test_a_dragged_plate_follows_the_cursor(camera, x, y):
    before, after = camera.pixels(CORNERS), camera.panned(x, y).pixels(CORNERS)
    np.testing.assert_allclose(after - before, np.broadcast_to([x, y], (4, 2)), atol=1e-9)


@given(x=PIXELS, y=PIXELS)
def test_turning_keeps_the_pivot_in_place_and_the_axes_square(camera, x, y):
    turned = camera.orbited(x, y, CORNERS[1])
    axes = np.array([turned.right, turned.up, turned.towards])
    np.testing.assert_allclose(axes @ axes.T, np.eye(3), atol=1e-12)
    np.testing.assert_allclose(turned.pixels(CORNERS[1:2]), camera.pixels(CORNERS[1:2]), atol=1e-6)


def test_the_near_side_follows_the_cursor_when_turned(camera):
    above = np.add(camera.centre, [0, 0, 1000.0])
    moved = camera.orbited(40, 20, camera.centre).pixels(above[None])[0]
    assert (moved > 0).all()


@given(x=PIXELS, y=PIXELS, width=st.floats(300, 2000), height=st.floats(300, 2000))
def test_a_fitted_plate_fills_the_picture_within_its_margin(camera, x, y, width, height):
    fitted = camera.orbited(x, y, camera.centre).fitted(CORNERS, width, height, 48)
    across = fitted.pixels(CORNERS)
    room = np.array([width, height]) / 2 - 48
    np.testing.assert_allclose(across.min(axis=0), -across.max(axis=0), atol=1e-6)
    np.testing.assert_allclose((across.max(axis=0) / room).max(), 1)


def test_a_single_point_is_fitted_without_a_size(camera):
    assert np.isfinite(camera.fitted(CORNERS[:1], 600, 400, 48).pixel)


@pytest.mark.parametrize(
    ("view", "from_where"), [("front", [1, 0, 0]), ("top", [0, 0, 1]), ("side", [0, -1, 0]), ("isometric", [1, -1, 1])]
)
def test_standard_views_look_from_where_they_say(camera, view, from_where):
    towards = camera.turned(*map(np.array, VIEWS[view])).towards
    np.testing.assert_allclose(towards, np.array(from_where) / np.linalg.norm(from_where), atol=1e-12)


@given(most=st.floats(1e-3, 1e6))
def test_a_scale_bar_has_a_round_length_that_fits(most):
    length = nice_length(most)
    assert most / 2.5 - 1e-9 <= length <= most * (1 + 1e-6)
    assert round(length / 10 ** np.floor(np.log10(length) + 1e-9), 6) in {1, 2, 5}


def test_lengths_are_written_in_groups():
    assert written(2000) == "2\N{NARROW NO-BREAK SPACE}000 mm"
    assert written(500) == "500 mm"
    assert written(0.05) == "0.05 mm"
