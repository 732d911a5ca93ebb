"""Machine code is never older than the sources it was made from."""

import shutil
from pathlib import Path

import pytest
from numba.core import config

import hullquad
from hullquad.metrics.code_folder import choose, fingerprint

PACKAGE = Path(hullquad.__file__).parent


@pytest.fixture
def copy(tmp_path):
    return Path(shutil.copytree(PACKAGE, tmp_path / "hullquad", ignore=shutil.ignore_patterns("__pycache__")))


def test_the_same_sources_have_the_same_fingerprint(copy):
    assert fingerprint(copy) == fingerprint(PACKAGE)


@pytest.mark.parametrize(
    "name", ["metrics/machine.py", "metrics/vectors.py", "optimization/rollback.py", "quads/draft.py"]
)
def test_a_change_of_any_part_of_a_kernel_changes_it(copy, name):
    before = fingerprint(copy)
    (copy / name).write_bytes((copy / name).read_bytes() + b"\n")
    assert fingerprint(copy) != before


def test_a_change_elsewhere_does_not(copy):
    before = fingerprint(copy)
    (copy / "sentences.py").write_bytes((copy / "sentences.py").read_bytes() + b"\n")
    assert fingerprint(copy) == before


def test_kernels_are_kept_in_the_folder_of_the_present_sources(monkeypatch):
    monkeypatch.delenv("NUMBA_CACHE_DIR", raising=False)
    monkeypatch.setattr(config, "CACHE_DIR", "")
    choose()
    assert Path(config.CACHE_DIR).name == "kernels-" + fingerprint(PACKAGE)


def test_whoever_says_where_is_obeyed(monkeypatch, tmp_path):
    monkeypatch.setenv("NUMBA_CACHE_DIR", str(tmp_path))
    monkeypatch.setattr(config, "CACHE_DIR", str(tmp_path))
    choose()
    assert str(tmp_path) == config.CACHE_DIR
