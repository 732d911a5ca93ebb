"""The rules of a set and what breaks them: counts, words, linked selection."""

import attrs
import numpy as np
import pytest
from PySide6.QtCore import Qt
from PySide6.QtGui import QColor, QImage

from hullquad.metrics import metric
from hullquad.quality import quality
from hullquad.rules import Level, Rule, RuleSet, Status, rule_set
from hullquad_app.canvas.legend import legend_of
from hullquad_app.colours import DARK, LIGHT
from hullquad_app.level_colours import LEVELS
from hullquad_app.panels.cell import CELL
from hullquad_app.panels.rule_rows import COLUMNS
from hullquad_app.panels.rules import RulesPanel
from hullquad_app.scene import Scene, View
from hullquad_app.track import Track
from hullquad_app.verdict import verdict

LEFT = Qt.MouseButton.LeftButton
STRICT = RuleSet(
    key="strict",
    title="Strict",
    edition="2026",
    source="QA 12",
    rules=(
        Rule(measure="aspect_ratio", title="Aspect ratio", warn=(-np.inf, 1.2), error=(-np.inf, 1.5),
             text="close to 1", source="QA 12, 3.1", status=Status.READ),
        Rule(measure="", title="Elements over the depth", text="three or more", source="QA 12",
             status=Status.UNVERIFIED, not_evaluated="depths are unknown"),
    ),
)  # fmt: skip


def scene(iterate, rules=STRICT, selection=frozenset(), **more):
    judged = quality(iterate.mesh, metric("stretch"))
    found = verdict(iterate.mesh, judged, rules, None)
    view = View(rules=rules, selection=selection)
    return Scene(track=Track((iterate,)), quality=judged, verdict=found, view=view, **more)


@pytest.fixture
def panel(qtbot):
    panel = RulesPanel()
    qtbot.addWidget(panel)
    panel.resize(420, 400)
    panel.show()
    return panel


def cell(panel, row, name, role=Qt.ItemDataRole.DisplayRole):
    return panel.model.index(row, COLUMNS.index(name)).data(role)


def middle(panel, row):
    return panel.table.visualRect(panel.model.index(row, COLUMNS.index("rule"))).center()


def test_every_rule_has_a_row_with_its_counts(panel, walked):
    now = scene(walked.first)
    panel.show_scene(now)
    assert panel.model.rowCount() == 3
    aspect = now.assessment.findings[1]
    assert cell(panel, 1, "rule") == "Aspect ratio · ≤ 1.2, fails unless ≤ 1.5"
    assert cell(panel, 1, "warn") == str(aspect.count(Level.WARN))
    assert cell(panel, 1, "error") == str(aspect.count(Level.ERROR))
    assert cell(panel, 1, "given") == str(aspect.given.sum())
    assert aspect.count(Level.ERROR) > 0


def test_a_rule_says_whether_it_was_read_and_where(panel, walked):
    panel.show_scene(scene(walked.first))
    assert cell(panel, 1, "rule", CELL).detail == "read: close to 1"
    assert "QA 12, 3.1" in cell(panel, 1, "rule", Qt.ItemDataRole.ToolTipRole)


def test_what_is_not_evaluated_says_why(panel, walked):
    panel.show_scene(scene(walked.first))
    assert cell(panel, 2, "rule", CELL).detail == "not evaluated: depths are unknown"
    assert [cell(panel, 2, name) for name in ("warn", "error", "given")] == ["–"] * 3
    assert cell(panel, 2, "swatch", Qt.ItemDataRole.DecorationRole) is None


def test_the_swatch_has_the_colour_of_the_worst_level(panel, walked):
    panel.show_scene(scene(walked.first))
    colours = [cell(panel, row, "swatch", Qt.ItemDataRole.DecorationRole) for row in (0, 1)]
    assert colours == [QColor(LEVELS[Level.OK]), QColor(LEVELS[Level.ERROR])]


def test_a_click_selects_the_elements_that_break_a_rule(panel, walked, qtbot):
    now = scene(walked.first)
    panel.show_scene(now)
    with qtbot.waitSignal(panel.selected) as signal:
        qtbot.mouseClick(panel.table.viewport(), LEFT, pos=middle(panel, 1))
    assert signal.args == [frozenset(now.assessment.findings[1].rows.tolist()), False]


def test_a_double_click_zooms_to_them(panel, walked, qtbot):
    now = scene(walked.first)
    panel.show_scene(now)
    with qtbot.waitSignal(panel.zoom_wanted) as signal:
        qtbot.mouseClick(panel.table.viewport(), LEFT, pos=middle(panel, 1))
        qtbot.mouseDClick(panel.table.viewport(), LEFT, pos=middle(panel, 1))
    assert signal.args == [frozenset(now.assessment.findings[1].rows.tolist())]


def test_the_rule_whose_elements_are_selected_is_marked(panel, walked):
    now = scene(walked.first)
    panel.show_scene(now)
    rows = frozenset(now.assessment.findings[1].rows.tolist())
    panel.show_scene(attrs.evolve(now, view=attrs.evolve(now.view, selection=rows)))
    assert {index.row() for index in panel.table.selectionModel().selectedIndexes()} == {1}


def test_the_legend_counts_the_levels(walked):
    now = scene(walked.first)
    counts = now.assessment.counts
    title, entries = legend_of(now)
    assert title == "Strict"
    words = [f"{counts[level]} {word}" for level, word in zip(Level, ("ok", "warn", "fail"), strict=True)]
    assert [entry.text for entry in entries][:3] == words
    assert [entry.colour for entry in entries][:3] == list(LEVELS)


def test_the_set_is_named(panel, walked):
    panel.show_scene(scene(walked.first))
    assert panel.title.text() == "Strict"
    assert "QA 12" in panel.title.toolTip()


def test_without_a_rule_set_nothing_is_listed(panel, walked):
    panel.show_scene(scene(walked.first))
    panel.show_scene(scene(walked.first, rules=None))
    assert panel.model.rowCount() == 0
    assert not panel.title.isVisible()


def test_a_run_refreshes_seldom(panel, walked):
    panel.show_scene(scene(walked.iterates[0], running=True))
    told = []
    panel.model.dataChanged.connect(lambda *_: told.append(1))
    for iterate in walked.iterates[1:5]:
        panel.show_scene(scene(iterate, running=True))
    assert told == []
    panel.show_scene(scene(walked.iterates[5]))
    assert told


@pytest.mark.parametrize("width", [200, 420])
@pytest.mark.parametrize("palette", [LIGHT, DARK], ids=["light", "dark"])
def test_it_is_drawn_in_both_themes_and_narrow(panel, walked, palette, width):
    panel.resize(width, 300)
    panel.show_scene(scene(walked.first, rules=rule_set("table_1")))
    panel.set_palette(palette)
    picture = QImage(panel.size(), QImage.Format.Format_RGB32)
    panel.render(picture)
    assert picture.pixelColor(2, 2) == QColor(palette.panel)
