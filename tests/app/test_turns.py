"""Work in turns: piece by piece, with everything else in between."""

import pytest
from PySide6.QtCore import QTimer

from hullquad.metrics import metric
from hullquad_app.document import Document
from hullquad_app.live import Live
from hullquad_app.scene import State
from hullquad_app.turns import Turns


@pytest.fixture
def turns(qapp):
    turns = Turns()
    yield turns
    turns.stop()


class Listener:
    """Keeps the scenes that it is told to show."""

    def __init__(self):
        self.scenes = []

    def show_scene(self, scene):
        self.scenes.append(scene)


def test_pieces_are_done_in_the_order_of_asking(turns, qtbot):
    done = []
    for name in "abc":
        turns.ask(lambda name=name: done.append(name))
    assert done == []
    qtbot.waitUntil(lambda: len(done) == 3)
    assert done == ["a", "b", "c"]


def test_a_piece_that_is_asked_for_twice_is_done_once(turns, qtbot):
    done = []

    def piece():
        done.append(1)

    turns.ask(piece)
    turns.ask(piece)
    turns.ask(lambda: done.append("last"))
    qtbot.waitUntil(lambda: "last" in done)
    assert done == [1, "last"]


def test_what_waits_gets_its_turn_between_two_pieces(turns, qtbot):
    done = []

    def piece():
        done.append("piece")
        QTimer.singleShot(0, lambda: done.append("other"))

    for _ in range(2):
        turns.ask(lambda: piece())
    qtbot.waitUntil(lambda: len(done) == 4)
    assert done == ["piece", "other"] * 2


def test_a_piece_may_ask_for_another(turns, qtbot):
    done = []
    turns.ask(lambda: turns.ask(lambda: done.append(1)))
    qtbot.waitUntil(lambda: done == [1])


def test_nothing_is_done_after_stopping(turns, qtbot):
    done = []
    turns.ask(lambda: done.append("before"))
    turns.stop()
    turns.ask(lambda: done.append("after"))
    qtbot.waitUntil(lambda: bool(done))
    assert done == ["after"]


def test_the_clock_rests_when_there_is_nothing_to_do(turns, qtbot):
    turns.ask(lambda: None)
    (clock,) = turns.findChildren(QTimer)
    assert clock.isActive()
    qtbot.waitUntil(lambda: not clock.isActive())


def test_every_group_gets_the_newest_scene_in_a_turn_of_its_own(turns, qtbot, walked):
    document, view, table = Document(), Listener(), Listener()
    live = Live(document, turns)
    live.follow(view)
    live.follow(table, seldom=True)
    document.open(State(tracks={"plate": walked}))
    live.show()
    document.look(metric=metric("shape"))
    qtbot.waitUntil(lambda: bool(table.scenes))
    assert view.scenes == table.scenes == [document.scene]


def test_what_is_read_follows_less_often_than_what_is_watched(turns, qtbot, walked):
    document, view, table = Document(), Listener(), Listener()
    live = Live(document, turns)
    live.follow(view)
    live.follow(table, seldom=True)
    document.open(State(tracks={"plate": walked}))
    for count in range(1, 4):
        live.show()
        qtbot.waitUntil(lambda count=count: len(view.scenes) == count)
    assert len(table.scenes) < 3
