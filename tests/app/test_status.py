"""The status bar: size, what goes on, a warning, the objective."""

import attrs
import numpy as np
import pytest

from hullquad.metrics import metric
from hullquad.optimization import stops
from hullquad.optimization.iterate import Iterate
from hullquad.optimization.objective import objective
from hullquad.optimization.paper import objective_sum
from hullquad.quality import quality
from hullquad_app.colours import DARK
from hullquad_app.count_words import number_of
from hullquad_app.passage import Passage
from hullquad_app.scene import Scene, View
from hullquad_app.status import StatusBar
from hullquad_app.track import Track


def scene(track, position=-1, key="stretch", **more):
    position %= len(track.iterates)
    by = metric(key)
    return Scene(
        track=track,
        position=position,
        view=View(metric=by),
        quality=quality(track.iterates[position].mesh, by),
        first_quality=quality(track.first.mesh, by),
        **more,
    )


@pytest.fixture
def bar(qtbot):
    bar = StatusBar()
    qtbot.addWidget(bar)
    bar.resize(1100, 24)
    bar.show()
    bar.set_palette(DARK)
    return bar


def test_an_empty_window_tells_nothing(bar):
    bar.show_scene(Scene())
    assert [bar.counts.text(), bar.course.text(), bar.objective.text()] == ["", "", ""]


def test_the_size_of_the_mesh_is_told(bar, walked):
    bar.show_scene(scene(walked))
    assert bar.counts.text() == "8 quads · 2 triangles · 16 nodes (4 free)"


@pytest.mark.parametrize(("count", "words"), [(0, "0 triangles"), (1, "1 triangle"), (2, "2 triangles")])
def test_one_thing_is_told_as_one(count, words):
    assert number_of("triangle", count) == words


def test_a_text_without_room_is_cut_and_holds_no_window_wide(bar, walked, qtbot):
    bar.show_scene(scene(walked))
    bar.resize(300, 24)
    assert bar.width() == 300
    assert bar.minimumSizeHint().width() < 100


def test_the_objective_is_that_of_the_shown_iterate(bar, walked):
    bar.show_scene(scene(walked, 3))
    assert bar.objective.text() == f"Σ stretch {walked.iterates[3].objective:.3f} · lengths in mm"


def test_the_objective_is_by_the_chosen_metric(bar, walked):
    bar.show_scene(scene(walked, key="min_angle"))
    angles, stretch = objective_sum(walked.last.mesh, metric("min_angle")), walked.last.objective
    assert bar.objective.text() == f"Σ min. angle {angles:.1f}° · optimised by stretch: {stretch:.3f} · lengths in mm"


def test_what_goes_on_is_told(bar, walked):
    bar.show_scene(scene(walked, 5))
    assert bar.course.text() == "iterate 5 of 12 shown"
    bar.show_scene(scene(walked, running=True))
    assert bar.course.text() == "running"
    bar.say_activity("preparing…")
    assert bar.course.text() == "preparing…"
    bar.say_activity("")
    assert bar.course.text() == "running"


def test_the_reason_of_the_end_is_told_with_its_advice(bar, walked):
    ended = Track((*walked.iterates[:-1], attrs.evolve(walked.last, stop=stops.GAIN)))
    bar.show_scene(scene(ended))
    assert bar.course.text() == f"stopped at 12: {stops.GAIN.reason}"
    assert bar.course.toolTip().endswith(stops.GAIN.advice)
    bar.show_scene(scene(ended, 7))
    assert bar.course.text() == f"iterate 7 of 12 shown · stopped at 12: {stops.GAIN.reason}"


def worsened(track, key):
    """The track with a last iterate whose sum is better and whose worst element is worse than at first."""
    by = metric(key)
    sense = 1 if by.higher_is_better else -1
    points = track.last.mesh.points.copy()
    points[5] += [45.0, 45.0, 0.0]
    mesh = attrs.evolve(track.last.mesh, points=points)
    first = quality(track.first.mesh, by)
    start = Iterate(number=0, mesh=track.first.mesh, quality=first, objective=1.0)
    end = Iterate(number=1, mesh=mesh, quality=quality(mesh, by), objective=1.0 + sense)
    assert sense * (end.quality.worst - first.worst) < 0
    return Track((start, end))


@pytest.mark.parametrize(("key", "words"), [("stretch", ("fell", "rose")), ("aspect_ratio", ("rose", "fell"))])
def test_a_better_sum_with_a_worse_element_is_warned_of(bar, walked, key, words):
    bar.show_scene(scene(worsened(walked, key), key=key))
    assert bar.warning.text().startswith(f"worst {words[0]}")
    assert bar.warning.text().endswith(f"while the sum {words[1]}")
    assert bar.warning.isVisible()


def test_a_mesh_that_is_better_in_both_is_not_warned_of(bar, walked):
    bar.show_scene(scene(walked))
    assert bar.warning.text() == ""


def test_a_narrow_window_shows_what_there_is_room_for(bar, walked):
    bar.resize(500, 24)
    bar.show_scene(scene(walked, 5))
    assert not bar.grab().isNull()
    assert np.isfinite(bar.course.width())


def test_a_metric_without_a_sum_tells_that_of_its_objective(bar, walked):
    bar.show_scene(scene(walked, key="corner_angle"))
    shape = objective_sum(walked.last.mesh, metric("shape"))
    assert bar.objective.text().startswith(f"Σ shape {shape:.3f}")
    assert bar.warning.text() == ""


def test_the_stage_is_told_while_a_run_goes_on_and_when_scrubbed(bar, walked):
    staged = Track(tuple(attrs.evolve(iterate, stage="worst first") for iterate in walked.iterates))
    bar.show_scene(scene(staged, running=True))
    assert bar.course.text() == "running · worst first"
    bar.show_scene(scene(staged, 3))
    assert bar.course.text() == "iterate 3 of 12 shown · worst first"


def test_a_weighted_objective_is_told_apart_from_the_sum(bar, walked):
    both = objective("stretch=2,shape")
    weighted = attrs.evolve(walked.last, objective=both.total(walked.last.mesh))
    passage = Passage(start=0, optimizer="default", objective=both, seconds=1.0)
    track = Track((*walked.iterates[:-1], weighted)).with_passage(passage)
    bar.show_scene(scene(track))
    plain = f"Σ stretch {walked.last.objective:.3f}"
    other = f"optimised by 2 stretch + shape: {weighted.objective:.3f}"
    assert bar.objective.text() == f"{plain} · {other} · lengths in mm"
