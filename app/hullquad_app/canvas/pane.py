"""The widget in which the plate is seen: VTK draws off the screen, Qt paints the picture like any other."""

from collections import deque
from time import perf_counter
from typing import Any

from PySide6.QtCore import QSize, Qt, QTimer, Signal
from PySide6.QtGui import QImage, QPainter, QPaintEvent
from PySide6.QtWidgets import QWidget

from hullquad_app.canvas.drawing import Drawing
from hullquad_app.turns import Turns

_SAMPLES = 4
_REST = 250
"""How long nothing must happen before the picture is smoothed [ms]."""
_QUICK, _AFFORDABLE = 0.012, 0.03
"""Times of drawings [s]: smooth ones up to the first are the rule, rough ones up to the other are smoothed at rest."""


class Pane(QWidget):
    """A view of VTK that takes no input and tells how long it paints.

    A widget of OpenGL would have Qt compose the whole window anew for each of its frames. Smooth lines cost ten times
    the drawing where there is no graphics card. There they come when the view is at rest.

    Parameters
    ----------
    turns
        Where drawing waits for its turn.
    """

    painted = Signal(float)
    """Emitted with the seconds that drawing a picture took, when it is painted for the first time."""

    def __init__(self, parent: QWidget, turns: Turns) -> None:
        super().__init__(parent)
        self.setAttribute(Qt.WidgetAttribute.WA_TransparentForMouseEvents)
        self.setAttribute(Qt.WidgetAttribute.WA_OpaquePaintEvent)
        self._drawing, self._turns = Drawing(), turns
        self.renderer: Any = self._drawing.renderer
        self._image = QImage()
        self.is_smooth = False
        """Whether the lines of the picture are smoothed."""
        self._is_due, self._is_closed = True, False
        self._took: float | None = None
        """Seconds that drawing the picture took; None when it has been on the screen."""
        self._last: deque[float] = deque(maxlen=3)
        self._rest = QTimer(self, singleShot=True, interval=_REST)
        self._rest.timeout.connect(self._smooth)

    def refresh(self) -> None:
        """Draw soon: something has changed."""
        if self._is_closed:
            return
        if self._drawing.samples and min(self._last, default=0.0) > _QUICK:
            self._sample(0)
        self._ask()

    def paintEvent(self, _: QPaintEvent) -> None:
        """Paint the picture; where it has not the size of the widget it is drawn before."""
        if self._image.size() != self._size():
            self._draw()
        painter = QPainter(self)
        painter.drawImage(0, 0, self._image)
        painter.end()
        if self._took is not None:
            took, self._took = self._took, None
            self.painted.emit(took)

    def finish(self) -> None:
        """Close; nothing may be asked of it afterwards."""
        self._rest.stop()
        self._is_closed = True
        self._drawing.finish()
        self.close()

    def _ask(self) -> None:
        self._is_due = True
        self._turns.ask(self._catch_up)

    def _catch_up(self) -> None:
        if self._is_due and self.isVisible():
            self._draw()
            self._turns.ask(self._put_up)

    def _put_up(self) -> None:
        """Have the picture painted, in a turn of its own, unless something else has."""
        if self._took is not None:
            self.update()

    def _size(self) -> QSize:
        """Width and height [device pixels]."""
        ratio = self.devicePixelRatioF()
        return QSize(max(round(self.width() * ratio), 1), max(round(self.height() * ratio), 1))

    def _draw(self) -> None:
        if self._is_closed:
            return
        start, size = perf_counter(), self._size()
        self._is_due, self.is_smooth = False, self._drawing.samples > 0
        pixels = self._drawing.pixels(size.width(), size.height())
        drawn = QImage(pixels.data, size.width(), size.height(), QImage.Format.Format_RGBX8888)
        self._image = drawn.convertToFormat(QImage.Format.Format_RGB32)  # the screen's, in memory of its own
        self._image.setDevicePixelRatio(self.devicePixelRatioF())
        self._took = perf_counter() - start
        self._last.append(self._took)
        if not self.is_smooth:
            self._rest.start()

    def _sample(self, samples: int) -> None:
        self._last.clear()
        self._drawing.samples = samples

    def _smooth(self) -> None:
        if min(self._last) < _AFFORDABLE:
            self._sample(_SAMPLES)
            self._ask()
        elif len(self._last) == 1:  # the first picture is slow, whatever is in it
            self._ask()
