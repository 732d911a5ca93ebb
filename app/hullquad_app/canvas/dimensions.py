"""Lengths and angles written at an element: at its edges and corners, or beside it where it is small."""

from math import atan2, cos, degrees, hypot, radians, sin

import attrs
from PySide6.QtCore import QPointF, QRectF, QSizeF, Qt
from PySide6.QtGui import QColor, QFont, QPainter, QPen, QPolygonF

from hullquad_app.colours import Palette
from hullquad_app.inspection import Inspection
from hullquad_app.panels.figures import CAPTION, sized

_LEAST_EDGE = 6.5
"""Length of the shortest edge at which there is room to write, in lines."""
_LARGE = 11.0
"""Side of the drawing beside a small element, in lines."""
_BESIDE, _ABOVE = 4.8, 2.2
"""Room for lengths around it, in lines."""
_CENTRE = Qt.AlignmentFlag.AlignCenter


@attrs.frozen(eq=False)
class Sheet:
    """What is drawn on: a painter with the font of the labels, the colours, and the room that there is."""

    painter: QPainter
    palette: Palette
    room: QRectF
    taken: QRectF
    """Where something else is written."""

    @property
    def line(self) -> float:
        """Height of a line of text."""
        return float(self.painter.fontMetrics().height())


def draw_dimensions(sheet: Sheet, outline: list[QPointF], inspection: Inspection) -> None:
    """Write the lengths and angles of an element, its outline (3 or 4 corners) in pixels."""
    painter, painted = sheet.painter, outline
    painter.save()
    painter.setFont(sized(painter.font(), CAPTION))
    if min(_length(side) for side in _sides(outline)) < _LEAST_EDGE * sheet.line:
        painted = _beside(sheet, outline)
    for corner in range(len(painted)):
        _draw_corner(sheet, painted, corner, inspection)
    for side, length in zip(_sides(painted), inspection.anatomy.edge_lengths.tolist(), strict=True):
        text = length_words(length)
        away = QPointF() if painted is outline else _outwards(sheet, painted, side, text)
        _label(sheet, (side[0] + side[1]) / 2 + away, text, sheet.palette.text)
    painter.restore()


def length_words(length: float) -> str:
    """A length as it is written at an edge [mm]."""
    return f"{length:.1f}\N{NO-BREAK SPACE}mm" if length < 100 else f"{length:.0f}\N{NO-BREAK SPACE}mm"


def _draw_corner(sheet: Sheet, outline: list[QPointF], corner: int, inspection: Inspection) -> None:
    """An arc with the angle; the worst corner is filled, and in the colour of failing."""
    painter, tip = sheet.painter, outline[corner]
    ahead, back = outline[(corner + 1) % len(outline)] - tip, outline[corner - 1] - tip
    reach = min(1.6 * sheet.line, 0.35 * min(_norm(ahead), _norm(back)))
    start, sweep = _sweep(outline, ahead, back)
    box = QRectF(tip.x() - reach, tip.y() - reach, 2 * reach, 2 * reach)
    is_worst = corner == inspection.worst_corner
    colour = QColor(sheet.palette.fail if is_worst else sheet.palette.text)
    around = round(16 * start), round(16 * sweep)
    if is_worst:
        painter.setPen(Qt.PenStyle.NoPen)
        painter.setBrush(colour)
        painter.drawPie(box, *around)
    halo = QColor(sheet.palette.panel)
    halo.setAlpha(200)
    for pen in (QPen(halo, 4.5), QPen(colour, 2.0 if is_worst else 1.5)):
        painter.setPen(pen)
        painter.drawArc(box, *around)
    middle = radians(start + sweep / 2)
    away = reach + 0.9 * sheet.line
    at = tip + QPointF(cos(middle) * away, -sin(middle) * away)
    _label(sheet, at, f"{inspection.anatomy.corner_angles[corner]:.1f}°", colour.name(), bold=is_worst)


def _label(sheet: Sheet, at: QPointF, text: str, colour: str, *, bold: bool = False) -> None:
    """A text on a ground of its own, so that it is read on every colour."""
    painter = sheet.painter
    font = QFont(painter.font())
    font.setBold(bold)
    painter.save()
    painter.setFont(font)
    place = QRectF(painter.fontMetrics().boundingRect(text)).adjusted(-3, -1, 3, 1)
    place.moveCenter(at)
    ground = QColor(sheet.palette.panel)
    ground.setAlpha(225)
    painter.setPen(Qt.PenStyle.NoPen)
    painter.setBrush(ground)
    painter.drawRoundedRect(place, 3, 3)
    painter.setPen(QColor(colour))
    painter.drawText(place, _CENTRE, text)
    painter.restore()


def _beside(sheet: Sheet, outline: list[QPointF]) -> list[QPointF]:
    """The outline of a large drawing of the element, in a box in a corner of the view, joined to it by a line."""
    painter, element = sheet.painter, QPolygonF(outline).boundingRect()
    factor = _LARGE * sheet.line / max(element.width(), element.height(), 1e-6)
    box = _box(sheet, element, element.size() * factor)
    painter.setPen(QPen(QColor(sheet.palette.dim), 1, Qt.PenStyle.DashLine))
    painter.drawLine(box.center(), element.center())
    painter.setPen(QPen(QColor(sheet.palette.rule), 1))
    painter.setBrush(QColor(sheet.palette.panel))
    painter.drawRoundedRect(box, 6, 6)
    large = [box.center() + (corner - element.center()) * factor for corner in outline]
    painter.setPen(QPen(QColor(sheet.palette.text), 1.5))
    painter.setBrush(QColor(sheet.palette.background))
    painter.drawPolygon(QPolygonF(large))
    return large


def _outwards(sheet: Sheet, outline: list[QPointF], side: tuple[QPointF, QPointF], text: str) -> QPointF:
    """How far a text stands from the middle of a side, so that it does not touch the element."""
    along, letters = side[1] - side[0], sheet.painter.fontMetrics()
    turn = 1 if _doubled_area(outline) > 0 else -1
    normal = QPointF(-along.y(), along.x()) * (turn / max(_norm(along), 1e-6))
    reach = abs(normal.x()) * letters.horizontalAdvance(text) / 2 + abs(normal.y()) * letters.height() / 2 + 6
    return normal * reach


def _box(sheet: Sheet, element: QRectF, size: QSizeF) -> QRectF:
    """Where a drawing of that size has room: in the upper right corner of the view, if the element is not there."""
    line = sheet.line
    box = QRectF(0, 0, size.width() + 2 * _BESIDE * line, size.height() + 2 * _ABOVE * line)
    box.moveTopRight(sheet.room.topRight() + QPointF(-line, line))
    if box.intersects(sheet.taken):
        box.moveTop(sheet.taken.bottom() + line)
    if box.adjusted(-line, -line, line, line).intersects(element):
        box.moveBottom(sheet.room.bottom() - 4 * line)
    return box


def _sweep(outline: list[QPointF], ahead: QPointF, back: QPointF) -> tuple[float, float]:
    """Where the arc of a corner begins, and how far it goes, as Qt counts degrees: up to the left is positive."""
    start, end = (degrees(atan2(-way.y(), way.x())) for way in (ahead, back))
    is_mirrored = _doubled_area(outline) < 0
    return start, -((start - end) % 360) if is_mirrored else (end - start) % 360


def _doubled_area(outline: list[QPointF]) -> float:
    """Positive where the corners run anticlockwise on the screen, whose y points down."""
    return sum(start.y() * end.x() - start.x() * end.y() for start, end in _sides(outline))


def _sides(outline: list[QPointF]) -> list[tuple[QPointF, QPointF]]:
    return list(zip(outline, [*outline[1:], outline[0]], strict=True))


def _length(side: tuple[QPointF, QPointF]) -> float:
    return _norm(side[1] - side[0])


def _norm(way: QPointF) -> float:
    return hypot(way.x(), way.y())
