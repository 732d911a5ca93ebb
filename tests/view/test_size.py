"""How small the window can be."""

import pytest
from PySide6.QtCore import QSettings
from PySide6.QtGui import QFont
from PySide6.QtWidgets import QApplication

from hullquad.metrics import metric
from hullquad.optimization.paper import unmoved
from hullquad_app.scene import State
from hullquad_app.session import Session
from hullquad_app.settings import Settings
from hullquad_app.track import Track
from hullquad_app.window import MainWindow


@pytest.fixture
def large_letters(qapp):
    """Fourteen points in everything that is made."""
    usual = QApplication.font()
    large = QFont(usual)
    large.setPointSizeF(14)
    QApplication.setFont(large)
    yield
    QApplication.setFont(usual)


@pytest.fixture
def window(large_letters, qtbot, tmp_path):
    window = MainWindow(Session(Settings(QSettings(str(tmp_path / "s.ini"), QSettings.Format.IniFormat))))
    window.resize(1100, 700)
    window.show()
    qtbot.waitExposed(window)
    yield window
    window.session.stop_and_wait()
    window.session.document.edits.setClean()
    window.close()
    window.deleteLater()


def is_small(window):
    """Whether the window is, and can stay, as small as it was made."""
    least = window.minimumSizeHint()
    return (window.width(), window.height()) == (1100, 700) and least.width() <= 1100 and least.height() <= 700


def test_a_small_window_is_enough_for_large_letters(window, partition, folded, qtbot):
    session = window.session
    assert is_small(window)
    session.document.open(State(title="hopper_partition", plates=partition))
    QApplication.processEvents()
    assert is_small(window)
    track = Track((unmoved(folded, metric("stretch")),))
    session.document.change("Mesh", session.document.scene.state.with_track("hopper_partition", track))
    session.choose_metric("min_angle")
    session.judging.set_limit(0, 60.0)
    for panel in (window.docks.inspect, window.docks.toggle_search, window.docks.next_worst):
        panel()
        QApplication.processEvents()
        assert is_small(window)
    session.message.emit("Something is wrong with a plate whose name is long. " * 3)
    QApplication.processEvents()
    assert is_small(window)
