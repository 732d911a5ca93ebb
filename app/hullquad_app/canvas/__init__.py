"""The true 3-D view: a scene in, clicks out."""

from hullquad_app.canvas.view import Canvas

__all__ = ["Canvas"]
