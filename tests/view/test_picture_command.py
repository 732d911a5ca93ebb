"""`hullquad picture`: no window, no screen."""

import os
import subprocess
import sys

import pytest
from PIL import Image

from hullquad.formats import write_mesh
from hullquad_app.colours import rgb
from hullquad_app.level_colours import LEVELS
from hullquad_app.main import main


@pytest.fixture
def mesh_file(coarse, tmp_path):
    path = tmp_path / "plate.vtu"
    write_mesh(coarse, path)
    return path


def test_it_writes_a_picture_without_a_screen(mesh_file, tmp_path):
    output = tmp_path / "plate.png"
    words = ["picture", str(mesh_file), "-o", str(output), "--metric", "skew", "--limit", "0.6", "--scale", "2"]
    kept = {name: value for name, value in os.environ.items() if name not in ("DISPLAY", "QT_QPA_PLATFORM")}
    command = [sys.executable, "-m", "hullquad_app", *words]
    done = subprocess.run(command, capture_output=True, text=True, check=False, env=kept)
    assert (done.returncode, done.stdout, done.stderr) == (0, "", "")
    with Image.open(output) as image:
        assert image.size == (3200, 2000)


def test_a_picture_can_be_transparent(mesh_file, tmp_path):
    assert main(["picture", str(mesh_file), "-o", str(tmp_path / "plate.png"), "--transparent"]) == 0
    with Image.open(tmp_path / "plate.png") as image:
        assert image.mode == "RGBA"


def test_a_mesh_that_is_missing_is_refused(tmp_path, capsys):
    assert main(["picture", str(tmp_path / "none.vtu"), "-o", str(tmp_path / "plate.png")]) == 1
    assert capsys.readouterr().err.startswith("error E_FILE at ")


def test_another_kind_of_file_is_refused_before_any_work(tmp_path, capsys):
    assert main(["picture", str(tmp_path / "none.vtu"), "-o", str(tmp_path / "plate.jpg")]) == 2
    assert capsys.readouterr().err.startswith("error E_SUFFIX at ")


def test_it_colours_by_rules(mesh_file, tmp_path):
    assert main(["picture", str(mesh_file), "-o", str(tmp_path / "plate.png"), "--rules", "bv"]) == 0
    with Image.open(tmp_path / "plate.png") as image:
        colours = {colour for _, colour in image.convert("RGB").getcolors(1 << 20)}
    assert {rgb(LEVELS[0]), rgb(LEVELS[1])} <= colours


def test_rules_that_there_are_not_are_refused(mesh_file, tmp_path, capsys):
    assert main(["picture", str(mesh_file), "-o", str(tmp_path / "plate.png"), "--rules", "none"]) == 1
    assert capsys.readouterr().err.startswith("error E_RULES at none")


@pytest.mark.parametrize("limit", ["40,140", "150"])
def test_a_metric_has_both_its_limits(mesh_file, tmp_path, limit):
    words = ["--metric", "corner_angle", "--limit", limit]
    assert main(["picture", str(mesh_file), "-o", str(tmp_path / "plate.png"), *words]) == 0


@pytest.mark.parametrize("words", [["--scale", "5"], ["--limit", "nan"], ["--limit", "2,1"], ["--metric", "beauty"]])
def test_wrong_usage_is_told(mesh_file, tmp_path, words, capsys):
    with pytest.raises(SystemExit, match="2"):
        main(["picture", str(mesh_file), "-o", str(tmp_path / "plate.png"), *words])
    assert "usage: hullquad picture" in capsys.readouterr().err
