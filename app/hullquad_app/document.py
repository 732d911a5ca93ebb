"""The document: what is open, and the one door through which it is changed."""

from time import perf_counter
from typing import Any

import attrs
from PySide6.QtCore import QObject, Signal
from PySide6.QtGui import QUndoCommand, QUndoStack

from hullquad_app.scene import Scene, State, resolved
from hullquad_app.track import Track

VERDICT_WAIT = 0.2
"""Least time between two verdicts while a run goes on [s]."""


class _Change(QUndoCommand):
    """Swap two states; every edit is one of these."""

    def __init__(self, document: "Document", label: str, before: Scene, after: Scene) -> None:
        super().__init__(label)
        self._document, self._before, self._after = document, before, after

    def redo(self) -> None:
        """Show the later state."""
        self._document.restore(self._after)

    def undo(self) -> None:
        """Show the earlier state."""
        self._document.restore(self._before)


class Document(QObject):
    """The open document; `changed` tells every widget what to show now."""

    changed = Signal(object)
    """Emitted with the `Scene` to show."""

    def __init__(self, parent: QObject | None = None) -> None:
        super().__init__(parent)
        self.scene = Scene()
        self._before_run = self.scene
        self._next_verdict = 0.0
        self.edits = QUndoStack(self)

    def change(self, label: str, after: State, key: str | None = None, position: int = -1) -> None:
        """Edit the document: one step of undo, called `label` in the Edit menu.

        Afterwards the plate `key` (None: the present one) is shown, and the iterate at `position` (-1: the last).
        """
        before = self._settled()
        view = attrs.evolve(before.view, key=key or before.view.key, position=position, stage=None)
        self.edits.push(_Change(self, label, before, resolved(before, after, view)))

    def open(self, state: State) -> None:
        """Begin with another document; what was done to the one before cannot be undone any more."""
        self.edits.clear()
        view = attrs.evolve(self.scene.view, key=None, position=-1, stage=None, selection=frozenset())
        self._set(resolved(Scene(), state, view))

    def look(self, **view: Any) -> None:
        """Look at the document otherwise: another plate, metric, limit, iterate or selection (fields of `View`)."""
        running = self.scene.track if self.scene.running else None
        self._set(resolved(self.scene, self.scene.state, attrs.evolve(self.scene.view, **view), running))

    def preview(self, track: Track, position: int = -1) -> None:
        """Show a run that goes on: its track so far, which becomes part of the document by `change` when it ends.

        Its meshes are judged by rules a few times a second, and no more than a fifth of the time.
        """
        started, view = perf_counter(), attrs.evolve(self.scene.view, position=position)
        is_due = started >= self._next_verdict
        scene = resolved(self.scene, self.scene.state, view, track, keeps_verdict=not is_due)
        if is_due:
            ended = perf_counter()
            self._next_verdict = ended + max(VERDICT_WAIT, 4 * (ended - started))
        self._set(scene)

    def restore(self, scene: Scene) -> None:
        """Show the state, plate and iterate of a scene; metric and limits stay as they are now."""
        view = attrs.evolve(self.scene.view, key=scene.view.key, position=scene.position, stage=None)
        self._set(resolved(self.scene, scene.state, view))

    def _settled(self) -> Scene:
        """The scene as the document's own state has it, without the run that goes on."""
        return self._before_run if self.scene.running else self.scene

    def _set(self, scene: Scene) -> None:
        if scene.running and not self.scene.running:
            self._before_run = self.scene
        self.scene = scene
        self.changed.emit(scene)
