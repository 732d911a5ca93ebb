"""The view, by its arrays, its camera and what it says when it is used."""

import gc
from pathlib import Path

import attrs
import numpy as np
import pytest
from PySide6.QtCore import QEvent, QPoint, QPointF, Qt, QTimer
from PySide6.QtGui import QMouseEvent, QWheelEvent
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QApplication

from hullquad.formats import read_plates
from hullquad.metrics import metric
from hullquad.topology import edges
from hullquad_app.canvas import Canvas
from hullquad_app.colours import DARK, LIGHT, PASS_FAIL, element_colours, rgb
from hullquad_app.division import division
from hullquad_app.scene import State

PLATES = Path(__file__).parents[2] / "assets" / "plates"
LEFT, MIDDLE = Qt.MouseButton.LeftButton, Qt.MouseButton.MiddleButton
NONE, SHIFT = Qt.KeyboardModifier.NoModifier, Qt.KeyboardModifier.ShiftModifier


def shown(canvas, name):
    """Data of a layer."""
    return canvas.stage.layers[name].data


def lines(canvas, name):
    """Pairs of nodes that a layer draws lines between."""
    return shown(canvas, name).lines.reshape(-1, 3)[:, 1:]


def is_visible(canvas, name):
    return bool(canvas.stage.layers[name].actor.GetVisibility())


def on_screen(canvas, point):
    """Where a point of the plate is in the widget."""
    x, y = canvas.viewpoint.camera.pixels(point[None])[0]
    return QPoint(round(canvas.width() / 2 + x), round(canvas.height() / 2 - y))


def middle_of(mesh, row):
    nodes = mesh.topology.elements[row]
    return mesh.points[nodes[nodes >= 0]].mean(axis=0)


def drag(canvas, start, end, button=LEFT, modifiers=NONE):
    """A drag by the mouse, as Qt reports it."""
    QTest.mousePress(canvas, button, modifiers, start)
    for place in (start + (end - start) / 2, end):
        move(canvas, place, button, modifiers)
    QTest.mouseRelease(canvas, button, modifiers, end)


def move(canvas, place, button=Qt.MouseButton.NoButton, modifiers=NONE):
    far = QPointF(canvas.mapToGlobal(place))
    event = QMouseEvent(QEvent.Type.MouseMove, QPointF(place), far, Qt.MouseButton.NoButton, button, modifiers)
    QApplication.sendEvent(canvas, event)


def wheel(canvas, place, notches):
    far = QPointF(canvas.mapToGlobal(place))
    turn = QPoint(0, 120 * notches)
    phase = Qt.ScrollPhase.NoScrollPhase
    event = QWheelEvent(QPointF(place), far, QPoint(), turn, Qt.MouseButton.NoButton, NONE, phase, False)
    QApplication.sendEvent(canvas, event)


def test_elements_are_shown_where_they_are_in_their_colours(canvas, give, coarse):
    scene = give(coarse)
    elements = shown(canvas, "elements")
    np.testing.assert_array_equal(elements.points, coarse.points)
    np.testing.assert_array_equal(elements.cell_data["colours"], element_colours(scene.quality))
    assert elements.n_cells == len(coarse.topology.elements)
    assert elements.get_cell(int(np.flatnonzero(coarse.topology.is_triangle)[0])).n_points == 3


def test_moving_nodes_changes_arrays_and_makes_nothing_anew(canvas, give, coarse, moved):
    give(coarse)
    elements, actor = shown(canvas, "elements"), canvas.stage.layers["elements"].actor
    points, cells = elements.GetPoints(), elements.GetPolys()
    stamp = points.GetMTime()
    scene = give(moved)
    assert (elements.GetPoints(), elements.GetPolys()) == (points, cells)
    assert canvas.stage.layers["elements"].actor is actor
    assert points.GetMTime() > stamp
    np.testing.assert_array_equal(elements.points, moved.points)
    np.testing.assert_array_equal(elements.cell_data["colours"], element_colours(scene.quality))


def test_another_limit_only_changes_colours(canvas, document, give, coarse):
    give(coarse)
    stamp = shown(canvas, "elements").GetPoints().GetMTime()
    document.look(bands={"stretch": (0.8, float("inf"))})
    colours = shown(canvas, "elements").cell_data["colours"]
    np.testing.assert_array_equal(colours, element_colours(document.scene.quality))
    assert shown(canvas, "elements").GetPoints().GetMTime() == stamp


def test_failing_elements_are_outlined(canvas, document, give, coarse):
    give(coarse)
    assert not is_visible(canvas, "failing")
    document.look(bands={"stretch": (0.8, float("inf"))})
    failing = coarse.topology.elements[document.scene.quality.failing]
    np.testing.assert_array_equal(np.unique(lines(canvas, "failing")), np.unique(failing[failing >= 0]))


def test_inverted_elements_lie_on_top(canvas, give, folded):
    scene = give(folded)
    assert shown(canvas, "inverted").n_cells == scene.quality.inverted_count > 0
    assert canvas.stage.layers["inverted"].rank > canvas.stage.layers["elements"].rank


def test_the_contour_is_what_has_one_element(canvas, give, coarse):
    give(coarse)
    found, counts = edges(coarse.topology.elements)
    np.testing.assert_array_equal(lines(canvas, "contour"), found[counts == 1])


def test_a_plate_without_a_mesh_is_shown_by_its_outline_and_contour_nodes(canvas, document, give, coarse):
    plate = document.scene.plate
    assert not is_visible(canvas, "nodes")
    canvas.show_division(division(document.scene.state.plates, None))
    assert shown(canvas, "outline").n_lines == sum(map(len, plate.outlines))
    assert shown(canvas, "nodes").n_points > 10
    give(coarse)
    assert not is_visible(canvas, "outline")
    assert not is_visible(canvas, "nodes")
    document.edits.undo()
    assert is_visible(canvas, "outline")
    assert not is_visible(canvas, "elements")
    assert not is_visible(canvas, "contour")


@pytest.mark.parametrize("size", ["fine", 313.0])
def test_the_nodes_drawn_are_those_of_the_size_that_is_chosen(canvas, document, size):
    found = division(document.scene.state.plates, size)
    canvas.show_division(found)
    points = found.contours["hopper_partition"].points
    assert shown(canvas, "nodes").n_points == len(points)
    np.testing.assert_allclose(np.asarray(shown(canvas, "nodes").points), points, atol=1e-2)


def test_no_nodes_of_another_document_are_drawn(canvas, document):
    other = read_plates(PLATES / "hopper_partition.json")
    canvas.show_division(division(other, None))
    assert not is_visible(canvas, "nodes")


def test_stiffeners_are_drawn_before_the_contour_is_divided(canvas, document):
    document.open(State(plates=read_plates(PLATES / "hopper_partition_stiffened.json")))
    assert is_visible(canvas, "lines")


def test_a_curved_plate_is_said_to_be_one(canvas, document, request):
    plates = request.path.parents[2] / "assets" / "plates"
    document.open(State(plates=read_plates(plates / "bilge_shell.json")))
    assert "curved" in canvas.overlay.notice
    document.open(State())
    assert canvas.overlay.notice == ""


def test_a_curved_plate_is_shown_by_its_outline_in_space(canvas, document, request):
    plates = request.path.parents[2] / "assets" / "plates"
    document.open(State(plates=read_plates(plates / "bilge_shell.json")))
    outline = shown(canvas, "outline")
    assert is_visible(canvas, "outline")
    assert (np.ptp(outline.points, axis=0) > 100).all()
    across = np.abs(canvas.viewpoint.camera.pixels(outline.points)).max(axis=0)
    assert (across <= [300 - 47, 200 - 47]).all()


def test_selected_elements_have_an_outline_around_them(canvas, document, give, coarse):
    give(coarse)
    document.look(selection=frozenset({0}))
    assert set(np.unique(lines(canvas, "selection"))) == set(coarse.topology.elements[0])
    document.look(selection=frozenset())
    assert not is_visible(canvas, "selection")


def test_small_edges_are_left_out(canvas, give, coarse):
    give(coarse)
    assert is_visible(canvas, "edges")
    canvas.viewpoint.zoom(canvas.viewpoint.camera.pixel * 3 / coarse.target_size, 300, 200)
    assert not is_visible(canvas, "edges")


def test_edges_can_be_hidden(canvas, give, coarse):
    give(coarse)
    canvas.toggle_edges()
    assert not is_visible(canvas, "edges")
    canvas.toggle_edges()
    assert is_visible(canvas, "edges")


@pytest.mark.parametrize("palette", [LIGHT, DARK], ids=["light", "dark"])
def test_the_view_takes_the_colours_of_the_theme(canvas, give, coarse, palette):
    give(coarse)
    canvas.set_palette(palette)
    ground = np.array(canvas.stage.renderer.GetBackground()) * 255
    np.testing.assert_allclose(ground, rgb(palette.view))
    contour = np.array(canvas.stage.layers["contour"].actor.GetProperty().GetColor()) * 255
    np.testing.assert_allclose(contour, rgb(palette.contour))


def test_another_map_colours_anew(canvas, document, give, coarse):
    give(coarse)
    canvas.set_colour_map(PASS_FAIL)
    colours = shown(canvas, "elements").cell_data["colours"]
    np.testing.assert_array_equal(colours, element_colours(document.scene.quality, PASS_FAIL))


def test_a_place_is_shown_until_another_plate_is(canvas, document, coarse, give):
    give(coarse)
    canvas.show_place(coarse.points[0])
    assert shown(canvas, "marks").n_points == 1
    canvas.show_place(coarse.points[:4])
    assert shown(canvas, "place").n_lines == 3
    assert not is_visible(canvas, "marks")
    document.open(State())
    assert not is_visible(canvas, "place")


def test_the_plate_is_seen_in_plan_first_and_whole(canvas, document):
    camera, surface = canvas.viewpoint.camera, document.scene.plate.surface
    np.testing.assert_allclose([camera.right, camera.up], [surface.u, surface.v])
    across = np.abs(camera.pixels(canvas.viewpoint.points)).max(axis=0)
    assert (across <= [300 - 47, 200 - 47]).all()


def test_vtk_looks_as_the_camera_says(canvas, give, coarse):
    give(coarse)
    camera, seen = canvas.viewpoint.camera, canvas.stage.renderer.GetActiveCamera()
    assert seen.GetParallelProjection()
    np.testing.assert_allclose(seen.GetFocalPoint(), camera.centre)
    np.testing.assert_allclose(seen.GetViewUp(), camera.up)
    np.testing.assert_allclose(np.negative(seen.GetDirectionOfProjection()), camera.towards)
    assert seen.GetParallelScale() == pytest.approx(camera.pixel * canvas.height() / 2)


def test_meshing_leaves_the_camera_where_it_is(canvas, give, coarse):
    canvas.viewpoint.zoom(3, 100, 100)
    before = canvas.viewpoint.camera
    give(coarse)
    assert canvas.viewpoint.camera is before


def test_dividing_an_edge_leaves_the_camera_and_takes_away_the_place_that_was_shown(canvas, document):
    canvas.viewpoint.zoom(3, 100, 100)
    before, state = canvas.viewpoint.camera, document.scene.state
    canvas.show_place(document.scene.plate.rims[0])
    plate = document.scene.plate.with_division(0, 0, 7)
    document.change("Divide", attrs.evolve(state, plates=state.plates.with_plate(plate)))
    assert canvas.viewpoint.camera is before
    assert not is_visible(canvas, "place")


def test_a_click_picks_an_element_and_shift_extends(canvas, qtbot, give, coarse):
    give(coarse)
    for modifiers, extends in ((NONE, False), (SHIFT, True)):
        with qtbot.waitSignal(canvas.picked) as clicked:
            QTest.mouseClick(canvas, LEFT, modifiers, on_screen(canvas, middle_of(coarse, 5)))
        assert clicked.args == [5, extends]


def test_a_click_beside_the_plate_misses(canvas, qtbot, give, coarse):
    give(coarse)
    with qtbot.waitSignal(canvas.missed), qtbot.assertNotEmitted(canvas.picked):
        QTest.mouseClick(canvas, LEFT, NONE, QPoint(3, 3))


def test_a_left_drag_turns_the_plate_and_picks_nothing(canvas, qtbot, give, coarse):
    give(coarse)
    before = canvas.viewpoint.camera
    with qtbot.assertNotEmitted(canvas.picked), qtbot.assertNotEmitted(canvas.missed):
        drag(canvas, QPoint(300, 200), QPoint(360, 230))
    assert before.towards @ canvas.viewpoint.camera.towards < 0.99


@pytest.mark.parametrize(("button", "modifiers"), [(MIDDLE, NONE), (LEFT, SHIFT)], ids=["middle", "shift"])
def test_a_drag_moves_the_plate_with_the_cursor(canvas, give, coarse, button, modifiers):
    give(coarse)
    before = canvas.viewpoint.camera
    drag(canvas, QPoint(300, 200), QPoint(340, 190), button, modifiers)
    away = canvas.viewpoint.camera.pixels(coarse.points[:1]) - before.pixels(coarse.points[:1])
    np.testing.assert_allclose(away, [[40, 10]], atol=1e-6)


def test_the_wheel_enlarges_at_the_cursor(canvas, give, coarse):
    give(coarse)
    place = on_screen(canvas, coarse.points[0])
    pixel = canvas.viewpoint.camera.pixel
    wheel(canvas, place, 2)
    assert canvas.viewpoint.camera.pixel < pixel
    assert on_screen(canvas, coarse.points[0]) == place


def test_keys_move_turn_and_enlarge(canvas, give, coarse):
    give(coarse)
    cameras = [canvas.viewpoint.camera]
    for key, modifiers in ((Qt.Key.Key_Right, NONE), (Qt.Key.Key_Right, SHIFT), (Qt.Key.Key_Plus, NONE)):
        QTest.keyClick(canvas, key, modifiers)
        cameras.append(canvas.viewpoint.camera)
    assert cameras[1].pixels(coarse.points[:1])[0, 0] == pytest.approx(cameras[0].pixels(coarse.points[:1])[0, 0] + 40)
    assert cameras[2].towards @ cameras[1].towards < 0.99
    assert cameras[3].pixel < cameras[2].pixel


def test_hovering_names_the_element(canvas, qtbot, give, coarse):
    give(coarse)
    with qtbot.waitSignal(canvas.hovered) as entered:
        move(canvas, on_screen(canvas, middle_of(coarse, 7)))
    assert entered.args == [7]
    assert canvas.overlay.tip.startswith("element 8 · quad · stretch ")
    with qtbot.waitSignal(canvas.hovered) as left:
        move(canvas, QPoint(3, 3))
    assert left.args == [-1]
    assert canvas.overlay.tip == ""


@pytest.mark.usefixtures("smooth_at_rest")
def test_hovering_does_not_paint_the_plate_again(canvas, qtbot, give, coarse):
    give(coarse)
    qtbot.waitUntil(lambda: canvas.is_smooth, timeout=5000)
    qtbot.waitSignal(canvas.painted, timeout=1000, raising=False).wait()
    with qtbot.assertNotEmitted(canvas.painted, wait=200):
        move(canvas, on_screen(canvas, middle_of(coarse, 7)))


def test_elements_out_of_the_picture_are_brought_into_it(canvas, give, coarse):
    give(coarse)
    canvas.zoom_to([0])
    assert (on_screen(canvas, middle_of(coarse, 0)) - QPoint(300, 200)).manhattanLength() < 20
    far = int(np.linalg.norm(coarse.points[coarse.topology.quads].mean(axis=1) - coarse.points[0], axis=1).argmax())
    far = int(np.flatnonzero(~coarse.topology.is_triangle)[far])
    pixel = canvas.viewpoint.camera.pixel
    canvas.reveal([far])
    assert canvas.rect().contains(on_screen(canvas, middle_of(coarse, far)))
    assert canvas.viewpoint.camera.pixel == pytest.approx(pixel)


def test_elements_in_the_picture_leave_the_camera(canvas, give, coarse):
    give(coarse)
    before = canvas.viewpoint.camera
    canvas.reveal([3])
    assert canvas.viewpoint.camera is before


def test_resizing_keeps_what_is_in_the_middle(canvas, qtbot, give, coarse):
    give(coarse)
    canvas.viewpoint.zoom(2, 250, 150)
    before = canvas.viewpoint.camera
    with qtbot.waitSignal(canvas.viewpoint.changed):
        canvas.resize(500, 380)
    assert canvas.viewpoint.camera is before


def test_a_fitted_plate_stays_fitted(canvas, qtbot, give, coarse):
    give(coarse)
    before = canvas.viewpoint.camera
    with qtbot.waitSignal(canvas.viewpoint.changed):
        canvas.resize(300, 200)
    assert canvas.viewpoint.camera.pixel > before.pixel


def test_fit_and_standard_views_show_the_whole_plate(canvas, give, coarse):
    give(coarse)
    for name in ("front", "isometric", "plan"):
        canvas.viewpoint.zoom(20, 0, 0)
        canvas.look(name)
        across = np.abs(canvas.viewpoint.camera.pixels(coarse.points)).max(axis=0)
        assert (across <= [300 - 47, 200 - 47]).all()


def test_a_view_that_starts_late_shows_what_it_was_told(qtbot, give, coarse):
    scene = give(coarse)
    canvas = Canvas()
    qtbot.addWidget(canvas)
    canvas.set_palette(DARK)
    canvas.show_scene(scene)
    canvas.look("isometric")
    canvas.start()
    assert shown(canvas, "elements").n_cells == len(coarse.topology.elements)
    canvas.stop()


def test_nothing_is_left_over_and_nothing_asked_after_closing(qtbot, give, coarse):
    scene = give(coarse)
    before = {id(widget) for widget in QApplication.allWidgets()}
    canvas = Canvas()
    canvas.show()
    qtbot.waitExposed(canvas)
    canvas.start()
    canvas.show_scene(scene)
    with qtbot.waitSignal(canvas.painted):
        canvas.fit()
    timers = canvas.findChildren(QTimer)
    canvas.close()
    canvas.show_scene(scene)
    canvas.fit()
    canvas.set_palette(DARK)
    assert not any(timer.isActive() for timer in timers)
    canvas.deleteLater()
    del canvas, timers
    gc.collect()
    QApplication.sendPostedEvents(None, 52)  # deferred deletions
    QApplication.processEvents()
    assert {id(widget) for widget in QApplication.allWidgets()} <= before


def test_failing_outlines_are_drawn_only_where_elements_are_large_enough(canvas, give, folded):
    give(folded, "scaled_jacobian")
    quality = canvas.stage.scene.quality
    outlined = {*lines(canvas, "failing").ravel().tolist(), *lines(canvas, "worst").ravel().tolist()}
    failing = quality.failing & quality.valid
    nodes = folded.topology.elements[failing]
    assert outlined == set(nodes[nodes >= 0].tolist())
    for _ in range(40):
        wheel(canvas, QPoint(300, 200), -1)
    assert not is_visible(canvas, "failing")


def test_what_the_contour_gives_is_hatched_where_there_is_room(canvas, document, give, coarse):
    give(coarse)
    document.look(metric=metric("longest_edge"))
    assert document.scene.given.any()
    assert shown(canvas, "hatching").n_cells > 0
    canvas.viewpoint.zoom(1e-3, 0, 0)
    document.look(bands={"longest_edge": (-np.inf, 60.0)})
    assert shown(canvas, "hatching").n_cells == 0
    document.look(metric=metric("stretch"))
    canvas.fit()
    assert shown(canvas, "hatching").n_cells == 0
