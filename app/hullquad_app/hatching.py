"""The sign of what the contour gives: a hatching, seen on light and dark grounds alike."""

import numpy as np
from PySide6.QtCore import QPointF, QRectF
from PySide6.QtGui import QColor, QPainter, QPen

from hullquad_app.colours import LIGHT, Colours, rgb

_STRENGTH = 0.75
"""Of a hatching over its ground: it must be seen, and not cry."""
_DARK = 110.0
"""Brightness of grounds on which light lines are seen better, of 255."""


def pens_on(grounds: Colours) -> Colours:
    """(H, 3) colours of lines on grounds (H, 3)."""
    wide = grounds.astype(float)
    is_dark = wide @ np.array([0.30, 0.59, 0.11]) < _DARK
    pens = np.where(is_dark[:, None], rgb(LIGHT.view), rgb(LIGHT.edge))
    return np.rint(_STRENGTH * pens + (1 - _STRENGTH) * wide).astype(np.uint8)


def hatch_colour(ground: QColor) -> QColor:
    """The same of one colour."""
    (pen,) = pens_on(np.array([[ground.red(), ground.green(), ground.blue()]], dtype=np.uint8)).tolist()
    return QColor(*pen)


def draw_hatching(painter: QPainter, square: QRectF, colour: QColor) -> None:
    """Draw four lines over a small square."""
    painter.save()
    painter.setRenderHint(QPainter.RenderHint.Antialiasing)
    painter.setClipRect(square)
    painter.setPen(QPen(colour, 1.2))
    side = square.width()
    for along in (-0.75, -0.375, 0.0, 0.375, 0.75):
        start = square.topLeft() + QPointF(along * side, 0)
        painter.drawLine(start, start + QPointF(side, side))
    painter.restore()
