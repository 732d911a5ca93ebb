"""The hand on a histogram's limits: which one the keys move, and where the mouse has it."""

import attrs
from PySide6.QtCore import QPointF, Qt

from hullquad.histogram import Histogram
from hullquad.quality import Quality
from hullquad_app.limits import with_limit
from hullquad_app.panels.bars import Bars
from hullquad_app.panels.limit import limit_step, rounded_limit

STEPS = {
    Qt.Key.Key_Left: -1,
    Qt.Key.Key_Right: 1,
    Qt.Key.Key_PageDown: -10,
    Qt.Key.Key_PageUp: 10,
}
"""By how many steps each key moves the limit."""
REACH = 5
"""How near to the limit's line the mouse takes it [px]."""


@attrs.define
class Handle:
    """One of the limits: that which was touched last."""

    end: int = 0
    """Its number: of two limits 0 is the lower one."""
    is_held: bool = False
    """Whether the mouse has it."""
    _before: float = 0.0
    _now: float = 0.0

    def end_among(self, quality: Quality) -> int:
        """Its number among the limits of a quality, of which there may be fewer than there were."""
        return min(self.end, len(quality.limits) - 1)

    def take(self, plot: Bars, point: QPointF) -> bool:
        """Take the limit at a point; whether there is one."""
        found = plot.limit_at(point, REACH)
        if found is None:
            return False
        self.end, self.is_held = found, True
        self._before = self._now = plot.quality.limits[found]
        return True

    def drag(self, plot: Bars, point: QPointF) -> float | None:
        """The limit's new value at a point; None where it stays."""
        value = self._bounded(plot.quality, rounded_limit(plot.now, plot.x.value(point.x())))
        is_same, self._now = value == self._now, value
        return None if is_same else value

    def release(self, *, give_up: bool = False) -> float | None:
        """The limit's value where it is left, or where it was before; None where nothing has changed."""
        was_moved, self.is_held = self.is_held and self._now != self._before, False
        return (self._before if give_up else self._now) if was_moved else None

    def stepped(self, quality: Quality, now: Histogram, key: Qt.Key) -> float:
        """The limit's value after a key."""
        self.end = self.end_among(quality)
        return self._bounded(quality, rounded_limit(now, quality.limits[self.end] + STEPS[key] * limit_step(now)))

    def _bounded(self, quality: Quality, value: float) -> float:
        """As near to a value as the other limit allows."""
        return quality.metric.limits(with_limit(quality.metric, quality.band, self.end, value))[self.end]
