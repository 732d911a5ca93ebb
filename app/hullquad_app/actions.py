"""The table of actions: menu, text, key, tip, and the method of the window that each one calls."""

import attrs
from PySide6.QtCore import QT_TRANSLATE_NOOP, QCoreApplication
from PySide6.QtGui import QAction, QKeySequence
from PySide6.QtWidgets import QMainWindow


@attrs.frozen
class Row:
    """One action; its texts are translated when the menus are filled."""

    menu: str
    text: str
    tip: str
    calls: str
    keys: QKeySequence.StandardKey = QKeySequence.StandardKey.UnknownKey


_FILE = str(QT_TRANSLATE_NOOP("Actions", "&File"))
_HELP = str(QT_TRANSLATE_NOOP("Actions", "&Help"))

ROWS = (
    Row(
        _FILE,
        str(QT_TRANSLATE_NOOP("Actions", "&Open…")),
        str(QT_TRANSLATE_NOOP("Actions", "Open a plate document")),
        "choose_file",
        QKeySequence.StandardKey.Open,
    ),
    Row(
        _FILE,
        str(QT_TRANSLATE_NOOP("Actions", "&Quit")),
        str(QT_TRANSLATE_NOOP("Actions", "Close the window and end the program")),
        "close",
        QKeySequence.StandardKey.Quit,
    ),
    Row(
        _HELP,
        str(QT_TRANSLATE_NOOP("Actions", "&About HullQuad")),
        str(QT_TRANSLATE_NOOP("Actions", "What this program is, and its version")),
        "about",
    ),
)


def fill_menus(window: QMainWindow) -> None:
    """Give the window a menu bar with an action for each row, named by what it calls."""
    menus = {title: window.menuBar().addMenu(_translated(title)) for title in dict.fromkeys(row.menu for row in ROWS)}
    for row in ROWS:
        action = QAction(_translated(row.text), window)
        action.setObjectName(row.calls)
        action.setStatusTip(_translated(row.tip))
        action.setShortcut(QKeySequence(row.keys))
        action.triggered.connect(getattr(window, row.calls))
        menus[row.menu].addAction(action)


def _translated(text: str) -> str:
    return QCoreApplication.translate("Actions", text)
