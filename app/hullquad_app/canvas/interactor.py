"""The widget in which VTK paints; slow to import, so the window is on the screen before."""

from collections import deque
from time import perf_counter
from typing import Any

from PySide6.QtCore import Qt, QTimer, Signal
from PySide6.QtWidgets import QWidget
from pyvistaqt import QtInteractor

_SAMPLES = 4
_REST = 250
"""How long nothing must happen before the picture is smoothed [ms]."""
_QUICK, _AFFORDABLE = 0.012, 0.03
"""Times of a paint: smoothed ones up to the first are the rule, rough ones up to the other are smoothed at rest [s]."""


class Interactor(QtInteractor):
    """A view of VTK that takes no input and tells how long it paints.

    Smooth lines cost ten times the paint where there is no graphics card. There they come when the view is at rest.
    """

    painted = Signal(float)
    """Emitted with the seconds that painting took."""

    def __init__(self, parent: QWidget) -> None:
        super().__init__(parent, auto_update=False, multi_samples=0)
        self.setAcceptDrops(False)
        self.setAttribute(Qt.WidgetAttribute.WA_TransparentForMouseEvents)
        self.setFocusPolicy(Qt.FocusPolicy.NoFocus)
        self._rest = QTimer(self, singleShot=True, interval=_REST)
        self._rest.timeout.connect(self._smooth)
        self._last: deque[float] = deque(maxlen=3)
        self._picture: Any = self.ren_win

    @property
    def is_smooth(self) -> bool:
        """Whether the lines of the next picture are smoothed."""
        return bool(self._picture.GetMultiSamples())

    def refresh(self) -> None:
        """Paint soon: something has changed."""
        if self.is_smooth and min(self._last, default=0.0) > _QUICK:
            self._last.clear()
            self._picture.SetMultiSamples(0)
        self.update()

    def paintGL(self, *arguments: Any) -> None:
        """Paint, and see how long it takes."""
        start = perf_counter()
        super().paintGL(*arguments)  # type: ignore[no-untyped-call]  # pyvistaqt
        took = perf_counter() - start
        self._last.append(took)
        if not self.is_smooth:
            self._rest.start()
        self.painted.emit(took)

    def finish(self) -> None:
        """Close; nothing may be asked of it afterwards."""
        self._rest.stop()
        self._picture = None
        self.close()

    def _smooth(self) -> None:
        if min(self._last) < _AFFORDABLE:
            self._last.clear()
            self._picture.SetMultiSamples(_SAMPLES)
            self.update()
        elif len(self._last) == 1:  # the first picture is slow, whatever is in it
            self.update()
