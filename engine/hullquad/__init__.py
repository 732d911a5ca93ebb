"""Quadrilateral meshes of ship hull plates: made, judged and improved."""

from importlib.metadata import PackageNotFoundError, version

try:
    __version__ = version("hullquad")
except PackageNotFoundError:  # started from a checkout that was never installed
    __version__ = "0.1.0"
