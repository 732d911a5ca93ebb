"""The tool bar gives up words before it gives up tools."""

import pytest
from PySide6.QtCore import Qt
from PySide6.QtGui import QAction, QIcon, QPixmap
from PySide6.QtWidgets import QLabel, QMainWindow

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


def test_boxes_are_squeezed_where_icons_do_not_fit_either(qtbot):
    squeezed = []
    window = QMainWindow()
    qtbot.addWidget(window)
    action = QAction(QIcon(QPixmap(20, 20)), "Word", window)
    window.addToolBar(Tools("Tools", ([action], [QLabel("a very long text " * 5)]), squeezed.append))
    window.resize(300, 200)
    window.show()
    qtbot.waitUntil(lambda: squeezed[-1])
    window.resize(1500, 200)
    qtbot.waitUntil(lambda: not squeezed[-1])
