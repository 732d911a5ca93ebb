"""Runs that are paused and go on: one run all the same, as long as nothing else is asked for."""

import threading
from itertools import islice

import numpy as np
import pytest

from hullquad.metrics import metric
from hullquad.optimization.iterate import outcome
from hullquad.optimization.objective import objective
from hullquad.optimization.paper import unmoved
from hullquad.optimization.selection import rings
from hullquad.optimization.settings import PaperSettings, SearchSettings
from hullquad.optimizers import OPTIMIZERS, iterates
from hullquad.rules import rule_set
from hullquad_app.count_words import number_of
from hullquad_app.document import Document
from hullquad_app.optimizer import Optimizer
from hullquad_app.plan import planned
from hullquad_app.scene import State
from hullquad_app.search import Search
from hullquad_app.source import Source
from hullquad_app.track import Track

MODES = [row.key for row in OPTIMIZERS]
RULES = rule_set("bv")
PAPER = PaperSettings(iterations=40)


@pytest.fixture
def document(qapp, dented):
    document = Document()
    document.open(State(tracks={"D": Track((unmoved(dented, metric("stretch")),))}))
    document.look(rules=RULES)
    return document


@pytest.fixture
def optimizer(document):
    optimizer = Optimizer(document)
    yield optimizer
    optimizer.stop_and_wait()
    assert not [thread for thread in threading.enumerate() if thread.name == "hullquad mailbox"]


@pytest.fixture
def act(optimizer, document, qtbot):
    """Step, or run with None, and wait for the end."""

    def wait(steps=1, **search):
        optimizer.start(planned(document.scene, Search(**search), PAPER, None), steps)
        qtbot.waitUntil(lambda: not optimizer.is_running, timeout=20_000)
        return document.scene

    return wait


def script(mesh, key, **settings):
    """The iterates that a script gets."""
    return iterates(key, mesh, objective("stretch"), SearchSettings(**settings), PAPER, RULES)


def same(one, other):
    return np.array_equal(one.mesh.points, other.mesh.points)


@pytest.mark.parametrize("key", MODES)
def test_three_steps_are_the_first_three_iterates_of_one_run(act, document, dented, key):
    for _ in range(3):
        act(optimizer=key)
    expected = list(islice(script(dented, key), 4))
    shown = document.scene.track.iterates
    assert [iterate.number for iterate in shown] == [0, 1, 2, 3]
    assert all(same(one, other) for one, other in zip(shown, expected, strict=True))
    assert [iterate.stage for iterate in shown] == [iterate.stage for iterate in expected]
    assert document.edits.count() == 3


@pytest.mark.parametrize("key", MODES)
def test_a_step_and_a_run_come_to_the_end_of_one_run(act, document, dented, key):
    act(optimizer=key)
    scene = act(None, optimizer=key)
    expected = outcome(script(dented, key))
    assert same(scene.track.last, expected.last)
    assert same(scene.iterate, expected.best)
    assert scene.track.last.stop == expected.last.stop
    assert [passage.start for passage in scene.track.passages] == [0]
    assert scene.track.passages[0].seconds > 0


def test_after_undo_a_new_run_begins_and_after_redo_the_old_one_goes_on(act, document, dented):
    old = list(islice(script(dented, "default"), 5))
    for _ in range(3):
        act()
    document.edits.undo()
    document.edits.redo()
    assert same(act().iterate, old[4])
    for _ in range(2):
        document.edits.undo()
    begun = document.scene.mesh
    new = list(islice(script(begun, "default"), 2))
    assert same(act().iterate, new[1])
    assert [passage.start for passage in document.scene.track.passages] == [0, 2]


@pytest.mark.parametrize("other", [{"optimizer": "worst"}, {"floor": None}, {"is_local": True}])
def test_with_another_plan_a_new_run_begins(act, document, other):
    document.look(selection=frozenset([4]))
    act()
    act(**other)
    assert [passage.start for passage in document.scene.track.passages] == [0, 1]


def test_another_metric_begins_a_new_run(act, document):
    act()
    document.look(metric=metric("shape"))
    scene = act()
    assert [passage.objective.metric.key for passage in scene.track.passages] == ["stretch", "shape"]


def test_what_cannot_go_on_is_closed(act, optimizer, document, monkeypatch):
    closed = []
    close = Source.close
    monkeypatch.setattr(Source, "close", lambda source: closed.append(close(source)))
    act()
    act()
    assert not closed
    act(optimizer="worst")
    assert len(closed) == 1
    optimizer.stop_and_wait()
    assert len(closed) == 2


@pytest.mark.parametrize("count", [0, 9])
def test_only_what_is_selected_and_near_it_moves(act, document, dented, count):
    document.look(selection=frozenset([0]))
    scene = act(None, is_local=True, rings=count)
    may_move = rings(dented, [0], count)
    has_moved = (scene.mesh.points != dented.points).any(axis=1)
    assert has_moved.any()
    assert not (has_moved & ~may_move).any()
    free = int((may_move & dented.topology.is_free).sum())
    assert document.edits.undoText().startswith(f"Optimize stretch ({number_of('node', free)}): ")
    assert same(scene.iterate, outcome(script(dented, "default", chosen=may_move)).best)


def test_without_a_selection_every_free_node_may_move(act, document, dented):
    assert same(act(None, is_local=True).iterate, outcome(script(dented, "default")).best)


def test_the_paper_moves_every_free_node(document):
    document.look(selection=frozenset([0]))
    assert planned(document.scene, Search(optimizer="paper", is_local=True), PAPER, None).selection is None


def test_a_time_limit_counts_no_pause(dented):
    source = Source(script(dented, "default"), 1e-9)
    first, last = source
    assert (first.number, first.stop, last.number, last.stop.name) == (0, None, 1, "time")


@pytest.mark.parametrize(
    ("key", "text"),
    [
        ("default", "Step stretch: {0.objective:.2f} → {1.objective:.2f}"),
        ("worst", "Step worst stretch: {0.quality.worst:.3f} → {1.quality.worst:.3f}"),
        ("worst_quad", "Step worst stretch of a quad: {0.quality.worst_quad:.3f} → {1.quality.worst_quad:.3f}"),
        ("untangle", "Step inverted elements: 0 → 0"),
    ],
)
def test_the_label_tells_what_the_optimiser_is_about(act, document, key, text):
    scene = act(optimizer=key)
    assert document.edits.undoText() == text.format(*scene.track.iterates)


def test_the_label_of_a_chase_counts_violations(act, document):
    act(None, optimizer="rules")
    before, after = document.edits.undoText().rpartition(": ")[2].split(" → ")
    assert int(after) <= int(before)
    assert RULES.title in document.edits.undoText()
