"""The panel that meshes: sizes, the prospect of triangles, what it asks for, progress."""

from pathlib import Path

import pytest
from PySide6.QtCore import Qt
from PySide6.QtWidgets import QComboBox, QDoubleSpinBox, QPushButton

from hullquad.formats import read_plates
from hullquad.triangulation.contour import attempts
from hullquad_app.abilities import Abilities
from hullquad_app.division import division
from hullquad_app.document import Document
from hullquad_app.mesher import Mesher
from hullquad_app.panels.meshing import MeshingPanel
from hullquad_app.scene import State

PLATES = Path(__file__).parents[2] / "assets" / "plates"
BLOCK = read_plates(PLATES / "hopper_block.json")
ALL = Abilities(can_mesh=True, can_mesh_all=True)


@pytest.fixture
def panel(qtbot):
    panel = MeshingPanel()
    qtbot.addWidget(panel)
    panel.show()
    return panel


@pytest.fixture
def asked(panel):
    """Sizes that the panel wants to know the contours of."""
    sizes = []
    panel.size_chosen.connect(sizes.append)
    return sizes


def show(panel, plates, key=None, size=None):
    """Show a plate, and its contours for a size."""
    document = Document()
    document.open(State(plates=plates))
    if key is not None:
        document.look(key=key)
    panel.show_scene(document.scene)
    panel.show_abilities(ALL)
    panel.show_division(division(plates, size))


def choose(panel, title, qtbot):
    """Choose a size by the beginning of its title."""
    row = next(i for i in range(panel.sizes.count()) if panel.sizes.itemText(i).startswith(title))
    panel.sizes.setCurrentIndex(row)
    panel.sizes.activated.emit(row)


def test_an_empty_window_can_mesh_nothing(panel):
    assert not panel.one.isEnabled()
    assert "Open a plate document" in panel.prospect.sentence.text()


def test_sizes_are_those_of_the_plate(panel):
    show(panel, BLOCK, "H1")
    sizes = BLOCK.plate("H1").sizes
    assert panel.sizes.itemText(1) == f"coarse: {sizes.coarse:g} mm"
    assert panel.sizes.itemText(3) == f"very fine: {sizes.very_fine:g} mm"


def test_unavoidable_triangles_are_told_before_meshing(panel):
    show(panel, BLOCK, "H1", 310.0)
    assert panel.prospect.sentence.text() == "Unavoidable triangles: …"  # those of another size are known
    show(panel, BLOCK, "H1")
    contour = attempts(BLOCK)["H1"]
    expected = f"Unavoidable triangles: {contour.edge_count % 2} ({contour.edge_count} contour edges)"
    assert panel.prospect.sentence.text() == expected


def test_contours_that_nobody_looks_for_any_more_are_not_waited_for(panel, qtbot):
    show(panel, BLOCK, "H1")
    choose(panel, "fine", qtbot)
    assert panel.prospect.sentence.text() == "Unavoidable triangles: …"
    panel.show_idle()
    assert panel.prospect.sentence.text().startswith("Unavoidable triangles: not looked for.")
    panel.ask()
    assert panel.prospect.sentence.text() == "Unavoidable triangles: …"


def test_a_curved_plate_is_refused_in_the_words_of_the_engine(panel):
    plates = read_plates(PLATES / "bilge_shell.json")
    show(panel, plates)
    assert "curved surfaces: not yet" in panel.prospect.sentence.text()


def test_a_chosen_size_is_asked_for(panel, asked, qtbot):
    show(panel, BLOCK)
    choose(panel, "fine", qtbot)
    choose(panel, "other", qtbot)
    panel.millimetres.selectAll()
    qtbot.keyClicks(panel.millimetres, "123.5")
    qtbot.keyClick(panel.millimetres, Qt.Key.Key_Return)
    assert asked == [None, "fine", BLOCK.plates[0].target_size, 123.5]
    with qtbot.waitSignal(panel.requested) as requested:
        qtbot.mouseClick(panel.one, Qt.MouseButton.LeftButton)
    assert requested.args == [123.5, False]


def test_a_chosen_size_stays_for_the_next_plate(panel, qtbot):
    show(panel, BLOCK, "H1")
    choose(panel, "fine", qtbot)
    show(panel, BLOCK, "B1")
    assert panel.size_wanted == "fine"


def test_all_plates_can_be_meshed_where_there_are_several(panel, qtbot):
    show(panel, read_plates(PLATES / "hopper_partition.json"))
    assert not panel.all_plates.isVisible()
    show(panel, BLOCK)
    assert "14" in panel.all_plates.text()
    with qtbot.waitSignal(panel.requested) as requested:
        qtbot.mouseClick(panel.all_plates, Qt.MouseButton.LeftButton)
    assert requested.args == [None, True]


def test_progress_can_be_seen_and_cancelled(panel, qtbot):
    assert not panel.progress.isVisible()
    panel.show_progress("Meshing H1", 3, 14)
    panel.show_abilities(Abilities(can_cancel=True))
    assert (panel.task.text(), panel.progress.value(), panel.progress.maximum()) == ("Meshing H1", 3, 14)
    with qtbot.waitSignal(panel.cancelled):
        qtbot.mouseClick(panel.cancel, Qt.MouseButton.LeftButton)
    panel.show_idle()
    assert not panel.cancel.isVisible()


def test_every_control_has_a_name_and_fits_the_column(panel):
    show(panel, BLOCK)
    for kind in (QComboBox, QDoubleSpinBox, QPushButton):
        assert all(control.accessibleName() for control in panel.findChildren(kind))
    assert panel.minimumSizeHint().width() < 60 * panel.fontMetrics().averageCharWidth()


@pytest.fixture
def odd(panel):
    """The panel with a plate of an odd contour, and its remedy."""
    plates = read_plates(PLATES / "bracket_toe.json")
    show(panel, plates)
    return division(plates, None).remedies["bracket_toe"]


def test_the_cause_of_a_triangle_is_told_with_what_helps(panel, odd):
    told = panel.prospect.sentence.text()
    assert "Odd number of contour edges: " in told
    assert "one node more or fewer on an edge makes it none" in told
    assert panel.prospect.remedy.isVisible()
    assert panel.prospect.remedy.text() == f"Divide edge {odd.edge} of bracket_toe in {odd.number}"
    assert not panel.prospect.evening.isVisible()


def test_a_remedy_is_asked_for_with_the_size(panel, odd, qtbot):
    with qtbot.waitSignal(panel.remedy_wanted) as wanted:
        qtbot.mouseClick(panel.prospect.remedy, Qt.MouseButton.LeftButton)
    assert wanted.args == [odd, None]


def test_the_edge_of_a_remedy_can_be_shown(panel, odd, qtbot):
    with qtbot.waitSignal(panel.prospect.place_wanted) as wanted:
        qtbot.mouseClick(panel.prospect.show_edge, Qt.MouseButton.LeftButton)
    assert wanted.args[0].numbers["where"].endswith(f"/{odd.edge}")


def test_all_contours_can_be_made_even_where_several_are_odd(panel, qtbot):
    show(panel, BLOCK, "F1", "fine")
    choose(panel, "fine", qtbot)
    count = len(division(BLOCK, "fine").odd)
    assert count > 1
    assert panel.prospect.evening.text() == f"Make all contours even ({count} are odd)"
    with qtbot.waitSignal(panel.remedy_wanted) as wanted:
        qtbot.mouseClick(panel.prospect.evening, Qt.MouseButton.LeftButton)
    assert wanted.args == [None, "fine"]


def test_neighbours_that_have_the_edge_too_are_named(panel, qtbot):
    found = division(BLOCK, "fine")
    key, change = next((key, change) for key, change in found.remedies.items() if change.neighbours)
    show(panel, BLOCK, key, "fine")
    choose(panel, "fine", qtbot)
    assert f"The edge is divided in {', '.join(change.neighbours)} too." in panel.prospect.sentence.text()


def test_an_even_contour_needs_nothing(panel):
    show(panel, BLOCK, "H1")
    assert not panel.prospect.remedy.isVisible()
    assert not panel.prospect.notices.isVisible()


def test_nothing_is_edited_while_something_is_meshed(panel, odd):
    panel.show_abilities(Abilities(can_cancel=True))
    assert not panel.prospect.remedy.isEnabled()


def test_other_notices_are_listed_and_show_their_place(panel, qtbot):
    plates = read_plates(PLATES / "girder_manholes.json")
    show(panel, plates)
    rows = panel.prospect.notices
    assert rows.count() == len(division(plates, None).notices["girder_manholes"]) > 0
    assert rows.item(0).text().startswith("The hole is ")
    with qtbot.waitSignal(panel.prospect.place_wanted) as wanted:
        qtbot.mouseClick(rows.viewport(), Qt.MouseButton.LeftButton, pos=rows.visualItemRect(rows.item(0)).center())
    assert wanted.args[0].code == "W_SMALL_HOLE"


def test_the_best_mesher_is_chosen_first_and_others_can_be(panel, qtbot):
    boxes, told = panel.mesher, []
    boxes.changed.connect(told.append)
    assert boxes.names.currentData() == "best"
    assert boxes.grading.isVisible()
    boxes.preferences.setCurrentIndex(1)
    boxes.preferences.activated.emit(1)
    boxes.grading.setValue(0.3)
    boxes.names.setCurrentIndex(1)
    boxes.names.activated.emit(1)
    assert told[-1] == Mesher(name="paper", prefer="quality", grading=0.3)
    assert not boxes.grading.isVisible()


def test_elements_follow_lines_if_asked_to_by_either_mesher(panel, qtbot):
    told = []
    panel.mesher.changed.connect(told.append)
    assert not panel.mesher.lines.isChecked()
    qtbot.mouseClick(panel.mesher.lines, Qt.MouseButton.LeftButton)
    assert told == [Mesher(follows_lines=True)]
    panel.mesher.show_mesher(Mesher(name="paper"))
    assert panel.mesher.lines.isVisible()
    assert not panel.mesher.lines.isChecked()


def test_what_is_known_of_contours_is_not_shown_of_followed_lines(panel):
    plates = read_plates(PLATES / "floor_manholes.json")
    show(panel, plates)
    panel.mesher.show_mesher(Mesher(follows_lines=True))
    panel.ask()
    assert panel.prospect.sentence.text() == "Unavoidable triangles: …"
    panel.show_division(division(plates, None, follows_lines=True))
    assert panel.prospect.sentence.text().startswith("Unavoidable triangles: 0")
    texts = [panel.prospect.notices.item(row).text() for row in range(panel.prospect.notices.count())]
    assert any("too narrow for elements of 800 mm that follow it" in text for text in texts)


def test_what_was_chosen_last_is_shown(panel):
    panel.mesher.show_mesher(Mesher(prefer="quality", grading=0.7))
    assert (panel.mesher.preferences.currentText(), panel.mesher.grading.value()) == ("best worst element", 0.7)
