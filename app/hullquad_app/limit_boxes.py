"""The limit as a number to type: one box, a second one for metrics with two sides, and the way back."""

from math import isfinite

from PySide6.QtCore import QSignalBlocker, Signal
from PySide6.QtWidgets import QDoubleSpinBox, QHBoxLayout, QToolButton, QWidget

from hullquad.metrics import Band, Metric
from hullquad_app.colours import LIGHT, Palette
from hullquad_app.limits import decimals, limit_words, step
from hullquad_app.metric_words import name_of
from hullquad_app.theme import icon

_LONGEST = "≤ 50.0 mm"
"""Of the texts that the boxes are wide enough for."""
_LARGEST = 1e6


class LimitBoxes(QWidget):
    """Shows within which values elements pass, and tells where the user wants a limit instead."""

    moved = Signal(int, float)
    """Number of a limit (of two 0 is the lower one), and its value."""
    reset_wanted = Signal()
    """The metric's own limits are wanted again."""

    def __init__(self) -> None:
        super().__init__()
        self._metric: Metric | None = None
        self.boxes = (QDoubleSpinBox(), QDoubleSpinBox())
        self.reset, self._room = QToolButton(), QWidget()
        self._is_squeezed = False
        for end, box in enumerate(self.boxes):
            box.setKeyboardTracking(False)
            box.valueChanged.connect(lambda value, end=end: self.moved.emit(end, value))
        self.reset.setAutoRaise(True)
        self.reset.setAccessibleName(self.tr("Take back the metric's own limit"))
        self.reset.clicked.connect(self.reset_wanted)
        self.setFocusProxy(self.boxes[0])
        self._lay_out()
        self.set_palette(LIGHT)

    def show_limits(self, by: Metric, band: Band) -> None:
        """Show the limits of a metric."""
        limits = by.limits(band)
        if by is not self._metric:
            self._metric = by
            self._dress(by)
        self.boxes[1].setVisible(by.is_two_sided)
        self._room.setVisible(not by.is_two_sided and not self._is_squeezed)
        for box, limit, ends in zip(self.boxes, limits, _ranges(by, band), strict=False):
            with QSignalBlocker(box):
                box.setDecimals(decimals(by, limits))
                box.setRange(*ends)
                box.setValue(limit)
        self.reset.setEnabled(band != by.band)
        own = self.tr("Take back the limit of the metric itself: {limit}")
        self.reset.setToolTip(own.format(limit=limit_words(by, by.band)))

    def squeeze(self, wanted: bool) -> None:
        """Do without the room that is kept for a second box."""
        self._is_squeezed = wanted
        self._room.setVisible(not wanted and not self.boxes[1].isVisibleTo(self))

    def set_palette(self, palette: Palette) -> None:
        """Draw the icon in the colours of a theme."""
        self.reset.setIcon(icon("own", palette))

    def _dress(self, by: Metric) -> None:
        one, two = (
            self.tr("Limit of {metric}"),
            (self.tr("Lower limit of {metric}"), self.tr("Upper limit of {metric}")),
        )
        tips = (self.tr("Quads below it fail."), self.tr("Quads above it fail."))
        for end, box in enumerate(self.boxes):
            is_least = end == 0 and isfinite(by.band[0])
            name = (two[end] if by.is_two_sided else one).format(metric=name_of(by))
            box.setAccessibleName(name)
            box.setToolTip(f"{name}.\n{tips[0 if is_least else 1]}")
            with QSignalBlocker(box):
                box.setPrefix("≥ " if is_least else "≤ ")
                box.setSuffix(f"\N{NARROW NO-BREAK SPACE}{by.unit}" if by.unit.isalpha() else by.unit)
                box.setSingleStep(step(by))

    def _lay_out(self) -> None:
        """Without a second box there is as much room behind: what stands beside must not jump."""
        row = QHBoxLayout(self)
        row.setContentsMargins(0, 0, 0, 0)
        row.setSpacing(self.fontMetrics().averageCharWidth() // 2)
        letters = self.fontMetrics()
        width = letters.horizontalAdvance(_LONGEST) + round(1.7 * letters.height())
        for widget in (*self.boxes, self._room):
            widget.setFixedWidth(width)
        for widget in (*self.boxes, self.reset, self._room):
            row.addWidget(widget)


def _ranges(by: Metric, band: Band) -> tuple[tuple[float, float], ...]:
    """Where each limit may be; of two neither passes the other."""
    low, high = by.quads.low, min(by.quads.high, _LARGEST)
    return ((low, band[1]), (band[0], high)) if by.is_two_sided else ((low, high),)
