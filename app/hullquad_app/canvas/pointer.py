"""What the mouse does in the view: click, orbit, pan."""

import attrs
from PySide6.QtCore import QPointF, Qt
from PySide6.QtGui import QMouseEvent
from PySide6.QtWidgets import QApplication

_LEFT, _MIDDLE = Qt.MouseButton.LeftButton, Qt.MouseButton.MiddleButton
_SHIFT = Qt.KeyboardModifier.ShiftModifier


@attrs.define
class Pointer:
    """One press of a button, until it is released."""

    button: Qt.MouseButton = Qt.MouseButton.NoButton
    extends: bool = False
    """Whether Shift was held when the button went down."""
    is_drag: bool = False
    """Whether the mouse has moved too far for a click."""
    _start: QPointF = attrs.field(factory=QPointF)
    _last: QPointF = attrs.field(factory=QPointF)

    @property
    def is_down(self) -> bool:
        """Whether a button is held."""
        return self.button != Qt.MouseButton.NoButton

    @property
    def pans(self) -> bool:
        """Whether a drag moves the plate; otherwise it turns it."""
        return self.button == _MIDDLE or self.extends

    def press(self, event: QMouseEvent) -> None:
        """Begin, unless another button is held already."""
        if not self.is_down and event.button() in (_LEFT, _MIDDLE):
            self.button = event.button()
            self.extends = bool(event.modifiers() & _SHIFT)
            self.is_drag = False
            self._start = self._last = event.position()

    def drag(self, event: QMouseEvent) -> QPointF | None:
        """How far the plate is dragged by this move [pixels, y down]; None while it may become a click."""
        if not self.is_down:
            return None
        away = (event.position() - self._start).manhattanLength()
        self.is_drag = self.is_drag or away >= QApplication.startDragDistance()
        if not self.is_drag:
            return None
        step = event.position() - self._last
        self._last = event.position()
        return step

    def release(self, event: QMouseEvent) -> bool:
        """End; whether it was a click with the left button."""
        if event.button() != self.button:
            return False
        is_click = self.button == _LEFT and not self.is_drag
        self.button = Qt.MouseButton.NoButton
        return is_click
