"""What is remembered, and that no file of settings can stop the program."""

import json
import math

import pytest
from PySide6.QtCore import QByteArray, QSettings

from hullquad.optimization.settings import PaperSettings
from hullquad_app.mesher import Mesher
from hullquad_app.search import Search
from hullquad_app.settings import MOST_RECENT, Settings

NAMES = ("geometry", "layout", "theme", "recent", "bands", "metric", "objective", "paper", "search", "mesher")
NONSENSE = [
    "", "x", "null", "[]", "{}", "3", "true", '"?"', "[[1]]", '{"step": "a"}', '{"stretch": "a"}', "[null]", "1e999",
    "[" * 100_000, '{"stretch": null}', '{"iterations": 1e99}', '["\\u0000"]',
]  # fmt: skip


@pytest.fixture
def ini(tmp_path):
    return tmp_path / "hullquad.ini"


def opened(ini):
    """Settings as the next start of the program finds them."""
    return Settings(QSettings(str(ini), QSettings.Format.IniFormat))


def values(settings):
    """Everything that is remembered."""
    return {name: getattr(settings, name) for name in NAMES}


@pytest.fixture
def usual(ini):
    """What is remembered when nothing is."""
    return values(opened(ini))


def test_the_next_start_finds_what_was_set(ini):
    before = opened(ini)
    before.geometry, before.layout, before.theme = QByteArray(b"\0\xff\1"), QByteArray(b"docks"), "dark"
    before.bands, before.metric, before.objective = {"stretch": (0.4, math.inf)}, "shape", "min_angle=2,shape"
    before.paper = PaperSettings(step=0.001, iterations=50, guard=False)
    before.search = Search(optimizer="worst", floor=None, iterations=9, seconds=3, is_local=True, rings=0)
    before.mesher = Mesher(name="paper", prefer="quality", grading=0.7, follows_lines=True)
    expected = values(before)
    del before
    assert values(opened(ini)) == expected
    assert expected["geometry"] == QByteArray(b"\0\xff\1")
    assert expected["paper"] == PaperSettings(step=0.001, iterations=50, guard=False)


@pytest.mark.parametrize("text", NONSENSE)
def test_nonsense_counts_as_nothing(ini, usual, text):
    store = QSettings(str(ini), QSettings.Format.IniFormat)
    for name in NAMES:
        store.setValue(name, text)
    assert values(Settings(store)) == usual


@pytest.mark.parametrize(
    "content", [b"\0\1\2\xff" * 999, b"[General\ntheme=@Variant(\0", b"=\n[]\n%%%=@ByteArray(", b"{}"]
)
def test_a_file_of_another_kind_counts_as_nothing(ini, usual, content):
    ini.write_bytes(content)
    assert values(opened(ini)) == usual


def test_of_what_is_kept_only_the_sound_parts_count(ini):
    store = QSettings(str(ini), QSettings.Format.IniFormat)
    store.setValue("paper", json.dumps({"step": 0.01, "iterations": -1, "guard": 1, "new": 3, "tolerance": math.nan}))
    store.setValue("bands", json.dumps({"stretch": [0.4], "beauty": [1.0], "shape": [math.inf], "skew": [0.1, 0.2]}))
    search = {"optimizer": "luck", "floor": True, "iterations": 0, "seconds": 1.5, "is_local": 1, "rings": 1, "new": 3}
    store.setValue("search", json.dumps(search))
    mesher = {"name": "luck", "prefer": ["quads"], "grading": 0.3, "follows_lines": 1, "new": 3}
    store.setValue("mesher", json.dumps(mesher))
    store.setValue("objective", json.dumps("stretch=2,beauty"))
    assert Settings(store).paper == PaperSettings(step=0.01)
    assert Settings(store).search == Search(rings=1)
    assert Settings(store).mesher == Mesher(grading=0.3)
    assert Settings(store).objective is None
    assert Settings(store).bands == {"stretch": (0.4, math.inf)}


def test_the_last_files_are_remembered_while_they_are_there(ini, tmp_path):
    files = [tmp_path / f"{i}.json" for i in range(MOST_RECENT + 5)]
    for file in files:
        file.touch()
        opened(ini).add_recent(file)
    opened(ini).add_recent(files[8])
    latest = [files[8], *(file for file in reversed(files) if file != files[8])]
    assert opened(ini).recent == latest[:MOST_RECENT]
    files[8].unlink()
    assert opened(ini).recent == latest[1:MOST_RECENT]


def test_settings_that_cannot_be_written_stop_nothing(tmp_path, usual):
    settings = opened(tmp_path / "file" / "hullquad.ini")
    (tmp_path / "file").touch()
    settings.theme = "dark"
    assert settings.theme == "dark"
