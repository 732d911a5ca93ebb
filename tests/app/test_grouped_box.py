"""Choosing from a long list: headings cannot be chosen, letters find a row, every row says what it is."""

import pytest
from PySide6.QtCore import Qt
from PySide6.QtTest import QTest

from hullquad.metrics import METRICS, metric
from hullquad_app.grouped_box import Choice, GroupedBox, metric_choices
from hullquad_app.metric_words import accepted, meaning, name_of


@pytest.fixture
def box(qtbot):
    box = GroupedBox()
    qtbot.addWidget(box)
    box.fill([Choice("", "none", None), Choice("One", "Ash", "ash"), Choice("Two", "Birch", "birch", "a tree")])
    box.show()
    return box


def test_keys_pass_over_headings(box, qtbot):
    box.show_choice("ash")
    with qtbot.waitSignal(box.chosen) as signal:
        QTest.keyClick(box, Qt.Key.Key_Down)
    assert signal.args == ["birch"]


def test_a_heading_cannot_be_chosen(box):
    headings = [row for row in range(box.count()) if box.itemText(row) in ("One", "Two")]
    assert len(headings) == 2
    assert not any(box.model().index(row, 0).flags() & Qt.ItemFlag.ItemIsEnabled for row in headings)


def test_letters_find_a_row_of_the_open_list(box, qtbot):
    box.showPopup()
    QTest.keyClicks(box.view(), "bi")
    with qtbot.waitSignal(box.chosen) as signal:
        QTest.keyClick(box.view(), Qt.Key.Key_Return)
    assert signal.args == ["birch"]


def test_nothing_chosen_is_a_choice(box):
    box.show_choice("birch")
    box.show_choice(None)
    assert box.currentText() == "none"


def test_filling_anew_keeps_what_is_chosen(box):
    box.show_choice("birch")
    box.fill([Choice("Two", "Birch", "birch")])
    assert box.currentText() == "Birch"


def test_every_metric_is_listed_under_its_group(qtbot):
    choices = metric_choices(METRICS)
    assert [choice.data for choice in choices] == [row.key for row in METRICS]
    assert all(choice.heading for choice in choices)


@pytest.mark.parametrize("row", METRICS, ids=lambda row: row.key)
def test_what_a_metric_is_stands_in_its_tip(row):
    text = " ".join(meaning(row).split())
    for part in (row.formula, accepted(row, row.opened(row.quads.acceptable)), row.source):
        assert " ".join(part.split()) in text
    assert ("judged by" in text) == (row.triangles is None)


def test_names_keep_their_capitals_within_a_sentence():
    assert name_of(metric("scaled_jacobian")) == "scaled Jacobian"
    assert name_of(metric("stretch")) == "stretch"
