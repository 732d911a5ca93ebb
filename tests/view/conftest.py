"""Scenes, and the view on a screen that nobody sees."""

import math
import os
import sys
from pathlib import Path

import numpy as np
import pytest

# The true 3-D view needs a screen (offscreen it paints garbage without an error); on Linux Xvfb is one.
if sys.platform.startswith("linux"):
    os.environ.setdefault("QT_QPA_PLATFORM", "xcb")

from hullquad import pipeline
from hullquad.formats import read_plates
from hullquad.metrics import metric
from hullquad.optimization.paper import unmoved
from hullquad.triangulation.contour import contours
from hullquad_app.canvas import Canvas
from hullquad_app.document import Document
from hullquad_app.garbage import Garbage
from hullquad_app.scene import State
from hullquad_app.track import Track

PLATES = Path(__file__).parents[2] / "assets" / "plates"


@pytest.fixture
def smooth_at_rest(monkeypatch):
    """The view is smoothed at rest, however busy the machine."""
    monkeypatch.setattr("hullquad_app.canvas.pane._AFFORDABLE", math.inf)


@pytest.fixture(scope="session", autouse=True)
def collector(qapp):
    """As in the program: windows that tests have left end in no thread but this one."""
    garbage = Garbage(qapp)
    yield
    garbage.release()


@pytest.fixture(scope="session")
def partition():
    """Document of one plate, the hopper partition."""
    return read_plates(PLATES / "hopper_partition.json")


@pytest.fixture(scope="session")
def coarse(partition):
    """Coarse mesh of it: quads, two triangles."""
    return pipeline.paper_mesh(contours(partition, "coarse")["hopper_partition"])


@pytest.fixture(scope="session")
def folded(coarse):
    """The same with a node carried over its neighbours: elements that are not valid, and bad ones."""
    node = np.flatnonzero(coarse.topology.is_free)[4]
    parameters = coarse.parameters.copy()
    parameters[node] += 1.2 * coarse.target_size
    return coarse.with_parameters(parameters)


@pytest.fixture
def moved(coarse):
    """The coarse mesh with its free nodes a little elsewhere."""
    steps = np.random.default_rng(2).uniform(-30, 30, coarse.parameters.shape)
    return coarse.with_parameters(coarse.parameters + steps)


@pytest.fixture
def document(qapp, partition):
    """The partition, not meshed."""
    document = Document()
    document.open(State(title="hopper_partition", plates=partition))
    return document


@pytest.fixture
def give(document):
    """Give the plate of the document a mesh, as the only iterate of its track."""

    def give(mesh, metric_key="stretch"):
        track = Track((unmoved(mesh, metric(metric_key)),))
        document.change("Mesh", document.scene.state.with_track("hopper_partition", track))
        return document.scene

    return give


@pytest.fixture
def canvas(qtbot, document):
    """The view of the document, running."""
    canvas = Canvas()
    canvas.resize(600, 400)
    document.changed.connect(canvas.show_scene)
    canvas.show_scene(document.scene)
    canvas.show()
    qtbot.waitExposed(canvas)
    canvas.start()
    yield canvas
    canvas.close()
    canvas.deleteLater()
