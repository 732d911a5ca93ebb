"""What the program leaves behind for whoever looks into a fault: a log that rotates, and traces of crashes."""

import faulthandler
import logging
import logging.handlers
import platform
import sys
import threading
from pathlib import Path
from types import TracebackType

from PySide6 import __version__ as pyside_version
from PySide6.QtCore import QMessageLogContext, QStandardPaths, QtMsgType, qInstallMessageHandler, qVersion

from hullquad import __version__

_QT_LEVELS = {
    QtMsgType.QtDebugMsg: logging.DEBUG,
    QtMsgType.QtInfoMsg: logging.INFO,
    QtMsgType.QtWarningMsg: logging.WARNING,
    QtMsgType.QtCriticalMsg: logging.ERROR,
    QtMsgType.QtFatalMsg: logging.CRITICAL,
}


def log_folder() -> Path:
    """The user's folder for logs, by the custom of the system."""
    return Path(QStandardPaths.writableLocation(QStandardPaths.StandardLocation.StateLocation))


def start_logging(folder: Path) -> None:
    """Log to ``hullquad.log`` and crashes to ``crash.log``, with whatever Python and Qt leave unhandled."""
    logging.basicConfig(level=logging.INFO, format="%(asctime)s %(levelname)s %(name)s: %(message)s", force=True)
    logging.getLogger().handlers[0].setLevel(logging.WARNING)  # the terminal
    try:
        folder.mkdir(parents=True, exist_ok=True)
        _log_to(folder)
    except OSError as problem:
        logging.warning("no log is kept: %s", problem)
    sys.excepthook = _log_exception
    threading.excepthook = _log_thread_exception
    qInstallMessageHandler(_log_qt_message)
    logging.info(
        "HullQuad %s, Python %s, PySide %s, Qt %s, %s",
        *(__version__, platform.python_version(), pyside_version, qVersion(), platform.platform()),
    )


def _log_to(folder: Path) -> None:
    handler = logging.handlers.RotatingFileHandler(
        folder / "hullquad.log", maxBytes=1_000_000, backupCount=3, encoding="utf-8"
    )
    handler.setFormatter(logging.getLogger().handlers[0].formatter)
    logging.getLogger().addHandler(handler)
    crashes = (folder / "crash.log").open("a", encoding="utf-8")  # for as long as the process lives
    faulthandler.enable(crashes)


def _log_exception(kind: type[BaseException], problem: BaseException, trace: TracebackType | None) -> None:
    if issubclass(kind, KeyboardInterrupt):
        sys.__excepthook__(kind, problem, trace)
    else:
        logging.critical("unhandled", exc_info=(kind, problem, trace))


def _log_thread_exception(event: threading.ExceptHookArgs) -> None:
    if event.exc_value is not None:
        _log_exception(event.exc_type, event.exc_value, event.exc_traceback)


def _log_qt_message(kind: QtMsgType, context: QMessageLogContext, text: str) -> None:
    logging.getLogger(f"qt.{context.category}").log(_QT_LEVELS.get(kind, logging.WARNING), "%s", text)
