"""The document: what is open, how it is looked at, and the one door through which it is changed."""

from collections.abc import Mapping
from pathlib import Path
from typing import Any

import attrs
from PySide6.QtCore import QObject, Signal
from PySide6.QtGui import QUndoCommand, QUndoStack

from hullquad.mesh import Mesh
from hullquad.metrics import Band, Metric, metric
from hullquad.optimization.iterate import Iterate
from hullquad.plate import Document as PlateDocument
from hullquad.plate import Plate
from hullquad.quality import Quality, quality
from hullquad_app.track import Track


@attrs.frozen(eq=False, kw_only=True)
class State:
    """What is open and what has become of it: all that undo brings back."""

    title: str = ""
    path: Path | None = None
    """File it was opened from."""
    plates: PlateDocument | None = None
    """None where a mesh was opened, or nothing."""
    tracks: Mapping[str, Track] = attrs.field(factory=dict)
    """Meshed plates by id; a mesh that was opened by its plate's id or its file's name."""

    @property
    def keys(self) -> tuple[str, ...]:
        """Ids of all that can be shown, in order."""
        return tuple(self.tracks) if self.plates is None else tuple(plate.id for plate in self.plates.plates)

    def plate(self, key: str) -> Plate | None:
        """Plate of that id, where the document has plates."""
        if self.plates is None:
            return None
        return next((plate for plate in self.plates.plates if plate.id == key), None)

    def with_track(self, key: str, track: Track) -> "State":
        """The state with another track of a plate."""
        return attrs.evolve(self, tracks={**self.tracks, key: track})


@attrs.frozen(eq=False, kw_only=True)
class View:
    """How the document is looked at: changes nothing in it, and is not undone."""

    key: str | None = None
    """The plate that is shown."""
    position: int = -1
    """Which iterate of its track; -1 the last."""
    metric: Metric = attrs.field(factory=lambda: metric("stretch"))
    bands: Mapping[str, Band] = attrs.field(factory=dict)
    """What the user accepts by metric key, where it differs from the metric's own band."""
    selection: frozenset[int] = frozenset()
    """Rows of the selected elements."""


@attrs.frozen(eq=False, kw_only=True)
class Scene:
    """All that is on the screen at one moment, resolved: widgets read this and nothing else."""

    state: State = attrs.field(factory=State)
    view: View = attrs.field(factory=View)
    plate: Plate | None = None
    """The plate that is shown; None where a mesh without plate is, or nothing."""
    track: Track | None = None
    """Of the plate that is shown; while a run goes on, with its iterates so far."""
    position: int = 0
    """Of the shown iterate in the track."""
    quality: Quality | None = None
    """Quality of the shown mesh by the chosen metric and limit: one value for view, histogram, table, status bar."""
    first_quality: Quality | None = None
    """The same of the mesh as it was made or loaded."""
    running: bool = False

    @property
    def iterate(self) -> Iterate | None:
        """The shown iterate."""
        return None if self.track is None else self.track.iterates[self.position]

    @property
    def mesh(self) -> Mesh | None:
        """The mesh that is shown, saved, pictured and continued from."""
        return None if self.iterate is None else self.iterate.mesh

    @property
    def band(self) -> Band:
        """Within which quads are acceptable."""
        return band(self.view)


def band(view: View) -> Band:
    """The band of the chosen metric: the user's, or the metric's own."""
    return view.bands.get(view.metric.key, view.metric.band)


def resolved(before: Scene, state: State, view: View, running: Track | None = None) -> Scene:
    """The scene of a state, looked at in some way; what has not changed since `before` is not computed again."""
    key = view.key if view.key in state.keys else next(iter(state.keys), None)
    track = running or (None if key is None else state.tracks.get(key))
    count = 0 if track is None else len(track.iterates)
    position = count - 1 if view.position < 0 else min(view.position, count - 1)
    shown = None if track is None else track.iterates[position]
    selection = view.selection if shown is not None and _shares_elements(shown, before.iterate) else frozenset()
    return Scene(
        state=state,
        view=attrs.evolve(view, key=key, selection=selection),
        plate=None if key is None else state.plate(key),
        track=track,
        position=max(position, 0),
        quality=_judged(shown, view, before),
        first_quality=_judged(None if track is None else track.first, view, before),
        running=running is not None,
    )


def _shares_elements(one: Iterate, other: Iterate | None) -> bool:
    return other is not None and one.mesh.topology is other.mesh.topology


def _judged(iterate: Iterate | None, view: View, before: Scene) -> Quality | None:
    """Quality of an iterate as it is looked at; one that is there already is taken again."""
    if iterate is None:
        return None
    known = [(iterate.mesh, iterate.quality)]
    if before.track is not None:
        known += [(before.iterate.mesh, before.quality)] if before.iterate and before.quality else []
        known += [(before.track.first.mesh, before.first_quality)] if before.first_quality else []
    for mesh, judged in known:
        if mesh is iterate.mesh and judged.metric is view.metric and judged.band == band(view):
            return judged
    return quality(iterate.mesh, view.metric, band(view))


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
        self.edits = QUndoStack(self)

    def change(self, label: str, after: State, key: str | None = None, position: int = -1) -> None:
        """Edit the document: one step of undo, called `label` in the Edit menu.

        Afterwards the plate `key` (None: the present one) is shown, and the iterate at `position` (-1: the last).
        """
        before = self._settled()
        view = attrs.evolve(before.view, key=key or before.view.key, position=position)
        self.edits.push(_Change(self, label, before, resolved(before, after, view)))

    def open(self, state: State) -> None:
        """Begin with another document; what was done to the one before cannot be undone any more."""
        self.edits.clear()
        view = attrs.evolve(self.scene.view, key=None, position=-1, selection=frozenset())
        self._set(resolved(Scene(), state, view))

    def look(self, **view: Any) -> None:
        """Look at the document otherwise: another plate, metric, limit, iterate or selection (fields of `View`)."""
        running = self.scene.track if self.scene.running else None
        self._set(resolved(self.scene, self.scene.state, attrs.evolve(self.scene.view, **view), running))

    def preview(self, track: Track, position: int = -1) -> None:
        """Show a run that goes on: its track so far, which becomes part of the document by `change` when it ends."""
        self._set(resolved(self.scene, self.scene.state, attrs.evolve(self.scene.view, position=position), track))

    def restore(self, scene: Scene) -> None:
        """Show the state, plate and iterate of a scene; metric and limits stay as they are now."""
        view = attrs.evolve(self.scene.view, key=scene.view.key, position=scene.position)
        self._set(resolved(self.scene, scene.state, view))

    def _settled(self) -> Scene:
        """The scene as the document's own state has it, without the run that goes on."""
        return self._before_run if self.scene.running else self.scene

    def _set(self, scene: Scene) -> None:
        if scene.running and not self.scene.running:
            self._before_run = self.scene
        self.scene = scene
        self.changed.emit(scene)
