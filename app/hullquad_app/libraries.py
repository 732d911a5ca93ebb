"""The shared libraries that Qt needs of the system, and who brings them (standard library only, for `run.py`)."""

import ctypes
import sys
from collections.abc import Iterable

PACKAGES = {
    "libglib-2.0.so.0": "libglib2.0-0",
    "libGL.so.1": "libgl1",
    "libEGL.so.1": "libegl1",
    "libX11.so.6": "libx11-6",
    "libfontconfig.so.1": "libfontconfig1",
    "libdbus-1.so.3": "libdbus-1-3",
    "libxkbcommon-x11.so.0": "libxkbcommon-x11-0",
    "libxcb-cursor.so.0": "libxcb-cursor0",
    "libxcb-icccm.so.4": "libxcb-icccm4",
    "libxcb-keysyms.so.1": "libxcb-keysyms1",
    "libxcb-shape.so.0": "libxcb-shape0",
    "libXcursor.so.1": "libxcursor1",
}
"""Debian and Ubuntu package of each library that the Qt wheels do not bring."""


def missing() -> list[str]:
    """Libraries of `PACKAGES` that this machine lacks; Qt would abort on them instead of raising."""
    return [name for name in PACKAGES if not _loads(name)] if sys.platform.startswith("linux") else []


def advice(packages: Iterable[str], sonames: Iterable[str]) -> str:
    """What to install, for somebody in front of a terminal."""
    names = ", ".join(sonames)
    elsewhere = f"\n(names on Debian and Ubuntu; elsewhere, what provides {names})" if names else ""
    return f"install the missing system packages, then start again:\n\n    {apt_line(packages)}\n{elsewhere}"


def apt_line(packages: Iterable[str]) -> str:
    """The command that installs packages on Debian and Ubuntu."""
    return "sudo apt-get install -y --no-install-recommends " + " ".join(packages)


def _loads(name: str) -> bool:
    try:
        ctypes.CDLL(name)
    except OSError:
        return False
    return True
