"""What `pip install` brings."""

import os
import subprocess
import sys
import zipfile
from pathlib import Path

import pytest

from hullquad.rules import rule_sets
from hullquad_app.assets import samples

ROOT = Path(__file__).parents[1]


@pytest.fixture(scope="module")
def site(tmp_path_factory):
    """A folder with the contents of the wheel."""
    folder = tmp_path_factory.mktemp("wheel")
    build = [sys.executable, "-m", "hatchling", "build", "-t", "wheel", "-d", str(folder)]
    subprocess.run(build, cwd=ROOT, capture_output=True, check=True)
    (wheel,) = folder.glob("*.whl")
    zipfile.ZipFile(wheel).extractall(folder / "site")
    return folder / "site"


def answer(code, site):
    """What code prints with the wheel's contents installed."""
    installed = os.environ | {"PYTHONPATH": str(site)}
    return subprocess.check_output([sys.executable, "-P", "-c", code], text=True, env=installed).strip()


def test_an_installed_program_finds_its_samples(site):
    plates = answer("from hullquad_app.assets import *; print(FOLDER, len(samples()))", site)
    count = len(list((ROOT / "assets" / "plates").glob("*.json")))
    assert plates == f"{site / 'hullquad_app' / 'assets'} {count}"


def test_an_installed_program_finds_its_rule_sets(site):
    code = "from hullquad import rules; print(rules.__file__, len(rules.rule_sets()))"
    assert answer(code, site) == f"{site / 'hullquad' / 'rules' / '__init__.py'} {len(rule_sets())}"


def test_a_checkout_finds_its_samples():
    assert samples()[0].path.parent == ROOT / "assets" / "plates"


def test_the_wheel_brings_both_packages_and_nothing_else(site):
    names = {path.name for path in site.iterdir() if path.suffix != ".dist-info"}
    assert names == {"hullquad", "hullquad_app"}


def test_the_wheel_brings_the_licence(site):
    assert len(list(site.glob("*.dist-info/licenses/LICENSE"))) == 1


def test_the_wheel_brings_the_command(site):
    (points,) = site.glob("*.dist-info/entry_points.txt")
    assert "hullquad = hullquad_app.main:main" in points.read_text()
