"""The element inspector: every value of the selected element, its edges and corners."""

import attrs
import pytest
from PySide6.QtCore import QPointF, QRectF, Qt
from PySide6.QtGui import QColor, QImage, QPainter

from hullquad.metrics import METRICS, metric
from hullquad.quality import quality
from hullquad_app.canvas.dimensions import Sheet, draw_dimensions, length_words
from hullquad_app.colours import DARK, LIGHT
from hullquad_app.panels.element import ElementPanel
from hullquad_app.panels.figures import valued
from hullquad_app.panels.reading_rows import COLUMNS
from hullquad_app.scene import Scene, View
from hullquad_app.track import Track
from hullquad_app.verdict import verdict

QUAD, TRIANGLE = 4, 8


def scene(iterate, row=QUAD, key="stretch", bands=None, **more):
    by, bands = metric(key), bands or {}
    judged = quality(iterate.mesh, by, bands.get(key))
    view = View(metric=by, bands=bands, selection=frozenset() if row is None else frozenset({row}))
    found = verdict(iterate.mesh, judged, None, None)
    return Scene(track=Track((iterate,)), quality=judged, verdict=found, view=view, **more)


@pytest.fixture
def panel(qtbot):
    panel = ElementPanel()
    qtbot.addWidget(panel)
    panel.resize(400, 500)
    panel.show()
    return panel


def rows(panel, name="metric"):
    """Texts of a column, headings included."""
    return [panel.model.index(row, COLUMNS.index(name)).data() for row in range(panel.model.rowCount())]


def row_of(panel, key):
    return next(row for row in range(panel.model.rowCount()) if panel.model.metric(row) is metric(key))


def cell(panel, key, name, role=Qt.ItemDataRole.DisplayRole):
    return panel.model.index(row_of(panel, key), COLUMNS.index(name)).data(role)


def test_every_metric_is_listed_under_its_heading(panel, walked):
    panel.show_scene(scene(walked.first))
    groups = list(dict.fromkeys(row.group for row in METRICS))
    assert [text for text in rows(panel) if text in groups] == groups
    assert panel.model.rowCount() == len(METRICS) + len(groups)


@pytest.mark.parametrize("row", [QUAD, TRIANGLE])
def test_values_and_verdicts_are_those_of_the_mesh(panel, walked, row):
    panel.show_scene(scene(walked.first, row))
    for by in METRICS:
        whole = quality(walked.first.mesh, by)
        judge = by.triangle_metric if whole.is_triangle[row] else by
        assert cell(panel, by.key, "value") == valued(float(whole.values[row]), judge)
        assert cell(panel, by.key, "state").startswith("FAIL" if whole.failing[row] else "pass")


def test_limits_are_those_of_the_user(panel, walked):
    panel.show_scene(scene(walked.first, bands={"stretch": (0.999, float("inf"))}))
    assert cell(panel, "stretch", "band") == "at least 0.999"
    assert cell(panel, "stretch", "state") == "FAIL"


def test_a_triangle_says_what_it_is_judged_by(panel, walked):
    panel.show_scene(scene(walked.first, TRIANGLE))
    assert cell(panel, "taper", "metric") == "Taper, by shape"
    assert panel.title.text() == "Element 9, triangle"


def test_what_fails_can_be_listed_alone(panel, walked, qtbot):
    panel.show_scene(scene(walked.first))
    qtbot.keyClick(panel.only_failing, Qt.Key.Key_Space)
    states = [text for text in rows(panel, "state") if text]
    assert states
    assert all(text.startswith("FAIL") for text in states)


def test_edges_and_corners_are_told_and_the_worst_one(panel, walked):
    now = scene(walked.first, key="max_angle")
    panel.show_scene(now)
    anatomy = now.inspection.anatomy
    assert all(length_words(length) in panel.shape.text() for length in anatomy.edge_lengths)
    assert f"<b>{anatomy.corner_angles.max():.1f}° worst</b>" in panel.shape.text()
    assert "by max. angle" in panel.shape.toolTip()


def test_a_double_click_wants_the_metric(panel, walked, qtbot):
    panel.show_scene(scene(walked.first))
    place = panel.table.visualRect(panel.model.index(row_of(panel, "aspect_ratio"), 0)).center()
    with qtbot.waitSignal(panel.metric_wanted) as signal:
        qtbot.mouseClick(panel.table.viewport(), Qt.MouseButton.LeftButton, pos=place)
        qtbot.mouseDClick(panel.table.viewport(), Qt.MouseButton.LeftButton, pos=place)
    assert signal.args == ["aspect_ratio"]


@pytest.mark.parametrize("selection", [frozenset(), frozenset({1, 2})])
def test_nothing_is_told_of_none_or_several(panel, walked, selection):
    now = scene(walked.first)
    panel.show_scene(now)
    panel.show_scene(attrs.evolve(now, view=attrs.evolve(now.view, selection=selection)))
    assert panel.model.rowCount() == 0
    assert not panel.title.isVisible()


def test_nothing_is_computed_while_nobody_looks(panel, walked):
    panel.hide()
    now = scene(walked.first)
    panel.show_scene(now)
    assert panel.model.rowCount() == 0
    panel.show()
    assert panel.model.rowCount() > len(METRICS)


def drawn(inspection, palette, outline):
    """A picture of the dimensions of an element."""
    image = QImage(600, 400, QImage.Format.Format_RGB32)
    image.fill(QColor(palette.view))
    painter = QPainter(image)
    draw_dimensions(Sheet(painter, palette, QRectF(image.rect()), QRectF()), outline, inspection)
    painter.end()
    return image


def share_of(image, colour, area):
    """Pixels of a colour in an area."""
    wanted = QColor(colour).rgb()
    return sum(
        image.pixel(x, y) == wanted
        for x in range(round(area.left()), round(area.right()))
        for y in range(round(area.top()), round(area.bottom()))
    )


@pytest.mark.parametrize("palette", [LIGHT, DARK], ids=["light", "dark"])
def test_the_worst_corner_of_a_large_element_is_marked_at_the_corner(qapp, walked, palette):
    found = scene(walked.first, key="max_angle").inspection
    outline = [QPointF(100, 350), QPointF(400, 350), QPointF(400, 50), QPointF(100, 50)]
    image = drawn(found, palette, outline)
    marks = [
        share_of(image, palette.fail, QRectF(0, 0, 60, 60).translated(corner - QPointF(30, 30))) for corner in outline
    ]
    assert max(range(4), key=marks.__getitem__) == found.worst_corner
    assert sum(count > 0 for count in marks) == 1


def test_a_small_element_is_drawn_large_beside(qapp, walked):
    found = scene(walked.first).inspection
    outline = [QPointF(50, 370), QPointF(70, 370), QPointF(70, 350), QPointF(50, 350)]
    image = drawn(found, LIGHT, outline)
    assert share_of(image, LIGHT.background, QRectF(300, 0, 300, 250)) > 5000


def test_the_drawing_beside_does_not_hide_its_element(qapp, walked):
    found = scene(walked.first).inspection
    outline = [QPointF(550, 60), QPointF(570, 60), QPointF(570, 40), QPointF(550, 40)]
    image = drawn(found, LIGHT, outline)
    assert share_of(image, LIGHT.background, QRectF(530, 20, 60, 60)) == 0
