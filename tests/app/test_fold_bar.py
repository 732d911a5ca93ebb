"""The bar that offers to open folded elements."""

import attrs
import numpy as np
import pytest
from PySide6.QtGui import QAction

from hullquad.metrics import metric
from hullquad.optimization.paper import unmoved
from hullquad_app.document import Document
from hullquad_app.fold_bar import FoldBar
from hullquad_app.scene import State
from hullquad_app.track import Track


@pytest.fixture
def bar(qtbot):
    bar = FoldBar(QAction("Open"))
    qtbot.addWidget(bar)
    return bar


def scene(mesh):
    document = Document()
    document.open(State(tracks={"D": Track((unmoved(mesh, metric("stretch")),))}))
    return document.scene


@pytest.fixture
def folded(dented):
    """The dented squares with one inner node carried over its neighbour."""
    parameters = dented.parameters.copy()
    parameters[5] += 180.0
    return dented.with_parameters(parameters)


def test_a_sound_mesh_needs_no_bar(bar, dented):
    bar.show_scene(scene(dented))
    assert not bar.isVisible()


def test_folded_elements_are_counted_and_can_be_opened(bar, folded):
    shown = scene(folded)
    bar.show_scene(shown)
    assert bar.isVisible()
    assert bar.sentence.text() == f"{shown.quality.inverted_count} elements are folded or inside out."
    assert bar.button.isVisible()


def test_while_a_run_goes_on_nothing_is_offered(bar, folded):
    bar.show_scene(attrs.evolve(scene(folded), running=True))
    assert not bar.isVisible()


def test_what_the_contour_folds_is_not_offered(bar, dented):
    parameters = dented.parameters.copy()
    parameters[0] = 90.0  # beyond the line from one neighbour on the contour to the other
    shown = scene(attrs.evolve(dented, parameters=parameters, points=dented.surface.points(parameters)))
    assert shown.quality.inverted_count
    assert np.array_equal(shown.given, ~shown.quality.valid)
    bar.show_scene(shown)
    assert "no move of the nodes" in bar.sentence.text()
    assert not bar.button.isVisible()
