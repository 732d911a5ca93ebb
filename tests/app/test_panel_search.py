"""The panel that chooses the optimiser, what it optimises by, and its options."""

from pathlib import Path

import attrs
import pytest
from PySide6.QtCore import QPoint, Qt
from PySide6.QtWidgets import QCheckBox, QComboBox, QPushButton, QSpinBox, QToolButton

from hullquad import pipeline, worker
from hullquad.formats import read_plates
from hullquad.metrics import METRICS, metric
from hullquad.optimization.paper import PaperSettings, paper_iterates, unmoved
from hullquad.optimizers import OPTIMIZERS
from hullquad.rules import rule_set
from hullquad.triangulation.contour import contours
from hullquad_app.document import Document
from hullquad_app.panels.scale_spin import ScaleSpin
from hullquad_app.panels.search import SearchPanel
from hullquad_app.scene import Scene, State, View
from hullquad_app.search import Search
from hullquad_app.track import Track

HOPPER = Path(__file__).parents[2] / "assets" / "plates" / "hopper_partition.json"
STRETCH = metric("stretch")
PAPER = Search(optimizer="paper")


@pytest.fixture
def panel(qtbot):
    panel = SearchPanel()
    qtbot.addWidget(panel)
    panel.show_settings(PaperSettings(), None, PAPER)
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
    panel.show_settings(PaperSettings(step=0.001, iterations=77, tolerance=1e-7, guard=False), "shape", PAPER)
    paper = panel.paper
    assert (paper.step.value(), paper.iterations.value(), paper.tolerance.value()) == (0.001, 77, 1e-7)
    assert not paper.guard.isChecked()
    assert panel.optimizer.currentText() == "The paper's method"
    assert panel.objective.currentText() == "Shape"
    assert wanted == []


@pytest.mark.parametrize(
    ("name", "text", "value"),
    [("step", "0.01", 0.01), ("step", "2e-3", 0.002), ("iterations", "25", 25), ("tolerance", "1e-8", 1e-8)],
)
def test_a_typed_parameter_is_asked_for_once(panel, wanted, qtbot, name, text, value):
    typed(qtbot, getattr(panel.paper, name), text)
    assert wanted == [attrs.evolve(PaperSettings(), **{name: value})]


def test_the_guard_can_be_taken_away(panel, wanted, qtbot):
    qtbot.keyClick(panel.paper.guard, Qt.Key.Key_Space)
    assert wanted == [PaperSettings(guard=False)]


def test_what_the_panel_does_not_show_is_kept(panel, wanted):
    panel.show_settings(PaperSettings(window=7), None, PAPER)
    panel.paper.iterations.setValue(3)
    assert wanted == [PaperSettings(window=7, iterations=3)]


def test_defaults_come_back(panel, wanted, qtbot):
    assert not panel.defaults.isEnabled()
    panel.show_settings(PaperSettings(step=0.1), "shape", PAPER)
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
    assert panel.paper.length.text() == "= 187.5 mm² at h = 250 mm"


@pytest.mark.parametrize("key", [row.key for row in OPTIMIZERS])
def test_every_control_has_a_name_and_fits_the_column(panel, key):
    panel.show_settings(PaperSettings(), "stretch=2,shape", Search(optimizer=key))
    for kind in (ScaleSpin, QSpinBox, QComboBox, QCheckBox, QPushButton, QToolButton):
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


@pytest.fixture
def searches(panel):
    """Searches that the panel has asked for."""
    asked = []
    panel.search_changed.connect(asked.append)
    return asked


def rows_shown(panel):
    """Names of the controls that are there."""
    parts = {"by": panel.objective, "weights": panel.weights, "local": panel.local, "step": panel.paper.step}
    options = {name: getattr(panel.options, name) for name in ("rules", "floor", "iterations", "seconds")}
    return {name for name, widget in (parts | options).items() if widget.isVisible()}


@pytest.mark.parametrize(
    ("key", "shown"),
    [
        ("default", {"by", "local", "floor", "iterations", "seconds"}),
        ("fine", {"by", "local", "floor", "iterations", "seconds"}),
        ("worst", {"by", "local", "iterations", "seconds"}),
        ("worst_quad", {"by", "local", "floor", "iterations", "seconds"}),
        ("rules", {"by", "local", "rules", "floor", "iterations", "seconds"}),
        ("untangle", {"local", "iterations", "seconds"}),
        ("paper", {"by", "step"}),
    ],
)
def test_an_optimiser_shows_its_own_options_only(panel, searches, qtbot, key, shown):
    row = [row.key for row in OPTIMIZERS].index(key)
    panel.optimizer.setFocus()
    qtbot.keyClick(panel.optimizer, Qt.Key.Key_Home)
    for _ in range(row):
        qtbot.keyClick(panel.optimizer, Qt.Key.Key_Down)
    assert searches[-1] == Search(optimizer=key)
    assert panel.words.text() == OPTIMIZERS[row].words
    assert rows_shown(panel) == shown


def test_the_options_are_asked_for(panel, searches, qtbot):
    panel.show_settings(PaperSettings(), None, Search())
    qtbot.keyClick(panel.options.floor, Qt.Key.Key_Down)
    typed(qtbot, panel.options.iterations, "50")
    typed(qtbot, panel.options.seconds, "7")
    assert searches == [
        Search(floor=0.6),
        Search(floor=0.6, iterations=50),
        Search(floor=0.6, iterations=50, seconds=7),
    ]
    qtbot.mouseClick(panel.defaults, Qt.MouseButton.LeftButton)
    assert searches[-1] == Search()


def test_metrics_are_weighted_added_and_removed(panel, qtbot):
    panel.show_settings(PaperSettings(), None, Search())
    asked = []
    panel.objective_chosen.connect(asked.append)
    qtbot.keyClick(panel.objective, Qt.Key.Key_End)
    assert asked[-1].startswith("stretch=1,")
    assert panel.weights.isVisible()
    qtbot.mouseClick(panel.weights.add, Qt.MouseButton.LeftButton)
    assert len(panel.weights.rows) == 3
    typed(qtbot, panel.weights.rows[0].weight, "2.5")
    for row in panel.weights.rows[:0:-1]:
        qtbot.mouseClick(row.remove, Qt.MouseButton.LeftButton)
    assert asked[-1] == "stretch=2.5"
    assert not panel.weights.rows[0].remove.isEnabled()
    qtbot.keyClick(panel.objective, Qt.Key.Key_Home)
    assert asked[-1] is None
    assert not panel.weights.isVisible()


def test_only_a_selection_can_be_optimised_alone(panel, searches, hopper, qtbot):
    panel.show_settings(PaperSettings(), None, Search())
    shown = scene(hopper, PaperSettings(iterations=1))
    panel.show_scene(shown)
    assert not panel.local.only.isEnabled()
    panel.show_scene(attrs.evolve(shown, view=attrs.evolve(shown.view, selection=frozenset([0]))))
    qtbot.mouseClick(panel.local.only, Qt.MouseButton.LeftButton, pos=QPoint(5, panel.local.only.height() // 2))
    typed(qtbot, panel.local.rings, "0")
    assert searches[-1] == Search(is_local=True, rings=0)
    free = hopper.topology.is_free
    count = int(free[hopper.topology.elements[0]].sum())
    assert panel.local.extent.text() == f"{count} of {free.sum()} free nodes may move"


def test_the_rules_that_are_judged_by_are_shown(panel):
    panel.show_settings(PaperSettings(), None, Search(optimizer="rules"))
    panel.show_scene(Scene(view=View(rules=rule_set("bv"))))
    assert panel.options.rules.currentText() == rule_set("bv").title
