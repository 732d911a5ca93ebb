"""Opening, saving and leaving, with the dialogs they need and the question before something is lost."""

from collections.abc import Callable, Sequence
from pathlib import Path
from types import ModuleType
from typing import Any

from PySide6.QtCore import QObject, Qt
from PySide6.QtGui import QGuiApplication
from PySide6.QtWidgets import QFileDialog, QMessageBox, QWidget

from hullquad.errors import HullquadError
from hullquad_app.picture_menu import PictureMenu
from hullquad_app.session import Session

_BUTTONS = QMessageBox.StandardButton
_NAMED = 5
"""How many files a question lists."""


class Filing(QObject):
    """What the File menu does with a session."""

    def __init__(self, session: Session, window: QWidget) -> None:
        super().__init__(window)
        self._session, self._window = session, window
        self.picture_menu = PictureMenu(window)
        self._go: Callable[[], object] | None = None
        session.saved.connect(self._go_on)
        session.workshop.jobs.saving.ended.connect(self._stay)

    def choose_file(self) -> None:
        """Ask for plates or a mesh, and open them."""
        from hullquad.formats import FORMATS  # noqa: PLC0415  brings SciPy and Shapely

        readable = [kind for kind in FORMATS if kind.read_plates or kind.read_mesh]
        together = self.tr("Plates and meshes ({patterns})")
        kinds = [together.format(patterns=" ".join(f"*{kind.suffix}" for kind in readable))]
        kinds += [f"{kind.title} (*{kind.suffix})" for kind in readable]
        name, _ = QFileDialog.getOpenFileName(self._window, self.tr("Open"), "", ";;".join(kinds))
        if name:
            self.open(Path(name))

    def open(self, path: Path) -> None:
        """Open a file, once what would be lost is saved or given up."""
        self.leave(lambda: self._session.open(path))

    def choose_output(self) -> bool:
        """Ask for a file and save the mesh; whether one was given."""
        from hullquad.formats import FORMATS  # noqa: PLC0415

        kinds = ";;".join(f"{kind.title} (*{kind.suffix})" for kind in FORMATS if kind.write_mesh)
        self._stay()
        path = self._output(self.tr("Save mesh"), ".vtu", kinds, self._session.targets)
        if path is not None:
            self._session.save(path)
        return path is not None

    def choose_plates_output(self) -> bool:
        """Ask for a file and save the plates; whether one was given."""
        from hullquad.formats import FORMATS  # noqa: PLC0415

        kinds = ";;".join(f"{kind.title} (*{kind.suffix})" for kind in FORMATS if kind.write_plates)
        self._stay()
        path = self._output(self.tr("Save plates"), ".json", kinds, lambda file: [file])
        if path is not None:
            self._session.save_plates(path)
        return path is not None

    def choose_picture(self) -> None:
        """Ask for a file and save a picture of the plate as it is shown."""
        path = self._output(self.tr("Save picture"), ".png", self.tr("Pictures (*.png)"), lambda file: [file])
        if path is not None:
            self._picture(lambda: _pictures().write(self._session.document.scene, path, **self._choices))

    def copy_picture(self) -> None:
        """Put a picture of the plate as it is shown on the clipboard."""
        self._picture(lambda: _pictures().to_clipboard(self._session.document.scene, scale=self.picture_menu.scale))

    def leave(self, go: Callable[[], object]) -> None:
        """Go, once the changes of plates and meshes that were not saved are saved or given up; or stay."""
        if not self._session.has_unsaved_plates:
            self._leave_meshes(go)
            return
        text = self.tr("The plates of {title} were edited and not saved. Save them first?")
        answer = self._answer(text, _BUTTONS.Save | _BUTTONS.Discard | _BUTTONS.Cancel, _BUTTONS.Save)
        if answer == _BUTTONS.Discard and self._session.has_unsaved_meshes:
            self._leave_meshes(go)
        elif answer == _BUTTONS.Discard:
            go()
        elif answer == _BUTTONS.Save and self.choose_plates_output():
            self._go = lambda: self.leave(go)

    def _leave_meshes(self, go: Callable[[], object]) -> None:
        if not self._session.is_modified:
            go()
            return
        text = self.tr("{title} has changes that were not saved. Save the mesh first?")
        buttons, proposed = _BUTTONS.Save | _BUTTONS.Discard | _BUTTONS.Cancel, _BUTTONS.Save
        if not self._session.document.scene.state.tracks:
            text = self.tr("{title} has changes that will be lost, and no mesh that could be saved. Go on?")
            buttons, proposed = _BUTTONS.Discard | _BUTTONS.Cancel, _BUTTONS.Cancel
        answer = self._answer(text, buttons, proposed)
        if answer == _BUTTONS.Discard:
            go()
        elif answer == _BUTTONS.Save and self.choose_output():
            self._go = lambda: self._leave_meshes(go)

    def _answer(self, text: str, buttons: QMessageBox.StandardButton, proposed: QMessageBox.StandardButton) -> int:
        question = text.format(title=self._session.title)
        return QMessageBox.question(self._window, self.tr("HullQuad"), question, buttons, proposed)

    def _go_on(self) -> None:
        """Go where somebody wanted to when the files are written; what was changed meanwhile is asked for again."""
        go, self._go = self._go, None
        if go is not None:
            go()

    def _stay(self) -> None:
        self._go = None

    @property
    def _choices(self) -> dict[str, Any]:
        return {"scale": self.picture_menu.scale, "transparent": self.picture_menu.is_transparent}

    def _picture(self, take: Callable[[], object]) -> None:
        """Take a picture, which takes a moment; what goes wrong is told."""
        QGuiApplication.setOverrideCursor(Qt.CursorShape.WaitCursor)
        try:
            take()
        except HullquadError as error:
            self._session.message.emit(error)
        finally:
            QGuiApplication.restoreOverrideCursor()

    def _output(self, title: str, suffix: str, kinds: str, targets: Callable[[Path], Sequence[Path]]) -> Path | None:
        """The file somebody chose, if all that is written for it may be."""
        proposal = (self._session.path or Path(self._session.title or "mesh")).with_suffix(suffix)
        name, _ = QFileDialog.getSaveFileName(self._window, title, str(proposal), kinds)
        if not name:
            return None
        path = Path(name) if Path(name).suffix else Path(name + suffix)
        others = [file for file in targets(path) if file != Path(name) and file.exists()]
        return path if self._may_replace(others) else None

    def _may_replace(self, files: Sequence[Path]) -> bool:
        """Ask for files that the dialog did not know of."""
        if not files:
            return True
        names = [file.name for file in files[:_NAMED]]
        if len(files) > _NAMED:
            names.append(self.tr("and {count} more").format(count=len(files) - _NAMED))
        text = self.tr("These files exist already. Replace them?") + "\n\n" + "\n".join(names)
        buttons = _BUTTONS.Yes | _BUTTONS.No
        return QMessageBox.question(self._window, self.tr("HullQuad"), text, buttons, _BUTTONS.No) == _BUTTONS.Yes


def _pictures() -> ModuleType:
    """What takes pictures; it brings VTK and Pillow, so it is loaded when the first one is taken."""
    from hullquad_app import pictures as module  # noqa: PLC0415

    return module
