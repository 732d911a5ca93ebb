"""The life of the desktop program, from QApplication to exit code."""

import signal
import sys
from collections.abc import Callable, Sequence
from functools import partial
from pathlib import Path

from PySide6.QtCore import QTimer
from PySide6.QtWidgets import QApplication

from hullquad import __version__
from hullquad_app.faults import Faults
from hullquad_app.garbage import Garbage
from hullquad_app.logs import log_folder, start_logging
from hullquad_app.session import Session
from hullquad_app.window import MainWindow


def show(files: Sequence[str], watch: Callable[[MainWindow], object] = lambda _: None) -> int:
    """Show the window with `files` opened until it is closed; gives the exit code.

    Parameters
    ----------
    watch
        Gets the window before it is shown: who measures it enters by the same door as everybody.
    """
    application = QApplication(sys.argv[:1])
    application.setApplicationName("hullquad")
    application.setApplicationDisplayName("HullQuad")
    application.setApplicationVersion(__version__)
    application.setStyle("Fusion")
    start_logging(log_folder())
    signal.signal(signal.SIGINT, signal.SIG_DFL)  # Ctrl+C in the terminal; Qt's loop would never look
    window = MainWindow(Session())
    faults, garbage = Faults(window), Garbage(application)
    watch(window)
    window.show()
    QTimer.singleShot(0, partial(window.start, Path(files[0]) if files else None))
    code = application.exec()
    window.stop()
    faults.release()
    garbage.release()
    return code
