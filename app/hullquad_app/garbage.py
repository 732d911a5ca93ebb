"""Python's garbage is collected by the thread of the window: no object of Qt may end in another one."""

import gc

from PySide6.QtCore import QObject, QTimer

_INTERVAL = 500
"""Between two looks whether there is enough of it [ms]."""


class Garbage(QObject):
    """Collects in the thread that owns it, in place of whichever thread happens to run when there is enough."""

    def __init__(self, parent: QObject | None = None) -> None:
        super().__init__(parent)
        gc.disable()
        gc.freeze()  # what is loaded stays
        self._timer = QTimer(self, interval=_INTERVAL)
        self._timer.timeout.connect(self.collect)
        self._timer.start()

    def release(self) -> None:
        """Leave garbage to Python again."""
        self._timer.stop()
        gc.unfreeze()
        gc.enable()

    def collect(self) -> None:
        """Collect the generations of which there is enough."""
        generations = enumerate(zip(gc.get_count(), gc.get_threshold(), strict=True))
        due = [generation for generation, (count, threshold) in generations if count > threshold]
        if due:
            gc.collect(due[-1])
