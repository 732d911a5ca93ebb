"""Long work on the document: what is asked of the jobs, and what becomes of their answers."""

import logging
from collections.abc import Callable, Mapping, Sequence
from pathlib import Path
from typing import TYPE_CHECKING

import attrs
from PySide6.QtCore import QObject, QTimer, Signal

from hullquad.errors import HullquadError
from hullquad.mesh import Mesh
from hullquad.plate import Notice
from hullquad_app.dividing import Redivided
from hullquad_app.division import Division, Size
from hullquad_app.document import Document
from hullquad_app.jobs import Jobs
from hullquad_app.kept import Kept
from hullquad_app.mesh_words import element_words, mesher_words
from hullquad_app.mesher import Mesher
from hullquad_app.objectives import optimised_by
from hullquad_app.remedy_words import remedy_words
from hullquad_app.scene import State
from hullquad_app.work import Meshed, Progress

if TYPE_CHECKING:
    from hullquad.triangulation.remedies import Remedy

KEPT_DIVISIONS = 16
PATIENCE = 500
"""Work that is usually done in a moment is told of when it takes longer [ms]."""


class Workshop(QObject):
    """Opens, divides, edits, meshes and saves; the document changes when the work is done, and only then.

    Parameters
    ----------
    settle
        Ends what goes on with the document, so that it can be changed.
    """

    message = Signal(object)
    busy = Signal(str, int, int)
    idle = Signal()
    opened = Signal(object)
    saved = Signal(object)
    divided = Signal(object)
    """All six are described in `session.Session`."""

    def __init__(self, document: Document, settle: Callable[[], None], parent: QObject | None = None) -> None:
        super().__init__(parent)
        self.jobs = Jobs(self)
        self.refused: dict[str, HullquadError] = {}
        """Why plates could not be meshed, by id."""
        self.kept = Kept()
        self._document, self._settle = document, settle
        self._divisions: dict[tuple[Size, bool], Division] = {}
        self._newest: Division | None = None
        self._being_saved = self.kept
        self._long, self._latest, self._is_long = QTimer(self, singleShot=True), Progress(""), False
        self._long.timeout.connect(self._tell_long)
        for job in self.jobs.all:
            job.broke.connect(self._tell_broken)
            job.ended.connect(self._tell_idle)
        for job in (self.jobs.opening, self.jobs.editing, self.jobs.meshing, self.jobs.saving):
            job.refused.connect(self.message)
        for job in (self.jobs.preparing, self.jobs.opening, self.jobs.meshing, self.jobs.saving):
            job.progressed.connect(self._tell_busy)
        for job in (self.jobs.dividing, self.jobs.editing):
            job.progressed.connect(self._tell_if_long)
        self.jobs.opening.done.connect(self._show_opened)
        self.jobs.dividing.done.connect(self._show_divided)
        self.jobs.editing.done.connect(self._show_redivided)
        self.jobs.meshing.done.connect(self._show_meshed)
        self.jobs.saving.done.connect(self._show_saved)

    def open(self, path: Path) -> None:
        """Read a document or a mesh, and show it."""
        self.jobs.open(path, optimised_by(self._document.scene.view.metric))

    def division(self, size: Size, *, follows_lines: bool) -> Division | None:
        """Contours of the document, divided for a size, if they are known."""
        known = self._divisions.get((size, follows_lines))
        return known if known is not None and known.plates is self._document.scene.state.plates else None

    def divide(self, size: Size, *, follows_lines: bool) -> None:
        """Have `divided` emitted with the contours of the document, at once if they are known."""
        plates, known = self._document.scene.state.plates, self.division(size, follows_lines=follows_lines)
        if known is not None:
            self._newest = known
            self.divided.emit(known)
        elif plates is not None:
            self.jobs.divide(plates, size, follows_lines=follows_lines)

    @property
    def has_odd(self) -> bool:
        """Whether contours of the document are odd, at the size that was asked for last."""
        newest = self._newest
        return newest is not None and newest.plates is self._document.scene.state.plates and bool(newest.odd)

    def redivide(self, change: "Remedy | None", size: Size) -> None:
        """Divide an edge otherwise, or None: make all contours even at a size."""
        plates = self._document.scene.state.plates
        if plates is not None:
            self.jobs.edit(plates, change, size)

    def mesh(self, keys: Sequence[str], size: Size, mesher: Mesher) -> None:
        """Mesh plates of the document."""
        scene, known = self._document.scene, self.division(size, follows_lines=mesher.follows_lines)
        self.jobs.mesh(
            scene.state, keys, size, mesher, optimised_by(scene.view.metric), None if known is None else known.contours
        )

    def save(self, files: Mapping[Path, Mesh]) -> None:
        """Write meshes, all that the document has."""
        scene = self._document.scene
        path = self.kept.path if scene.state.plates is not None else next(iter(files))
        self._being_saved = attrs.evolve(self.kept, path=path, tracks=scene.state.tracks)
        self.jobs.save(files, scene.view.metric)

    def save_plates(self, path: Path) -> None:
        """Write the plates of the document."""
        plates = self._document.scene.state.plates
        if plates is not None:
            self._being_saved = attrs.evolve(self.kept, path=path, plates=plates)
            self.jobs.save_plates(plates, path)

    def cancel(self) -> None:
        """Give up what is being opened, divided or meshed; the document stays as it is."""
        for job in (self.jobs.opening, self.jobs.dividing, self.jobs.editing, self.jobs.meshing):
            job.cancel()

    def _show_opened(self, state: State) -> None:
        self.jobs.meshing.cancel()
        self._settle()
        self.refused = {}
        self.kept = self._being_saved = Kept.of(state)
        self._divisions.clear()
        self._document.open(state)
        self.opened.emit(state.path)
        if state.plates is not None and state.plates.warnings:
            heading = self.tr("The document can be used, but {count} things in it should be looked at.")
            self._tell_warnings(state.plates.warnings, heading)

    def _show_divided(self, division: Division) -> None:
        if division.plates is self._document.scene.state.plates:
            for known in list(self._divisions)[: 1 - KEPT_DIVISIONS]:
                del self._divisions[known]
            self._divisions[division.size, division.follows_lines] = division
            self._newest = division
            self.divided.emit(division)

    def _show_redivided(self, found: Redivided) -> None:
        self._settle()
        state = self._document.scene.state
        if state.plates is not found.before:
            return
        if found.plates is found.before:
            self.message.emit(self.tr("No way was found to make more contours even by dividing edges otherwise."))
            return
        label = self.tr("Make contours even") if found.change is None else remedy_words(found.change)
        self._document.change(label, found.after(state))
        if lost := found.meshes_lost(state):
            text = self.tr("Taken away: the meshes of {plates}, which have other contours now. Undo brings them back.")
            self.message.emit(text.format(plates=", ".join(lost)))

    def _show_meshed(self, meshed: Meshed) -> None:
        self._settle()
        state = self._document.scene.state
        if state.plates is not meshed.plates:
            return
        kept = {key: error for key, error in self.refused.items() if key not in meshed.tracks}
        self.refused = {**kept, **meshed.refused}
        if meshed.tracks:
            after = attrs.evolve(state, tracks={**state.tracks, **meshed.tracks})
            self._document.change(self._label(meshed), after, self._key_to_show(meshed))
        if meshed.refused:
            self._tell_refused(list(meshed.refused.values()))
        elif meshed.left:
            self._tell_warnings(meshed.left, self.tr("{count} meshes have more triangles than they need."))

    def _key_to_show(self, meshed: Meshed) -> str | None:
        """The plate that is shown already, if it is among those that were meshed."""
        shown = self._document.scene.view.key
        return shown if shown in meshed.tracks or len(meshed.tracks) > 1 else next(iter(meshed.tracks))

    def _show_saved(self, files: list[Path]) -> None:
        self.kept, state = self._being_saved, self._document.scene.state
        if self.kept.has_plates(state) and self.kept.has_meshes(state):
            self._document.edits.setClean()
        self.saved.emit(files)

    def _label(self, meshed: Meshed) -> str:
        plates = self.tr("{count} plates").format(count=len(meshed.tracks))
        return self.tr("Mesh {plates} ({mesher}): {elements}").format(
            plates=plates if len(meshed.tracks) > 1 else next(iter(meshed.tracks)),
            mesher=mesher_words(meshed.mesher.name),
            elements=element_words(track.first.mesh for track in meshed.tracks.values()),
        )

    def _tell_refused(self, errors: list[HullquadError]) -> None:
        if len(errors) == 1:
            self.message.emit(errors[0])
        elif errors:
            count = self.tr("{count} plates could not be meshed:").format(count=len(errors))
            self.message.emit("\n".join([count, *map(str, errors)]))

    def _tell_warnings(self, notices: Sequence[Notice], heading: str) -> None:
        """Tell one warning as it is, and of several how many there are, before the details."""
        if len(notices) == 1:
            head = notices[0].text[:1].upper() + notices[0].text[1:] + "."
            self.message.emit(f"{head}\n{notices[0].code} at {notices[0].place}")
            return
        self.message.emit("\n".join([heading.format(count=len(notices)), *map(str, notices)]))

    def _tell_broken(self, problem: Exception) -> None:
        logging.error("a job broke down", exc_info=problem)
        text = self.tr("This broke down and was ended, nothing else is affected: {problem}")
        self.message.emit(text.format(problem=f"{type(problem).__name__}: {problem}"))

    def _tell_busy(self, progress: Progress) -> None:
        self.busy.emit(progress.text, progress.done, progress.total)

    def _tell_if_long(self, progress: Progress) -> None:
        self._latest = progress
        if self._is_long:
            self._tell_busy(progress)
        elif not self._long.isActive():
            self._long.start(PATIENCE)

    def _tell_long(self) -> None:
        self._is_long = self.jobs.dividing.is_running or self.jobs.editing.is_running
        if self._is_long:
            self._tell_busy(self._latest)

    def _tell_idle(self) -> None:
        if not any(job.is_running for job in self.jobs.all):
            self._long.stop()
            self._is_long = False
            self.idle.emit()
