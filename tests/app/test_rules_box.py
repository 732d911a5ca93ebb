"""By what elements are judged is chosen from a list of rule sets, and told in words."""

from math import inf
from pathlib import Path

import attrs
import pytest
from PySide6.QtCore import Qt
from PySide6.QtTest import QTest

from hullquad.metrics import metric
from hullquad.rules import MEASURES, NO_INVERTED, rule_set, rule_sets
from hullquad_app.judging import named_rules
from hullquad_app.rule_words import about, limit_of, source_of
from hullquad_app.rules_box import OTHER, RulesBox
from hullquad_app.scene import Scene, View


@pytest.fixture
def box(qtbot):
    box = RulesBox()
    qtbot.addWidget(box)
    box.show()
    box.complete()
    return box


def test_every_rule_set_can_be_chosen(box, qtbot):
    listed = [box.itemData(row) for row in range(box.count())]
    assert {row.key for row in rule_sets()} <= set(listed)
    with qtbot.waitSignal(box.picked) as signal:
        QTest.keyClick(box, Qt.Key.Key_Down)
    assert signal.args == ["table_1"]


def test_nothing_is_shown_as_chosen_before_the_document_agrees(box):
    QTest.keyClick(box, Qt.Key.Key_Down)
    assert box.currentData() == ""
    box.show_scene(Scene(view=View(rules=rule_set("csr_fine"))))
    assert box.currentText() == rule_set("csr_fine").title
    assert rule_set("csr_fine").edition in box.toolTip().replace("\n", " ")


def test_another_file_is_asked_for(box, qtbot):
    with qtbot.waitSignal(box.file_wanted), qtbot.assertNotEmitted(box.picked):
        QTest.keyClick(box, Qt.Key.Key_End)
    assert box.currentData() != OTHER


def test_files_of_the_user_are_listed(box):
    box.offer(lambda: [Path("/yard/ours.json")])
    box.complete()
    assert box.itemText(box.findData("/yard/ours.json")) == "ours"


def test_rules_in_a_file_are_known_by_its_name(tmp_path):
    file = tmp_path / "ours.json"
    file.write_text(
        '{"format": "hullquad rules", "version": 1, "title": "Our yard", "edition": "", "source": "QA 12",'
        ' "rules": [{"measure": "aspect_ratio", "error": [null, 4], "text": "at most 4", "status": "read"}]}'
    )
    found = named_rules(str(file))
    assert (found.key, found.title) == (str(file), "Our yard")


@pytest.mark.parametrize("rules", rule_sets(), ids=lambda rules: rules.key)
def test_every_rule_is_told_in_words(rules):
    assert rules.title in about(rules)
    for rule in rules.rules:
        text = " ".join(source_of(rule).split())
        assert " ".join(rule.text.split()).lower() in text.lower()
        assert ("unverified" in text.lower()) == (rule.status.value == "unverified")
        if rule.measure:
            limit = next(end for end in (rule.limits or ()) if abs(end) != float("inf"))
            assert f"{limit:.4g}" in limit_of(rule, MEASURES[rule.measure].unit).replace("−", "-")


def test_limits_have_their_unit():
    rule = attrs.evolve(NO_INVERTED, measure="corner_angle", warn=(45.0, 135.0), error=None)
    assert limit_of(rule, metric("corner_angle").unit) == "45° – 135°"
    assert limit_of(attrs.evolve(rule, warn=(-inf, 20.0), error=(-inf, 1e6)), "") == "≤ 20, fails unless ≤ 1e+06"
    assert limit_of(NO_INVERTED, "") == ""
