"""Where machine code is kept: one folder for each state of the sources, so that none is ever older than they are.

Numba sees when the file of a kernel changes, but not when one of a function that the kernel calls does.
"""

import hashlib
import os
import shutil
import time
from pathlib import Path

from numba.core import config

_PACKAGE = Path(__file__).parents[1]
_SIGN = b"hullquad.metrics.compiled"
"""What the source of a kernel contains."""
_NAME = "kernels-"
_KEPT = 86_400.0
"""How long code of other states is kept [s]."""


def choose() -> None:
    """Have machine code kept beside the sources, by their state; elsewhere if that cannot be or somebody says where."""
    if os.environ.get("NUMBA_CACHE_DIR"):
        return
    folder = _PACKAGE / "__pycache__" / (_NAME + fingerprint(_PACKAGE))
    try:
        folder.mkdir(parents=True, exist_ok=True)
        os.utime(folder)
    except OSError:
        return
    if os.access(folder, os.W_OK):
        config.CACHE_DIR = str(folder)  # type: ignore[attr-defined]  # Numba sets it when it is imported
        _tidy(folder)


def fingerprint(package: Path) -> str:
    """Of all sources below a folder that have kernels."""
    digest = hashlib.sha256()
    for file in sorted(package.rglob("*.py")):
        source = file.read_bytes()
        if _SIGN in source or file.parent.name == "metrics":
            digest.update(str(file.relative_to(package)).encode() + b"\0" + source)
    return digest.hexdigest()[:16]


def _tidy(folder: Path) -> None:
    """Remove what has been of no use for a day."""
    for other in folder.parent.glob(_NAME + "*"):
        if other != folder and time.time() - other.stat().st_mtime > _KEPT:
            shutil.rmtree(other, ignore_errors=True)
