"""Plates: what has become of each, and which is shown."""

from math import inf
from pathlib import Path

import attrs
import pytest
from PySide6.QtCore import Qt

from hullquad.formats import read_plates
from hullquad.metrics import metric
from hullquad.quality import quality
from hullquad_app.panels.plate_rows import COLUMNS
from hullquad_app.panels.plates import PlatesPanel
from hullquad_app.scene import Scene, State, View

BLOCK = Path(__file__).parents[2] / "assets" / "plates" / "hopper_block.json"


@pytest.fixture(scope="module")
def block():
    return read_plates(BLOCK)


@pytest.fixture
def panel(qtbot):
    panel = PlatesPanel()
    qtbot.addWidget(panel)
    panel.resize(400, 500)
    panel.show()
    return panel


def scene(plates, tracks=None, key="B1", by="stretch", bands=None, **more):
    tracks = tracks or {}
    view = View(key=key, metric=metric(by), bands=bands or {})
    return Scene(state=State(plates=plates, tracks=tracks), view=view, track=tracks.get(key), **more)


def cell(panel, key, name, role=Qt.ItemDataRole.DisplayRole):
    keys = [panel.model.key(row) for row in range(panel.model.rowCount())]
    return panel.model.index(keys.index(key), COLUMNS.index(name)).data(role)


def test_every_plate_has_a_row(panel, block):
    panel.show_scene(scene(block))
    assert [panel.model.key(row) for row in range(panel.model.rowCount())] == [plate.id for plate in block.plates]
    assert cell(panel, "B1", "title") == "bottom shell inboard"


def test_plates_without_a_mesh_say_so(panel, block):
    panel.show_scene(scene(block))
    assert cell(panel, "B2", "state") == "not meshed"
    assert cell(panel, "BL", "state") == "curved: not yet"
    assert cell(panel, "B2", "worst") == ""


def test_meshed_plates_tell_failing_and_worst(panel, block, walked):
    mesh = walked.last.mesh
    worst = quality(mesh, metric("stretch")).worst
    panel.show_scene(scene(block, {"B2": walked}))
    assert cell(panel, "B2", "state") == "meshed"
    assert cell(panel, "B2", "worst") == f"{worst:.3f}"
    panel.show_scene(scene(block, {"B2": walked}, bands={"stretch": (0.99, inf)}))
    assert cell(panel, "B2", "state") == f"{quality(mesh, metric('stretch'), (0.99, inf)).failing_count} failing"


def test_plates_are_judged_by_the_chosen_metric(panel, block, walked):
    panel.show_scene(scene(block, {"B2": walked}, by="max_angle"))
    assert cell(panel, "B2", "worst") == f"{quality(walked.last.mesh, metric('max_angle')).worst:.1f}"
    assert panel.model.headerData(COLUMNS.index("worst"), Qt.Orientation.Horizontal) == "Worst [°]"


def test_the_run_of_the_shown_plate_is_told(panel, block, walked):
    shown = scene(block, {}, running=True)
    panel.show_scene(attrs.evolve(shown, track=walked, position=12, quality=walked.last.quality))
    assert cell(panel, "B1", "state") == "meshed"


def test_the_shown_plate_is_marked(panel, block):
    panel.show_scene(scene(block, key="IB"))
    (row,) = {index.row() for index in panel.table.selectionModel().selectedIndexes()}
    assert panel.model.key(row) == "IB"
    assert cell(panel, "IB", "plate", Qt.ItemDataRole.FontRole).bold()


def test_a_click_chooses_a_plate_and_marks_none(panel, qtbot, block):
    panel.show_scene(scene(block))
    place = panel.table.visualRect(panel.model.index(3, 1)).center()
    with qtbot.waitSignal(panel.chosen) as signal:
        qtbot.mouseClick(panel.table.viewport(), Qt.MouseButton.LeftButton, pos=place)
    assert signal.args == [panel.model.key(3)]
    assert {index.row() for index in panel.table.selectionModel().selectedIndexes()} == {0}


def test_showing_a_scene_chooses_nothing(panel, qtbot, block):
    with qtbot.assertNotEmitted(panel.chosen):
        panel.show_scene(scene(block, key="IB"))
        panel.show_scene(Scene())
    assert panel.model.rowCount() == 0


def test_only_what_is_painted_is_judged(panel, block, walked, monkeypatch):
    plates = [attrs.evolve(block.plates[0], id=f"P{number}") for number in range(200)]
    many = attrs.evolve(block, plates=tuple(plates))
    tracks = {
        plate.id: attrs.evolve(
            walked, iterates=(attrs.evolve(walked.last, mesh=attrs.evolve(walked.last.mesh, plate_id=plate.id)),)
        )
        for plate in plates
    }
    asked = []

    def judged(mesh, *rest):
        asked.append(mesh.plate_id)
        return quality(mesh, *rest)

    monkeypatch.setattr("hullquad_app.panels.plate_rows.quality", judged)
    panel.show_scene(scene(many, tracks, key="P0", by="shape"))
    panel.grab()
    assert 0 < len(asked) < 60
    assert len(set(asked)) == len(asked)
