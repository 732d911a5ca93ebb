"""Objective history: two lines over the iterations, to look at and to go back by."""

from itertools import islice

import attrs
import numpy as np
import pytest
from PySide6.QtCore import QEvent, Qt
from PySide6.QtGui import QHelpEvent
from PySide6.QtWidgets import QApplication, QToolTip

from hullquad.metrics import metric
from hullquad.optimization.objective import objective
from hullquad.optimization.paper import paper_iterates, unmoved
from hullquad.optimizers import iterates
from hullquad_app.colours import DARK
from hullquad_app.panels.course import course, thinned
from hullquad_app.panels.objective import ObjectivePanel
from hullquad_app.passage import Passage
from hullquad_app.scene import Scene
from hullquad_app.track import Track


def scene(track, position=-1):
    return Scene(track=track, position=position % len(track.iterates))


@pytest.fixture
def panel(qtbot):
    panel = ObjectivePanel()
    qtbot.addWidget(panel)
    panel.resize(400, 150)
    panel.show()
    return panel


@pytest.fixture(scope="module")
def two_metrics(walked):
    """A track that went on by another metric."""
    return walked.with_run(islice(paper_iterates(walked.last.mesh, metric("aspect_ratio")), 5))


def at(panel, position):
    return panel.point_at(position).toPoint()


@pytest.mark.parametrize("position", [0, 5, 11])
def test_a_click_chooses_the_iterate_below_the_mouse(panel, qtbot, walked, position):
    panel.show_scene(scene(walked))
    with qtbot.waitSignal(panel.position_chosen) as signal:
        qtbot.mouseClick(panel, Qt.MouseButton.LeftButton, pos=at(panel, position))
    assert signal.args == [position]


def test_dragging_goes_through_the_iterates(panel, qtbot, walked):
    panel.show_scene(scene(walked))
    chosen = []
    panel.position_chosen.connect(chosen.append)
    places = [at(panel, position) for position in (3, 2, 1)]
    qtbot.mousePress(panel, Qt.MouseButton.LeftButton, pos=places[0])
    for place in places[1:]:
        qtbot.mouseMove(panel, place)
    assert chosen[0] == 3


@pytest.mark.parametrize(
    ("key", "position"),
    [(Qt.Key.Key_Left, 4), (Qt.Key.Key_Right, 6), (Qt.Key.Key_Home, 0), (Qt.Key.Key_End, 12)],
)
def test_keys_go_through_the_iterates(panel, qtbot, walked, key, position):
    panel.show_scene(scene(walked, 5))
    with qtbot.waitSignal(panel.position_chosen) as signal:
        qtbot.keyClick(panel, key)
    assert signal.args == [position]


def test_hovering_tells_the_numbers(panel, walked):
    panel.show_scene(scene(walked))
    point = at(panel, 5)
    QApplication.sendEvent(panel, QHelpEvent(QEvent.Type.ToolTip, point, panel.mapToGlobal(point)))
    iterate = walked.iterates[5]
    assert QToolTip.text().startswith(
        f"iterate 5: Σ stretch {iterate.objective:.3f}, worst {iterate.quality.worst:.3f}"
    )


@pytest.mark.parametrize("count", [1, 2, 13])
def test_tracks_of_any_length_are_drawn(panel, walked, count):
    panel.show_scene(scene(Track(walked.iterates[:count])))
    panel.set_palette(DARK)
    assert not panel.grab().isNull()


def test_infinite_values_break_the_line(panel, walked):
    broken = [attrs.evolve(iterate, objective=np.inf) for iterate in walked.iterates[:5]]
    panel.show_scene(scene(Track((*broken, *walked.iterates[5:])), 0))
    assert not panel.grab().isNull()


def test_without_a_mesh_nothing_is_chosen(panel, qtbot):
    panel.show_scene(Scene())
    with qtbot.assertNotEmitted(panel.position_chosen):
        qtbot.mouseClick(panel, Qt.MouseButton.LeftButton)
        qtbot.keyClick(panel, Qt.Key.Key_Left)
    assert not panel.grab().isNull()


def test_iterates_by_another_metric_are_told_apart(panel, two_metrics):
    rows = course(two_metrics)
    assert [(part.start, part.end, part.by.key) for part in rows.parts] == [
        (0, 12, "stretch"),
        (12, 17, "aspect_ratio"),
    ]
    assert rows.alike(rows.parts[0]).sum() == 12
    panel.show_scene(scene(two_metrics))
    later = panel.grab().toImage()
    panel.show_scene(scene(two_metrics, 3))
    assert panel.grab().toImage() != later


def test_missing_numbers_lead_to_the_nearest_iterate(walked):
    rows = course(Track(walked.iterates[::3]))
    assert [rows.nearest(number) for number in (0, 1, 2, 7, 99)] == [0, 0, 1, 2, 4]


def test_a_long_line_keeps_its_peaks_and_ends():
    places, values = np.linspace(0, 300, 10_000), np.zeros(10_000)
    values[4321], values[77] = 5.0, -5.0
    rows = thinned(places, values, 2.0)
    assert len(rows) <= 2 * 151 + 2
    assert {0, 77, 4321, 9999} <= set(rows.tolist())


def test_a_short_line_keeps_every_point():
    assert thinned(np.arange(5.0), np.zeros(5)).tolist() == [0, 1, 2, 3, 4]


@pytest.fixture
def staged(dented):
    """A run with stages, then one by two metrics."""
    track = Track((unmoved(dented, metric("stretch")),)).with_run(iterates("default", dented, objective("stretch")))
    start, both = track.last.number, objective("stretch,shape")
    track = track.with_run(iterates("worst", track.last.mesh, both))
    passage = Passage(start=start, optimizer="worst", objective=both, seconds=1.0)
    return track.with_passage(passage)


def test_the_stages_of_every_run_are_marked(panel, staged):
    stages = [stage.words for stage in course(staged).stages]
    assert stages[:2] == ["even out", "p = 4"]
    assert "worst first" in stages
    starts = [stage.start for stage in course(staged).stages]
    assert all(staged.iterates[row].stage != staged.iterates[row - 1].stage for row in starts)
    panel.show_scene(scene(staged))
    marked = panel.grab().toImage()
    bare = Track(tuple(attrs.evolve(iterate, stage="") for iterate in staged.iterates), staged.passages)
    panel.show_scene(scene(bare))
    assert panel.grab().toImage() != marked


def test_the_stage_is_told_with_the_numbers(panel, staged):
    row = next(row for row, iterate in enumerate(staged.iterates) if iterate.stage == "p = 4")
    panel.show_scene(scene(staged, row))
    assert panel.accessibleDescription().endswith(", p = 4")


def test_a_weighted_objective_is_compared_with_nothing_else(panel, staged):
    rows = course(staged)
    assert [part.weighted is not None for part in rows.parts] == [False, True]
    assert not rows.alike(rows.parts[0])[-1]
    panel.show_scene(scene(staged))
    assert ": stretch + shape " in panel.accessibleDescription()
