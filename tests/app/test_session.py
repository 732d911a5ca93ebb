"""What the user can do, without a widget: opening, meshing, running, looking, undoing, saving, closing."""

import math
import random
import threading
from pathlib import Path

import numpy as np
import pytest
from PySide6.QtCore import QSettings

from hullquad import pipeline, worker
from hullquad.errors import HullquadError
from hullquad.formats import read_mesh, read_plates
from hullquad.metrics import metric
from hullquad.optimization.paper import PaperSettings, unmoved
from hullquad.triangulation.contour import contours
from hullquad_app.abilities import Abilities
from hullquad_app.mesher import Mesher
from hullquad_app.scene import State
from hullquad_app.search import Search
from hullquad_app.session import Session
from hullquad_app.settings import Settings
from hullquad_app.track import Track

PLATES = Path(__file__).parents[2] / "assets" / "plates"
BAD = Path(__file__).parents[1] / "data" / "bad-plates"
BLOCK, HOPPER = PLATES / "hopper_block.json", PLATES / "hopper_partition.json"
ENDLESS = PaperSettings(iterations=10**6, tolerance=0.0, step=1e-4)
SHORT = PaperSettings(iterations=40)


def threads():
    """Threads of ours."""
    return [thread.name for thread in threading.enumerate() if thread.name.startswith("hullquad")]


def children():
    """Processes that this one has started."""
    return set().union(*(file.read_text().split() for file in Path("/proc/self/task").glob("*/children")))


@pytest.fixture
def settings(tmp_path):
    return Settings(QSettings(str(tmp_path / "settings.ini"), QSettings.Format.IniFormat))


@pytest.fixture
def session(qapp, settings):
    before = children()
    session = Session(settings)
    session.set_search(Search(optimizer="paper"))
    session.set_paper(SHORT)
    yield session
    session.stop_and_wait()
    assert threads() == []
    assert children() <= before


@pytest.fixture(scope="module")
def hopper():
    """A mesh of the hopper's partition as it is when it was loaded: 300 elements."""
    (contour,) = contours(read_plates(HOPPER), 250.0).values()
    mesh = pipeline.paper_mesh(contour)
    worker.stop()
    return State(title="hopper", tracks={mesh.plate_id: Track((unmoved(mesh, metric("stretch")),))})


@pytest.fixture
def show(session, hopper):
    """Shows that mesh."""

    def act():
        session.document.open(hopper)
        return session.document.scene

    return act


@pytest.fixture
def open_(session, qtbot):
    """Opens a file and waits."""

    def act(path):
        with qtbot.waitSignal(session.opened, timeout=10_000):
            session.open(path)
        return session.document.scene

    return act


@pytest.fixture
def ended(session, qtbot):
    """Waits for the end of a run that an act starts, or that goes on."""

    def wait(act=lambda: None):
        act()
        qtbot.waitUntil(lambda: not session.optimizer.is_running, timeout=10_000)
        return session.document.scene

    return wait


@pytest.fixture
def running(session, show, qtbot):
    """A session in the middle of a run that does not end by itself."""
    show()
    session.set_paper(ENDLESS)
    session.run()
    qtbot.waitUntil(lambda: session.document.scene.position > 3)
    return session


@pytest.fixture
def said(session):
    """Every message."""
    messages = []
    session.message.connect(messages.append)
    return messages


def points(session):
    """Nodes of the mesh that is shown."""
    return session.document.scene.mesh.points


def labels(session):
    """Texts of the steps of undo."""
    edits = session.document.edits
    return [edits.text(i) for i in range(edits.count())]


def test_an_empty_session_can_do_nothing(session):
    assert session.abilities == Abilities()


def test_an_opened_document_shows_its_first_plate(session, open_):
    scene = open_(BLOCK)
    assert (scene.view.key, scene.mesh) == ("B1", None)
    assert not session.is_modified
    assert session.abilities.can_mesh
    assert not session.abilities.can_run
    assert session.settings.recent == [BLOCK]


def test_a_mesh_that_was_saved_is_opened_with_its_plate(session, show, open_, qtbot, tmp_path):
    show()
    with qtbot.waitSignal(session.saved):
        session.save(tmp_path / "out.vtu")
    scene = open_(tmp_path / "out.vtu")
    assert (scene.state.title, scene.state.keys, scene.plate) == ("out", ("hopper_partition",), None)
    assert session.abilities.can_run
    assert not session.abilities.can_mesh


def test_a_refused_file_leaves_the_document(session, open_, said, qtbot):
    before = open_(BLOCK).state
    with qtbot.waitSignal(session.message):
        session.open(BAD / "bowtie.json")
    assert isinstance(said[0], HullquadError)
    assert session.document.scene.state is before


def test_meshing_a_plate_is_a_step_of_undo(session, open_, qtbot):
    before = open_(HOPPER).state
    with qtbot.waitSignal(session.idle):
        session.mesh(400.0)
    scene = session.document.scene
    assert labels(session) == [f"Mesh hopper_partition (best): 1 triangle, {len(scene.mesh.topology.quads)} quads"]
    assert scene.mesh.target_size == 400.0
    assert session.is_modified
    session.undo()
    assert session.document.scene.state is before


@pytest.fixture
def block(session, open_):
    """A document of fourteen plates, to be meshed by the quick mesher."""
    session.set_mesher(Mesher(name="paper"))
    open_(BLOCK)


def test_meshing_all_plates_is_one_step_and_refusals_are_told(session, block, said, qtbot):
    session.choose_plate("H1")
    with qtbot.waitSignal(session.idle, timeout=10_000):
        session.mesh(all_plates=True)
    scene = session.document.scene
    assert [label.split(":")[0] for label in labels(session)] == [f"Mesh {len(scene.state.tracks)} plates (paper)"]
    assert scene.view.key == "H1"
    assert set(session.workshop.refused) | set(scene.state.tracks) == set(scene.state.keys)
    assert said == list(session.workshop.refused.values())


def test_cancelled_meshing_leaves_the_document(session, open_, qtbot):
    before = open_(BLOCK).state
    session.mesh(5.0, all_plates=True)
    with qtbot.waitSignal(session.idle):
        session.cancel()
    assert session.document.scene.state is before
    assert session.abilities.can_mesh


def test_one_step_is_one_step_of_undo(session, show, ended):
    first = show()
    scene = ended(session.step)
    assert (scene.position, scene.iterate.number) == (1, 1)
    before, after = first.iterate.objective, scene.iterate.objective
    assert labels(session) == [f"Step stretch: {before:.2f} → {after:.2f}"]


def test_a_run_that_ended_by_itself_shows_its_best(session, show, ended):
    first = show()
    scene = ended(session.run)
    best = max(scene.track.iterates, key=lambda iterate: iterate.objective)
    assert scene.iterate is best
    assert scene.track.last.stop.name == "iterations"
    assert labels(session) == [f"Optimize stretch: {first.iterate.objective:.2f} → {best.objective:.2f}"]


def test_a_paused_run_shows_its_last(running, ended):
    scene = ended(running.pause)
    assert scene.iterate is scene.track.last
    assert len(labels(running)) == 1


def test_a_run_goes_on_from_what_is_shown_and_undo_brings_the_rest_back(session, show, ended):
    show()
    before = ended(session.run)
    session.scrub(12)
    scrubbed = points(session)
    scene = ended(session.step)
    assert [iterate.number for iterate in scene.track.iterates] == list(range(14))
    assert np.array_equal(scene.track.iterates[12].mesh.points, scrubbed)
    session.undo()
    assert session.document.scene.state is before.state
    assert session.document.scene.position == 12


def test_scrubbing_changes_nothing_in_the_document(session, show, ended):
    show()
    state = ended(session.run).state
    session.scrub(7)
    session.scrub_by(-2)
    assert session.document.scene.position == 5
    session.scrub_by(-99)
    assert session.document.scene.position == 0
    assert session.document.scene.state is state
    assert len(labels(session)) == 1


def test_an_iterate_that_is_looked_at_stays_while_the_run_goes_on(running, ended, qtbot):
    running.scrub(2)
    shown, count = running.document.scene.iterate, len(running.document.scene.track.iterates)
    qtbot.waitUntil(lambda: len(running.document.scene.track.iterates) > count + 5)
    assert running.document.scene.iterate is shown
    scene = ended(running.pause)
    assert scene.iterate is shown


def test_the_newest_iterate_is_followed_again(running, qtbot):
    running.scrub(2)
    running.scrub(len(running.document.scene.track.iterates) - 1)
    count = len(running.document.scene.track.iterates)
    qtbot.waitUntil(lambda: running.document.scene.position > count)


@pytest.mark.parametrize(
    "act",
    [
        lambda session: session.choose_metric("shape"),
        lambda session: session.choose_plate("hopper_partition"),
        lambda session: session.choose_objective("shape"),
    ],
)
def test_changing_metric_plate_or_objective_pauses_first(running, act):
    act(running)
    assert not running.document.scene.running
    assert len(labels(running)) == 1


def test_limit_and_selection_can_change_while_the_run_goes_on(running):
    running.judging.set_limit(0, 0.9)
    running.select([3])
    scene = running.document.scene
    assert (scene.running, scene.quality.limits, scene.view.selection) == (True, (0.9,), {3})
    running.pause()


def test_limits_outlive_a_run(running, ended):
    running.judging.set_limit(0, 0.9)
    assert ended(running.pause).quality.limits == (0.9,)


def test_undo_while_running_takes_the_run_back(running):
    opened = running.document.scene.track.first.mesh
    running.undo()
    scene = running.document.scene
    assert (scene.running, len(scene.track.iterates)) == (False, 1)
    assert np.array_equal(scene.mesh.points, opened.points)


def test_reset_is_a_step_of_undo(session, show, ended):
    opened = show().mesh
    best = ended(session.run)
    session.reset()
    assert np.array_equal(points(session), opened.points)
    assert labels(session)[-1] == "Reset hopper_partition"
    assert not session.abilities.can_reset
    session.undo()
    assert session.document.scene.iterate is best.iterate


def test_another_objective_than_the_shown_metric_is_optimised(session, show, ended):
    show()
    session.choose_objective("scaled_jacobian")
    scene = ended(session.run)
    assert scene.iterate.quality.metric is metric("scaled_jacobian")
    assert scene.quality.metric is metric("stretch")
    assert labels(session)[0].startswith("Optimize scaled Jacobian: ")


def test_a_run_that_can_do_nothing_says_why_and_leaves_the_document(session, said, ended, open_, qtbot):
    open_(BLOCK)
    session.choose_plate("G2")
    with qtbot.waitSignal(session.idle):
        session.mesh(5000.0)
    meshed = session.document.scene.state
    ended(session.run)
    assert said == ["every node is given by the plate. A smaller element size gives nodes that can be moved."]
    assert session.document.scene.state is meshed
    assert labels(session) == ["Mesh G2 (best): 4 quads"]


def test_selection_extends_and_takes_back(session, show):
    show()
    session.select([1, 2])
    session.select([3], extend=True)
    assert session.document.scene.view.selection == {1, 2, 3}
    session.select([1, 3], extend=True)
    assert session.document.scene.view.selection == {2}


def test_a_limit_is_remembered_and_reset(session, show, settings):
    show()
    session.judging.set_limit(0, 0.7)
    assert settings.bands == {"stretch": (0.7, math.inf)}
    session.judging.reset_limit()
    assert session.document.scene.band == metric("stretch").band
    assert settings.bands == {}


def test_a_new_session_looks_as_the_last_did(session, settings, qapp):
    session.choose_metric("shape")
    session.judging.set_limit(0, 0.7)
    view = Session(settings).document.scene.view
    assert (view.metric.key, view.bands) == ("shape", {"shape": (0.7, math.inf)})


def test_the_iterate_that_is_shown_is_saved(session, show, ended, qtbot, tmp_path):
    show()
    ended(session.run)
    session.scrub(4)
    with qtbot.waitSignal(session.saved):
        session.save(tmp_path / "out.vtu")
    assert np.array_equal(read_mesh(tmp_path / "out.vtu").points, points(session))
    assert not session.is_modified
    session.undo()
    assert session.is_modified


def test_plates_are_saved_beside_each_other(session, block, ended, qtbot, tmp_path):
    with qtbot.waitSignal(session.idle, timeout=10_000):
        session.mesh(all_plates=True)
    session.choose_plate("H1")
    shown = ended(session.run).mesh
    session.choose_plate("B1")
    with qtbot.waitSignal(session.saved):
        session.save(tmp_path / "block.vtu")
    assert {file.name for file in tmp_path.glob("*.vtu")} == {
        f"block-{key}.vtu" for key in session.document.scene.state.tracks
    }
    assert np.array_equal(read_mesh(tmp_path / "block-H1.vtu").points, shown.points)


def test_a_plate_is_shown_where_it_was_left(session, block, ended, qtbot):
    with qtbot.waitSignal(session.idle, timeout=10_000):
        session.mesh(all_plates=True)
    session.choose_plate("H1")
    ended(session.run)
    session.scrub(3)
    session.choose_plate("B1")
    session.choose_plate("H1")
    assert session.document.scene.position == 3


def test_contours_are_divided_once_for_a_size(session, open_, qtbot):
    open_(BLOCK)
    with qtbot.waitSignal(session.divided) as first:
        session.divide("fine")
    with qtbot.waitSignal(session.divided) as again:
        session.divide("fine")
    assert first.args[0] is again.args[0]
    assert first.args[0].contours["H1"].edge_count > 0


def test_contours_are_divided_anew_when_lines_are_to_be_followed(session, open_, qtbot):
    open_(BLOCK)
    with qtbot.waitSignal(session.divided) as before:
        session.divide()
    session.set_mesher(Mesher(follows_lines=True))
    with qtbot.waitSignal(session.divided) as after:
        session.divide()
    assert not before.args[0].follows_lines
    assert len(after.args[0].contours["B1"].line_edges) > 0


def test_a_session_can_be_closed_in_the_middle_of_everything(session, open_, qtbot, tmp_path):
    open_(BLOCK)
    with qtbot.waitSignal(session.idle):
        session.mesh(100.0)
    session.set_paper(ENDLESS)
    session.run()
    session.save(tmp_path / "out.vtu")
    session.mesh(10.0, all_plates=True)
    session.prepare()
    session.open(BLOCK)
    session.divide("very_fine")


@pytest.mark.parametrize("seed", range(3))
def test_whatever_is_done_can_be_undone(session, show, ended, qtbot, seed):
    chance = random.Random(seed)
    session.set_paper(PaperSettings(iterations=200))
    opened = show()
    acts = [
        *(session.step, session.run, session.run, session.pause, session.undo, session.redo, session.reset),
        *(lambda key=key: session.set_search(Search(optimizer=key)) for key in ("default", "paper")),
        *(lambda key=key: session.choose_metric(key) for key in ("stretch", "min_angle")),
        *(lambda: session.scrub(chance.randrange(60)), lambda: session.scrub_by(chance.choice([-3, 3]))),
        *(lambda: session.select([chance.randrange(20)]), lambda: session.judging.set_limit(0, chance.random())),
        *(lambda: qtbot.wait(chance.randrange(40)), ended),
    ]
    for _ in range(120):
        steps = session.document.edits.index()
        chance.choice(acts)()
        scene = session.document.scene
        assert abs(session.document.edits.index() - steps) <= 2  # a run that was ended, and the act
        assert scene.running == session.optimizer.is_running
        assert scene.quality.metric is scene.view.metric
        assert scene.iterate is scene.track.iterates[scene.position]
        numbers = [iterate.number for iterate in scene.track.iterates]
        assert numbers == sorted(set(numbers))
    while session.abilities.can_undo:
        session.undo()
    assert session.document.scene.state is opened.state
    assert np.array_equal(points(session), opened.mesh.points)


def test_the_label_tells_what_came_of_the_run_whatever_is_looked_at(running, ended):
    running.scrub(2)
    scene = ended(running.pause)
    first, last = scene.track.first.objective, scene.track.last.objective
    assert labels(running) == [f"Optimize stretch: {first:.2f} → {last:.2f}"]
    assert scene.position == 2


def test_saving_without_a_mesh_writes_nothing(session, open_, tmp_path):
    open_(HOPPER)
    session.save(tmp_path / "out.vtu")
    assert session.targets(tmp_path / "out.vtu") == []


def test_steps_asked_for_while_one_goes_on_follow_it(session, show, ended):
    show()
    for _ in range(3):
        session.step()
    assert ended().iterate.number == 3
    assert len(labels(session)) == 3


def test_a_pause_forgets_the_steps_to_come(session, show, ended):
    show()
    for _ in range(3):
        session.step()
    assert ended(session.pause).iterate.number <= 1


def test_a_chase_needs_rules(session, show, said, ended):
    show()
    session.set_search(Search(optimizer="rules"))
    ended(session.run)
    assert said == ["Which rules are to be met? Choose a rule set to judge by first."]
    session.judging.judge_by("bv")
    scene = ended(session.run)
    assert labels(session)[0].startswith(f"Optimize violations of {scene.view.rules.title}: ")


def test_folded_elements_are_opened_whatever_optimiser_is_chosen(session, show, ended):
    mesh = show().mesh
    assert not session.abilities.can_untangle
    parameters = mesh.parameters.copy()
    parameters[np.flatnonzero(mesh.topology.is_free)[5]] += 2 * mesh.target_size
    folded = mesh.with_parameters(parameters)
    session.document.open(State(tracks={"H": Track((unmoved(folded, metric("stretch")),))}))
    assert session.abilities.can_untangle
    count = session.document.scene.quality.inverted_count
    assert ended(session.untangle).quality.inverted_count == 0
    assert labels(session) == [f"Optimize inverted elements: {count} → 0"]
    assert not session.abilities.can_untangle
    session.undo()
    assert np.array_equal(points(session), folded.points)


def test_only_selected_elements_are_optimised(session, show, ended):
    mesh = show().mesh
    session.set_search(Search(is_local=True, rings=0))
    session.select([40])
    moved = (ended(session.run).mesh.points != mesh.points).any(axis=1)
    assert set(np.flatnonzero(moved)) <= set(mesh.topology.elements[40].tolist())
