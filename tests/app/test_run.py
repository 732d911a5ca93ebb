"""A run in its thread: what the window gets of it, in which order, and that nothing is left over."""

import threading
from pathlib import Path
from time import perf_counter

import attrs
import numpy as np
import pytest

from hullquad import pipeline, worker
from hullquad.errors import MeshError
from hullquad.formats import read_plates
from hullquad.metrics import metric
from hullquad.optimization import stops
from hullquad.optimization.paper import PaperSettings, paper_iterates
from hullquad.triangulation.contour import contours
from hullquad_app.run import Run

PLATE = Path(__file__).parents[2] / "assets" / "plates" / "hopper_partition.json"
STRETCH = metric("stretch")
ENDLESS = PaperSettings(iterations=10**6, tolerance=0.0, step=1e-5)


@pytest.fixture(scope="module")
def hopper():
    (contour,) = contours(read_plates(PLATE)).values()
    mesh = pipeline.paper_mesh(contour)
    worker.stop()
    return mesh


@pytest.fixture
def make(qapp):
    """Makes runs that end with the test, and shows that their threads do."""
    runs = []

    def made(**options):
        runs.append(Run(**options))
        return runs[-1]

    yield made
    for run in runs:
        run.stop_and_wait()
    assert not [thread for thread in threading.enumerate() if thread.name == "hullquad mailbox"]


@pytest.fixture
def run(make):
    return make()


@pytest.fixture
def heard(run):
    """Everything that the run has said, in order."""
    words = []
    run.advanced.connect(lambda iterates: words.extend(iterates))
    run.ended.connect(lambda stop: words.append(("ended", stop)))
    run.failed.connect(lambda problem: words.append(("failed", problem)))
    return words


def test_a_run_gives_the_iterates_of_the_method_bit_for_bit(run, heard, hopper, qtbot):
    settings = PaperSettings(iterations=25)
    with qtbot.waitSignal(run.ended):
        run.start(paper_iterates(hopper, STRETCH, settings))
    *iterates, end = heard
    expected = list(paper_iterates(hopper, STRETCH, settings))
    assert end == ("ended", stops.ITERATIONS)
    assert [iterate.number for iterate in iterates] == list(range(26))
    assert all(np.array_equal(a.mesh.points, b.mesh.points) for a, b in zip(iterates, expected, strict=True))


def test_a_step_is_the_mesh_and_one_iterate(run, heard, hopper, qtbot):
    with qtbot.waitSignal(run.ended):
        run.start(paper_iterates(hopper, STRETCH), 2)
    *iterates, end = heard
    assert iterates[0].mesh is hopper
    assert [iterate.number for iterate in iterates] == [0, 1]
    assert end == ("ended", None)


def test_a_pause_returns_at_once_and_the_end_follows(run, heard, hopper, qtbot):
    with qtbot.waitSignal(run.advanced):
        run.start(paper_iterates(hopper, STRETCH, ENDLESS))
    with qtbot.waitSignal(run.ended):
        run.pause()
        assert run.is_running
    assert not run.is_running
    assert heard[-1] == ("ended", None)


def test_finishing_hands_over_everything_before_it_returns(run, heard, hopper, qtbot):
    with qtbot.waitSignal(run.advanced):
        run.start(paper_iterates(hopper, STRETCH, ENDLESS))
    run.finish()
    *iterates, end = heard
    assert end == ("ended", None)
    assert [iterate.number for iterate in iterates] == list(range(len(iterates)))
    assert not run.is_running


def test_finishing_from_within_a_signal_ends_the_run_once(run, heard, hopper, qtbot):
    run.advanced.connect(lambda _: run.finish())
    with qtbot.waitSignal(run.ended):
        run.start(paper_iterates(hopper, STRETCH, ENDLESS))
    assert [word for word in heard if isinstance(word, tuple)] == [("ended", None)]


def test_nothing_is_heard_after_stopping(run, heard, hopper, qtbot):
    with qtbot.waitSignal(run.advanced):
        run.start(paper_iterates(hopper, STRETCH, ENDLESS))
    run.stop_and_wait()
    before = len(heard)
    with qtbot.assertNotEmitted(run.ended, wait=100):
        assert not run.is_running
    assert len(heard) == before


def test_what_goes_wrong_in_the_thread_is_heard(run, heard, hopper, qtbot):
    with qtbot.waitSignal(run.failed):
        run.start(paper_iterates(attrs.evolve(hopper, surface=None, parameters=None), STRETCH))
    ((word, problem),) = heard
    assert word == "failed"
    assert isinstance(problem, MeshError)


def test_a_run_can_start_again_after_its_end(run, heard, hopper, qtbot):
    for _ in range(3):
        with qtbot.waitSignal(run.ended):
            run.start(paper_iterates(hopper, STRETCH), 3)
    assert len(heard) == 3 * 4


def test_a_run_goes_on_with_the_next_iterate(run, heard, hopper, qtbot):
    iterates = paper_iterates(hopper, STRETCH, PaperSettings(iterations=9))
    for count in (3, 2, None):
        with qtbot.waitSignal(run.ended):
            run.start(iterates, count)
    assert [word.number for word in heard if not isinstance(word, tuple)] == list(range(10))
    assert [word[1] for word in heard if isinstance(word, tuple)] == [None, None, stops.ITERATIONS]


def test_two_runs_at_once_are_a_mistake_of_the_program(run, hopper):
    run.start(paper_iterates(hopper, STRETCH, ENDLESS))
    with pytest.raises(RuntimeError):
        run.start(paper_iterates(hopper, STRETCH))


def test_a_slow_window_gets_first_best_and_last_within_the_budget(make, hopper):
    run, iterates, ends = make(budget=20 * hopper.points.nbytes), [], []
    run.advanced.connect(iterates.extend)
    run.ended.connect(ends.append)
    run.start(paper_iterates(hopper, STRETCH, PaperSettings(iterations=200)))
    (thread,) = [thread for thread in threading.enumerate() if thread.name == "hullquad mailbox"]
    thread.join()  # nobody looks into the mailbox meanwhile
    run.finish()
    best = max(paper_iterates(hopper, STRETCH, PaperSettings(iterations=200)), key=lambda iterate: iterate.objective)
    assert len(iterates) < 20
    assert [iterates[0].number, iterates[-1].number] == [0, 200]
    assert best.number in {iterate.number for iterate in iterates}
    assert ends == [stops.ITERATIONS]


def test_the_next_iterates_wait_as_long_as_the_last_paint_took(run, hopper, qtbot):
    times = []
    run.advanced.connect(lambda _: times.append(perf_counter()))
    run.painted(0.2)
    run.start(paper_iterates(hopper, STRETCH, ENDLESS))
    qtbot.waitUntil(lambda: len(times) >= 3)
    assert min(np.diff(times)) > 0.19


def test_every_iterate_comes_in_the_thread_of_the_window(run, hopper, qtbot):
    threads = set()
    run.advanced.connect(lambda _: threads.add(threading.current_thread()))
    with qtbot.waitSignal(run.ended):
        run.start(paper_iterates(hopper, STRETCH, PaperSettings(iterations=50)))
    assert threads == {threading.main_thread()}
