"""Files that are written whole or not at all."""

import os
import secrets
import stat
from collections.abc import Iterable
from pathlib import Path

from hullquad.errors import FileError


def write(path: Path, content: bytes | Iterable[bytes]) -> None:
    """Put the content into the file in one step; until then, and after any failure, the old file stays as it is.

    The permissions of an existing file are kept; of a link, the file it points to is replaced.

    Raises
    ------
    FileError
        The folder is missing or protected, the disk is full, or `path` is no ordinary file.
    """
    target = check(path)
    draft = target.with_name(f".{secrets.token_hex(8)}.tmp")
    try:
        _write_draft(draft, [content] if isinstance(content, bytes) else content)
        if target.exists():
            draft.chmod(stat.S_IMODE(target.stat().st_mode))
        draft.replace(target)
    except OSError as error:
        raise FileError("E_FILE", str(path), "unwritable", reason=error.strerror or str(error)) from error
    finally:
        draft.unlink(missing_ok=True)


def check(path: Path) -> Path:
    """Return the file that writing to `path` replaces or makes.

    Raises
    ------
    FileError
        It cannot be written, as far as that can be told beforehand.
    """
    try:
        target = Path(path).resolve()
        named = str(target.parent if Path(path).is_symlink() else Path(path).parent)
        mode = target.stat().st_mode if os.path.lexists(target) else None
        folder = target.parent.stat().st_mode
    except FileNotFoundError as error:
        raise FileError("E_FILE", str(path), "no_folder", folder=named) from error
    except (OSError, RuntimeError, ValueError) as error:  # a loop of links, a name with a null character
        raise FileError("E_FILE", str(path), "unwritable", reason=str(error)) from error
    if not stat.S_ISDIR(folder):
        raise FileError("E_FILE", str(path), "no_folder", folder=named)
    if mode is not None and not stat.S_ISREG(mode):
        raise FileError("E_FILE", str(path), "folder" if stat.S_ISDIR(mode) else "special")
    if not os.access(target.parent, os.W_OK | os.X_OK):
        raise FileError("E_FILE", str(path), "protected_folder", folder=named)
    if mode is not None and not os.access(target, os.W_OK):
        raise FileError("E_FILE", str(path), "protected")
    return target


def _write_draft(draft: Path, chunks: Iterable[bytes]) -> None:
    with draft.open("xb") as file:
        file.writelines(chunks)
        file.flush()
        os.fsync(file.fileno())
