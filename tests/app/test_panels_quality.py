"""Quality distribution: key figures, bars to click, the limit to drag."""

import attrs
import numpy as np
import pytest
from PySide6.QtCore import QEvent, QPoint, Qt
from PySide6.QtGui import QColor, QHelpEvent, QImage
from PySide6.QtWidgets import QApplication, QToolTip

from hullquad.metrics import Scale, Sense, metric
from hullquad.quality import Quality
from hullquad_app.colours import DARK, INVERTED, LIGHT, PASS_FAIL
from hullquad_app.panels.axis import Axis, labels, ticks, top
from hullquad_app.panels.figures import counted, plain, shown
from hullquad_app.panels.quality import QualityPanel
from hullquad_app.scene import Scene, View
from hullquad_app.verdict import Verdict

LEFT = Qt.MouseButton.LeftButton
CORNERS = attrs.evolve(metric("min_angle"), sense=Sense.NEARER, quads=Scale(0, 180, 90, (45, 135)))


def judged(values, key="stretch", limit=None, invalid=()):
    """Quality of quads with given values."""
    row, values = metric(key), np.array(values, dtype=float)
    band = row.band if limit is None else row.opened((limit, limit))
    valid = ~np.isin(np.arange(len(values)), invalid)
    return Quality(
        metric=row,
        band=band,
        values=values,
        valid=valid,
        failing=~(row.is_within(band, values) & valid),
        is_triangle=np.zeros(len(values), dtype=bool),
    )


def scene(quality, first=None, **view):
    """A scene with that quality and nothing else."""
    return Scene(quality=quality, first_quality=first or quality, view=View(**view))


@pytest.fixture
def panel(qtbot):
    panel = QualityPanel()
    qtbot.addWidget(panel)
    panel.resize(400, 300)
    panel.show()
    return panel


def at(panel, value):
    """Point of the chart where a value is."""
    return panel.chart.point_at(value).toPoint()


def tip(panel, value):
    """Text that hovering over a value shows."""
    QToolTip.hideText()
    point = at(panel, value)
    QApplication.sendEvent(panel.chart, QHelpEvent(QEvent.Type.ToolTip, point, panel.chart.mapToGlobal(point)))
    return QToolTip.text()


def picture(widget):
    """A widget as it is drawn, in true colours whatever the screen has."""
    image = QImage(widget.size(), QImage.Format.Format_RGB32)
    widget.render(image)
    return image


def has_colour(panel, colour):
    """Whether any pixel of the chart has a colour."""
    image, wanted = picture(panel.chart), QColor(colour).rgb()
    return any(image.pixel(x, y) == wanted for x in range(image.width()) for y in range(0, image.height(), 2))


def test_key_figures_tell_worst_mean_and_failing(panel):
    panel.show_scene(scene(judged([0.1, 0.5, 0.9])))
    figures = panel.figures
    assert [figures.worst.number.text(), figures.mean.number.text()] == ["0.100", "0.500"]
    assert figures.failing.number.text() + figures.failing.rest.text() == "1 of 3"


@pytest.mark.parametrize(("count", "caption"), [(0, "failing"), (1, "failing, 1 given")])
def test_key_figures_tell_what_the_contour_gives(panel, dented, count, caption):
    now = scene(judged([0.1, 0.2]))
    found = Verdict(mesh=dented, quality=now.quality, given=np.array([count > 0, False]))
    panel.show_scene(attrs.evolve(now, verdict=found))
    assert panel.figures.failing.caption.text() == caption


def test_figures_that_fail_are_in_the_colour_of_failing(panel):
    panel.show_scene(scene(judged([0.1, 0.9])))
    panel.set_palette(DARK)
    assert panel.figures.worst.number.palette().windowText().color() == QColor(DARK.fail)
    assert panel.figures.mean.number.palette().windowText().color() == QColor(DARK.text)


@pytest.mark.parametrize("invalid", [(), (0,)])
def test_inverted_elements_are_counted_where_there_are_some(panel, invalid):
    panel.show_scene(scene(judged([0.0, 0.9], invalid=invalid)))
    assert panel.figures.inverted.isVisible() == bool(invalid)
    assert has_colour(panel, INVERTED) == bool(invalid)


def test_a_click_on_a_bar_selects_its_elements(panel, qtbot):
    panel.show_scene(scene(judged([0.51, 0.9, 0.515])))
    with qtbot.waitSignal(panel.selected) as signal:
        qtbot.mouseClick(panel.chart, LEFT, pos=at(panel, 0.512))
    assert signal.args == [frozenset({0, 2}), False]


def test_a_click_with_shift_extends_the_selection(panel, qtbot):
    panel.show_scene(scene(judged([0.51, 0.91])))
    with qtbot.waitSignal(panel.selected) as signal:
        qtbot.mouseClick(panel.chart, LEFT, Qt.KeyboardModifier.ShiftModifier, at(panel, 0.91))
    assert signal.args == [frozenset({1}), True]


def test_the_limit_follows_the_mouse_and_stays_where_it_is_left(panel, qtbot):
    panel.show_scene(scene(judged([0.1, 0.9])))
    dragged, released = [], []
    panel.limit_dragged.connect(lambda end, limit: dragged.append((end, limit)))
    panel.limit_released.connect(lambda end, limit: released.append((end, limit)))
    qtbot.mousePress(panel.chart, LEFT, pos=at(panel, 0.25))
    for value in (0.3, 0.4):
        qtbot.mouseMove(panel.chart, at(panel, value))
    qtbot.mouseRelease(panel.chart, LEFT, pos=at(panel, 0.4))
    assert dragged[-1] == (0, pytest.approx(0.4, abs=0.011))
    assert released == [dragged[-1]]


def test_a_click_on_the_limit_moves_nothing(panel, qtbot):
    panel.show_scene(scene(judged([0.1, 0.9])))
    with qtbot.assertNotEmitted(panel.limit_released), qtbot.assertNotEmitted(panel.selected):
        qtbot.mouseClick(panel.chart, LEFT, pos=at(panel, 0.25))


def test_escape_gives_up_dragging(panel, qtbot):
    panel.show_scene(scene(judged([0.1, 0.9])))
    qtbot.mousePress(panel.chart, LEFT, pos=at(panel, 0.25))
    qtbot.mouseMove(panel.chart, at(panel, 0.4))
    with qtbot.waitSignal(panel.limit_released) as signal:
        qtbot.keyClick(panel.chart, Qt.Key.Key_Escape)
    assert signal.args == [0, 0.25]


def test_a_double_click_on_the_limit_takes_back_the_metrics_own(panel, qtbot):
    panel.show_scene(scene(judged([0.1], limit=0.4)))
    with qtbot.waitSignal(panel.limit_reset):
        qtbot.mouseDClick(panel.chart, LEFT, pos=at(panel, 0.4))


@pytest.mark.parametrize(
    ("key", "limit"), [(Qt.Key.Key_Left, 0.24), (Qt.Key.Key_Right, 0.26), (Qt.Key.Key_PageUp, 0.35)]
)
def test_keys_move_the_limit(panel, qtbot, key, limit):
    panel.show_scene(scene(judged([0.1])))
    with qtbot.waitSignal(panel.limit_released) as signal:
        qtbot.keyClick(panel.chart, key)
    assert signal.args == [0, pytest.approx(limit)]


@pytest.mark.parametrize(("start", "end", "told"), [(45, 60, (0, 60.0)), (135, 120, (1, 120.0)), (45, 170, (0, 135.0))])
def test_each_of_two_limits_is_dragged_by_itself_and_stops_at_the_other(panel, qtbot, start, end, told):
    panel.show_scene(scene(attrs.evolve(judged([50.0, 90.0], "min_angle"), metric=CORNERS, band=CORNERS.band)))
    qtbot.mousePress(panel.chart, LEFT, pos=at(panel, start))
    qtbot.mouseMove(panel.chart, at(panel, end))
    with qtbot.waitSignal(panel.limit_released) as signal:
        qtbot.mouseRelease(panel.chart, LEFT, pos=at(panel, end))
    assert signal.args == [told[0], pytest.approx(told[1], abs=1.1)]


def test_keys_choose_which_of_two_limits_they_move(panel, qtbot):
    panel.show_scene(scene(attrs.evolve(judged([50.0, 90.0], "min_angle"), metric=CORNERS, band=CORNERS.band)))
    for key, told in ((Qt.Key.Key_Up, [1, 136.0]), (Qt.Key.Key_Down, [0, 46.0])):
        qtbot.keyClick(panel.chart, key)
        with qtbot.waitSignal(panel.limit_released) as signal:
            qtbot.keyClick(panel.chart, Qt.Key.Key_Right)
        assert signal.args == told


def test_the_cursor_tells_where_the_limit_can_be_taken(panel, qtbot):
    panel.show_scene(scene(judged([0.1, 0.9])))
    qtbot.mouseMove(panel.chart, at(panel, 0.25))
    assert panel.chart.cursor().shape() == Qt.CursorShape.SplitHCursor


@pytest.mark.parametrize(
    ("key", "values", "value", "text"),
    [
        ("stretch", [0.51, 0.512], 0.512, "0.5–0.525: 2 elements"),
        ("min_angle", [50.0], 51.0, "50°–52.5°: 1 element"),
        ("aspect_ratio", [np.inf, 30.0], 9.9, "over 9.75: 2 elements"),
        ("scaled_jacobian", [-0.5], 0.01, "below 0.025: 1 element"),
        ("stretch", [0.5], 0.25, "Drag to move the limit, double-click to take back the metric's own"),
    ],
)
def test_hovering_tells_range_and_number(panel, key, values, value, text):
    panel.show_scene(scene(judged(values, key)))
    assert tip(panel, value) == text


def test_bars_have_the_colours_of_the_chosen_map(panel):
    panel.show_scene(scene(judged([0.1, 0.1, 0.9])))
    panel.set_palette(LIGHT, PASS_FAIL)
    assert has_colour(panel, "#E34A33")
    assert has_colour(panel, "#ADCDE1")


def test_selected_elements_mark_their_bar(panel):
    panel.show_scene(scene(judged([0.5, 0.9])))
    unmarked = picture(panel.chart)
    panel.show_scene(attrs.evolve(scene(judged([0.5, 0.9])), view=View(selection=frozenset({1}))))
    assert picture(panel.chart) != unmarked


def test_iteration_0_is_outlined_where_it_differs(panel):
    now = judged([0.5, 0.9])
    panel.show_scene(scene(now))
    alone = picture(panel.chart)
    panel.show_scene(scene(now, first=judged([0.3, 0.3])))
    assert picture(panel.chart) != alone


def test_what_has_not_changed_is_not_painted_again(panel):
    now = scene(judged([0.5]))
    panel.show_scene(now)
    QApplication.processEvents()
    painted = []
    panel.chart.paintEvent = painted.append
    panel.show_scene(attrs.evolve(now, running=True))
    QApplication.processEvents()
    assert len(painted) == 0


@pytest.mark.parametrize(
    "quality",
    [
        None,
        judged([]),
        judged([0.5]),
        judged([0.7] * 9),
        judged([np.inf], "aspect_ratio"),
        judged([200.0], "max_angle"),
    ],
    ids=["none", "empty", "one", "equal", "infinite", "beyond"],
)
def test_every_mesh_can_be_shown(panel, quality):
    panel.show_scene(Scene(quality=quality, first_quality=quality))
    assert not panel.grab().isNull()


def test_without_a_mesh_nothing_can_be_taken(panel, qtbot):
    for signal in (panel.selected, panel.limit_released):
        with qtbot.assertNotEmitted(signal):
            qtbot.mouseClick(panel.chart, LEFT, pos=QPoint(200, 100))
            qtbot.keyClick(panel.chart, Qt.Key.Key_Left)


def test_every_control_has_an_accessible_name(panel):
    assert panel.chart.accessibleName()
    assert panel.figures.worst.number.accessibleName() == "worst"


def test_numbers_have_three_decimals_that_count():
    values = [("stretch", 0.12345), ("min_angle", 7.1234), ("aspect_ratio", 1.6789), ("aspect_ratio", np.inf)]
    assert [shown(value, metric(key)) for key, value in values] == ["0.123", "7.1", "1.68", "∞"]
    assert plain(45.0, metric("min_angle")) == "45°"
    assert counted(1234567) == "1\u202f234\u202f567"


def test_ticks_are_round_and_few():
    assert ticks(0, 1, 6) == pytest.approx([0, 0.2, 0.4, 0.6, 0.8, 1.0])
    assert labels(ticks(0, 0.1, 3)) == ["0", "0.05", "0.10"]
    assert ticks(0, 3, 5, whole=True) == [0, 1, 2, 3]
    assert [top(count) for count in (0, 3, 53, 101)] == [1, 4, 60, 200]


def test_an_axis_gives_back_the_value_of_a_pixel():
    axis = Axis(0.0, 2.0, 10.0, 110.0)
    assert axis.value(axis.at(0.5)) == pytest.approx(0.5)
    assert axis.at(7.0) == 110.0
