"""The bytes of a file that somebody gives us."""

import stat
from pathlib import Path

from hullquad.errors import FileError

_MOST_BYTES = 2 << 30


def content(path: Path, most: int = _MOST_BYTES) -> bytes:
    """Everything in an ordinary file of at most so many bytes.

    Raises
    ------
    FileError
        It is missing, a folder, a device, not ours to read, or too large.
    """
    try:
        about = Path(path).stat()
        if stat.S_ISDIR(about.st_mode):
            raise FileError("E_FILE", str(path), "folder")
        if not stat.S_ISREG(about.st_mode):
            raise FileError("E_FILE", str(path), "special")
        if about.st_size > most:
            raise _too_large(path, about.st_size, most)
        return Path(path).read_bytes()
    except FileNotFoundError as error:
        raise FileError("E_FILE", str(path), "missing") from error
    except OSError as error:
        raise FileError("E_FILE", str(path), "unreadable", reason=error.strerror or str(error)) from error
    except ValueError as error:  # a name with a null character
        raise FileError("E_FILE", str(path), "unreadable", reason=str(error)) from error


def _too_large(path: Path, size: int, most: int) -> FileError:
    if most == _MOST_BYTES:
        return FileError("E_FILE", str(path), "large", size=size / 2**30)
    return FileError("E_FILE", str(path), "other", size=size / 2**20, most=most / 2**20)
