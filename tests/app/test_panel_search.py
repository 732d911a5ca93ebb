"""The panel with the paper's parameters: what it says of them, and of what a run has brought."""

from pathlib import Path

import attrs
import pytest
from PySide6.QtCore import Qt
from PySide6.QtWidgets import QCheckBox, QComboBox, QPushButton, QSpinBox

from hullquad import pipeline, worker
from hullquad.formats import read_plates
from hullquad.metrics import METRICS, metric
from hullquad.optimization.paper import PaperSettings, paper_iterates, unmoved
from hullquad.triangulation.contour import contours
from hullquad_app.colours import DARK
from hullquad_app.document import Document
from hullquad_app.panels.scale_spin import ScaleSpin
from hullquad_app.panels.search import SearchPanel
from hullquad_app.scene import Scene, State, View
from hullquad_app.track import Track

HOPPER = Path(__file__).parents[2] / "assets" / "plates" / "hopper_partition.json"
STRETCH = metric("stretch")


@pytest.fixture
def panel(qtbot):
    panel = SearchPanel()
    qtbot.addWidget(panel)
    panel.show()
    return panel


@pytest.fixture
def wanted(panel):
    """Settings that the panel has asked for."""
    settings = []
    panel.changed.connect(settings.append)
    return settings


@pytest.fixture(scope="module")
def hopper():
    (contour,) = contours(read_plates(HOPPER), 250.0).values()
    mesh = pipeline.paper_mesh(contour)
    worker.stop()
    return mesh


def scene(mesh, settings, by=STRETCH, position=-1):
    """The scene after a run."""
    track = Track((unmoved(mesh, by),)).with_run(paper_iterates(mesh, by, settings))
    document = Document()
    document.open(State(tracks={"H": track}))
    document.look(position=position)
    return document.scene


def typed(qtbot, box, text):
    """Type into a box and press Enter."""
    box.setFocus()
    box.selectAll()
    qtbot.keyClicks(box, text)
    qtbot.keyClick(box, Qt.Key.Key_Return)


def test_it_shows_the_settings_without_asking_for_others(panel, wanted):
    panel.show_settings(PaperSettings(step=0.001, iterations=77, tolerance=1e-7, guard=False), "shape")
    assert (panel.step.value(), panel.iterations.value(), panel.tolerance.value()) == (0.001, 77, 1e-7)
    assert not panel.guard.isChecked()
    assert panel.objective.currentText() == "Shape"
    assert wanted == []


@pytest.mark.parametrize(
    ("name", "text", "value"),
    [("step", "0.01", 0.01), ("step", "2e-3", 0.002), ("iterations", "25", 25), ("tolerance", "1e-8", 1e-8)],
)
def test_a_typed_parameter_is_asked_for_once(panel, wanted, qtbot, name, text, value):
    typed(qtbot, getattr(panel, name), text)
    assert wanted == [attrs.evolve(PaperSettings(), **{name: value})]


def test_the_guard_can_be_taken_away(panel, wanted, qtbot):
    qtbot.keyClick(panel.guard, Qt.Key.Key_Space)
    assert wanted == [PaperSettings(guard=False)]


def test_what_the_panel_does_not_show_is_kept(panel, wanted):
    panel.show_settings(PaperSettings(window=7), None)
    panel.iterations.setValue(3)
    assert wanted == [PaperSettings(window=7, iterations=3)]


def test_defaults_come_back(panel, wanted, qtbot):
    assert not panel.defaults.isEnabled()
    panel.show_settings(PaperSettings(step=0.1), "shape")
    with qtbot.waitSignal(panel.objective_chosen) as chosen:
        qtbot.mouseClick(panel.defaults, Qt.MouseButton.LeftButton)
    assert chosen.args == [None]
    assert wanted == [PaperSettings()]
    assert not panel.defaults.isEnabled()


def test_another_objective_is_chosen(panel, qtbot):
    chosen = []
    panel.objective_chosen.connect(chosen.append)
    qtbot.keyClick(panel.objective, Qt.Key.Key_Down)
    qtbot.keyClick(panel.objective, Qt.Key.Key_Up)
    assert chosen == [METRICS[0].key, None]


def test_the_step_is_told_as_a_length_squared(panel, hopper):
    panel.show_scene(scene(hopper, PaperSettings(iterations=1)))
    assert panel.length.text() == "= 187.5 mm² at h = 250 mm"


def test_objective_and_worst_are_shown_before_and_now(panel, hopper):
    shown = scene(hopper, PaperSettings(iterations=30))
    panel.show_scene(shown)
    outcome, first, now = panel.outcome, shown.track.first, shown.iterate
    assert outcome.captions[0].text() == "Sum of stretch"
    assert [label.text() for label in outcome.before] == [f"{first.objective:.3f}", f"{first.quality.worst:.3f}", "0"]
    assert [label.text() for label in outcome.now] == [f"{now.objective:.3f}", f"{now.quality.worst:.3f}", "0"]


def test_the_reason_to_stop_comes_with_its_advice(panel, hopper):
    shown = scene(hopper, PaperSettings(iterations=3))
    panel.show_scene(shown)
    assert panel.outcome.stop.isVisible()
    assert "Ended at iteration 3" in panel.outcome.stop.text()
    assert shown.track.last.stop.advice in panel.outcome.stop.text()


def test_a_worst_that_is_sacrificed_to_the_sum_is_warned_of(panel, hopper):
    folded = scene(hopper, PaperSettings(iterations=60, step=0.02, guard=False))
    panel.show_scene(folded)
    assert panel.outcome.warning.isVisible()
    assert int(panel.outcome.now[2].text()) == folded.quality.inverted_count > 0


def test_a_mesh_as_it_was_made_is_warned_of_nothing(panel, hopper):
    panel.show_scene(scene(hopper, PaperSettings(iterations=60, step=0.02, guard=False), position=0))
    assert not panel.outcome.warning.isVisible()


def test_it_can_be_dark(panel, hopper):
    panel.show_scene(scene(hopper, PaperSettings(iterations=3)))
    panel.set_palette(DARK)
    assert panel.outcome.stop.palette().windowText().color().name().upper() == DARK.text


def test_every_control_has_a_name_and_fits_the_column(panel):
    for kind in (ScaleSpin, QSpinBox, QComboBox, QCheckBox, QPushButton):
        assert all(control.accessibleName() for control in panel.findChildren(kind))
    assert panel.minimumSizeHint().width() < 60 * panel.fontMetrics().averageCharWidth()


@pytest.mark.parametrize(
    ("value", "steps", "after"), [(0.003, 1, 0.005), (0.003, -1, 0.002), (0.5, 2, 2.0), (1, -1, 0.5)]
)
def test_arrows_go_in_round_steps(qtbot, value, steps, after):
    box = ScaleSpin(1e-7, 10.0)
    qtbot.addWidget(box)
    box.setValue(value)
    box.stepBy(steps)
    assert box.value() == pytest.approx(after)


@pytest.mark.parametrize("text", ["", "x", "1e", "0", "99", "nan", "inf", "1e999"])
def test_what_is_no_number_of_the_range_is_not_taken(qtbot, text):
    box = ScaleSpin(1e-7, 10.0)
    qtbot.addWidget(box)
    box.setValue(0.5)
    typed(qtbot, box, text)
    assert 1e-7 <= box.value() <= 10.0


@pytest.mark.parametrize(
    ("key", "text"),
    [("stretch", "the metric that is shown"), ("corner_angle", "shape: corner angle has no sum")],
)
def test_it_says_what_is_optimised_where_the_shown_metric_cannot_be(panel, key, text):
    panel.show_scene(Scene(view=View(metric=metric(key))))
    assert panel.objective.itemText(0) == text
