"""Dividing contours and edges of large documents: told when it takes long, and given up; of small ones not a word."""

import threading
from pathlib import Path

import pytest
from PySide6.QtCore import QSettings

from hullquad.formats import read_plates
from hullquad.triangulation.evening import evening
from hullquad_app import work
from hullquad_app.division import dividing
from hullquad_app.session import Session
from hullquad_app.settings import Settings

PLATES = Path(__file__).parents[2] / "assets" / "plates"
BLOCK = PLATES / "hopper_block.json"


@pytest.fixture
def session(qapp, qtbot, tmp_path):
    session = Session(Settings(QSettings(str(tmp_path / "settings.ini"), QSettings.Format.IniFormat)))
    with qtbot.waitSignal(session.opened, timeout=10_000):
        session.open(BLOCK)
    yield session
    session.stop_and_wait()


@pytest.fixture
def told(session):
    """What is told to go on."""
    texts = []
    session.busy.connect(lambda *progress: texts.append(progress))
    return texts


@pytest.fixture
def gate(monkeypatch):
    """Holds up what divides contours and edges before its second step."""
    gate = threading.Event()

    def held(steps):
        def slowly(*given, **options):
            going_on = steps(*given, **options)
            yield next(going_on)
            gate.wait()
            return (yield from going_on)

        return slowly

    for name in ("dividing", "redividing"):
        monkeypatch.setattr(work, name, held(getattr(work, name)))
    yield gate
    gate.set()


def ended(session, qtbot):
    jobs = session.workshop.jobs
    qtbot.waitUntil(lambda: not any(job.is_running for job in jobs.all), timeout=20_000)


@pytest.mark.parametrize("act", ["divide", "redivide"])
def test_long_work_is_told_and_can_be_cancelled(session, qtbot, gate, told, act):
    state = session.document.scene.state
    with qtbot.waitSignal(session.busy, timeout=10_000):
        session.divide("fine") if act == "divide" else session.redivide(None, "fine")
    assert told[-1][0] == {"divide": "Dividing contours", "redivide": "Dividing edges"}[act]
    assert session.abilities.can_cancel
    with qtbot.waitSignal(session.idle, timeout=10_000):
        session.cancel()
    assert not session.abilities.can_cancel
    gate.set()
    qtbot.wait(100)
    assert session.document.scene.state is state


def test_what_is_done_in_a_moment_is_not_told(session, qtbot, told, monkeypatch):
    monkeypatch.setattr("hullquad_app.workshop.PATIENCE", 60_000)  # however busy the machine
    session.divide(500.0)
    ended(session, qtbot)
    assert told == []


def test_nothing_is_meshed_while_edges_are_divided(session, qtbot, gate):
    assert session.abilities.can_mesh
    session.redivide(None, "fine")
    assert not session.abilities.can_mesh
    assert not session.abilities.can_mesh_all
    gate.set()
    ended(session, qtbot)
    assert session.abilities.can_mesh


def test_steps_tell_how_much_is_left():
    plates = read_plates(BLOCK)
    assert list(dividing(plates, "fine"))[:15] == [0, *range(14)]
    left = list(evening(plates, "fine"))
    assert left == sorted(left, reverse=True)
    assert left[0] > 1
