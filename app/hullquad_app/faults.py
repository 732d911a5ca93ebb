"""A fault of the program itself: logged, and told in one dialog from which the user can go on."""

import logging
import sys
import traceback
from types import TracebackType

from PySide6.QtCore import QCoreApplication, QObject, Signal, Slot
from PySide6.QtGui import QGuiApplication
from PySide6.QtWidgets import QMessageBox, QWidget

_MOST_DETAILS = 20_000


class Faults(QObject):
    """Tells of exceptions that nobody caught, in slots or anywhere else; one dialog at a time, never a storm."""

    _found = Signal(str)

    def __init__(self, window: QWidget) -> None:
        super().__init__(window)
        self._window = window
        self._dialog: QMessageBox | None = None
        self._told: set[str] = set()
        self._found.connect(self._tell)
        sys.excepthook = self._catch

    def release(self) -> None:
        """Leave exceptions to Python again."""
        sys.excepthook = sys.__excepthook__

    def _catch(self, kind: type[BaseException], problem: BaseException, trace: TracebackType | None) -> None:
        if issubclass(kind, KeyboardInterrupt):
            sys.__excepthook__(kind, problem, trace)
            return
        logging.critical("unhandled", exc_info=(kind, problem, trace))
        details = "".join(traceback.format_exception(kind, problem, trace))
        self._found.emit(details[-_MOST_DETAILS:])

    @Slot(str)
    def _tell(self, details: str) -> None:
        """Show a fault, unless one is being shown or this one was shown before."""
        if self._dialog is not None or details in self._told:
            return
        self._told.add(details)
        dialog = QMessageBox(QMessageBox.Icon.Warning, _tr("HullQuad"), _tr("Something went wrong in the program."))
        dialog.setInformativeText(
            _tr("Your document is as it was before the last action. You can go on; save under another name to be safe.")
        )
        dialog.setDetailedText(details)
        copy = dialog.addButton(_tr("Copy details"), QMessageBox.ButtonRole.ActionRole)
        dialog.setDefaultButton(dialog.addButton(_tr("Continue"), QMessageBox.ButtonRole.AcceptRole))
        copy.clicked.connect(lambda: QGuiApplication.clipboard().setText(details))
        dialog.finished.connect(self._forget)
        dialog.setParent(self._window, dialog.windowFlags())
        self._dialog = dialog
        dialog.open()

    def _forget(self) -> None:
        if self._dialog is not None:
            self._dialog.deleteLater()
        self._dialog = None


def _tr(text: str) -> str:
    return QCoreApplication.translate("Faults", text)
