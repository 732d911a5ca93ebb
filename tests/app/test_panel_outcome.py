"""The table of a run: figures before and now, effort, warning, and why it ended."""

import pytest

from hullquad.metrics import metric
from hullquad.optimization.iterate import outcome
from hullquad.optimization.objective import objective
from hullquad.optimization.paper import PaperSettings, paper_iterates, unmoved
from hullquad.optimization.settings import SearchSettings
from hullquad.optimizers import iterates
from hullquad.quality import quality
from hullquad_app.colours import DARK
from hullquad_app.document import Document
from hullquad_app.panels.outcome import OutcomePanel
from hullquad_app.passage import Passage
from hullquad_app.scene import State
from hullquad_app.track import Track

STRETCH = metric("stretch")


@pytest.fixture
def panel(qtbot):
    panel = OutcomePanel()
    qtbot.addWidget(panel)
    panel.show()
    return panel


def scene(mesh, position=-1, by="stretch", **settings):
    """The scene after a run by the paper's method."""
    wanted = objective(by)
    run = paper_iterates(mesh, wanted.metric, PaperSettings(**settings))
    track = Track((unmoved(mesh, wanted.metric),)).with_run(run)
    document = Document()
    passage = Passage(start=0, optimizer="paper", objective=wanted, seconds=1.25)
    document.open(State(tracks={"D": track.with_passage(passage)}))
    document.look(position=position)
    return document


def texts(labels):
    return [label.text() for label in labels]


def test_both_meshes_are_told_in_figures(panel, dented):
    shown = scene(dented, iterations=30).scene
    panel.show_scene(shown)
    assert texts(panel.captions) == ["Σ stretch", "Mean", "Worst", "Failing", "Inverted", "Given"]
    for labels, iterate in ((panel.before, shown.track.first), (panel.now, shown.iterate)):
        judged = iterate.quality
        figures = [iterate.objective, judged.mean, judged.worst]
        assert texts(labels) == [*(f"{value:.3f}" for value in figures), str(judged.failing_count), "0", "0"]


def test_failing_is_counted_by_the_limit_of_the_user(panel, dented):
    document = scene(dented, iterations=3)
    document.look(bands={"stretch": (0.9, float("inf"))})
    panel.show_scene(document.scene)
    failing = quality(document.scene.mesh, STRETCH, (0.9, float("inf"))).failing_count
    assert panel.now[3].text() == str(failing) != "0"


def test_the_effort_is_told(panel, dented):
    panel.show_scene(scene(dented, iterations=3).scene)
    assert panel.effort.text().startswith("The paper's method, by stretch · 3 iterations · 1.25 s · moved by up to ")


def test_a_weighted_objective_is_worked_out_for_both_meshes(panel, dented):
    shown = scene(dented, by="stretch=2,shape", iterations=3).scene
    panel.show_scene(shown)
    both = objective("stretch=2,shape")
    totals = [f"{both.total(mesh):.3f}" for mesh in (shown.track.first.mesh, shown.mesh)]
    assert [panel.captions[0].text(), panel.before[0].text(), panel.now[0].text()] == ["Weighted", *totals]


def test_the_reason_to_stop_comes_with_its_advice(panel, dented):
    shown = scene(dented, iterations=3).scene
    panel.show_scene(shown)
    assert "Ended at iteration 3" in panel.stop.text()
    assert shown.track.last.stop.advice in panel.stop.text()


def test_a_worst_that_is_sacrificed_to_the_sum_is_warned_of(panel, dented):
    evened = outcome(iterates("worst", dented, objective("stretch"))).best.mesh
    run = iterates("default", evened, objective("stretch"), SearchSettings(floor=None))
    document = Document()
    document.open(State(tracks={"D": Track((unmoved(evened, STRETCH),)).with_run(run)}))
    start, now = document.scene.track.first, document.scene.iterate
    assert now.objective > start.objective
    panel.show_scene(document.scene)
    assert panel.warning.isVisible()
    assert f"{start.quality.worst:.3f} → {now.quality.worst:.3f}" in panel.warning.text()


def test_a_mesh_as_it_was_made_is_warned_of_nothing(panel, dented):
    panel.show_scene(scene(dented, 0, iterations=5).scene)
    assert not panel.warning.isVisible()
    assert not panel.effort.isVisible()


def test_without_a_mesh_there_are_no_figures(panel):
    panel.show_scene(Document().scene)
    assert set(texts([*panel.before, *panel.now])) == {"–"}
    assert not panel.stop.isVisible()


def test_it_can_be_dark_and_every_figure_has_a_name(panel, dented):
    panel.show_scene(scene(dented, iterations=3).scene)
    panel.set_palette(DARK)
    assert panel.stop.palette().windowText().color().name().upper() == DARK.text
    assert all(label.accessibleName() for label in (*panel.before, *panel.now))
    assert panel.minimumSizeHint().width() < 60 * panel.fontMetrics().averageCharWidth()
