"""The main window, as its user meets it."""

import sys
from pathlib import Path

import pytest
from PySide6.QtCore import QMimeData, QObject, QPointF, Qt, QUrl
from PySide6.QtGui import QAction, QDropEvent
from PySide6.QtWidgets import QFileDialog, QMessageBox

from hullquad import __version__
from hullquad_app.window import MainWindow

ROOT = Path(__file__).parents[2]
PLATES = ROOT / "assets" / "plates"
BLOCK = PLATES / "hopper_block.json"


@pytest.fixture
def window(qtbot):
    window = MainWindow()
    qtbot.addWidget(window)
    window.show()
    return window


def rows(table):
    """Texts of a table, row by row."""
    items = [table.topLevelItem(i) for i in range(table.topLevelItemCount())]
    return [[item.text(column) for column in range(table.columnCount())] for item in items]


def test_an_empty_window_lists_every_sample_plate(window):
    listed = rows(window.welcome.table)
    assert [file for _, file in listed] == sorted(path.name for path in PLATES.glob("*.json"))
    assert listed[0][0] == "Bilge shell plate, singly curved R=1800"


def test_a_block_is_listed_by_name_and_number_of_plates(window):
    (row,) = window.welcome.table.findItems("hopper_block.json", Qt.MatchFlag.MatchExactly, 1)
    assert row.text(0) == "hopper_block: 14 plates"


def test_a_double_click_on_a_sample_lists_its_plates(window, qtbot):
    table = window.welcome.table
    (row,) = table.findItems(BLOCK.name, Qt.MatchFlag.MatchExactly, 1)
    table.scrollToItem(row)
    place = table.visualItemRect(row).center()
    for click in (qtbot.mouseClick, qtbot.mouseDClick):
        click(table.viewport(), Qt.MouseButton.LeftButton, pos=place)
    assert len(rows(window.plates)) == 14
    assert rows(window.plates)[0] == ["B1", "bottom shell inboard", "16", "AH36", "800"]
    assert "hopper_block" in window.windowTitle()


def test_open_lists_the_plates_of_the_chosen_file(window, monkeypatch):
    monkeypatch.setattr(QFileDialog, "getOpenFileName", lambda *_: (str(BLOCK), ""))
    window.findChild(QAction, "choose_file").trigger()
    assert len(rows(window.plates)) == 14


def test_open_without_a_choice_changes_nothing(window, monkeypatch):
    monkeypatch.setattr(QFileDialog, "getOpenFileName", lambda *_: ("", ""))
    window.findChild(QAction, "choose_file").trigger()
    assert rows(window.plates) == []
    assert not window.messages.isVisible()


def test_a_dropped_file_is_opened(window):
    files = QMimeData()
    files.setUrls([QUrl.fromLocalFile(str(BLOCK))])
    actions, button, keys = Qt.DropAction.CopyAction, Qt.MouseButton.LeftButton, Qt.KeyboardModifier.NoModifier
    window.dropEvent(QDropEvent(QPointF(1, 1), actions, files, button, keys))
    assert len(rows(window.plates)) == 14


def test_a_refused_document_is_explained_in_the_message_bar(window):
    window.open(ROOT / "tests" / "data" / "bad-plates" / "bowtie.json")
    assert window.messages.isVisible()
    assert window.messages.sentence.text().startswith("E_SELF_INTERSECT at /plates/0/outer")
    window.open(BLOCK)
    assert not window.messages.isVisible()


def test_quit_closes_the_window(window):
    window.findChild(QAction, "close").trigger()
    assert not window.isVisible()


def test_about_names_the_version(window, monkeypatch):
    said = []
    monkeypatch.setattr(QMessageBox, "about", lambda *words: said.append(words[-1]))
    window.findChild(QAction, "about").trigger()
    assert __version__ in said[0]


def test_void_qt_methods_keep_their_reference_to_none(qapp):
    thing = QObject()
    before = sys.getrefcount(None)
    for _ in range(200):
        thing.setObjectName("name")
    assert abs(sys.getrefcount(None) - before) < 100
