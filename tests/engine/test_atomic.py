"""Files are written whole or not at all."""

import errno
import os
import stat
from pathlib import Path

import pytest

from hullquad.errors import FileError
from hullquad.formats import atomic


@pytest.fixture
def old(tmp_path: Path) -> Path:
    path = tmp_path / "mesh.vtu"
    path.write_bytes(b"old")
    return path


def broken(error: BaseException):
    yield b"half"
    raise error


def test_a_new_file_holds_the_chunks(tmp_path):
    atomic.write(tmp_path / "new.vtu", [b"one ", b"two"])
    assert (tmp_path / "new.vtu").read_bytes() == b"one two"


def test_a_new_file_has_the_permissions_of_any_new_file(tmp_path):
    atomic.write(tmp_path / "new.vtu", b"new")
    (tmp_path / "plain").touch()
    assert (tmp_path / "new.vtu").stat().st_mode == (tmp_path / "plain").stat().st_mode


def test_an_existing_file_keeps_its_permissions(old):
    old.chmod(0o640)
    atomic.write(old, b"new")
    assert (old.read_bytes(), stat.S_IMODE(old.stat().st_mode)) == (b"new", 0o640)


def test_of_a_link_to_nowhere_the_missing_folder_is_told(tmp_path):
    link = tmp_path / "link.vtu"
    link.symlink_to(tmp_path / "gone" / "mesh.vtu")
    with pytest.raises(FileError, match=f"no folder {tmp_path / 'gone'}"):
        atomic.check(link)


def test_of_a_link_the_target_is_replaced(old, tmp_path):
    folder = tmp_path / "elsewhere"
    folder.mkdir()
    link = folder / "link.vtu"
    link.symlink_to(old)
    atomic.write(link, b"new")
    assert link.is_symlink()
    assert old.read_bytes() == b"new"


@pytest.mark.parametrize("error", [KeyboardInterrupt(), MemoryError(), ValueError("chunk")], ids=repr)
def test_an_interrupted_write_leaves_the_old_file_and_nothing_else(old, error):
    with pytest.raises(type(error)):
        atomic.write(old, broken(error))
    assert old.read_bytes() == b"old"
    assert list(old.parent.iterdir()) == [old]


def test_a_full_disk_is_told_and_leaves_the_old_file(old):
    with pytest.raises(FileError, match="No space left") as caught:
        atomic.write(old, broken(OSError(errno.ENOSPC, os.strerror(errno.ENOSPC))))
    assert caught.value.key == "E_FILE:unwritable"
    assert caught.value.place == str(old)
    assert list(old.parent.iterdir()) == [old]
    assert old.read_bytes() == b"old"


def make_fifo(path: Path) -> Path:
    os.mkfifo(path)
    return path


def make_loop(path: Path) -> Path:
    path.symlink_to(path)
    return path


def make_link_to_fifo(path: Path) -> Path:
    path.symlink_to(make_fifo(path.with_suffix(".fifo")))
    return path


@pytest.mark.parametrize(
    ("make", "key"),
    [
        (lambda path: path.parent, "E_FILE:folder"),
        (make_fifo, "E_FILE:special"),
        (make_link_to_fifo, "E_FILE:special"),
        (make_loop, "E_FILE:unwritable"),
        (lambda path: Path("/dev/null"), "E_FILE:special"),
        (lambda path: path.parent / "no" / "file.vtu", "E_FILE:no_folder"),
        (lambda path: path.parent / "nul\0.vtu", "E_FILE:unwritable"),
    ],
)
def test_only_ordinary_files_are_written(tmp_path, make, key):
    path = make(tmp_path / "out.vtu")
    before = sorted(tmp_path.iterdir())
    with pytest.raises(FileError) as caught:
        atomic.write(path, b"new")
    assert caught.value.key == key
    assert caught.value.text
    assert sorted(tmp_path.iterdir()) == before


def test_a_file_is_no_folder(old):
    with pytest.raises(FileError) as caught:
        atomic.write(old / "out.vtu", b"new")
    assert caught.value.code == "E_FILE"


@pytest.mark.skipif(os.geteuid() == 0, reason="nothing is protected from root")
def test_a_protected_folder_and_a_protected_file_are_refused(old):
    old.chmod(0o444)
    with pytest.raises(FileError, match="protected"):
        atomic.write(old, b"new")
    old.parent.chmod(0o555)
    try:
        with pytest.raises(FileError, match="folder"):
            atomic.write(old.parent / "new.vtu", b"new")
    finally:
        old.parent.chmod(0o755)
