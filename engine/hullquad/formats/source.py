"""The bytes of a file that somebody gives us."""

import stat
from pathlib import Path

from hullquad.errors import FileError

_MOST_BYTES = 2 << 30


def content(path: Path) -> bytes:
    """Everything in an ordinary file.

    Raises
    ------
    FileError
        It is missing, a folder, a device, not ours to read, or over 2 GiB.
    """
    try:
        about = Path(path).stat()
        if stat.S_ISDIR(about.st_mode):
            raise FileError("E_FILE", str(path), "folder")
        if not stat.S_ISREG(about.st_mode):
            raise FileError("E_FILE", str(path), "special")
        if about.st_size > _MOST_BYTES:
            raise FileError("E_FILE", str(path), "large", size=about.st_size / 2**30)
        return Path(path).read_bytes()
    except FileNotFoundError as error:
        raise FileError("E_FILE", str(path), "missing") from error
    except OSError as error:
        raise FileError("E_FILE", str(path), "unreadable", reason=error.strerror or str(error)) from error
    except ValueError as error:  # a name with a null character
        raise FileError("E_FILE", str(path), "unreadable", reason=str(error)) from error
