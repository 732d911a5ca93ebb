"""The slider over the whole width by which every iterate can be shown again."""

from collections.abc import Set

from PySide6.QtCore import QEvent, QPointF, QRect, QSignalBlocker, Qt, Signal
from PySide6.QtGui import QColor, QMouseEvent, QPainter, QPaintEvent, QPolygonF
from PySide6.QtWidgets import QHBoxLayout, QLabel, QSlider, QStyle, QStyleOptionSlider, QWidget

from hullquad_app.colours import COLOUR_MAPS, LIGHT, ColourMap, Palette
from hullquad_app.panels.figures import sized
from hullquad_app.panels.ground import coloured, frame
from hullquad_app.scene import Scene
from hullquad_app.stage_words import stage_words

_LEAST_DIGITS = 3
"""Room for iterates up to 999 from the start, so that the slider seldom changes its length."""


class Slider(QSlider):
    """A slider that jumps to where it is clicked, with a mark below its best value."""

    def __init__(self) -> None:
        super().__init__(Qt.Orientation.Horizontal)
        self._best: int | None = None
        self._colour = QColor(LIGHT.accent)

    def mark(self, best: int | None, colour: QColor) -> None:
        """Mark one value; None marks none."""
        self._best, self._colour = best, colour
        self.update()

    def mousePressEvent(self, press: QMouseEvent) -> None:
        """Go to the place of the click, and drag from there."""
        option = QStyleOptionSlider()
        self.initStyleOption(option)
        handle = self._part(option, QStyle.SubControl.SC_SliderHandle)
        if press.button() == Qt.MouseButton.LeftButton and not handle.contains(press.position().toPoint()):
            groove = self._part(option, QStyle.SubControl.SC_SliderGroove)
            room, at = (
                groove.width() - handle.width(),
                press.position().toPoint().x() - groove.x() - handle.width() // 2,
            )
            self.setValue(QStyle.sliderValueFromPosition(self.minimum(), self.maximum(), at, room))
        super().mousePressEvent(press)

    def paintEvent(self, painting: QPaintEvent) -> None:
        """Draw the slider, and a small triangle below the best value."""
        super().paintEvent(painting)
        if self._best is None or not self.isEnabled():
            return
        option = QStyleOptionSlider()
        self.initStyleOption(option)
        groove = self._part(option, QStyle.SubControl.SC_SliderGroove)
        handle = self._part(option, QStyle.SubControl.SC_SliderHandle).width()
        room = groove.width() - handle
        at = QStyle.sliderPositionFromValue(self.minimum(), self.maximum(), self._best, room)
        tip = QPointF(groove.x() + handle / 2 + at + 0.5, groove.center().y() + 4)
        painter = QPainter(self)
        painter.setRenderHint(QPainter.RenderHint.Antialiasing)
        painter.setPen(Qt.PenStyle.NoPen)
        painter.setBrush(self._colour)
        reach = 0.25 * self.fontMetrics().height()
        painter.drawPolygon(QPolygonF([tip, tip + QPointF(reach, 1.5 * reach), tip + QPointF(-reach, 1.5 * reach)]))

    def _part(self, option: QStyleOptionSlider, part: QStyle.SubControl) -> QRect:
        return self.style().subControlRect(QStyle.ComplexControl.CC_Slider, option, part, self)


class HistoryBar(QWidget):
    """Which of the iterates is shown, and a slider to show another."""

    position_chosen = Signal(int)
    """Position in the track of the iterate to show."""

    def __init__(self) -> None:
        super().__init__()
        self._palette, self._scene = LIGHT, Scene()
        self.title, self.slider = QLabel(self.tr("History")), Slider()
        self.stage, self.place = QLabel(), QLabel()
        self.stage.setAccessibleName(self.tr("Stage of the shown iterate"))
        self.title.setBuddy(self.slider)
        self.slider.setAccessibleName(self.tr("Iterate that is shown"))
        self.slider.setToolTip(self.tr("Show another iterate (Left, Right, Page Up, Page Down, Home, End)"))
        self.slider.valueChanged.connect(self.position_chosen)
        for label in (self.stage, self.place):
            label.setAlignment(Qt.AlignmentFlag.AlignRight | Qt.AlignmentFlag.AlignVCenter)
            label.setFont(sized(self.font()))
        line = QHBoxLayout(self)
        line.setContentsMargins(self.fontMetrics().averageCharWidth(), 0, self.fontMetrics().averageCharWidth(), 0)
        for widget, stretch in ((self.title, 0), (self.slider, 1), (self.stage, 0), (self.place, 0)):
            line.addWidget(widget, stretch=stretch)
        self._show()

    def show_scene(self, scene: Scene) -> None:
        """Show where a scene stands in its track."""
        before, self._scene = self._scene, scene
        if (scene.track, scene.position, scene.stage) != (before.track, before.position, before.stage):
            self._show()

    def set_palette(self, palette: Palette, _: ColourMap = COLOUR_MAPS[0]) -> None:
        """Take the colours of a theme."""
        self._palette = palette
        for label in (self.title, self.stage):
            coloured(label, palette.dim)
        coloured(self.place, palette.text)
        frame(self, palette)
        self._show()

    def changeEvent(self, change: QEvent) -> None:
        """Follow the font."""
        super().changeEvent(change)
        if change.type() == QEvent.Type.FontChange and hasattr(self, "place"):
            for label in (self.stage, self.place):
                label.setFont(sized(self.font()))
            self._show()

    def _show(self) -> None:
        track, position, stage = self._scene.track, self._scene.position, self._scene.stage
        iterates, making = ((), 0) if track is None else (track.iterates, len(track.making))
        numbers = (0, 0) if track is None else (iterates[position].number, track.last.number)
        best = max((row for row, iterate in enumerate(iterates) if iterate.is_best), default=None)
        with QSignalBlocker(self.slider):
            self.slider.setEnabled(len(iterates) + making > 1)
            self.slider.setRange(-making, max(len(iterates) - 1, 0))
            self.slider.setPageStep(max(len(iterates) // 10, 1))
            if not self.slider.isSliderDown():
                self.slider.setValue(position if stage is None else stage - making)
        self.slider.mark(best, QColor(self._palette.accent))
        self._show_stage({iterate.stage for iterate in iterates} | (track.making.steps if track else set()))
        self.place.setText(self._words(*map(str, numbers)) if iterates else "")
        of_making = self.tr("making {number} of {last}")
        if stage is not None:
            self.place.setText(of_making.format(number=stage + 1, last=making))
        digits = "0" * max(len(str(numbers[1])), len(str(making)), _LEAST_DIGITS)
        texts = self._words(digits, digits), of_making.format(number=digits, last=digits)
        self.place.setFixedWidth(max(map(self.place.fontMetrics().horizontalAdvance, texts)) + 2)

    def _show_stage(self, stages: Set[str]) -> None:
        """Name the stage of the shown iterate, in a place that is wide enough for all of them."""
        words = {stage: stage_words(stage) for stage in stages}
        self.stage.setText("" if self._scene.iterate is None else words[self._scene.iterate.stage])
        self.stage.setVisible(any(words.values()))
        advances = [self.stage.fontMetrics().horizontalAdvance(text) for text in words.values()]
        self.stage.setFixedWidth(max(advances, default=0) + 2)

    def _words(self, number: str, last: str) -> str:
        return self.tr("iterate {number} of {last}").format(number=number, last=last)
