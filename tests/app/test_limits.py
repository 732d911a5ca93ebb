"""Limits as they are typed and stepped: one box or two, in the metric's own steps, and the way back."""

from math import inf

import attrs
import pytest
from PySide6.QtCore import Qt
from PySide6.QtTest import QTest

from hullquad.metrics import METRICS, Scale, Sense, metric
from hullquad_app.limit_boxes import LimitBoxes
from hullquad_app.limits import decimals, limit_words, step, with_limit

CORNERS = attrs.evolve(metric("min_angle"), title="Corners", sense=Sense.NEARER, quads=Scale(0, 180, 90, (45, 135)))


@pytest.fixture
def boxes(qtbot):
    boxes = LimitBoxes()
    qtbot.addWidget(boxes)
    boxes.show()
    return boxes


def typed(box, text):
    """Type a number and Enter."""
    box.setFocus()
    box.selectAll()
    QTest.keyClicks(box, text)
    QTest.keyClick(box, Qt.Key.Key_Return)


@pytest.mark.parametrize("row", METRICS, ids=lambda row: row.key)
def test_the_boxes_show_the_limits_of_every_metric(boxes, row):
    boxes.show_limits(row, row.band)
    shown = [box.value() for box in boxes.boxes if box.isVisible()]
    assert shown == pytest.approx(row.limits(row.band))


def test_a_limit_that_is_typed_is_told(boxes, qtbot):
    boxes.show_limits(metric("stretch"), metric("stretch").band)
    with qtbot.waitSignal(boxes.moved) as signal:
        typed(boxes.boxes[0], "0.4")
    assert signal.args == [0, 0.4]


def test_each_limit_of_two_sides_has_its_box(boxes, qtbot):
    boxes.show_limits(CORNERS, CORNERS.band)
    with qtbot.waitSignal(boxes.moved) as signal:
        typed(boxes.boxes[1], "120")
    assert signal.args == [1, 120.0]
    assert [box.prefix() for box in boxes.boxes] == ["≥ ", "≤ "]


def test_a_second_box_moves_nothing(boxes):
    boxes.show_limits(metric("stretch"), metric("stretch").band)
    before = boxes.sizeHint()
    boxes.show_limits(CORNERS, CORNERS.band)
    assert boxes.sizeHint() == before


def test_the_way_back_is_open_where_the_limit_is_another(boxes, qtbot):
    row = metric("aspect_ratio")
    boxes.show_limits(row, row.band)
    assert not boxes.reset.isEnabled()
    boxes.show_limits(row, (-inf, 3.0))
    with qtbot.waitSignal(boxes.reset_wanted):
        QTest.mouseClick(boxes.reset, Qt.MouseButton.LeftButton)


@pytest.mark.parametrize("row", METRICS, ids=lambda row: row.key)
def test_a_press_of_an_arrow_is_seen_and_is_no_leap(row):
    (limit, *_), one = row.limits(row.band), step(row)
    assert f"{limit + one:.{decimals(row, (limit,))}f}" != f"{limit:.{decimals(row, (limit,))}f}"
    assert one <= (1.0 if row.unit else 0.25 * limit)


def test_a_limit_is_never_rounded_in_its_box():
    assert decimals(metric("stretch"), (0.3125,)) == 4
    assert decimals(metric("min_angle"), (45.0,)) == 1


@pytest.mark.parametrize(
    ("end", "limit", "band"),
    [(0, 60.0, (60.0, 135.0)), (1, 120.0, (45.0, 120.0)), (0, 150.0, (135.0, 135.0)), (1, 10.0, (45.0, 45.0))],
)
def test_two_limits_never_pass_each_other(end, limit, band):
    assert with_limit(CORNERS, CORNERS.band, end, limit) == band


def test_limits_are_told_with_their_unit():
    assert limit_words(CORNERS, CORNERS.band) == "45° – 135°"
    assert limit_words(metric("aspect_ratio"), (-inf, 3.0)) == "3"
