"""The histogram that is the legend: bars to click, the limit to drag."""

import attrs
import numpy as np
from PySide6.QtCore import QEvent, QPoint, QPointF, QRectF, QSize, Qt, Signal
from PySide6.QtGui import QColor, QFontMetricsF, QHelpEvent, QKeyEvent, QMouseEvent, QPainter, QPaintEvent
from PySide6.QtWidgets import QSizePolicy, QToolTip, QWidget

from hullquad.histogram import Histogram, histogram
from hullquad.quality import Quality
from hullquad_app.colours import COLOUR_MAPS, LIGHT, ColourMap, Palette
from hullquad_app.document import Scene
from hullquad_app.panels.bars import Bars, bars, draw
from hullquad_app.panels.figures import CAPTION, sized
from hullquad_app.panels.legend import bin_words, draw_legend
from hullquad_app.panels.limit import draw_limit, draw_triangle_limit, limit_label, limit_step, rounded_limit

_REACH = 5
"""How near to the limit's line the mouse takes it [px]."""
_STEPS = {
    Qt.Key.Key_Left: -1,
    Qt.Key.Key_Right: 1,
    Qt.Key.Key_PageDown: -10,
    Qt.Key.Key_PageUp: 10,
}
_EXTENDS = Qt.KeyboardModifier.ShiftModifier | Qt.KeyboardModifier.ControlModifier


@attrs.define
class _Drag:
    """The limit in the user's hand."""

    before: float
    now: float


class HistogramChart(QWidget):
    """Elements by value; says which bar was clicked and where the limit was moved to."""

    limit_dragged = Signal(float)
    """The limit while the mouse has it."""
    limit_released = Signal(float)
    """The limit where it was left, by mouse or key."""
    limit_reset = Signal()
    """The metric's own limit is wanted again."""
    selected = Signal(object, bool)
    """Rows of the elements of a bar (frozenset), and whether they extend the selection."""

    def __init__(self) -> None:
        super().__init__()
        self._palette, self._map = LIGHT, COLOUR_MAPS[0]
        self._quality: Quality | None = None
        self._first_quality: Quality | None = None
        self._selection: frozenset[int] = frozenset()
        self._now: Histogram | None = None
        self._first: Histogram | None = None
        self._drag: _Drag | None = None
        self._hovered: int | None = None
        self._at_limit = False
        self.setMouseTracking(True)
        self.setFocusPolicy(Qt.FocusPolicy.StrongFocus)
        self.setSizePolicy(QSizePolicy.Policy.Expanding, QSizePolicy.Policy.Expanding)
        self.setAccessibleName(self.tr("Histogram of the elements' quality"))

    def show_scene(self, scene: Scene) -> None:
        """Show the spread of a scene's quality."""
        shown = (scene.quality, scene.first_quality, scene.view.selection)
        if all(new is old for new, old in zip(shown, self._shown, strict=True)):
            return
        self._quality, self._first_quality, self._selection = shown
        self._count()
        self.update()

    def set_palette(self, palette: Palette, chosen: ColourMap = COLOUR_MAPS[0]) -> None:
        """Draw in the colours of a theme and a map."""
        self._palette, self._map = palette, chosen
        self.update()

    def sizeHint(self) -> QSize:
        """Forty letters wide, twelve lines high."""
        return self._letters_size(40, 13)

    def minimumSizeHint(self) -> QSize:
        """Enough for the axes and some bars."""
        return self._letters_size(24, 9)

    def point_at(self, value: float) -> QPointF:
        """Where a value is, in the middle of the ground."""
        plot = self._plot()
        return QPointF() if plot is None else QPointF(plot.x.at(value), (plot.y.start + plot.y.end) / 2)

    @property
    def _shown(self) -> tuple[Quality | None, Quality | None, frozenset[int]]:
        return self._quality, self._first_quality, self._selection

    def _count(self) -> None:
        before, self._now, self._first = self._now, None, None
        if self._quality is None or not len(self._quality.values):
            return
        edges = before.edges if self._drag is not None and before is not None else None  # the ground stays still
        self._now = histogram(self._quality, edges)
        if self._first_quality is not None and self._first_quality is not self._quality:
            self._first = histogram(self._first_quality, self._now.edges)
        text = self.tr("limit {limit}; the arrow keys move it").format(limit=limit_label(self._quality))
        self.setAccessibleDescription(text)

    def _plot(self) -> Bars | None:
        if self._quality is None or self._now is None:
            return None
        letters = QFontMetricsF(sized(self.font(), CAPTION))
        rows = np.fromiter(self._selection, dtype=np.int64, count=len(self._selection))
        rows = rows[rows < len(self._now.bins)]
        selected = frozenset(np.unique(self._now.bins[rows]).tolist()) - {-1}
        return bars(QRectF(self.rect()), letters, self._quality, self._now, self._first, selected)

    def paintEvent(self, _: QPaintEvent) -> None:
        """Draw bars, strip, limit and legend."""
        painter, plot = QPainter(self), self._plot()
        painter.setFont(sized(self.font(), CAPTION))
        if plot is None:
            painter.setPen(QColor(self._palette.dim))
            painter.drawText(self.rect(), Qt.AlignmentFlag.AlignCenter, self.tr("no mesh yet"))
            return
        if self._hovered is not None:
            shade = QColor(self._palette.text)
            shade.setAlphaF(0.06)
            painter.fillRect(plot.column(self._hovered), shade)
        painter.setRenderHint(QPainter.RenderHint.Antialiasing, False)
        draw(painter, plot, self._palette, self._map)
        draw_triangle_limit(painter, plot, self._palette)
        draw_legend(painter, plot, self._palette, self._map)
        lively = self._at_limit or self._drag is not None or self.hasFocus()
        draw_limit(painter, plot, self._palette, lively=lively)

    def mouseMoveEvent(self, move: QMouseEvent) -> None:
        """Drag the limit, or show what is under the mouse."""
        plot = self._plot()
        if plot is None:
            return
        if self._drag is not None:
            value = rounded_limit(plot.now, plot.x.value(move.position().x()))
            if value != self._drag.now:
                self._drag.now = value
                self.limit_dragged.emit(value)
            return
        self._hover(plot, move.position())

    def mousePressEvent(self, press: QMouseEvent) -> None:
        """Take the limit, or select a bar."""
        plot = self._plot()
        if plot is None or press.button() != Qt.MouseButton.LeftButton:
            return
        if plot.is_limit_at(press.position(), _REACH):
            at = press.position().x()
            limit = min(plot.quality.limits, key=lambda end: abs(plot.x.at(end) - at))
            self._drag = _Drag(limit, limit)
            return
        number = plot.bin_at(press.position())
        extend = bool(press.modifiers() & _EXTENDS)
        rows = frozenset() if number is None else frozenset(plot.now.rows(number).tolist())
        if rows or not extend:
            self.selected.emit(rows, extend)

    def mouseReleaseEvent(self, _: QMouseEvent) -> None:
        """Leave the limit where it is."""
        self._let_go(None)

    def mouseDoubleClickEvent(self, press: QMouseEvent) -> None:
        """Take back the metric's own limit."""
        plot = self._plot()
        if plot is not None and plot.is_limit_at(press.position(), _REACH):
            self.limit_reset.emit()
        else:
            self.mousePressEvent(press)

    def leaveEvent(self, leaving: QEvent) -> None:
        """Nothing is under the mouse."""
        super().leaveEvent(leaving)
        self._hovered, self._at_limit = None, False
        self.update()

    def keyPressEvent(self, press: QKeyEvent) -> None:
        """Move the limit by arrows, take back the metric's own by Delete; Escape gives up dragging."""
        key = Qt.Key(press.key())
        if key == Qt.Key.Key_Escape and self._drag is not None:
            self._let_go(self._drag.before)
        elif self._quality is not None and self._now is not None and key in _STEPS:
            limit = self._quality.limits[0] + _STEPS[key] * limit_step(self._now)
            self.limit_released.emit(rounded_limit(self._now, limit))
        elif key in (Qt.Key.Key_Delete, Qt.Key.Key_Backspace):
            self.limit_reset.emit()
        else:
            super().keyPressEvent(press)

    def event(self, happening: QEvent) -> bool:
        """Show the numbers of the bar under the mouse."""
        if happening.type() == QEvent.Type.ToolTip and isinstance(happening, QHelpEvent):
            QToolTip.showText(happening.globalPos(), self._tip(happening.pos()), self)
            return True
        return super().event(happening)

    def _tip(self, at: QPoint) -> str:
        plot = self._plot()
        if plot is None:
            return ""
        if plot.is_limit_at(QPointF(at), _REACH):
            return self.tr("Drag to move the limit, double-click to take back the metric's own")
        number = plot.bin_at(QPointF(at))
        if number is None:
            return ""
        return bin_words(plot, number)

    def _hover(self, plot: Bars, point: QPointF) -> None:
        at_limit = plot.is_limit_at(point, _REACH)
        number = None if at_limit else plot.bin_at(point)
        number = number if number is not None and plot.now.totals[number] else None
        if (at_limit, number) == (self._at_limit, self._hovered):
            return
        self._at_limit, self._hovered = at_limit, number
        bar = Qt.CursorShape.ArrowCursor if number is None else Qt.CursorShape.PointingHandCursor
        self.setCursor(Qt.CursorShape.SplitHCursor if at_limit else bar)
        self.update()

    def _let_go(self, limit: float | None) -> None:
        drag, self._drag = self._drag, None
        if drag is not None and drag.now != drag.before:
            self.limit_released.emit(drag.now if limit is None else limit)
        self.update()

    def _letters_size(self, wide: int, high: int) -> QSize:
        letters = self.fontMetrics()
        return QSize(letters.averageCharWidth() * wide, letters.height() * high)
