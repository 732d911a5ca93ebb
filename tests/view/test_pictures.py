"""Pictures for reports: everything in them, nothing of the screen."""

import io
import os
from pathlib import Path

import attrs
import numpy as np
import pytest
from PIL import Image
from PySide6.QtGui import QGuiApplication

from hullquad.errors import HullquadError
from hullquad.metrics import metric
from hullquad.rules import rule_set
from hullquad_app import pictures
from hullquad_app.colours import BROKEN, INVERTED, PASS_FAIL, rgb
from hullquad_app.document import Document
from hullquad_app.level_colours import LEVELS
from hullquad_app.scene import State

GOLDEN = Path(__file__).parents[2] / "assets" / "golden"
CLOSE = 2.0
"""Mean difference of a channel between two drivers' pictures of the same thing."""


def share_of(image, colour):
    """Share of the pixels that have a colour."""
    return float((np.asarray(image.convert("RGB")) == rgb(colour)).all(axis=2).mean())


def compare(image, name):
    """Hold a picture against the golden one; HULLQUAD_GOLDEN=write makes that anew."""
    small = image.convert("RGB").resize((image.width // 2, image.height // 2), Image.Resampling.BOX)
    path = GOLDEN / name
    if os.environ.get("HULLQUAD_GOLDEN") == "write":
        small.quantize(96).save(path, optimize=True)
    with Image.open(path) as golden:
        expected = np.asarray(golden.convert("RGB"), dtype=float)
    assert np.abs(np.asarray(small, dtype=float) - expected).mean() < CLOSE


@pytest.fixture
def scene(document, give, coarse):
    give(coarse)
    document.look(bands={"stretch": (0.7, float("inf"))})
    return document.scene


def test_a_picture_is_as_it_was(scene):
    compare(pictures.picture(scene), "picture.png")


def test_a_picture_of_a_folded_mesh_is_as_it_was(give, folded):
    compare(pictures.picture(give(folded, "min_angle")), "picture_folded.png")


def test_elements_keep_their_colours_to_the_bit(scene):
    image = pictures.picture(scene)
    best = BROKEN.colour(float(scene.quality.grades.max()))
    assert share_of(image, best) > 0.001
    assert share_of(image, "#FFFFFF") > 0.5


def test_another_map_is_used(scene):
    assert share_of(pictures.picture(scene, chosen=PASS_FAIL), PASS_FAIL.passing[0]) > 0.05


def test_inverted_elements_are_magenta(give, folded):
    assert share_of(pictures.picture(give(folded)), INVERTED) > 0.005


def test_rules_colour_a_picture_and_are_named(document, scene):
    document.look(rules=rule_set("csr_fine"))
    image = pictures.picture(document.scene)
    assert share_of(image, LEVELS[2]) > 0.02
    assert (np.asarray(image)[:120] != np.asarray(pictures.picture(scene))[:120]).any()


def test_what_the_contour_gives_is_hatched(document, scene):
    document.look(metric=metric("longest_edge"))
    assert document.scene.given.any()
    hatched = pictures.picture(document.scene)
    plain = attrs.evolve(document.scene.verdict, given=np.zeros_like(document.scene.given))
    assert np.asarray(hatched).tobytes() != pictures.picture(attrs.evolve(document.scene, verdict=plain)).tobytes()


@pytest.mark.parametrize("scale", [1, 2])
def test_a_picture_has_the_size_of_its_scale(scene, scale):
    assert pictures.picture(scene, scale=scale).size == (1600 * scale, 1000 * scale)


def test_the_ground_can_be_left_out(scene):
    opacity = np.asarray(pictures.picture(scene, transparent=True))[..., 3]
    assert opacity[0, 0] == opacity[-1, -1] == 0
    assert 0.1 < (opacity == 255).mean() < 0.5


def test_the_selection_is_not_in_the_picture(document, scene):
    before = np.asarray(pictures.picture(scene))
    document.look(selection=frozenset({1, 2}))
    np.testing.assert_array_equal(np.asarray(pictures.picture(document.scene)), before)


def test_a_long_title_is_cut_and_not_written_over_the_figures(scene):
    plate = attrs.evolve(scene.plate, title="Wing tank bulkhead " * 20)
    whole, cut = (np.asarray(pictures.picture(shown)) for shown in (scene, attrs.evolve(scene, plate=plate)))
    np.testing.assert_array_equal(whole[:120, 1150:], cut[:120, 1150:])


def test_a_plate_without_a_mesh_has_no_picture(document, tmp_path):
    with pytest.raises(HullquadError, match="E_PICTURE at hopper_partition"):
        pictures.write(document.scene, tmp_path / "plate.png")
    empty = Document()
    empty.open(State())
    with pytest.raises(HullquadError, match="E_PICTURE"):
        pictures.to_clipboard(empty.scene)


def test_the_file_says_what_made_it_and_fits_a_page(scene, tmp_path):
    pictures.write(scene, tmp_path / "plate.png", scale=2)
    with Image.open(tmp_path / "plate.png") as image:
        assert image.text["Software"].startswith("HullQuad ")
        assert image.width / image.info["dpi"][0] * 25.4 == pytest.approx(170, rel=1e-3)


def test_a_picture_that_cannot_be_written_leaves_nothing(scene, tmp_path):
    with pytest.raises(HullquadError, match="E_FILE"):
        pictures.write(scene, tmp_path / "missing" / "plate.png")
    assert list(tmp_path.iterdir()) == []


def test_the_clipboard_gets_the_picture(scene, qapp):
    pictures.to_clipboard(scene, scale=1)
    image = QGuiApplication.clipboard().image()
    assert (image.width(), image.height()) == (1600, 1000)
    QGuiApplication.clipboard().clear()


@pytest.mark.usefixtures("smooth_at_rest")
def test_taking_a_picture_leaves_the_view_alone(canvas, qtbot, scene):
    canvas.show_scene(scene)
    qtbot.waitUntil(lambda: canvas.is_smooth, timeout=5000)
    before = canvas.grab().toImage()
    pictures.picture(scene)
    with qtbot.waitSignal(canvas.painted):
        canvas.fit()
    qtbot.waitUntil(lambda: canvas.is_smooth, timeout=5000)
    assert canvas.grab().toImage() == before


def test_the_picture_is_read_back_as_it_was_made(scene):
    image = pictures.picture(scene)
    again = Image.open(io.BytesIO(pictures.png(image)))
    np.testing.assert_array_equal(np.asarray(again), np.asarray(image))
