"""The slider by which every iterate can be shown again."""

import attrs
import pytest
from PySide6.QtCore import QPoint, Qt

from hullquad.pipeline import MeshStage
from hullquad.quads.stages import Step
from hullquad_app.colours import DARK
from hullquad_app.history_bar import HistoryBar
from hullquad_app.making import Making
from hullquad_app.scene import Scene
from hullquad_app.track import Track


def scene(track, position=-1, **more):
    return Scene(track=track, position=position % len(track.iterates), **more)


@pytest.fixture
def bar(qtbot):
    bar = HistoryBar()
    qtbot.addWidget(bar)
    bar.resize(900, 40)
    bar.show()
    return bar


def test_it_tells_which_iterate_is_shown(bar, walked):
    bar.show_scene(scene(walked, 5))
    assert bar.place.text() == "iterate 5 of 12"


def test_numbers_that_are_missing_are_told_as_they_are(bar, walked):
    bar.show_scene(scene(Track(walked.iterates[::4]), 1))
    assert bar.place.text() == "iterate 4 of 12"
    assert bar.slider.maximum() == 3


def test_the_making_of_a_mesh_comes_before_its_first_iterate(bar, qtbot, walked):
    stages = [
        MeshStage(step=step, candidate=0, candidates=1, is_best=False, mesh=lambda: walked.first.mesh)
        for step in (Step.TRIANGULATED, Step.JOINED)
    ]
    track = attrs.evolve(walked, making=Making(stages, walked.first.quality.metric))
    bar.show_scene(scene(track, 0, stage=1))
    assert (bar.slider.minimum(), bar.slider.value(), bar.slider.maximum()) == (-2, -1, 12)
    assert (bar.place.text(), bar.stage.text()) == ("making 2 of 2", "triangles joined to quads")
    with qtbot.waitSignal(bar.position_chosen) as signal:
        qtbot.keyClick(bar.slider, Qt.Key.Key_Home)
    assert signal.args == [-2]


def test_its_text_keeps_its_width(bar, walked):
    bar.show_scene(scene(walked, 5))
    width = bar.place.width()
    bar.show_scene(scene(walked, 11))
    assert bar.place.width() == width


@pytest.mark.parametrize(
    ("key", "position"),
    [
        (Qt.Key.Key_Left, 5),
        (Qt.Key.Key_Right, 7),
        (Qt.Key.Key_Home, 0),
        (Qt.Key.Key_End, 12),
        (Qt.Key.Key_PageDown, 5),
    ],
)
def test_keys_choose_an_iterate(bar, qtbot, walked, key, position):
    bar.show_scene(scene(walked, 6))
    with qtbot.waitSignal(bar.position_chosen) as signal:
        qtbot.keyClick(bar.slider, key)
    assert signal.args == [position]


def test_a_click_goes_to_its_place(bar, qtbot, walked):
    bar.show_scene(scene(walked, 0))
    with qtbot.waitSignal(bar.position_chosen) as signal:
        qtbot.mouseClick(bar.slider, Qt.MouseButton.LeftButton, pos=bar.slider.rect().center())
    assert signal.args == [6]


def test_showing_a_scene_chooses_nothing(bar, qtbot, walked):
    with qtbot.assertNotEmitted(bar.position_chosen):
        bar.show_scene(scene(walked, 3))
        bar.show_scene(scene(Track(walked.iterates[:2]), 0))


@pytest.mark.parametrize("count", [0, 1])
def test_it_is_off_where_there_is_nothing_to_choose(bar, walked, count):
    bar.show_scene(scene(walked))
    bar.show_scene(scene(Track(walked.iterates[:1])) if count else Scene())
    assert not bar.slider.isEnabled()


def test_it_follows_the_newest_iterate_while_running(bar, walked):
    for count in (2, 5, 9):
        bar.show_scene(scene(Track(walked.iterates[:count]), running=True))
    assert bar.slider.value() == bar.slider.maximum() == 8


def test_it_does_not_take_the_slider_out_of_the_hand(bar, qtbot, walked):
    bar.show_scene(scene(Track(walked.iterates[:9]), running=True))
    qtbot.mousePress(bar.slider, Qt.MouseButton.LeftButton, pos=QPoint(5, bar.slider.height() // 2))
    bar.show_scene(scene(walked, running=True))
    assert bar.slider.value() == 0


def test_the_best_iterate_is_marked(bar, walked):
    bar.show_scene(scene(walked, 0))
    marked = bar.slider.grab().toImage()
    bar.slider.mark(None, bar.slider.palette().highlight().color())
    assert bar.slider.grab().toImage() != marked
    bar.set_palette(DARK)


def test_every_control_has_an_accessible_name(bar):
    assert bar.slider.accessibleName()


def test_the_stage_of_the_shown_iterate_is_named_in_a_place_of_one_width(bar, walked):
    bar.show_scene(scene(walked, 5))
    assert not bar.stage.isVisible()
    iterates = tuple(
        attrs.evolve(iterate, stage="even out" if iterate.number < 6 else "fewest violations")
        for iterate in walked.iterates
    )
    bar.show_scene(scene(Track(iterates), 5))
    width = bar.stage.width()
    assert bar.stage.text() == "even out"
    bar.show_scene(scene(Track(iterates), 6))
    assert (bar.stage.text(), bar.stage.width()) == ("fewest violations", width)
