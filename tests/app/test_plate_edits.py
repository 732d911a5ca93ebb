"""Contours made even before meshing, as edits of the plates: undone, saved, asked for; and what becomes of meshes."""

from pathlib import Path

import pytest
from PySide6.QtCore import QSettings

from hullquad.formats import read_plates
from hullquad.triangulation.contour import contours
from hullquad_app.mesher import Mesher
from hullquad_app.session import Session
from hullquad_app.settings import Settings

PLATES = Path(__file__).parents[2] / "assets" / "plates"
TOE, BLOCK = PLATES / "bracket_toe.json", PLATES / "hopper_block.json"


@pytest.fixture
def session(qapp, tmp_path):
    session = Session(Settings(QSettings(str(tmp_path / "settings.ini"), QSettings.Format.IniFormat)))
    yield session
    session.stop_and_wait()


@pytest.fixture
def open_(session, qtbot):
    def act(path):
        with qtbot.waitSignal(session.opened, timeout=10_000):
            session.open(path)
        return session.document.scene

    return act


@pytest.fixture
def found(session, qtbot):
    """Divides the contours for a size."""

    def act(size=None):
        with qtbot.waitSignal(session.divided, timeout=10_000) as divided:
            session.divide(size)
        return divided.args[0]

    return act


@pytest.fixture
def after(session, qtbot):
    """Waits for what an act has changed."""

    def wait(act, *args, **options):
        before = session.document.edits.index()
        act(*args, **options)
        qtbot.waitUntil(lambda: session.document.edits.index() != before, timeout=20_000)
        return session.document.scene

    return wait


@pytest.fixture
def said(session):
    """Every message."""
    messages = []
    session.message.connect(messages.append)
    return messages


def triangles(scene):
    return len(scene.mesh.topology.triangles)


def test_an_odd_contour_is_made_even_meshed_without_triangles_and_brought_back(session, open_, found, after):
    before = open_(TOE).state
    change = found().remedies["bracket_toe"]
    scene = after(session.redivide, change)
    assert session.document.edits.undoText() == f"Divide edge {change.edge} of bracket_toe in {change.number}"
    assert found().odd == ()
    assert triangles(after(session.mesh)) == 0
    session.undo()
    assert session.document.scene.state is scene.state
    session.undo()
    assert session.document.scene.state is before
    assert found().odd == ("bracket_toe",)


def test_only_meshes_with_other_contours_go_and_come_back(session, open_, found, after, said):
    session.set_mesher(Mesher(name="paper"))
    open_(BLOCK)
    meshed = after(session.mesh, "fine", all_plates=True).state
    division = found("fine")
    change = division.remedies["F1"]
    said.clear()
    state = after(session.redivide, change, "fine").state
    old, new = contours(division.plates, "fine"), contours(state.plates, "fine")
    other = {key for key in new if old[key].points.tobytes() != new[key].points.tobytes()}
    assert {"F1", *change.neighbours} <= other < set(new)
    assert meshed.tracks.keys() - state.tracks.keys() == other
    assert all(state.tracks[key] is meshed.tracks[key] for key in state.tracks)
    assert all(key in said[0] for key in other)
    session.undo()
    assert session.document.scene.state is meshed


def test_all_contours_are_made_even_in_one_step(session, open_, found, after):
    open_(BLOCK)
    assert len(found("fine").odd) > 1
    after(session.redivide, None, "fine")
    assert session.document.edits.undoText() == "Make contours even"
    assert session.document.edits.count() == 1
    assert found("fine").odd == ()


def test_there_is_nothing_to_make_even_twice(session, open_, said, qtbot):
    before = open_(BLOCK).state
    said.clear()
    with qtbot.waitSignal(session.message):
        session.redivide(None)
    assert session.document.scene.state is before
    assert "No way was found" in said[0]


def test_edited_plates_are_saved_and_read_as_they_were(session, open_, found, after, qtbot, tmp_path):
    open_(TOE)
    edited = after(session.redivide, found().remedies["bracket_toe"]).state.plates
    with qtbot.waitSignal(session.saved):
        session.save_plates(tmp_path / "toe.json")
    again = read_plates(tmp_path / "toe.json")
    assert again.plates[0].divisions == edited.plates[0].divisions != ()
    assert again.input_hash == edited.input_hash
    assert contours(again)["bracket_toe"].points.tobytes() == contours(edited)["bracket_toe"].points.tobytes()


def test_plates_and_meshes_are_each_unsaved_until_they_are_written(session, open_, found, after, qtbot, tmp_path):
    open_(TOE)
    assert not session.has_unsaved_plates
    after(session.redivide, found().remedies["bracket_toe"])
    assert (session.has_unsaved_plates, session.has_unsaved_meshes) == (True, False)
    after(session.mesh)
    with qtbot.waitSignal(session.saved):
        session.save(tmp_path / "toe.vtu")
    assert (session.is_modified, session.has_unsaved_plates, session.has_unsaved_meshes) == (True, True, False)
    with qtbot.waitSignal(session.saved):
        session.save_plates(tmp_path / "toe.json")
    assert (session.is_modified, session.has_unsaved_plates) == (False, False)
    session.undo()
    session.undo()
    assert (session.is_modified, session.has_unsaved_plates) == (True, True)


def test_saved_plates_are_the_document_from_then_on(session, open_, found, after, qtbot, tmp_path):
    open_(TOE)
    assert (session.path, session.title) == (TOE, "bracket_toe")
    after(session.redivide, found().remedies["bracket_toe"])
    with qtbot.waitSignal(session.saved):
        session.save_plates(tmp_path / "toe.json")
    session.undo()
    assert (session.path, session.title) == (tmp_path / "toe.json", "toe")
    assert session.settings.recent[:2] == [tmp_path / "toe.json", TOE]


def test_contours_can_be_made_even_where_some_are_odd(session, open_, found, after):
    open_(TOE)
    assert not session.abilities.can_even  # nobody knows yet
    change = found().remedies["bracket_toe"]
    assert session.abilities.can_even
    after(session.redivide, change)
    found()
    assert not session.abilities.can_even


def test_a_mesh_of_edited_plates_names_the_file_they_are_saved_to(session, open_, found, after, qtbot, tmp_path):
    open_(TOE)
    after(session.redivide, found().remedies["bracket_toe"])
    mesh = after(session.mesh).mesh
    with qtbot.waitSignal(session.saved):
        session.save_plates(tmp_path / "toe.json")
    assert mesh.input_hash == read_plates(tmp_path / "toe.json").input_hash


def test_the_name_of_a_mesh_in_the_menu_says_what_came_of_it(session, open_, after):
    open_(TOE)
    quads = len(after(session.mesh).mesh.topology.quads)
    assert session.document.edits.undoText() == f"Mesh bracket_toe (best): 1 triangle, {quads} quads"


def test_the_chosen_mesher_is_remembered(session):
    session.set_mesher(Mesher(name="paper", grading=0.9))
    assert session.settings.mesher == Mesher(name="paper", grading=0.9)
