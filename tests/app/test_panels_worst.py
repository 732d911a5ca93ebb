"""Worst elements: a table in step with view and histogram."""

import attrs
import numpy as np
import pytest
from PySide6.QtCore import Qt
from PySide6.QtGui import QColor, QImage

from hullquad.metrics import metric
from hullquad.quality import quality
from hullquad.rules import rule_set
from hullquad_app.colours import DARK, INVERTED, LIGHT
from hullquad_app.level_colours import LEVELS
from hullquad_app.panels.cell import CELL
from hullquad_app.panels.elements import COLUMNS
from hullquad_app.panels.worst import WorstPanel
from hullquad_app.scene import Scene, View
from hullquad_app.track import Track
from hullquad_app.verdict import verdict

DISPLAY = Qt.ItemDataRole.DisplayRole


def scene(iterate, key="stretch", limit=None, selection=frozenset(), **more):
    by = metric(key)
    judged = quality(iterate.mesh, by, None if limit is None else by.opened((limit, limit)))
    return Scene(track=Track((iterate,)), quality=judged, view=View(metric=by, selection=selection), **more)


def texts(panel, name):
    """Texts of a column."""
    return [cell(panel, row, name) for row in range(panel.model.rowCount())]


def cell(panel, row, name, role=DISPLAY):
    return panel.model.index(row, COLUMNS.index(name)).data(role)


def selected(panel):
    """Rows of the table that are selected."""
    return sorted({index.row() for index in panel.table.selectionModel().selectedIndexes()})


def middle(panel, row):
    """Point in a row of the table."""
    return panel.table.visualRect(panel.model.index(row, COLUMNS.index("value"))).center()


@pytest.fixture
def panel(qtbot):
    panel = WorstPanel()
    qtbot.addWidget(panel)
    panel.resize(460, 400)
    panel.show()
    return panel


@pytest.fixture
def iterate(walked):
    return walked.first


@pytest.fixture
def folded(iterate):
    """The mesh with an inverted element."""
    points = iterate.mesh.points.copy()
    points[5] = points[10] + 1.0
    return attrs.evolve(iterate, mesh=attrs.evolve(iterate.mesh, points=points))


def test_the_worst_element_is_first(panel, iterate):
    now = scene(iterate)
    panel.show_scene(now)
    values = [float(text) for text in texts(panel, "value")]
    assert values == sorted(values)
    assert values[0] == pytest.approx(now.quality.worst, abs=5e-4)
    assert int(cell(panel, 0, "element")) == now.quality.worst_element + 1


def test_triangles_are_listed_with_the_quads(panel, iterate):
    panel.show_scene(scene(iterate))
    assert sorted(texts(panel, "kind")) == ["quad"] * 8 + ["triangle"] * 2


def test_a_triangle_says_what_it_is_judged_by(panel, iterate):
    panel.show_scene(scene(iterate))
    row = texts(panel, "kind").index("triangle")
    assert cell(panel, row, "value", Qt.ItemDataRole.ToolTipRole) == "triangles are judged by shape"
    assert cell(panel, texts(panel, "kind").index("quad"), "value", Qt.ItemDataRole.ToolTipRole) is None


def test_the_state_is_a_word(panel, folded):
    panel.show_scene(scene(folded, limit=0.7))
    states = texts(panel, "state")
    assert states[0] == "INVERTED"
    assert {"FAIL", "pass"} <= set(states)
    assert cell(panel, 0, "swatch", Qt.ItemDataRole.DecorationRole) == QColor(INVERTED)


def test_angles_and_aspect_ratios_are_those_of_the_mesh(panel, iterate):
    now = scene(iterate)
    panel.show_scene(now)
    for name, decimals in (("min_angle", 1), ("aspect_ratio", 2)):
        values = quality(iterate.mesh, metric(name)).values[now.quality.worst_first]
        assert texts(panel, name) == [f"{value:.{decimals}f}" for value in values]


@pytest.mark.parametrize("name", ["min_angle", "aspect_ratio"])
def test_no_value_is_shown_twice(panel, iterate, name):
    panel.show_scene(scene(iterate, key=name))
    assert panel.table.isColumnHidden(COLUMNS.index(name))


def test_a_narrow_table_leaves_out_what_can_be_done_without(panel, iterate, qtbot):
    panel.show_scene(scene(iterate))
    assert not panel.table.isColumnHidden(COLUMNS.index("aspect_ratio"))
    panel.resize(200, 400)
    qtbot.waitUntil(lambda: panel.table.isColumnHidden(COLUMNS.index("aspect_ratio")))
    assert not panel.table.isColumnHidden(COLUMNS.index("state"))


def test_headers_name_the_metric_and_its_unit(panel, iterate):
    panel.show_scene(scene(iterate, key="max_angle"))
    titles = [panel.model.headerData(column, Qt.Orientation.Horizontal) for column in range(len(COLUMNS))]
    assert titles[COLUMNS.index("value")] == "Max. angle [°]"


def test_a_click_selects_an_element(panel, qtbot, iterate):
    now = scene(iterate)
    panel.show_scene(now)
    with qtbot.waitSignal(panel.selected) as signal:
        qtbot.mouseClick(panel.table.viewport(), Qt.MouseButton.LeftButton, pos=middle(panel, 2))
    assert signal.args == [frozenset({int(now.quality.worst_first[2])}), False]


def test_a_click_with_shift_extends_the_selection(panel, qtbot, iterate):
    panel.show_scene(scene(iterate))
    with qtbot.waitSignal(panel.selected) as signal:
        shift = Qt.KeyboardModifier.ShiftModifier
        qtbot.mouseClick(panel.table.viewport(), Qt.MouseButton.LeftButton, shift, middle(panel, 2))
    assert signal.args[1]


def test_a_double_click_zooms(panel, qtbot, iterate):
    now = scene(iterate)
    panel.show_scene(now)
    with qtbot.waitSignal(panel.zoom_wanted) as signal:
        qtbot.mouseClick(panel.table.viewport(), Qt.MouseButton.LeftButton, pos=middle(panel, 1))
        qtbot.mouseDClick(panel.table.viewport(), Qt.MouseButton.LeftButton, pos=middle(panel, 1))
    assert signal.args == [int(now.quality.worst_first[1])]


def test_arrow_keys_select(panel, qtbot, iterate):
    now = scene(iterate)
    panel.show_scene(now)
    qtbot.mouseClick(panel.table.viewport(), Qt.MouseButton.LeftButton, pos=middle(panel, 0))
    with qtbot.waitSignal(panel.selected) as signal:
        qtbot.keyClick(panel.table, Qt.Key.Key_Down)
    assert signal.args == [frozenset({int(now.quality.worst_first[1])}), False]


def test_the_selection_of_the_scene_is_shown_and_tells_nobody(panel, qtbot, iterate):
    first = scene(iterate)
    chosen = frozenset(first.quality.worst_first[[1, 4]].tolist())
    with qtbot.assertNotEmitted(panel.selected):
        panel.show_scene(attrs.evolve(first, view=attrs.evolve(first.view, selection=chosen)))
    assert selected(panel) == [1, 4]
    panel.show_scene(first)
    assert selected(panel) == []


def test_next_and_previous_go_through_the_worst(panel, iterate):
    now = scene(iterate)
    order = now.quality.worst_first.tolist()
    told = []
    panel.selected.connect(lambda rows, _: told.append(set(rows)))
    panel.show_scene(now)
    panel.next()
    for element, step in ((order[0], panel.next), (order[1], panel.previous), (order[0], panel.previous)):
        panel.show_scene(attrs.evolve(now, view=attrs.evolve(now.view, selection=frozenset({element}))))
        step()
    assert told == [{order[0]}, {order[1]}, {order[0]}, {order[0]}]


def test_without_elements_nothing_is_selected(panel, qtbot):
    with qtbot.assertNotEmitted(panel.selected):
        panel.show_scene(Scene())
        panel.next()


def test_a_run_refreshes_seldom_and_its_end_at_once(panel, qtbot, walked):
    scenes = [scene(iterate, running=True) for iterate in walked.iterates[:6]]
    refreshed = []
    panel.show_scene(scenes[0])
    panel.model.dataChanged.connect(lambda *_: refreshed.append(1))
    for running in scenes[1:]:
        panel.show_scene(running)
    assert refreshed == []
    qtbot.waitUntil(lambda: refreshed == [1], timeout=1000)
    ended = scene(walked.last)
    panel.show_scene(ended)
    assert float(cell(panel, 0, "value")) == pytest.approx(ended.quality.worst, abs=5e-4)


def test_at_most_two_hundred_elements_are_listed(panel, iterate):
    now = scene(iterate)
    many = attrs.evolve(now.track.first.mesh.topology, elements=np.tile(iterate.mesh.topology.elements, (50, 1)))
    mesh = attrs.evolve(iterate.mesh, topology=attrs.evolve(many, element_labels=np.arange(1, 501)))
    panel.show_scene(scene(attrs.evolve(iterate, mesh=mesh)))
    assert panel.model.rowCount() == 200


@pytest.mark.parametrize("palette", [LIGHT, DARK], ids=["light", "dark"])
def test_it_is_drawn_in_both_themes(panel, folded, palette):
    now = scene(folded)
    panel.show_scene(attrs.evolve(now, view=attrs.evolve(now.view, selection=frozenset({0}))))
    panel.set_palette(palette)
    picture = QImage(panel.size(), QImage.Format.Format_RGB32)
    panel.render(picture)
    assert picture.pixelColor(2, picture.height() - 3) == QColor(palette.panel)
    assert panel.table.accessibleName()


def test_what_the_contour_gives_says_so(panel, iterate):
    now = scene(iterate, key="longest_edge")
    given = np.zeros(10, dtype=bool)
    given[now.quality.worst_element] = True
    found = attrs.evolve(verdict(iterate.mesh, now.quality, None, None), given=given)
    panel.show_scene(attrs.evolve(now, verdict=found))
    assert texts(panel, "state")[:2] == ["FAIL, given", "FAIL"]
    assert [cell(panel, row, "swatch", CELL).is_hatched for row in (0, 1)] == [True, False]
    assert "contour" in cell(panel, 0, "state", Qt.ItemDataRole.ToolTipRole)


def test_what_the_contour_gives_can_be_left_out(panel, iterate, qtbot):
    now = scene(iterate, key="longest_edge")
    given = np.zeros(10, dtype=bool)
    given[now.quality.worst_first[:2]] = True
    found = attrs.evolve(verdict(iterate.mesh, now.quality, None, None), given=given)
    panel.show_scene(attrs.evolve(now, verdict=found))
    qtbot.keyClick(panel.without_given, Qt.Key.Key_Space)
    assert panel.model.rowCount() == 8
    assert panel.model.element(0) == now.quality.worst_first[2]
    qtbot.keyClick(panel.without_given, Qt.Key.Key_Space)
    assert panel.model.rowCount() == 10


def test_where_the_contour_gives_nothing_nothing_can_be_left_out(panel, iterate):
    panel.show_scene(scene(iterate))
    assert not panel.without_given.isVisible()


def test_the_swatch_has_the_colour_of_the_view(panel, iterate):
    now, rules = scene(iterate), rule_set("bv")
    panel.show_scene(attrs.evolve(now, verdict=verdict(iterate.mesh, now.quality, rules, None)))
    worst = now.quality.worst_first[0]
    level = verdict(iterate.mesh, now.quality, rules, None).assessment.levels[worst]
    assert cell(panel, 0, "swatch", Qt.ItemDataRole.DecorationRole) == QColor(LEVELS[level])


def test_a_triangle_by_shape_has_the_decimals_of_shape(panel, iterate):
    now = scene(iterate, key="taper")
    panel.show_scene(now)
    row = texts(panel, "kind").index("triangle")
    assert cell(panel, row, "value") == f"{now.quality.values[panel.model.element(row)]:.3f}"
