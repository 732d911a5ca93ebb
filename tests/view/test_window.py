"""The window as its user meets it, by mouse and keyboard alone; what is shown is what is checked."""

import gc
import sys
import threading
from pathlib import Path

import numpy as np
import pytest
from PySide6.QtCore import QEvent, QMimeData, QPoint, QPointF, QSettings, Qt, QUrl
from PySide6.QtGui import QDropEvent, QGuiApplication, QImage
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QApplication, QFileDialog, QLabel, QMessageBox

from hullquad.formats import read_mesh, write_mesh
from hullquad.metrics import METRICS, metric
from hullquad.optimization.paper import unmoved
from hullquad.optimization.settings import PaperSettings
from hullquad.triangulation.contour import attempts
from hullquad.triangulation.edges import edge_counts
from hullquad.triangulation.remedies import Remedy
from hullquad_app.canvas.picker import corners
from hullquad_app.colours import Theme, element_colours
from hullquad_app.faults import Faults
from hullquad_app.level_colours import level_colours
from hullquad_app.limits import limit_words
from hullquad_app.panels.figures import valued
from hullquad_app.scene import State
from hullquad_app.search import Search
from hullquad_app.session import Session
from hullquad_app.settings import Settings
from hullquad_app.theme_menu import ThemeMenu
from hullquad_app.track import Track
from hullquad_app.window import MainWindow

PROJECT = Path(__file__).parents[2]
KEY, LEFT = Qt.Key, Qt.MouseButton.LeftButton
CONTROL, SHIFT, NONE = Qt.KeyboardModifier.ControlModifier, Qt.KeyboardModifier.ShiftModifier, Qt.KeyboardModifier(0)


def settings_in(folder):
    return Settings(QSettings(str(folder / "settings.ini"), QSettings.Format.IniFormat))


def started(folder):
    """The true window on a screen that nobody sees; it still loads what meshing needs."""
    window = MainWindow(Session(settings_in(folder)))
    window.resize(1440, 900)
    window.show()
    window.activateWindow()
    assert QTest.qWaitForWindowActive(window)
    window.start()
    return window


def closed(window):
    """Close a window, which leaves no thread behind."""
    window.session.stop_and_wait()
    window.session.document.edits.setClean()
    window.close()
    assert not window.isVisible()
    assert [thread.name for thread in threading.enumerate() if thread.name.startswith("hullquad")] == []
    window.deleteLater()
    QApplication.sendPostedEvents(None, QEvent.Type.DeferredDelete)


@pytest.fixture
def own_window(qapp, tmp_path):
    """A window that the test may close; it leaves no widget behind."""
    widgets = set(QApplication.topLevelWidgets())
    window = started(tmp_path)
    yield window
    closed(window)
    gc.collect()
    assert set(QApplication.topLevelWidgets()) <= widgets


@pytest.fixture(scope="module")
def kept_window(qapp, tmp_path_factory):
    """A window for all tests that do not close it."""
    window = started(tmp_path_factory.mktemp("settings"))
    while window.session.workshop.jobs.preparing.is_running:
        QTest.qWait(20)
    yield window
    closed(window)


@pytest.fixture
def window(kept_window):
    """The kept window as it is at first: empty and light."""
    session = kept_window.session
    session.optimizer.finish()
    session.document.open(State())
    session.document.look(bands={}, rules=None)
    session.choose_metric("stretch")
    session.set_search(Search())
    kept_window.docks.search.show_settings(PaperSettings(), None, Search())
    kept_window.apply_theme(Theme.LIGHT)
    kept_window.messages.hide()
    kept_window.activateWindow()
    assert QTest.qWaitForWindowActive(kept_window)
    kept_window.setFocus()
    return kept_window


def scene(window):
    return window.session.document.scene


def press(window, key, modifiers=NONE):
    QTest.keyClick(window, key, modifiers)


def open_sample(window, qtbot, name):
    """Double-click a sample on the start page."""
    gallery = window.welcome.gallery
    (item,) = [gallery.item(row) for row in range(gallery.count()) if gallery.item(row).toolTip() == f"{name}.json"]
    gallery.scrollToItem(item)
    place = gallery.visualItemRect(item).center()
    QTest.mouseClick(gallery.viewport(), LEFT, pos=place)
    QTest.mouseDClick(gallery.viewport(), LEFT, pos=place)
    qtbot.waitUntil(lambda: scene(window).state.keys != (), timeout=20_000)


def mesh(window, qtbot):
    press(window, KEY.Key_M)
    qtbot.waitUntil(lambda: scene(window).mesh is not None, timeout=20_000)


def wait_for_end(window, qtbot):
    qtbot.waitUntil(lambda: not scene(window).running, timeout=60_000)


def test_the_view_draws_the_nodes_of_the_size_that_is_chosen(window, qtbot):
    open_sample(window, qtbot, "hopper_block")
    key = scene(window).view.key or scene(window).plate.id
    panel = window.docks.meshing

    def drawn():
        return window.canvas.stage.layers["nodes"].data.n_points

    for row, size in ((2, "fine"), (1, "coarse")):
        panel.sizes.setCurrentIndex(row)
        panel.sizes.activated.emit(row)
        count = len(attempts(scene(window).state.plates, size)[key].points)
        qtbot.waitUntil(lambda count=count: drawn() == count, timeout=20_000)


def test_nodes_that_an_edit_of_another_plate_divides_are_drawn_anew(window, qtbot):
    open_sample(window, qtbot, "hopper_block")
    session, drawn = window.session, window.canvas.stage.layers["nodes"].data
    session.choose_plate("G1")
    state = scene(window).state
    before = len(attempts(state.plates, None)["G1"].points)
    qtbot.waitUntil(lambda: drawn.n_points == before, timeout=20_000)
    change = Remedy("F0", 0, 3, edge_counts(state.plates, "F0")[0][3], edge_counts(state.plates, "F0")[0][3] + 1)
    session.redivide(change)
    qtbot.waitUntil(lambda: scene(window).state is not state, timeout=20_000)
    after = len(attempts(scene(window).state.plates, None)["G1"].points)
    assert after != before
    qtbot.waitUntil(lambda: drawn.n_points == after, timeout=20_000)


@pytest.fixture
def meshed(window, qtbot):
    """The window with the hopper partition meshed."""
    open_sample(window, qtbot, "hopper_partition")
    mesh(window, qtbot)
    return window


@pytest.fixture
def own_meshed(own_window, coarse, qtbot):
    """The window that may be closed with a mesh of the hopper partition."""
    open_sample(own_window, qtbot, "hopper_partition")
    document = own_window.session.document
    track = Track((unmoved(coarse, metric("stretch")),))
    document.change("Mesh hopper_partition", document.scene.state.with_track("hopper_partition", track))
    return own_window


def colours(window):
    """Colours of the elements in the view."""
    return window.canvas.stage.layers["elements"].data.cell_data["colours"]


def points(window):
    """Nodes of the elements in the view."""
    return np.asarray(window.canvas.stage.layers["elements"].data.points)


def test_the_journey_from_a_sample_to_a_saved_mesh(window, qtbot, tmp_path, monkeypatch):
    assert window.welcome.isVisible()
    open_sample(window, qtbot, "hopper_partition")
    assert window.canvas.isVisible()
    assert "Unavoidable triangles" in window.docks.meshing.prospect.sentence.text()
    mesh(window, qtbot)
    quads = len(scene(window).mesh.topology.quads)
    assert any(f"{quads} quads · 0 triangles" in label.text() for label in window.status.findChildren(QLabel))
    np.testing.assert_array_equal(colours(window), element_colours(scene(window).quality))

    first = scene(window).mesh
    for number in (1, 2, 3):
        press(window, KEY.Key_S)
        wait_for_end(window, qtbot)
        assert scene(window).iterate.number == number
    assert window.session.document.edits.undoText().startswith("Step stretch: ")
    np.testing.assert_allclose(points(window), scene(window).mesh.points, rtol=1e-6)

    press(window, KEY.Key_R)
    qtbot.waitUntil(lambda: scene(window).running or scene(window).iterate.number > 3, timeout=20_000)
    press(window, KEY.Key_Space)
    wait_for_end(window, qtbot)
    paused = scene(window).track.last.number
    assert paused >= 3

    press(window, KEY.Key_Left, CONTROL)
    assert scene(window).position == len(scene(window).track.iterates) - 2
    np.testing.assert_allclose(points(window), scene(window).mesh.points, rtol=1e-6)
    for _ in range(2):
        press(window, KEY.Key_Left, CONTROL)
    start = scene(window).iterate.number
    press(window, KEY.Key_R)
    wait_for_end(window, qtbot)
    assert scene(window).track.iterates[start].number == start
    assert scene(window).iterate.objective > scene(window).track.first.objective

    out = tmp_path / "better.vtu"
    monkeypatch.setattr(QFileDialog, "getSaveFileName", lambda *_: (str(out), ""))
    shown = scene(window).mesh
    press(window, KEY.Key_S, CONTROL)
    qtbot.waitUntil(out.exists, timeout=20_000)
    qtbot.waitUntil(lambda: not window.isWindowModified(), timeout=20_000)
    assert read_mesh(out).points.tobytes() == shown.points.tobytes()

    while window.session.document.edits.canUndo():
        press(window, KEY.Key_Z, CONTROL)
    assert scene(window).mesh is None
    press(window, KEY.Key_Y, CONTROL)
    assert scene(window).mesh is first

    monkeypatch.setattr(QMessageBox, "question", lambda *_: QMessageBox.StandardButton.Discard)
    monkeypatch.setattr(QFileDialog, "getOpenFileName", lambda *_: (str(out), ""))
    press(window, KEY.Key_O, CONTROL)
    qtbot.waitUntil(lambda: scene(window).state.path == out, timeout=20_000)
    np.testing.assert_allclose(points(window), shown.points, rtol=1e-6)


def test_the_journey_from_an_odd_contour_to_quads_alone(window, qtbot, tmp_path, monkeypatch):
    open_sample(window, qtbot, "bracket_toe")
    prospect = window.docks.meshing.prospect
    qtbot.waitUntil(prospect.remedy.isVisible)
    before = scene(window).state
    assert "one node more or fewer on an edge makes it none" in prospect.sentence.text()
    QTest.mouseClick(prospect.show_edge, LEFT)
    QTest.mouseClick(prospect.remedy, LEFT)
    qtbot.waitUntil(lambda: scene(window).state is not before)
    edited = scene(window).state
    qtbot.waitUntil(lambda: "Unavoidable triangles: 0" in prospect.sentence.text())
    mesh(window, qtbot)
    assert len(scene(window).mesh.topology.triangles) == 0

    press(window, KEY.Key_Z, CONTROL)
    assert scene(window).state is edited
    press(window, KEY.Key_Z, CONTROL)
    assert scene(window).state is before
    press(window, KEY.Key_Y, CONTROL)

    out = tmp_path / "toe.json"
    monkeypatch.setattr(QFileDialog, "getSaveFileName", lambda *_: (str(out), ""))
    assert window.isWindowModified()
    window.actions_by_name["choose_plates_output"].trigger()
    qtbot.waitUntil(lambda: not window.isWindowModified(), timeout=20_000)
    monkeypatch.setattr(QFileDialog, "getOpenFileName", lambda *_: (str(out), ""))
    press(window, KEY.Key_O, CONTROL)
    qtbot.waitUntil(lambda: scene(window).state.path == out, timeout=20_000)
    assert scene(window).plate.divisions == edited.plates.plates[0].divisions


def test_the_making_of_a_mesh_is_scrubbed_and_stepped_by_every_metric(meshed, qtbot):
    making, finished = scene(meshed).track.making, scene(meshed).mesh
    assert not len(making[0].mesh.topology.quads)
    for row in METRICS:
        meshed.session.choose_metric(row.key)
        meshed.history.slider.setValue(-len(making))
        assert scene(meshed).mesh is making[0].mesh
        np.testing.assert_allclose(points(meshed), making[0].mesh.points, rtol=1e-6)
        np.testing.assert_array_equal(colours(meshed), element_colours(scene(meshed).quality))
    assert meshed.history.stage.text() == "triangulated"
    assert "making of the mesh, 1 of" in meshed.status.course.text()
    for row in range(1, len(making)):
        press(meshed, KEY.Key_S)
        assert scene(meshed).mesh is making[row].mesh
    press(meshed, KEY.Key_S)
    assert scene(meshed).mesh is finished


def test_dragging_the_limit_colours_and_counts_anew(meshed, qtbot):
    before = scene(meshed).quality.failing_count
    chart = meshed.docks.quality.chart
    at = {limit: chart.point_at(limit).toPoint() for limit in (0.25, 0.8)}
    QTest.mousePress(chart, LEFT, pos=at[0.25])
    QTest.mouseMove(chart, at[0.8])
    QTest.mouseRelease(chart, LEFT, pos=at[0.8])
    assert scene(meshed).quality.limits[0] == pytest.approx(0.8, abs=0.01)
    assert scene(meshed).quality.failing_count > before
    np.testing.assert_array_equal(colours(meshed), element_colours(scene(meshed).quality))
    assert meshed.choices.limits.boxes[0].value() == pytest.approx(scene(meshed).quality.limits[0], abs=0.005)
    assert meshed.session.settings.bands == {"stretch": scene(meshed).band}


def test_a_click_in_view_or_table_selects_in_both(meshed, qtbot):
    table = meshed.docks.worst.table
    qtbot.waitUntil(lambda: table.model().rowCount() > 0, timeout=5000)
    QTest.mouseClick(table.viewport(), LEFT, pos=table.visualRect(table.model().index(2, 0)).center())
    (row,) = scene(meshed).view.selection
    assert row == scene(meshed).quality.worst_first[2]
    press(meshed, KEY.Key_N)
    assert scene(meshed).view.selection == {scene(meshed).quality.worst_first[3]}
    press(meshed, KEY.Key_Escape)
    assert scene(meshed).view.selection == frozenset()


@pytest.mark.parametrize("number", range(9))
def test_number_keys_choose_the_metric(meshed, number):
    press(meshed, Qt.Key(KEY.Key_1 + number))
    assert scene(meshed).view.metric is METRICS[number]
    assert meshed.choices.metrics.currentText() == METRICS[number].title
    np.testing.assert_array_equal(colours(meshed), element_colours(scene(meshed).quality))


def test_letters_are_keys_again_after_a_number_was_typed(meshed, qtbot):
    box = meshed.choices.limits.boxes[0]
    box.setFocus()
    box.selectAll()
    QTest.keyClicks(box, "0.7")
    press(box, KEY.Key_Return)
    assert scene(meshed).quality.limits == (0.7,)
    press(QApplication.focusWidget(), KEY.Key_S)
    qtbot.waitUntil(lambda: scene(meshed).iterate.number == 1, timeout=20_000)


def test_reset_goes_back_to_the_mesh_as_it_was_made(meshed, qtbot):
    made = scene(meshed).mesh
    for _ in range(2):
        press(meshed, KEY.Key_S)
        wait_for_end(meshed, qtbot)
    press(meshed, KEY.Key_R, CONTROL)
    assert scene(meshed).mesh is made
    assert len(scene(meshed).track.iterates) == 1
    press(meshed, KEY.Key_Z, CONTROL)
    assert scene(meshed).iterate.number == 2


def test_dark_and_light_change_every_part_and_are_remembered(meshed):
    light = meshed.grab().toImage().pixelColor(5, 5)
    press(meshed, KEY.Key_D)
    assert meshed.session.settings.theme == "dark"
    assert meshed.grab().toImage().pixelColor(5, 5).lightness() < light.lightness()
    press(meshed, KEY.Key_D)
    assert meshed.session.settings.theme == "light"


def test_the_theme_can_be_left_to_the_system_again(window):
    press(window, KEY.Key_D)
    (themes,) = window.findChildren(ThemeMenu)
    themes.actions()[0].trigger()
    assert window.session.settings.theme == "system"


def test_faults_are_told_in_one_dialog_that_lets_the_user_go_on(window, qtbot):
    faults = Faults(window)
    try:
        for text in ("odd", "odd", "odder"):
            sys.excepthook(ValueError, ValueError(text), None)
        (dialog,) = [one for one in window.findChildren(QMessageBox) if one.isVisible()]
        assert {button.text().rstrip(".…") for button in dialog.buttons()} >= {"Copy details", "Continue"}
        dialog.defaultButton().click()
        assert window.isEnabled()
        assert not dialog.isVisible()
    finally:
        faults.release()


def test_the_plates_of_a_block_are_listed_meshed_and_chosen(window, qtbot):
    open_sample(window, qtbot, "hopper_block")
    assert window.choices.plates.count() == 14
    press(window, KEY.Key_M, SHIFT)
    qtbot.waitUntil(lambda: len(scene(window).state.tracks) == 13, timeout=60_000)
    qtbot.waitUntil(window.messages.isVisible, timeout=5000)
    assert "not yet" in window.messages.sentence.text()
    window.choices.plates.setFocus()
    press(window.choices.plates, KEY.Key_Down)
    assert scene(window).view.key == "B2"


def test_a_refused_document_is_told_and_what_was_open_stays(meshed, qtbot):
    before = scene(meshed)
    drop(meshed, "tests/data/bad-plates/bowtie.json")
    qtbot.waitUntil(meshed.messages.isVisible, timeout=20_000)
    assert "cross" in meshed.messages.sentence.text()
    assert meshed.messages.details.toPlainText() == "E_SELF_INTERSECT at /plates/0/outer"
    assert scene(meshed).mesh is before.mesh


def drop(window, file):
    """Drop a file of the project on the window."""
    files = QMimeData()
    files.setUrls([QUrl.fromLocalFile(str(PROJECT / file))])
    window.session.document.edits.setClean()
    window.dropEvent(QDropEvent(QPointF(9, 9), Qt.DropAction.CopyAction, files, LEFT, NONE))


def test_a_picture_of_what_is_shown_is_saved_and_copied(meshed, tmp_path, monkeypatch):
    out = tmp_path / "plate.png"
    monkeypatch.setattr(QFileDialog, "getSaveFileName", lambda *_: (str(out), ""))
    meshed.filing.picture_menu.actions()[0].trigger()
    press(meshed, KEY.Key_S, CONTROL | SHIFT)
    image = QImage(str(out))
    assert (image.width(), image.height()) == (1600, 1000)
    press(meshed, KEY.Key_C, CONTROL | SHIFT)
    assert QGuiApplication.clipboard().image().width() == 1600


@pytest.mark.parametrize("answer", ["Cancel", "Discard", "Save"])
def test_closing_asks_before_something_is_lost(own_meshed, qtbot, tmp_path, monkeypatch, answer):
    out = tmp_path / "kept.vtu"
    asked = []
    buttons = QMessageBox.StandardButton
    monkeypatch.setattr(QMessageBox, "question", lambda *_: asked.append(1) or getattr(buttons, answer))
    monkeypatch.setattr(QFileDialog, "getSaveFileName", lambda *_: (str(out), ""))
    assert own_meshed.isWindowModified()
    own_meshed.close()
    assert asked
    if answer == "Cancel":
        assert own_meshed.isVisible()
    else:
        qtbot.waitUntil(lambda: not own_meshed.isVisible(), timeout=20_000)
    assert out.exists() == (answer == "Save")


def test_closing_while_a_run_goes_on_ends_cleanly(own_meshed, qtbot, monkeypatch):
    monkeypatch.setattr(QMessageBox, "question", lambda *_: QMessageBox.StandardButton.Discard)
    press(own_meshed, KEY.Key_R)
    own_meshed.close()
    qtbot.waitUntil(lambda: not own_meshed.isVisible(), timeout=20_000)


def test_layout_and_size_come_back(own_window, tmp_path):
    own_window.docks.quality.parent().hide()
    own_window.resize(1234, 777)
    own_window.close()
    assert own_window.height() == 777
    again = MainWindow(Session(settings_in(tmp_path)))
    assert again.size() == own_window.size()
    assert not again.docks.quality.parent().isVisibleTo(again)
    closed(again)


def test_the_window_can_be_as_small_as_a_laptop(window):
    assert window.minimumSizeHint().width() <= 1100
    assert window.minimumSizeHint().height() <= 700


def test_every_control_has_a_name_and_every_action_a_tip(window):
    for action in window.actions_by_name:
        assert action.toolTip()
        if not action.shortcut().isEmpty():
            assert "(" in action.toolTip()
    choices = window.choices
    boxes = (choices.plates, choices.rules, choices.metrics, *choices.limits.boxes, choices.limits.reset)
    for box in (*boxes, window.welcome.gallery, window.docks.rules.table, window.docks.element.table):
        assert box.accessibleName()


def test_no_two_actions_share_a_key(window):
    keys = [action.shortcut().toString() for action in window.actions_by_name if not action.shortcut().isEmpty()]
    assert len(keys) == len(set(keys))


def test_the_view_turns_to_standard_views_and_back(meshed):
    before = meshed.canvas.viewpoint.camera
    press(meshed, KEY.Key_F9)
    assert abs(meshed.canvas.viewpoint.camera.towards @ before.towards) < 0.9
    press(meshed, KEY.Key_F5)
    np.testing.assert_allclose(meshed.canvas.viewpoint.camera.towards, before.towards, atol=1e-9)


@pytest.fixture
def answers(monkeypatch, tmp_path):
    """What dialogs are answered: the file, and the buttons in turn; and the texts of the questions."""
    given, asked = {"file": tmp_path / "out.vtu", "buttons": []}, []
    monkeypatch.setattr(QFileDialog, "getSaveFileName", lambda *_: (str(given["file"]), ""))
    buttons = QMessageBox.StandardButton

    def question(_parent, _title, text, *_):
        asked.append(text)
        return getattr(buttons, given["buttons"].pop(0))

    monkeypatch.setattr(QMessageBox, "question", question)
    return given, asked


def test_a_closing_save_that_failed_is_forgotten(meshed, qtbot, answers, tmp_path):
    given, _ = answers
    given.update(file=tmp_path / "nowhere" / "out.vtu", buttons=["Save"])
    gone = []
    meshed.filing.leave(lambda: gone.append(1))
    qtbot.waitUntil(meshed.messages.isVisible, timeout=5000)
    given["file"] = tmp_path / "out.vtu"
    with qtbot.waitSignal(meshed.session.saved):
        press(meshed, KEY.Key_S, CONTROL)
    assert gone == []


def test_what_is_done_while_the_closing_save_is_written_is_asked_for(meshed, qtbot, answers):
    given, asked = answers
    given["buttons"] = ["Save", "Cancel"]
    gone = []
    meshed.filing.leave(lambda: gone.append(1))
    meshed.session.step()
    qtbot.waitUntil(lambda: len(asked) == 2 or gone == [1], timeout=5000)
    assert (len(asked), gone) == (2, [])


def test_files_that_the_dialog_did_not_know_are_asked_for(meshed, answers, tmp_path):
    given, asked = answers
    given.update(file=tmp_path / "nosuf", buttons=["No"])
    (tmp_path / "nosuf.vtu").write_text("kept")
    assert not meshed.filing.choose_output()
    assert "nosuf.vtu" in asked[0]


def test_leaving_without_a_mesh_does_not_offer_to_save(meshed, answers):
    given, asked = answers
    meshed.session.document.edits.setClean()
    meshed.session.undo()
    given["buttons"] = ["Cancel"]
    meshed.filing.leave(lambda: None)
    assert "no mesh" in asked[0]


@pytest.fixture
def edited(window, qtbot):
    """The window with a plate whose contour was made even, meshed."""
    open_sample(window, qtbot, "bracket_toe")
    qtbot.waitUntil(window.docks.meshing.prospect.remedy.isVisible)
    before = scene(window).state
    QTest.mouseClick(window.docks.meshing.prospect.remedy, LEFT)
    qtbot.waitUntil(lambda: scene(window).state is not before)
    mesh(window, qtbot)
    return window


@pytest.mark.parametrize(
    ("given_answers", "questions", "goes"),
    [(["Cancel"], 1, False), (["Discard", "Discard"], 2, True), (["Discard", "Cancel"], 2, False)],
)
def test_leaving_asks_for_plates_and_then_for_meshes(edited, answers, given_answers, questions, goes):
    given, asked = answers
    given["buttons"] = list(given_answers)
    gone = []
    edited.filing.leave(lambda: gone.append(1))
    assert (len(asked), bool(gone)) == (questions, goes)
    assert "plates" in asked[0]


def test_leaving_saves_plates_and_then_meshes(edited, answers, qtbot, tmp_path):
    given, asked = answers
    given.update(file=tmp_path / "toe", buttons=["Save", "Save"])
    gone = []
    edited.filing.leave(lambda: gone.append(1))
    qtbot.waitUntil(lambda: gone == [1], timeout=5000)
    assert len(asked) == 2
    assert {path.name for path in tmp_path.glob("toe*")} == {"toe.json", "toe.vtu"}
    assert not edited.isWindowModified()


def test_what_was_said_during_a_run_stays_when_it_ends(meshed, qtbot):
    press(meshed, KEY.Key_S)
    meshed.session.message.emit("odd")
    wait_for_end(meshed, qtbot)
    assert meshed.messages.isVisible()


def test_every_metric_is_shown_alike_everywhere(meshed):
    box, figures = meshed.choices.metrics, meshed.docks.quality.figures
    meshed.session.choose_metric(METRICS[0].key)
    box.setFocus()
    for row in METRICS:
        quality = scene(meshed).quality
        assert (box.currentData(), quality.metric) == (row.key, row)
        np.testing.assert_array_equal(colours(meshed), element_colours(quality))
        assert [limit.value() for limit in meshed.choices.limits.boxes if limit.isVisible()] == list(quality.limits)
        assert limit_words(row, quality.band) in meshed.docks.quality.chart.accessibleDescription()
        assert figures.worst.number.text() == valued(quality.worst, row)
        assert figures.failing.number.text() == str(quality.failing_count)
        assert meshed.docks.worst.model.element(0) == quality.worst_first[0]
        press(box, KEY.Key_Down)


def test_both_limits_of_a_two_sided_metric_are_dragged(meshed):
    meshed.session.choose_metric("corner_angle")
    chart = meshed.docks.quality.chart
    for start, end in ((45, 60), (135, 120)):
        QTest.mousePress(chart, LEFT, pos=chart.point_at(start).toPoint())
        QTest.mouseMove(chart, chart.point_at(end).toPoint())
        QTest.mouseRelease(chart, LEFT, pos=chart.point_at(end).toPoint())
    assert scene(meshed).quality.limits == pytest.approx((60, 120), abs=2)
    assert [box.value() for box in meshed.choices.limits.boxes] == pytest.approx(scene(meshed).quality.limits)
    np.testing.assert_array_equal(colours(meshed), element_colours(scene(meshed).quality))
    QTest.mouseClick(meshed.choices.limits.reset, LEFT)
    assert scene(meshed).quality.limits == (45, 135)


def test_a_rule_set_is_chosen_and_a_rule_shows_its_elements(meshed):
    box, panel = meshed.choices.rules, meshed.docks.rules
    box.showPopup()
    box.hidePopup()
    box.setFocus()
    while scene(meshed).view.rules is None or scene(meshed).view.rules.key != "csr_fine":
        press(box, KEY.Key_Down)
    assessment = scene(meshed).assessment
    np.testing.assert_array_equal(colours(meshed), level_colours(assessment.levels, scene(meshed).quality.valid))
    assert panel.isVisible()
    assert panel.title.text() == assessment.rule_set.title
    row = next(row for row, finding in enumerate(assessment.findings) if len(finding.rows))
    panel.table.scrollTo(panel.model.index(row, 1))
    place = panel.table.visualRect(panel.model.index(row, 1)).center()
    QTest.mouseClick(panel.table.viewport(), LEFT, pos=place)
    assert scene(meshed).view.selection == set(assessment.findings[row].rows.tolist())
    box.setFocus()
    press(box, KEY.Key_Home)
    assert scene(meshed).view.rules is None
    np.testing.assert_array_equal(colours(meshed), element_colours(scene(meshed).quality))


def test_a_rule_set_is_followed_while_a_run_goes_on(meshed, qtbot):
    meshed.session.judging.judge_by("bv")
    before = scene(meshed).verdict
    press(meshed, KEY.Key_R)
    qtbot.waitUntil(lambda: scene(meshed).verdict is not before, timeout=20_000)
    wait_for_end(meshed, qtbot)
    assert scene(meshed).verdict.mesh is scene(meshed).mesh
    np.testing.assert_array_equal(
        colours(meshed), level_colours(scene(meshed).assessment.levels, scene(meshed).quality.valid)
    )


def test_an_element_is_inspected_by_mouse_and_key(meshed, qtbot):
    panel, canvas = meshed.docks.element, meshed.canvas
    values, by = scene(meshed).quality.values, scene(meshed).quality.metric
    worst = int(values.argmin() if by.higher_is_better else values.argmax())  # the key goes on from there
    x, y = canvas.viewpoint.camera.pixels(corners(scene(meshed).mesh, worst).mean(axis=0)[None])[0]
    place = QPoint(round(canvas.width() / 2 + x), round(canvas.height() / 2 - y))
    QTest.mouseClick(canvas, LEFT, pos=place)
    assert scene(meshed).view.selection == {worst}
    plain = canvas.overlay.grab().toImage()
    press(meshed, KEY.Key_I)
    qtbot.waitUntil(panel.isVisible, timeout=5000)
    assert panel.title.text() == f"Element {worst + 1}, quad"
    assert canvas.overlay.grab().toImage() != plain
    press(meshed, KEY.Key_N)
    assert panel.title.text() != f"Element {worst + 1}, quad"
    press(meshed, KEY.Key_I)
    qtbot.waitUntil(lambda: panel.visibleRegion().isEmpty(), timeout=5000)


def test_criteria_are_saved_and_loaded_from_the_menu(meshed, tmp_path, monkeypatch):
    file = tmp_path / "ours.json"
    monkeypatch.setattr(QFileDialog, "getSaveFileName", lambda *_: (str(tmp_path / "ours"), ""))
    monkeypatch.setattr(QFileDialog, "getOpenFileName", lambda *_: (str(file), ""))
    meshed.session.judging.set_limit(0, 0.7)
    meshed.actions_by_name["save_criteria"].trigger()
    meshed.actions_by_name["reset_limits"].trigger()
    assert scene(meshed).quality.limits == (0.25,)
    meshed.actions_by_name["load_criteria"].trigger()
    assert scene(meshed).quality.limits == (0.7,)
    file.write_text("{")
    meshed.actions_by_name["load_criteria"].trigger()
    assert meshed.messages.isVisible()
    assert "ours.json" in meshed.messages.details.toPlainText()


def test_rules_of_the_user_are_read_and_offered_again(meshed, tmp_path, monkeypatch):
    file = tmp_path / "ours.json"
    file.write_text(
        '{"format": "hullquad rules", "version": 1, "title": "Our yard", "edition": "", "source": "QA 12",'
        ' "rules": [{"measure": "aspect_ratio", "error": [null, 1.2], "text": "close to 1", "status": "read"}]}'
    )
    monkeypatch.setattr(QFileDialog, "getOpenFileName", lambda *_: (str(file), ""))
    meshed.choices.rules.complete()
    meshed.choices.rules.setFocus()
    press(meshed.choices.rules, KEY.Key_End)
    assert scene(meshed).view.rules.title == "Our yard"
    meshed.choices.rules.complete()
    assert meshed.choices.rules.currentText() == "ours"


def choose_optimizer(window, key):
    """Choose an optimiser by the keyboard; the panel comes up with a key of its own."""
    press(window, KEY.Key_O)
    box = window.docks.search.optimizer
    assert QApplication.focusWidget() is box
    press(box, KEY.Key_Home)
    while box.currentData() != key:
        press(box, KEY.Key_Down)


def is_in_front(panel):
    return not panel.visibleRegion().isEmpty()


def test_the_worst_element_is_raised_undone_and_redone(meshed, qtbot):
    made = scene(meshed)
    choose_optimizer(meshed, "worst")
    press(meshed, KEY.Key_O)
    qtbot.waitUntil(lambda: is_in_front(meshed.docks.objective), timeout=5000)
    press(meshed, KEY.Key_R)
    qtbot.waitUntil(lambda: scene(meshed).iterate.number > 0 and not scene(meshed).running, timeout=60_000)
    ended = scene(meshed)
    assert ended.quality.worst > made.quality.worst
    assert "worst first" in {iterate.stage for iterate in ended.track.iterates}
    qtbot.waitUntil(lambda: is_in_front(meshed.docks.outcome), timeout=5000)
    assert meshed.docks.outcome.now[2].text() == valued(ended.quality.worst, ended.quality.metric)
    row = next(row for row, iterate in enumerate(ended.track.iterates) if iterate.stage == "worst first")
    meshed.history.slider.setValue(row)
    assert meshed.history.stage.text() == "worst first"
    assert "worst first" in meshed.status.course.text()
    meshed.history.slider.setValue(ended.position)
    assert meshed.session.document.edits.undoText().startswith("Optimize worst stretch: ")
    press(meshed, KEY.Key_Z, CONTROL)
    assert scene(meshed).mesh is made.mesh
    press(meshed, KEY.Key_Y, CONTROL)
    assert scene(meshed).mesh is ended.mesh
    np.testing.assert_allclose(points(meshed), ended.mesh.points, rtol=1e-6)


def test_violations_are_chased_by_the_rules_that_are_chosen_in_the_panel(meshed, qtbot):
    choose_optimizer(meshed, "rules")
    press(meshed, KEY.Key_R)
    qtbot.waitUntil(meshed.messages.isVisible, timeout=5000)
    box = meshed.docks.search.options.rules
    box.complete()
    box.setFocus()
    while scene(meshed).view.rules is None or scene(meshed).view.rules.key != "csr_fine":
        press(box, KEY.Key_Down)
    assert meshed.choices.rules.currentData() == "csr_fine"
    before = len(np.flatnonzero(scene(meshed).assessment.levels))
    press(meshed, KEY.Key_R)
    qtbot.waitUntil(lambda: scene(meshed).iterate.number > 0 and not scene(meshed).running, timeout=60_000)
    assert len(np.flatnonzero(scene(meshed).assessment.levels)) <= before


def test_a_folded_mesh_is_opened_by_the_bar_above_the_view(meshed, qtbot, tmp_path):
    mesh = scene(meshed).mesh
    parameters = mesh.parameters.copy()
    parameters[np.flatnonzero(mesh.topology.is_free)[4]] += 1.2 * mesh.target_size
    write_mesh(mesh.with_parameters(parameters), tmp_path / "folded.vtu")
    meshed.session.document.edits.setClean()
    meshed.filing.open(tmp_path / "folded.vtu")
    qtbot.waitUntil(meshed.folds.isVisible, timeout=20_000)
    QTest.mouseClick(meshed.folds.button, LEFT)
    qtbot.waitUntil(lambda: scene(meshed).iterate.number > 0 and not scene(meshed).running, timeout=60_000)
    assert scene(meshed).quality.inverted_count == 0
    assert not meshed.folds.isVisible()
    press(meshed, KEY.Key_Z, CONTROL)
    assert scene(meshed).quality.inverted_count > 0
    assert meshed.folds.isVisible()
    press(meshed, KEY.Key_U)
    qtbot.waitUntil(lambda: scene(meshed).iterate.number > 0 and not scene(meshed).running, timeout=60_000)
    assert scene(meshed).quality.inverted_count == 0


def test_only_what_is_selected_in_the_view_is_optimised(meshed, qtbot):
    before = scene(meshed).mesh
    meshed.session.select({scene(meshed).quality.worst_first[0]})
    press(meshed, KEY.Key_O)
    local = meshed.docks.search.local
    local.only.setFocus()
    press(local.only, KEY.Key_Space)
    may_move = int(local.extent.text().split()[0])
    press(meshed, KEY.Key_R)
    qtbot.waitUntil(lambda: scene(meshed).iterate.number > 0 and not scene(meshed).running, timeout=60_000)
    assert 0 < (scene(meshed).mesh.points != before.points).any(axis=1).sum() <= may_move
