"""Long work outside the GUI thread: answers, progress, cancelling, and nothing left over."""

import threading
from pathlib import Path

import numpy as np
import pytest

from hullquad import pipeline, worker
from hullquad.errors import FileError, MeshingError, PlateError
from hullquad.formats import read_plates
from hullquad.metrics import metric
from hullquad.topology import NodeState
from hullquad.triangulation.contour import contours
from hullquad_app.jobs import Job, Jobs
from hullquad_app.mesher import Mesher
from hullquad_app.scene import State
from hullquad_app.work import Progress

PLATES = Path(__file__).parents[2] / "assets" / "plates"
BAD = Path(__file__).parents[1] / "data" / "bad-plates"
BLOCK = PLATES / "hopper_block.json"
STRETCH = metric("stretch")
BEST, PAPER = Mesher(), Mesher(name="paper")


def threads():
    """Threads of ours."""
    return [thread for thread in threading.enumerate() if thread.name.startswith("hullquad")]


@pytest.fixture
def jobs(qapp):
    jobs = Jobs()
    yield jobs
    jobs.stop_and_wait()
    assert threads() == []


@pytest.fixture
def block():
    plates = read_plates(BLOCK)
    return State(title=plates.name, path=BLOCK, plates=plates)


def answer(qtbot, signal, act):
    """What a signal says after an act."""
    with qtbot.waitSignal(signal, timeout=20_000) as waited:
        act()
    return waited.args[0]


def mesh(jobs, state, keys, size=None, mesher=BEST):
    """Act that meshes plates."""
    return lambda: jobs.mesh(state, keys, size, mesher, STRETCH, None)


def counted(steps, *, gate=None):
    """Work that yields its steps and returns their number."""
    for i in range(steps):
        yield Progress("counting", i, steps)
        if gate is not None:
            gate.wait()
    return steps


def test_a_job_answers_with_what_its_work_returns(jobs, qtbot):
    assert answer(qtbot, jobs.opening.done, lambda: jobs.opening.start(lambda: counted(3))) == 3
    assert not jobs.opening.is_running


def test_progress_comes_in_the_thread_of_the_window(jobs, qtbot):
    seen = []
    jobs.opening.progressed.connect(lambda progress: seen.append((progress.total, threading.current_thread())))
    answer(qtbot, jobs.opening.done, lambda: jobs.opening.start(lambda: counted(3)))
    assert seen[-1] == (3, threading.main_thread())


def test_an_unexpected_exception_comes_back(jobs, qtbot):
    broken = answer(qtbot, jobs.opening.broke, lambda: jobs.opening.start(lambda: counted("three")))
    assert isinstance(broken, TypeError)


def test_a_cancelled_job_ends_at_once_and_never_answers(jobs, qtbot):
    gate, heard = threading.Event(), []
    jobs.opening.done.connect(heard.append)
    jobs.opening.start(lambda: counted(3, gate=gate))
    with qtbot.waitSignal(jobs.opening.ended):
        jobs.opening.cancel()
    assert not jobs.opening.is_running
    gate.set()
    assert answer(qtbot, jobs.opening.done, lambda: jobs.opening.start(lambda: counted(4))) == 4
    assert heard == [4]


def test_of_two_jobs_the_later_answers(jobs, qtbot):
    heard = []
    jobs.opening.done.connect(heard.append)
    with qtbot.waitSignal(jobs.opening.ended):
        jobs.opening.start(lambda: counted(3))
        jobs.opening.start(lambda: counted(4))
    assert heard == [4]


def test_files_are_written_to_their_end_when_the_program_ends(qapp):
    ended, gate = [], threading.Event()

    def written():
        yield from counted(1, gate=gate)
        ended.append(True)

    job = Job(interrupt=gate.set, completes=True)
    job.start(written)
    job.stop_and_wait()
    assert ended == [True]


def test_a_document_is_opened_with_its_plates(jobs, qtbot):
    state = answer(qtbot, jobs.opening.done, lambda: jobs.open(BLOCK, STRETCH))
    assert (state.title, state.path, len(state.plates.plates)) == ("hopper_block", BLOCK, 14)
    assert state.tracks == {}


def test_a_refused_document_comes_back_as_its_error(jobs, qtbot):
    error = answer(qtbot, jobs.opening.refused, lambda: jobs.open(BAD / "bowtie.json", STRETCH))
    assert isinstance(error, PlateError)


def test_a_plate_is_meshed_for_a_size(jobs, block, qtbot):
    meshed = answer(qtbot, jobs.meshing.done, mesh(jobs, block, ["H1"], "fine"))
    (track,) = meshed.tracks.values()
    assert track.first.mesh.plate_id == "H1"
    assert track.first.mesh.target_size == block.plate("H1").sizes.fine
    assert meshed.refused == {}


@pytest.mark.parametrize("mesher", [BEST, Mesher(prefer="quality", grading=0.2), PAPER])
def test_a_plate_is_meshed_as_the_engine_does_by_itself(jobs, block, qtbot, mesher):
    meshed = answer(qtbot, jobs.meshing.done, mesh(jobs, block, ["H1"], 400.0, mesher))
    contour = contours(block.plates, 400.0)["H1"]
    by_itself = (
        pipeline.paper_mesh(contour) if mesher is PAPER else pipeline.best_mesh(contour, settings=mesher.settings)
    )
    assert np.array_equal(meshed.tracks["H1"].first.mesh.points, by_itself.points)
    assert meshed.mesher is mesher


@pytest.mark.parametrize("name", ["best", "paper"])
def test_elements_follow_lines_if_they_are_to(jobs, block, qtbot, name):
    meshed = answer(qtbot, jobs.meshing.done, mesh(jobs, block, ["B1"], 800.0, Mesher(name=name, follows_lines=True)))
    topology = meshed.tracks["B1"].first.mesh.topology
    assert (topology.node_states == NodeState.ON_LINE).any()


def test_the_stages_of_the_best_mesher_are_told(jobs, block, qtbot):
    told = []
    jobs.meshing.progressed.connect(lambda progress: told.append(progress.text))
    answer(qtbot, jobs.meshing.done, mesh(jobs, block, ["IB"], "very_fine"))
    assert any(text.startswith("Meshing IB: ") for text in told)


def test_plates_that_cannot_be_meshed_do_not_stop_the_others(jobs, block, qtbot):
    meshed = answer(qtbot, jobs.meshing.done, mesh(jobs, block, block.keys, mesher=PAPER))
    curved = [plate.id for plate in block.plates.plates if not plate.is_plane]
    assert list(meshed.refused) == curved
    assert isinstance(meshed.refused[curved[0]], MeshingError)
    assert len(meshed.tracks) + len(curved) == 14


def test_meshing_can_be_cancelled_while_the_worker_computes(jobs, block, qtbot):
    seen = []
    jobs.meshing.done.connect(seen.append)
    with qtbot.waitSignal(jobs.meshing.progressed):
        jobs.mesh(block, block.keys, 5.0, BEST, STRETCH, None)
    with qtbot.waitSignal(jobs.meshing.ended):
        jobs.meshing.cancel()
    assert answer(qtbot, jobs.meshing.done, mesh(jobs, block, ["H1"])).tracks.keys() == {"H1"}
    assert len(seen) == 1


def test_closing_while_meshing_leaves_no_thread_and_no_worker(block, qtbot):
    jobs = Jobs()
    with qtbot.waitSignal(jobs.meshing.progressed):
        jobs.mesh(block, block.keys, 5.0, BEST, STRETCH, None)
    jobs.stop_and_wait()
    assert threads() == []


def test_meshing_waits_until_the_kernels_are_prepared(jobs, block, qtbot, monkeypatch):
    order = []

    def fail(*_):
        order.append("meshed")
        raise ValueError

    monkeypatch.setattr(pipeline, "prepare", lambda: order.append("prepared"))
    monkeypatch.setattr(worker, "call", lambda *_, **__: order.append("worker"))
    monkeypatch.setattr(pipeline, "paper_stages", fail)
    jobs.prepare()
    answer(qtbot, jobs.meshing.broke, mesh(jobs, block, ["H1"], mesher=PAPER))
    assert order == ["worker", "prepared", "meshed"]


def test_cancelling_meshing_does_not_cancel_the_preparation(jobs, block, qtbot, monkeypatch):
    gate, cancelled = threading.Event(), []
    monkeypatch.setattr(pipeline, "prepare", lambda: None)
    monkeypatch.setattr(worker, "call", lambda *_, **__: gate.wait())
    monkeypatch.setattr(worker, "cancel", lambda: cancelled.append(True))
    jobs.prepare()
    jobs.mesh(block, ["H1"], None, BEST, STRETCH, None)
    jobs.meshing.cancel()
    assert cancelled == []
    with qtbot.waitSignal(jobs.preparing.ended):
        gate.set()


def test_a_saved_mesh_is_opened_as_it_was(jobs, block, qtbot, tmp_path):
    track = answer(qtbot, jobs.meshing.done, mesh(jobs, block, ["H1"])).tracks["H1"]
    path = tmp_path / "H1.vtu"
    assert answer(qtbot, jobs.saving.done, lambda: jobs.save({path: track.first.mesh}, STRETCH)) == [path]
    state = answer(qtbot, jobs.opening.done, lambda: jobs.open(path, STRETCH))
    assert list(state.tracks) == ["H1"]
    assert np.array_equal(state.tracks["H1"].first.mesh.points, track.first.mesh.points)


def test_a_mesh_is_not_saved_where_it_cannot_be(jobs, block, qtbot, tmp_path):
    track = answer(qtbot, jobs.meshing.done, mesh(jobs, block, ["H1"])).tracks["H1"]
    files = {tmp_path / "H1.vtu": track.first.mesh, tmp_path / "H1.xyz": track.first.mesh}
    error = answer(qtbot, jobs.saving.refused, lambda: jobs.save(files, STRETCH))
    assert isinstance(error, FileError)
    assert list(tmp_path.iterdir()) == []


def test_contours_are_divided_for_a_size(jobs, block, qtbot):
    division = answer(qtbot, jobs.dividing.done, lambda: jobs.divide(block.plates, 400.0))
    assert division.plates is block.plates
    assert division.contours["H1"].size == 400.0
