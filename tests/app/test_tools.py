"""The tool bar gives up words before it gives up tools."""

import pytest
from PySide6.QtCore import Qt
from PySide6.QtGui import QAction, QIcon, QPixmap
from PySide6.QtWidgets import QMainWindow

from hullquad_app.tools import Tools


@pytest.fixture
def window(qtbot):
    window = QMainWindow()
    qtbot.addWidget(window)
    actions = [QAction(QIcon(QPixmap(20, 20)), f"Quite a long word {number}", window) for number in range(4)]
    window.bar = Tools("Tools", (actions[:2], actions[2:]))
    window.addToolBar(window.bar)
    window.show()
    return window


@pytest.mark.parametrize(("width", "style"), [(1200, "ToolButtonTextBesideIcon"), (300, "ToolButtonIconOnly")])
def test_words_are_shown_where_there_is_room(window, qtbot, width, style):
    window.resize(width, 200)
    qtbot.waitUntil(lambda: window.bar.toolButtonStyle() == getattr(Qt.ToolButtonStyle, style))
    buttons = [window.bar.widgetForAction(action) for action in window.bar.actions() if not action.isSeparator()]
    qtbot.waitUntil(lambda: all(button.isVisible() for button in buttons))


def test_words_come_back_with_the_room(window, qtbot):
    for width in (300, 1200):
        window.resize(width, 200)
    qtbot.waitUntil(lambda: window.bar.toolButtonStyle() == Qt.ToolButtonStyle.ToolButtonTextBesideIcon)
