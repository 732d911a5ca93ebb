"""Quadrilateral meshes of ship hull plates: made, judged and improved."""

__version__ = "0.1.0"
