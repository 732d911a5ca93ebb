"""A minute of somebody who presses everything: no exception, no warning of Qt, nothing left behind.

``python3 run.py test tests/soak``
"""

import gc
import os
import random
import sys
import threading
import time
from pathlib import Path

if sys.platform.startswith("linux"):
    os.environ.setdefault("QT_QPA_PLATFORM", "xcb")

import pytest
from PySide6.QtCore import QEvent, QMimeData, QPoint, QPointF, QSettings, Qt, QUrl
from PySide6.QtGui import QAction, QDropEvent
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QApplication, QFileDialog, QMenu, QMessageBox, QWidget

from hullquad.optimization.paper import PaperSettings
from hullquad_app.session import Session
from hullquad_app.settings import Settings
from hullquad_app.window import MainWindow

SECONDS = 20.0
SEEDS = (1, 2, 3)
ROOT = Path(__file__).parents[2]
FILES = sorted([*(ROOT / "assets" / "plates").glob("*.json"), *(ROOT / "tests" / "data" / "bad-plates").glob("*.json")])
NAMED = "Escape Tab Backspace Return Delete Home End Left Up Right Down PageUp PageDown Space F5 F6 F7 F8 F9 Plus Minus"
KEYS = [
    *map(Qt.Key, (*range(Qt.Key.Key_0, Qt.Key.Key_9 + 1), *range(Qt.Key.Key_A, Qt.Key.Key_Z + 1))),
    *(getattr(Qt.Key, f"Key_{name}") for name in NAMED.split()),
]
NEVER = {"close"}


class Monkey:
    """Does something at random with a window, again and again."""

    def __init__(self, window: MainWindow, seed: int) -> None:
        self.window = window
        self.choose = random.Random(seed)
        self.deeds = [self.press, self.click, self.click, self.trigger, self.trigger, self.drop, self.turn, self.resize]

    def act(self) -> None:
        """One deed, and then a moment; dialogs and menus that came up are closed."""
        self.choose.choice(self.deeds)()
        QTest.qWait(self.choose.choice((0, 1, 20, 100)))
        while (above := QApplication.activeModalWidget() or QApplication.activePopupWidget()) is not None:
            above.close()
        if not self.window.isVisible():
            self.window.show()

    def press(self) -> None:
        target = QApplication.focusWidget() or self.window
        modifiers = self.choose.choice([Qt.KeyboardModifier.NoModifier] * 3 + [Qt.KeyboardModifier.ShiftModifier])
        QTest.keyClick(target, self.choose.choice(KEYS), modifiers)

    def click(self) -> None:
        widgets = [one for one in self.window.findChildren(QWidget) if one.isVisible() and not isinstance(one, QMenu)]
        target = self.choose.choice(widgets)
        place = QPoint(self.choose.randrange(max(target.width(), 1)), self.choose.randrange(max(target.height(), 1)))
        deed = self.choose.choice([QTest.mouseClick, QTest.mouseClick, QTest.mouseDClick, QTest.mouseMove])
        if deed is QTest.mouseMove:
            deed(target, place)
        else:
            deed(target, Qt.MouseButton.LeftButton, Qt.KeyboardModifier.NoModifier, place)

    def trigger(self) -> None:
        actions = [
            one for one in self.window.findChildren(QAction) if one.isEnabled() and one.objectName() not in NEVER
        ]
        self.choose.choice(actions).trigger()

    def drop(self) -> None:
        files = QMimeData()
        files.setUrls([QUrl.fromLocalFile(str(self.choose.choice(FILES)))])
        actions, button, keys = Qt.DropAction.CopyAction, Qt.MouseButton.LeftButton, Qt.KeyboardModifier.NoModifier
        self.window.dropEvent(QDropEvent(QPointF(1, 1), actions, files, button, keys))

    def turn(self) -> None:
        canvas = self.window.canvas
        start, end = (QPoint(self.choose.randrange(600), self.choose.randrange(500)) for _ in range(2))
        QTest.mousePress(canvas, Qt.MouseButton.LeftButton, Qt.KeyboardModifier.NoModifier, start)
        QTest.mouseMove(canvas, end)
        QTest.mouseRelease(canvas, Qt.MouseButton.LeftButton, Qt.KeyboardModifier.NoModifier, end)

    def resize(self) -> None:
        self.window.resize(self.choose.randrange(1100, 1800), self.choose.randrange(700, 1100))


@pytest.mark.parametrize("seed", SEEDS)
def test_a_monkey_breaks_nothing(seed, qtbot, tmp_path, monkeypatch):
    answers = random.Random(seed)
    buttons = QMessageBox.StandardButton
    monkeypatch.setattr(
        QMessageBox, "question", lambda *_: answers.choice([buttons.Discard, buttons.Cancel, buttons.Save])
    )
    monkeypatch.setattr(QFileDialog, "getOpenFileName", lambda *_: (str(answers.choice(FILES)), ""))
    monkeypatch.setattr(
        QFileDialog, "getSaveFileName", lambda *_: (str(tmp_path / answers.choice(["a.vtu", "b.png", "c.xyz"])), "")
    )
    widgets = set(QApplication.topLevelWidgets())
    window = MainWindow(Session(Settings(QSettings(str(tmp_path / "s.ini"), QSettings.Format.IniFormat))))
    window.session.set_paper(PaperSettings(iterations=200))
    window.show()
    window.start()
    monkey, end, deeds = Monkey(window, seed), time.monotonic() + SECONDS, 0
    while time.monotonic() < end:
        monkey.act()
        deeds += 1
    assert deeds > 100
    window.session.stop_and_wait()
    window.session.document.edits.setClean()
    window.close()
    assert [thread.name for thread in threading.enumerate() if thread.name.startswith("hullquad")] == []
    window.deleteLater()
    QApplication.sendPostedEvents(None, QEvent.Type.DeferredDelete)
    gc.collect()
    assert set(QApplication.topLevelWidgets()) <= widgets
