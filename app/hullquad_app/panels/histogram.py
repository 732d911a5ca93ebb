"""The histogram that is the legend: bars to click, the limit to drag."""

import numpy as np
from PySide6.QtCore import QEvent, QPoint, QPointF, QRectF, QSize, Qt, Signal
from PySide6.QtGui import QColor, QFontMetricsF, QHelpEvent, QKeyEvent, QMouseEvent, QPainter, QPaintEvent
from PySide6.QtWidgets import QSizePolicy, QToolTip, QWidget

from hullquad.arrays import Bools
from hullquad.histogram import Histogram, histogram
from hullquad.quality import Quality
from hullquad_app.colours import COLOUR_MAPS, LIGHT, ColourMap, Palette
from hullquad_app.limits import limit_words
from hullquad_app.panels.bars import Bars, bars, draw
from hullquad_app.panels.figures import CAPTION, sized
from hullquad_app.panels.handle import REACH, STEPS, Handle
from hullquad_app.panels.legend import bin_words, draw_legend
from hullquad_app.panels.limit import draw_limits, draw_triangle_limit
from hullquad_app.scene import Scene

_EXTENDS = Qt.KeyboardModifier.ShiftModifier | Qt.KeyboardModifier.ControlModifier


class HistogramChart(QWidget):
    """Elements by value; says which bar was clicked and where the limit was moved to."""

    limit_dragged = Signal(int, float)
    """Number and value of a limit while the mouse has it."""
    limit_released = Signal(int, float)
    """Number and value of a limit where it was left, by mouse or key."""
    limit_reset = Signal()
    """The metric's own limits are wanted again."""
    selected = Signal(object, bool)
    """Rows of the elements of a bar (frozenset), and whether they extend the selection."""

    def __init__(self) -> None:
        super().__init__()
        self._palette, self._map = LIGHT, COLOUR_MAPS[0]
        self._quality: Quality | None = None
        self._first_quality: Quality | None = None
        self._selection: frozenset[int] = frozenset()
        self._given: Bools | None = None
        self._now: Histogram | None = None
        self._first: Histogram | None = None
        self._handle = Handle()
        self._hovered: int | None = None
        self._hovered_limit: int | None = None
        self.setMouseTracking(True)
        self.setFocusPolicy(Qt.FocusPolicy.StrongFocus)
        self.setSizePolicy(QSizePolicy.Policy.Expanding, QSizePolicy.Policy.Expanding)
        self.setAccessibleName(self.tr("Histogram of the elements' quality"))

    def show_scene(self, scene: Scene) -> None:
        """Show the spread of a scene's quality."""
        shown = (scene.quality, scene.first_quality, scene.view.selection, scene.given)
        if all(new is old for new, old in zip(shown, self._shown, strict=True)):
            return
        if (scene.quality is None) != (self._quality is None):
            self.updateGeometry()
        self._quality, self._first_quality, self._selection, self._given = shown
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
        """Enough for the axes and some bars; the legend needs more."""
        return self._letters_size(24, 2 if self._quality is None else 5)

    def point_at(self, value: float) -> QPointF:
        """Where a value is, in the middle of the ground."""
        plot = self._plot()
        return QPointF() if plot is None else QPointF(plot.x.at(value), (plot.y.start + plot.y.end) / 2)

    @property
    def _shown(self) -> tuple[Quality | None, Quality | None, frozenset[int], Bools | None]:
        return self._quality, self._first_quality, self._selection, self._given

    def _count(self) -> None:
        before, self._now, self._first = self._now, None, None
        if self._quality is None or not len(self._quality.values):
            return
        edges = before.edges if self._handle.is_held and before is not None else None  # the ground stays still
        self._now = histogram(self._quality, edges)
        if self._first_quality is not None and self._first_quality is not self._quality:
            self._first = histogram(self._first_quality, self._now.edges)
        self.setAccessibleDescription(self._description(self._quality))

    def _description(self, quality: Quality) -> str:
        one = self.tr("limit {limit}; Left and Right move it")
        two = self.tr("limits {limit}; Left and Right move one of them, Up and Down choose which")
        return (two if quality.metric.is_two_sided else one).format(limit=limit_words(quality.metric, quality.band))

    def _plot(self) -> Bars | None:
        if self._quality is None or self._now is None:
            return None
        letters = QFontMetricsF(sized(self.font(), CAPTION))
        rows = np.fromiter(self._selection, dtype=np.int64, count=len(self._selection))
        rows = rows[rows < len(self._now.bins)]
        selected = frozenset(np.unique(self._now.bins[rows]).tolist()) - {-1}
        given = 0 if self._given is None else int(self._given.sum())
        return bars(QRectF(self.rect()), letters, self._quality, self._now, self._first, selected, given)

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
        draw_limits(painter, plot, self._palette, self._lively(plot.quality))

    def _lively(self, quality: Quality) -> int | None:
        """Number of the limit that mouse or keys would move now."""
        if self._hovered_limit is not None and not self._handle.is_held:
            return self._hovered_limit
        return self._handle.end_among(quality) if self._handle.is_held or self.hasFocus() else None

    def mouseMoveEvent(self, move: QMouseEvent) -> None:
        """Drag the limit, or show what is under the mouse."""
        plot = self._plot()
        if plot is None:
            return
        if not self._handle.is_held:
            self._hover(plot, move.position())
        elif (value := self._handle.drag(plot, move.position())) is not None:
            self.limit_dragged.emit(self._handle.end, value)

    def mousePressEvent(self, press: QMouseEvent) -> None:
        """Take the limit, or select a bar."""
        plot = self._plot()
        if plot is None or press.button() != Qt.MouseButton.LeftButton:
            return
        if self._handle.take(plot, press.position()):
            self.update()
            return
        number = plot.bin_at(press.position())
        extend = bool(press.modifiers() & _EXTENDS)
        rows = frozenset() if number is None else frozenset(plot.now.rows(number).tolist())
        if rows or not extend:
            self.selected.emit(rows, extend)

    def mouseReleaseEvent(self, _: QMouseEvent) -> None:
        """Leave the limit where it is."""
        self._let_go(give_up=False)

    def mouseDoubleClickEvent(self, press: QMouseEvent) -> None:
        """Take back the metric's own limit."""
        plot = self._plot()
        if plot is not None and plot.limit_at(press.position(), REACH) is not None:
            self.limit_reset.emit()
        else:
            self.mousePressEvent(press)

    def leaveEvent(self, leaving: QEvent) -> None:
        """Nothing is under the mouse."""
        super().leaveEvent(leaving)
        self._hovered = self._hovered_limit = None
        self.update()

    def keyPressEvent(self, press: QKeyEvent) -> None:
        """Move the limit by arrows, take back the metric's own by Delete; Escape gives up dragging."""
        key = Qt.Key(press.key())
        if key == Qt.Key.Key_Escape and self._handle.is_held:
            self._let_go(give_up=True)
        elif self._quality is not None and self._now is not None and key in STEPS:
            limit = self._handle.stepped(self._quality, self._now, key)
            self.limit_released.emit(self._handle.end, limit)
        elif key in (Qt.Key.Key_Up, Qt.Key.Key_Down):
            self._handle.end = int(key == Qt.Key.Key_Up)
            self.update()
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
        if plot.limit_at(QPointF(at), REACH) is not None:
            return self.tr("Drag to move the limit, double-click to take back the metric's own")
        number = plot.bin_at(QPointF(at))
        if number is None:
            return ""
        return bin_words(plot, number)

    def _hover(self, plot: Bars, point: QPointF) -> None:
        limit = plot.limit_at(point, REACH)
        number = None if limit is not None else plot.bin_at(point)
        number = number if number is not None and plot.now.totals[number] else None
        if (limit, number) == (self._hovered_limit, self._hovered):
            return
        self._hovered_limit, self._hovered = limit, number
        bar = Qt.CursorShape.ArrowCursor if number is None else Qt.CursorShape.PointingHandCursor
        self.setCursor(bar if limit is None else Qt.CursorShape.SplitHCursor)
        self.update()

    def _let_go(self, *, give_up: bool) -> None:
        limit = self._handle.release(give_up=give_up)
        if limit is not None:
            self.limit_released.emit(self._handle.end, limit)
        self.update()

    def _letters_size(self, wide: int, high: int) -> QSize:
        letters = self.fontMetrics()
        return QSize(letters.averageCharWidth() * wide, letters.height() * high)
