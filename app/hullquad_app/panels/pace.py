"""At most so many refreshes a second while a run goes on, and always one at the end."""

from collections.abc import Callable

from PySide6.QtCore import QObject, QTimer

INTERVAL = 200
"""Between two refreshes of a table while running [ms]."""


class Pace:
    """Calls something now, or after the interval when it was called only just before."""

    def __init__(self, refresh: Callable[[], None], parent: QObject) -> None:
        self._refresh = refresh
        self._is_due = False
        self._timer = QTimer(parent)
        self._timer.setSingleShot(True)
        self._timer.setInterval(INTERVAL)
        self._timer.timeout.connect(self._catch_up)

    def ask(self, *, at_once: bool) -> None:
        """Refresh soon; `at_once` whatever was before."""
        if not at_once and self._timer.isActive():
            self._is_due = True
            return
        self._is_due = False
        self._timer.stop()
        self._refresh()
        if not at_once:
            self._timer.start()

    def _catch_up(self) -> None:
        if self._is_due:
            self.ask(at_once=False)
