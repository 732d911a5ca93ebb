"""Colours and signs of rules: told apart by every eye, hatched where the contour is the reason."""

import numpy as np
import pytest

from hullquad.metrics import metric
from hullquad.rules import rule_set
from hullquad_app.canvas.painting import painting
from hullquad_app.canvas.strokes import hatching
from hullquad_app.colours import BROKEN, INVERTED, element_colours, rgb
from hullquad_app.document import Document
from hullquad_app.hatching import pens_on
from hullquad_app.level_colours import LEVELS, level_colours
from hullquad_app.scene import State
from hullquad_app.track import Track

EYES = {
    "normal": np.eye(3),
    "protan": [[0.152286, 1.052583, -0.204868], [0.114503, 0.786281, 0.099216], [-0.003882, -0.048116, 1.051998]],
    "deutan": [[0.367322, 0.860646, -0.227968], [0.280085, 0.672501, 0.047413], [-0.011820, 0.042940, 0.968881]],
    "tritan": [[1.255528, -0.076749, -0.178779], [-0.078411, 0.930809, 0.147602], [0.004733, 0.691367, 0.303900]],
}
"""Machado, Oliveira and Fernandes (2009), severity 1, on linear RGB."""
TO_XYZ = np.array([[0.4124, 0.3576, 0.1805], [0.2126, 0.7152, 0.0722], [0.0193, 0.1192, 0.9505]])


def seen(colour, eye):
    """L*a*b* of a colour as an eye sees it."""
    channels = np.array(rgb(colour)) / 255
    linear = np.where(channels <= 0.04045, channels / 12.92, ((channels + 0.055) / 1.055) ** 2.4)
    x, y, z = TO_XYZ @ np.clip(np.array(eye) @ linear, 0, 1) / [0.95047, 1.0, 1.08883]
    fx, fy, fz = (np.cbrt(t) if t > 0.008856 else 7.787 * t + 16 / 116 for t in (x, y, z))
    return np.array([116 * fy - 16, 500 * (fx - fy), 200 * (fy - fz)])


@pytest.mark.parametrize("eye", EYES)
def test_levels_and_inverted_elements_are_told_apart_by_every_eye(eye):
    colours = [seen(colour, EYES[eye]) for colour in (*LEVELS, INVERTED)]
    apart = [np.linalg.norm(one - other) for i, one in enumerate(colours) for other in colours[:i]]
    assert min(apart) >= 40


def test_inverted_elements_are_magenta_whatever_rules_say():
    colours = level_colours(np.array([0, 1, 2, 2], dtype=np.int8), np.array([True, True, True, False]))
    assert [tuple(row) for row in colours.tolist()] == [rgb(colour) for colour in (*LEVELS, INVERTED)]


@pytest.fixture
def document(qapp, walked):
    document = Document()
    document.open(State(title="dented", tracks={"dented": Track(walked.iterates[:1])}))
    return document


def test_elements_have_the_colours_of_the_metric_or_of_the_rules(document):
    by_metric = painting(document.scene, BROKEN)
    np.testing.assert_array_equal(by_metric.colours, element_colours(document.scene.quality))
    document.look(rules=rule_set("bv"))
    by_rules = painting(document.scene, BROKEN)
    assessment = document.scene.assessment
    np.testing.assert_array_equal(by_rules.colours, np.array([rgb(colour) for colour in LEVELS])[assessment.levels])
    np.testing.assert_array_equal(by_rules.hatched, assessment.given)


def test_what_the_contour_gives_is_hatched(document, walked):
    document.look(metric=metric("longest_edge"))
    scene = document.scene
    assert scene.given.any()
    np.testing.assert_array_equal(painting(scene, BROKEN).hatched, scene.given)


def test_a_hatching_stays_within_its_elements():
    points = np.array([[0, 0, 0], [100, 0, 0], [100, 100, 0], [0, 100, 0], [200, 0, 0]], dtype=float)
    elements = np.array([[0, 1, 2, 3], [1, 4, 2, -1]], dtype=np.int32)
    lines, owners = hatching(points, elements, 1.0)
    assert set(owners.tolist()) == {0, 1}
    quad, triangle = (lines[owners == row].reshape(-1, 3) for row in (0, 1))
    assert ((quad[:, :2] >= -1e-9) & (quad[:, :2] <= 100 + 1e-9)).all()
    assert (triangle[:, 0] >= 100 - 1e-9).all()
    assert (triangle[:, :2].sum(axis=1) <= 200 + 1e-9).all()


def test_small_elements_are_not_hatched_and_neither_are_too_many():
    points = np.array([[0, 0, 0], [100, 0, 0], [100, 100, 0], [0, 100, 0]], dtype=float)
    quads = np.tile(np.array([[0, 1, 2, 3]], dtype=np.int32), (3000, 1))
    assert len(hatching(points, quads[:1], 100.0)[0]) == 0
    assert len(hatching(points, quads, 1.0)[0]) == 0


def test_a_hatching_is_light_on_dark_and_dark_on_light():
    grounds = np.array([rgb("#6E0A1E"), rgb("#E3EDF3")], dtype=np.uint8)
    on_dark, on_light = pens_on(grounds).astype(int).sum(axis=1) - grounds.astype(int).sum(axis=1)
    assert on_dark > 200
    assert on_light < -200
