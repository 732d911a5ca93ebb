"""Limits and rule sets: chosen, remembered, saved and loaded; verdicts are reached when they are due."""

import math

import pytest
from PySide6.QtCore import QObject, QSettings

from hullquad.metrics import metric
from hullquad_app.document import Document
from hullquad_app.judging import Judging
from hullquad_app.scene import State
from hullquad_app.settings import Settings
from hullquad_app.track import Track

RULES = (
    '{"format": "hullquad rules", "version": 1, "title": "Our yard", "edition": "", "source": "QA 12",'
    ' "rules": [{"measure": "aspect_ratio", "error": [null, 1.2], "text": "close to 1", "status": "read"}]}'
)


@pytest.fixture
def settings(tmp_path):
    return Settings(QSettings(str(tmp_path / "settings.ini"), QSettings.Format.IniFormat))


@pytest.fixture
def document(qapp, walked):
    document = Document()
    document.open(State(title="dented", tracks={"dented": Track(walked.iterates[:1])}))
    return document


@pytest.fixture
def said():
    """Every error that was told."""
    return []


@pytest.fixture
def judging(document, settings, said):
    parent = QObject()
    yield Judging(document, settings, said.append, parent)
    parent.deleteLater()


def test_a_rule_set_is_judged_by_and_remembered(judging, document, settings):
    judging.judge_by("csr_fine")
    assert document.scene.assessment.rule_set.key == "csr_fine"
    assert settings.rules == "csr_fine"
    judging.judge_by("")
    assert document.scene.assessment is None
    assert settings.rules == ""


def test_a_new_session_judges_as_the_last_did(judging, settings, said):
    judging.judge_by("csr_fine")
    other = Document()
    Judging(other, settings, said.append, other)
    assert other.scene.view.rules.key == "csr_fine"


def test_a_file_of_rules_is_judged_by_and_offered_again(judging, document, settings, tmp_path):
    (tmp_path / "ours.json").write_text(RULES)
    judging.judge_by(str(tmp_path / "ours.json"))
    assert document.scene.view.rules.title == "Our yard"
    assert document.scene.assessment.levels.max() == 2
    assert settings.rule_files == [tmp_path / "ours.json"]


def test_a_file_of_rules_that_is_of_no_use_is_told(judging, document, said, tmp_path):
    (tmp_path / "bad.json").write_text("{")
    judging.judge_by(str(tmp_path / "bad.json"))
    assert "bad.json" in said[0].place
    assert document.scene.view.rules is None


def test_a_file_of_rules_that_is_gone_is_forgotten(document, settings, said):
    settings.rules = "/nowhere/ours.json"
    Judging(document, settings, said.append, document)
    assert (document.scene.view.rules, said) == (None, [])


def test_criteria_are_saved_and_loaded(judging, document, tmp_path):
    judging.set_limit(0, 0.7)
    judging.write_criteria(tmp_path / "ours.json")
    judging.reset_limits()
    assert document.scene.band == metric("stretch").band
    judging.read_criteria(tmp_path / "ours.json")
    assert document.scene.view.bands == {"stretch": (0.7, math.inf)}


def test_criteria_that_cannot_be_read_are_told_and_change_nothing(judging, document, said, tmp_path):
    judging.set_limit(0, 0.7)
    (tmp_path / "bad.json").write_text(
        '{"format": "hullquad criteria", "version": 1, "bands": {"stretsch": [0, null]}}'
    )
    judging.read_criteria(tmp_path / "bad.json")
    assert "/bands/stretsch" in said[0].place
    assert document.scene.quality.limits == (0.7,)


def test_criteria_that_cannot_be_written_are_told(judging, said, tmp_path):
    judging.write_criteria(tmp_path / "nowhere" / "ours.json")
    assert said[0].code == "E_FILE"


def test_verdicts_are_reached_seldom_while_running_and_at_once_in_the_end(judging, document, walked):
    judging.judge_by("csr_fine")
    for count in (2, 3, 4):
        document.preview(Track(walked.iterates[:count]))
    assert document.scene.mesh is walked.iterates[3].mesh
    assert document.scene.verdict.mesh is walked.iterates[1].mesh
    document.change("Run", document.scene.state.with_track("dented", Track(walked.iterates[:4])))
    assert document.scene.verdict.mesh is walked.iterates[3].mesh


def test_another_rule_set_is_judged_by_at_once_while_running(judging, document, walked):
    judging.judge_by("csr_fine")
    for count in (2, 3):
        document.preview(Track(walked.iterates[:count]))
    judging.judge_by("bv")
    assert document.scene.assessment.rule_set.key == "bv"
    assert document.scene.verdict.mesh is document.scene.mesh


def test_what_is_looked_at_otherwise_is_not_judged_again(judging, document):
    judging.judge_by("csr_fine")
    before = document.scene
    document.look(selection=frozenset({1}))
    assert document.scene.verdict is before.verdict
    judging.set_limit(0, 0.7)
    assert document.scene.verdict.assessment is before.assessment


def test_at_the_beginning_there_is_nothing_to_compare_with(document):
    document.look(metric=metric("shape"))
    assert document.scene.first_quality is document.scene.quality
