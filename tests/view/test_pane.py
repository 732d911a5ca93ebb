"""The picture of the plate in its widget."""

import numpy as np
import pytest
from PySide6.QtGui import QColor
from PySide6.QtWidgets import QWidget

from hullquad_app.canvas.drawing import Drawing
from hullquad_app.canvas.pane import Pane
from hullquad_app.turns import Turns


@pytest.fixture
def pane(qtbot):
    """A pane on the screen, with nothing on a red ground."""
    parent = QWidget()
    parent.resize(301, 203)
    turns = Turns(parent)
    pane = Pane(parent, turns)
    pane.renderer.SetBackground(1.0, 0.0, 0.0)
    pane.setGeometry(parent.rect())
    with qtbot.waitSignal(pane.painted):
        parent.show()
    yield pane
    turns.stop()
    pane.finish()
    parent.close()
    parent.deleteLater()


def colours(pane):
    """Every colour that the pane shows."""
    image = pane.grab().toImage()
    return {image.pixelColor(x, y).name() for x in range(image.width()) for y in range(image.height())}


def test_it_shows_what_is_drawn_from_edge_to_edge(pane):
    assert colours(pane) == {"#ff0000"}


def test_a_change_is_seen_after_a_refresh(pane, qtbot):
    pane.renderer.SetBackground(0.0, 0.0, 1.0)
    assert colours(pane) == {"#ff0000"}
    with qtbot.waitSignal(pane.painted):
        pane.refresh()
    assert colours(pane) == {"#0000ff"}


def test_painting_it_again_draws_nothing(pane, qtbot):
    with qtbot.assertNotEmitted(pane.painted, wait=50):
        pane.repaint()


def test_another_size_is_drawn_at_once(pane, qtbot):
    with qtbot.waitSignal(pane.painted):
        pane.resize(150, 90)
        pane.repaint()
    assert colours(pane) == {"#ff0000"}


def test_a_hidden_one_draws_nothing(pane, qtbot):
    pane.hide()
    with qtbot.assertNotEmitted(pane.painted, wait=50):
        pane.refresh()


def test_nothing_is_drawn_after_the_end(pane, qtbot):
    pane.finish()
    with qtbot.assertNotEmitted(pane.painted, wait=50):
        pane.refresh()


def test_rows_of_pixels_run_downwards():
    drawing = Drawing()
    drawing.renderer.GradientBackgroundOn()
    drawing.renderer.SetBackground(0.0, 0.0, 0.0)  # below
    drawing.renderer.SetBackground2(1.0, 1.0, 1.0)
    pixels = drawing.pixels(8, 32)
    drawing.finish()
    assert pixels.shape == (32, 8, 4)
    assert QColor(*pixels[0, 0, :3].tolist()).lightness() > 200
    assert (np.diff(pixels[:, 0, 0].astype(int)) <= 0).all()
