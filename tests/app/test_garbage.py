"""Garbage with Qt's objects in it, while threads work."""

import gc
import threading

import pytest
from PySide6.QtCore import QObject

from hullquad_app.garbage import Garbage


@pytest.fixture
def garbage(qapp):
    """The collector of the window, in place of that of the tests."""
    was_enabled = gc.isenabled()
    garbage = Garbage()
    yield garbage
    garbage.release()
    if not was_enabled:
        gc.disable()


class Knot(QObject):
    """An object of Qt that only the collector can end; it keeps where that was."""

    ended: list[str]

    def __init__(self, ended):
        super().__init__()
        self.myself, self.ended = self, ended

    def __del__(self):
        self.ended.append(threading.current_thread().name)


def litter(ended):
    """Leave more garbage than Python would bear."""
    Knot(ended)
    for _ in range(20 * gc.get_threshold()[0]):
        loop = []
        loop.append(loop)


def test_a_thread_that_litters_ends_no_object_of_qt(garbage, qtbot):
    ended = []
    worker = threading.Thread(target=litter, args=(ended,))
    worker.start()
    worker.join()
    assert ended == []
    qtbot.waitUntil(lambda: ended == ["MainThread"], timeout=5000)


def test_python_collects_again_after_the_release(garbage):
    garbage.release()
    assert gc.isenabled()
