"""A dock that makes its panel when somebody sees it or asks for it."""

import pytest
from PySide6.QtCore import Qt
from PySide6.QtWidgets import QMainWindow, QWidget

from hullquad_app.colours import COLOUR_MAPS, DARK
from hullquad_app.panel_dock import PanelDock
from hullquad_app.scene import Scene


class Noted(QWidget):
    """A panel that keeps what it was told."""

    def __init__(self):
        super().__init__()
        self.scenes, self.palettes = [], []

    def show_scene(self, scene):
        self.scenes.append(scene)

    def set_palette(self, palette, chosen):
        self.palettes.append(palette)


@pytest.fixture
def docks(qtbot):
    """Two docks, one behind the other, and the panels that they have made."""
    window, made = QMainWindow(), []

    def make():
        made.append(Noted())
        return made[-1]

    front, behind = PanelDock("front", "Front", make), PanelDock("behind", "Behind", make)
    for dock in (front, behind):
        window.addDockWidget(Qt.DockWidgetArea.RightDockWidgetArea, dock)
    window.tabifyDockWidget(front, behind)
    front.raise_()
    qtbot.addWidget(window)
    window.show()
    qtbot.waitExposed(window)
    yield front, behind, made
    window.close()


def test_only_panels_that_are_seen_are_made(docks):
    front, _, made = docks
    assert [front.widget()] == made


def test_a_panel_that_comes_to_the_front_shows_the_newest_scene(docks, qtbot):
    _, behind, made = docks
    scene = Scene()
    behind.set_palette(DARK, COLOUR_MAPS[0])
    behind.show_scene(Scene())
    behind.show_scene(scene)
    behind.raise_()
    qtbot.waitUntil(lambda: len(made) == 2)
    assert (made[1].scenes, made[1].palettes) == ([scene], [DARK])


def test_a_panel_that_is_not_seen_any_more_follows_no_longer(docks, qtbot):
    front, behind, made = docks
    behind.raise_()
    qtbot.waitUntil(lambda: len(made) == 2)
    front.show_scene(Scene())
    assert made[0].scenes == []


def test_a_panel_that_is_asked_for_is_up_to_date(docks):
    _, behind, _ = docks
    scene = Scene()
    behind.show_scene(scene)
    assert behind.panel.scenes == [scene]


def test_the_place_of_a_dock_without_panel_comes_back(docks):
    front, behind, made = docks
    window = front.window()
    state = window.saveState()
    behind.hide()
    assert window.restoreState(state)
    assert behind.isVisibleTo(window)
    assert len(made) == 1
