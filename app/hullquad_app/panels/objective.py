"""Objective history: the sum over the iterations, and the worst value below it."""

from PySide6.QtCore import QEvent, QLineF, QPointF, QRectF, QSize, Qt, Signal
from PySide6.QtGui import QColor, QFontMetricsF, QHelpEvent, QKeyEvent, QMouseEvent, QPainter, QPaintEvent, QPen
from PySide6.QtWidgets import QSizePolicy, QToolTip, QWidget

from hullquad_app.colours import COLOUR_MAPS, LIGHT, ColourMap, Palette
from hullquad_app.metric_words import name_of
from hullquad_app.objectives import objective_name
from hullquad_app.panels.axis import Axis, ticks
from hullquad_app.panels.band import Band, bands, draw_course, draw_frame, draw_mark, draw_ring, draw_station
from hullquad_app.panels.course import Course, course
from hullquad_app.panels.figures import CAPTION, counted, sized, summed, valued
from hullquad_app.panels.ground import dress
from hullquad_app.panels.pace import Pace
from hullquad_app.panels.stage_marks import draw_stages
from hullquad_app.scene import Scene
from hullquad_app.stage_words import stage_words
from hullquad_app.track import Track

_CENTRE = Qt.AlignmentFlag.AlignCenter
_RIGHT = Qt.AlignmentFlag.AlignRight | Qt.AlignmentFlag.AlignVCenter
_STEPS = {
    Qt.Key.Key_Left: -1,
    Qt.Key.Key_Right: 1,
    Qt.Key.Key_PageUp: -10,
    Qt.Key.Key_PageDown: 10,
    Qt.Key.Key_Home: -(10**9),
    Qt.Key.Key_End: 10**9,
}


class ObjectivePanel(QWidget):
    """Two lines over the iterations: what the run makes better, and the worst element."""

    position_chosen = Signal(int)
    """Position in the track of the iterate to show."""

    def __init__(self) -> None:
        super().__init__()
        self._palette = LIGHT
        self._track: Track | None = None
        self._course: Course | None = None
        self._position = 0
        self._hovered: int | None = None
        self._scene, self._pace = Scene(), Pace(self._refresh, self)
        self.setMouseTracking(True)
        self.setFocusPolicy(Qt.FocusPolicy.StrongFocus)
        self.setSizePolicy(QSizePolicy.Policy.Expanding, QSizePolicy.Policy.Expanding)
        self.setAccessibleName(self.tr("Objective over the iterations"))
        dress(self, LIGHT)

    def show_scene(self, scene: Scene) -> None:
        """Show the track of a scene and where it stands; while it runs not more than a few times a second."""
        self._scene = scene
        if scene.track is not self._track or scene.position != self._position:
            self._pace.ask(at_once=not scene.running)

    def _refresh(self) -> None:
        scene = self._scene
        if scene.track is not self._track:
            self.updateGeometry()
            self._course = None if scene.track is None else course(scene.track)
            self._hovered = None
        self._track, self._position = scene.track, scene.position
        if self._course is not None:
            self.setAccessibleDescription(self._words(self._position))
        self.update()

    def set_palette(self, palette: Palette, _: ColourMap = COLOUR_MAPS[0]) -> None:
        """Draw in the colours of a theme."""
        self._palette = palette
        dress(self, palette)

    def sizeHint(self) -> QSize:
        """As wide as forty letters, nine lines high."""
        letters = self.fontMetrics()
        return QSize(letters.averageCharWidth() * 40, letters.height() * 9)

    def minimumSizeHint(self) -> QSize:
        """Enough for the upper band."""
        letters = self.fontMetrics()
        return QSize(letters.averageCharWidth() * 24, round(letters.height() * (2 if self._track is None else 4.5)))

    def point_at(self, position: int) -> QPointF:
        """Where an iterate of the track is on the upper line."""
        if self._course is None:
            return QPointF()
        upper = self._bands(self._course)[0]
        return QPointF(upper.x.at(self._course.numbers[position]), upper.y.at(self._course.objectives[position]))

    def paintEvent(self, _: QPaintEvent) -> None:
        """Draw both bands, the axis of the iterations and the marks."""
        painter = QPainter(self)
        painter.setFont(sized(self.font(), CAPTION))
        if self._course is None:
            painter.setPen(QColor(self._palette.dim))
            painter.drawText(self.rect(), _CENTRE, self.tr("no mesh yet"))
            return
        rows, both = self._course, self._bands(self._course)
        for row in both:
            draw_frame(painter, row, self._palette)
        self._draw_iterations(painter, both[0].x, rows)
        draw_stages(painter, both[0], rows, self._palette)
        painter.setRenderHint(QPainter.RenderHint.Antialiasing)
        for row in both:
            draw_course(painter, row, rows, rows.part_at(self._position), self._palette)
        self._draw_marks(painter, both, rows)

    def mouseMoveEvent(self, move: QMouseEvent) -> None:
        """Point at an iterate; show it while the button is down."""
        position = self._position_at(move.position())
        if position != self._hovered:
            self._hovered = position
            self.update()
        if move.buttons() & Qt.MouseButton.LeftButton:
            self._choose(position)

    def mousePressEvent(self, press: QMouseEvent) -> None:
        """Show the iterate that was clicked."""
        if press.button() == Qt.MouseButton.LeftButton:
            self._choose(self._position_at(press.position()))

    def leaveEvent(self, leaving: QEvent) -> None:
        """Point at nothing."""
        super().leaveEvent(leaving)
        self._hovered = None
        self.update()

    def keyPressEvent(self, press: QKeyEvent) -> None:
        """Go through the iterates by arrows, Page, Home and End."""
        step = _STEPS.get(Qt.Key(press.key()))
        if step is None or self._track is None:
            super().keyPressEvent(press)
            return
        self._choose(min(max(self._position + step, 0), len(self._track.iterates) - 1))

    def event(self, happening: QEvent) -> bool:
        """Show the numbers of the iterate under the mouse."""
        if happening.type() == QEvent.Type.ToolTip and isinstance(happening, QHelpEvent):
            position = self._position_at(QPointF(happening.pos()))
            QToolTip.showText(happening.globalPos(), "" if position is None else self._words(position), self)
            return True
        return super().event(happening)

    def _choose(self, position: int | None) -> None:
        if position is not None and position != self._position:
            self.position_chosen.emit(position)

    def _position_at(self, point: QPointF) -> int | None:
        if self._course is None:
            return None
        x = self._bands(self._course)[0].x
        return self._course.nearest(x.value(point.x()))

    def _words(self, position: int) -> str:
        assert self._track is not None  # asked only where there are iterates
        iterate = self._track.iterates[position]
        by = iterate.quality.metric
        weighted = self._track.weighted_at(iterate.number)
        text = self.tr("iterate {number}: {name} {objective}, worst {worst}, moved {moved} mm").format(
            number=iterate.number,
            name=f"Σ {name_of(by)}" if weighted is None else objective_name(weighted),
            objective=summed(iterate.objective, None if weighted else by),
            worst=valued(iterate.quality.worst, by),
            moved=f"{iterate.displacement:.3g}",
        )
        if iterate.stage:
            text += self.tr(", {stage}").format(stage=stage_words(iterate.stage))
        is_best = self._course is not None and position == self._course.best
        return text + self.tr(" (best)") if is_best else text

    def _bands(self, rows: Course) -> tuple[Band, ...]:
        """The bands, beside the longest text of their axes."""
        letters = QFontMetricsF(sized(self.font(), CAPTION))
        line = letters.height()
        area = QRectF(self.rect()).adjusted(line, 0.4 * line, -0.7 * line, -1.8 * line)
        texts = [text for row in bands(rows, self._position, area, line, self._palette) for text in row.tick_texts]
        width = max(letters.horizontalAdvance(text) for text in (*texts, self.tr("iteration")))
        area.setLeft(round(0.5 * line + width + 0.5 * line))
        return bands(rows, self._position, area, line, self._palette)

    def _draw_iterations(self, painter: QPainter, x: Axis, rows: Course) -> None:
        """Write the iterations below, and part the metrics."""
        line = painter.fontMetrics().height()
        top = self.height() - 1.6 * line
        painter.setPen(QColor(self._palette.dim))
        painter.drawText(QRectF(0, top, x.start - 0.5 * line, line), _RIGHT, self.tr("iteration"))
        widest = painter.fontMetrics().horizontalAdvance(counted(int(x.high)))
        most = max(2, min(6, int((x.end - x.start) / (2 * widest))))
        for value in ticks(x.low, x.high, most, whole=True):
            left = min(x.at(value) - widest / 2, self.width() - widest - 1)
            painter.drawText(QRectF(left, top, widest + 1, line), _CENTRE, counted(int(value)))
        painter.setPen(QPen(QColor(self._palette.dim), 1, Qt.PenStyle.DotLine))
        for part in rows.parts[1:]:
            at = round(x.at(rows.numbers[part.start]))
            painter.drawLine(QLineF(at, 0.4 * line, at, top - 0.2 * line))

    def _draw_marks(self, painter: QPainter, both: tuple[Band, ...], rows: Course) -> None:
        """Draw lines where the shown iterate and the mouse are, a ring at the best and dots at the shown one."""
        ground, shown_at = self._palette.panel, self._position
        for row in both:
            draw_station(painter, row, rows.numbers[shown_at], self._palette.dim)
            if self._hovered is not None:
                draw_station(painter, row, rows.numbers[self._hovered], self._palette.accent)
        if rows.best != shown_at and rows.alike(rows.part_at(shown_at))[rows.best]:
            draw_ring(painter, both[0], rows, rows.best, ground, self.tr("best"))
        for row in both:
            draw_mark(painter, row, rows, shown_at, ground)
