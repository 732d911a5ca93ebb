"""What is written over the view: scale bar, axes, the hovered element with its value, a notice."""

import numpy as np
from PySide6.QtCore import QPointF, QRectF, Qt
from PySide6.QtGui import QColor, QPainter, QPainterPath, QPaintEvent, QPen, QPolygonF
from PySide6.QtWidgets import QWidget

from hullquad.arrays import Floats
from hullquad_app.canvas.camera import Camera
from hullquad_app.canvas.dimensions import Sheet, draw_dimensions
from hullquad_app.canvas.legend import draw_legend
from hullquad_app.canvas.ruler import nice_length, written
from hullquad_app.colours import LIGHT, Palette
from hullquad_app.inspection import Inspection
from hullquad_app.level_legend import Entry

_SOLID, _FLAT = Qt.PenStyle.SolidLine, Qt.PenCapStyle.FlatCap
_RIGHT = Qt.AlignmentFlag.AlignRight | Qt.AlignmentFlag.AlignVCenter


class Overlay(QWidget):
    """Lies over the view without taking part in it: painting it does not draw the plate again."""

    def __init__(self, parent: QWidget) -> None:
        super().__init__(parent)
        self.setAttribute(Qt.WidgetAttribute.WA_TransparentForMouseEvents)
        self.palette_shown: Palette = LIGHT
        self.camera: Camera | None = None
        self.notice = ""
        self.tip = ""
        self._cursor = QPointF()
        self._hovered: Floats | None = None
        self._loops: list[Floats] = []
        self._legend: tuple[str, list[Entry]] = ("", [])
        self._inspection: Inspection | None = None

    def set_palette(self, palette: Palette) -> None:
        """Take the colours of a theme."""
        self.palette_shown = palette
        self.update()

    def set_camera(self, camera: Camera | None) -> None:
        """Follow the camera when the view is painted next; None hides bar and axes, for one with nothing in it."""
        self.camera = camera
        self._hovered, self.tip = None, ""

    def set_notice(self, text: str) -> None:
        """Say something in the middle of the view, or above the outline of a plate."""
        if text != self.notice:
            self.notice = text
            self.update()

    def set_loops(self, loops: list[Floats]) -> None:
        """Shade a plate that is not meshed: its outline and holes, each (N, 3) in space."""
        if loops or self._loops:
            self._loops = loops
            self.update()

    def set_legend(self, title: str, rows: list[Entry]) -> None:
        """Say what the colours mean; no rows where another legend does."""
        if (title, rows) != self._legend:
            self._legend = (title, rows)
            self.update()

    def set_inspection(self, inspection: Inspection | None) -> None:
        """Write lengths and angles at an element."""
        if inspection is not self._inspection:
            self._inspection = inspection
            self.update()

    def hover(self, tip: str, cursor: QPointF, corners: Floats | None) -> None:
        """Outline an element, its `corners` (K, 3) in space, and say something of it beside the cursor."""
        if tip or self.tip:
            self.tip, self._cursor, self._hovered = tip, cursor, corners
            self.update()

    def paintEvent(self, event: QPaintEvent) -> None:  # noqa: ARG002
        """Paint all that there is."""
        painter = QPainter(self)
        painter.setRenderHint(QPainter.RenderHint.Antialiasing)
        if self.camera is not None:
            self._paint_plate(painter, self.camera)
            self._paint_hovered(painter, self.camera)
            self._paint_axes(painter, self.camera)
            self._paint_bar(painter, self.camera.pixel)
            corner = QPointF(self.fontMetrics().height(), self.fontMetrics().height())
            taken = draw_legend(painter, self.palette_shown, corner, *self._legend)
            self._paint_inspection(painter, self.camera, taken)
        self._paint_notice(painter)
        self._paint_tip(painter)
        painter.end()

    def _polygon(self, camera: Camera, points: Floats) -> QPolygonF:
        across = camera.pixels(points) * [1, -1] + [self.width() / 2, self.height() / 2]
        return QPolygonF([QPointF(x, y) for x, y in across.tolist()])

    def _paint_plate(self, painter: QPainter, camera: Camera) -> None:
        inside = QPainterPath()  # where an odd number of loops runs around
        for loop in self._loops:
            inside.addPolygon(self._polygon(camera, loop))
            inside.closeSubpath()
        shade = QColor(self.palette_shown.accent)
        shade.setAlpha(28)
        painter.fillPath(inside, shade)

    def _paint_hovered(self, painter: QPainter, camera: Camera) -> None:
        if self._hovered is None:
            return
        painter.setPen(QPen(QColor(self.palette_shown.hover), 2.5, _SOLID, _FLAT, Qt.PenJoinStyle.RoundJoin))
        painter.setBrush(Qt.BrushStyle.NoBrush)
        painter.drawPolygon(self._polygon(camera, self._hovered))

    def _paint_inspection(self, painter: QPainter, camera: Camera, taken: QRectF) -> None:
        if self._inspection is not None:
            outline = self._polygon(camera, self._inspection.anatomy.corners).toList()
            draw_dimensions(Sheet(painter, self.palette_shown, QRectF(self.rect()), taken), outline, self._inspection)

    def _paint_bar(self, painter: QPainter, pixel: float) -> None:
        letter = self.fontMetrics().height()
        length = nice_length(9.0 * letter * pixel)
        width = length / pixel
        right, base = self.width() - 1.25 * letter, self.height() - 1.25 * letter
        bar = [QPointF(right - width, base - 5), QPointF(right - width, base)]
        bar += [QPointF(right, base), QPointF(right, base - 5)]
        text = written(length)
        wide = self.fontMetrics().horizontalAdvance(text) > width
        room = max(width, self.fontMetrics().horizontalAdvance(text)) + letter
        self._paint_ground(painter, QRectF(right - room + 0.5 * letter, base - 1.6 * letter, room, 2 * letter))
        painter.setPen(QPen(QColor(self.palette_shown.dim), 1.5, _SOLID, _FLAT, Qt.PenJoinStyle.MiterJoin))
        painter.drawPolyline(bar)
        above = QRectF(right - 20 * letter, base - 8 - letter, 20 * letter, letter)
        middle = QRectF(right - width / 2 - 10 * letter, above.top(), 20 * letter, letter)
        painter.drawText(above if wide else middle, _RIGHT if wide else Qt.AlignmentFlag.AlignCenter, text)

    def _paint_ground(self, painter: QPainter, box: QRectF) -> None:
        """Let what is written be read over elements."""
        ground = QColor(self.palette_shown.view)
        ground.setAlpha(200)
        painter.setPen(Qt.PenStyle.NoPen)
        painter.setBrush(ground)
        painter.drawRoundedRect(box, 4, 4)

    def _paint_axes(self, painter: QPainter, camera: Camera) -> None:
        letter = self.fontMetrics().height()
        reach = 2.0 * letter
        origin = QPointF(1.5 * letter + reach, self.height() - 1.5 * letter - reach)
        axes = np.stack([camera.right, -camera.up, camera.towards], axis=1)
        for axis in np.argsort(axes[:, 2]).tolist():  # the nearest last, over the others
            self._paint_axis(painter, origin, axes[axis], reach, "XYZ"[axis])

    def _paint_axis(self, painter: QPainter, origin: QPointF, axis: Floats, reach: float, name: str) -> None:
        letter = self.fontMetrics().height()
        dim, text = QColor(self.palette_shown.dim), QColor(self.palette_shown.text)
        tip = QPointF(axis[0] * reach, axis[1] * reach)
        painter.setPen(QPen(dim, 1.5))
        if np.hypot(axis[0], axis[1]) > 0.1:
            painter.drawLine(origin, origin + tip)
            beyond = origin + tip * (1 + 0.55 * letter / np.hypot(tip.x(), tip.y()))
        else:  # straight at the viewer, or away from him
            painter.setBrush(dim if axis[2] > 0 else Qt.BrushStyle.NoBrush)
            painter.drawEllipse(origin, 3.0, 3.0)
            beyond = origin + QPointF(-0.6, 0.6) * letter
        painter.setPen(text)
        box = QRectF(0, 0, 2 * letter, 2 * letter)
        box.moveCenter(beyond)
        painter.drawText(box, Qt.AlignmentFlag.AlignCenter, name)

    def _paint_tip(self, painter: QPainter) -> None:
        if not self.tip:
            return
        letter = self.fontMetrics()
        box = QRectF(letter.boundingRect(self.tip)).adjusted(-8, -5, 8, 5)
        box.moveTopLeft(self._cursor + QPointF(14, 18))
        if box.right() > self.width() - 4:
            box.moveRight(self._cursor.x() - 8)
        if box.bottom() > self.height() - 4:
            box.moveBottom(self._cursor.y() - 8)
        painter.setPen(QPen(QColor(self.palette_shown.rule), 1))
        painter.setBrush(QColor(self.palette_shown.panel))
        painter.drawRoundedRect(box, 4, 4)
        painter.setPen(QColor(self.palette_shown.text))
        painter.drawText(box, Qt.AlignmentFlag.AlignCenter, self.tip)

    def _paint_notice(self, painter: QPainter) -> None:
        margin = (1 if self._loops else 3) * self.fontMetrics().height()
        box = QRectF(self.rect()).adjusted(margin, margin, -margin, -margin)
        painter.setPen(QColor(self.palette_shown.dim))
        height = Qt.AlignmentFlag.AlignTop if self._loops else Qt.AlignmentFlag.AlignVCenter  # above a plate
        painter.drawText(box, Qt.AlignmentFlag.AlignHCenter | height | Qt.TextFlag.TextWordWrap, self.notice)
