"""What the user can do, on document, optimiser and jobs: everything between the widgets and the engine."""

import logging
from collections.abc import Iterable
from pathlib import Path
from typing import TYPE_CHECKING

import attrs
from PySide6.QtCore import QObject, Signal

from hullquad.errors import HullquadError
from hullquad.mesh import Mesh
from hullquad.metrics import metric
from hullquad.optimization.settings import PaperSettings
from hullquad.optimization.stops import Stop
from hullquad_app.abilities import Abilities, abilities
from hullquad_app.bookmarks import Bookmarks
from hullquad_app.division import Size
from hullquad_app.document import Document
from hullquad_app.judging import Judging
from hullquad_app.mesher import Mesher
from hullquad_app.optimizer import Optimizer
from hullquad_app.plan import UNTANGLE, plan, planned
from hullquad_app.scene import Scene
from hullquad_app.search import Search
from hullquad_app.settings import Settings
from hullquad_app.workshop import Workshop

if TYPE_CHECKING:
    from hullquad.triangulation.remedies import Remedy


class Session(QObject):
    """The user's intentions as methods; what has come of them is in `document.scene`.

    A run is shown while it goes on, and becomes one step of undo when it ends. What needs the document as it is
    (another plate or metric, undo, reset, meshing, saving) ends it first, as a pause would.
    """

    message = Signal(object)
    """Emitted with a `HullquadError`, or with a text: its first line is the message, the others are details."""
    busy = Signal(str, int, int)
    """Emitted with what is being done, and how much of it is done of how much (0 where nobody can tell)."""
    idle = Signal()
    """Emitted when nothing is being done any more."""
    able = Signal(object)
    """Emitted with `Abilities`, when they have changed."""
    opened = Signal(object)
    """Emitted with the path of a file that was opened."""
    saved = Signal(object)
    """Emitted with the list of files that were written."""
    divided = Signal(object)
    """Emitted with the `Division` that was asked for."""

    def __init__(self, settings: Settings | None = None, parent: QObject | None = None) -> None:
        super().__init__(parent)
        self.settings = settings or Settings()
        self.document = Document(self)
        self.optimizer = Optimizer(self.document, self)
        self.workshop = Workshop(self.document, self.optimizer.finish, self)
        self.abilities = Abilities()
        self._bookmarks = Bookmarks()
        self.judging = Judging(self.document, self.settings, self.message.emit, self)
        self._connect()

    @property
    def is_modified(self) -> bool:
        """Whether something would be lost if the program ended now."""
        return not self.document.edits.isClean() or self.optimizer.is_running

    @property
    def has_unsaved_plates(self) -> bool:
        """Whether plates were edited and not written."""
        return self.is_modified and not self.workshop.kept.has_plates(self.document.scene.state)

    @property
    def has_unsaved_meshes(self) -> bool:
        """Whether meshes were made or changed and not written."""
        state = self.document.scene.state
        return self.is_modified and (self.optimizer.is_running or not self.workshop.kept.has_meshes(state))

    @property
    def path(self) -> Path | None:
        """File that the document is in."""
        return self.workshop.kept.path

    @property
    def title(self) -> str:
        """Name of that file; without one, of the document."""
        return self.document.scene.state.title if self.path is None else self.path.stem

    def prepare(self) -> None:
        """Load what meshing and judging need, while the user looks at the empty window."""
        self.workshop.jobs.prepare()
        self._tell_able()

    def open(self, path: Path) -> None:
        """Open a document or a mesh in place of what is open."""
        self.workshop.open(Path(path))
        self._tell_able()

    def mesh(self, size: Size = None, *, all_plates: bool = False) -> None:
        """Mesh the plate that is shown, or every plate of the document."""
        self.optimizer.finish()
        scene = self.document.scene
        keys = scene.state.keys if all_plates else (scene.view.key,)
        if scene.state.plates is not None:
            self.workshop.mesh([key for key in keys if key is not None], size, self.settings.mesher)
            self._tell_able()

    def divide(self, size: Size = None) -> None:
        """Have `divided` emitted with the contours for a size, and for whether elements follow lines."""
        self.workshop.divide(size, follows_lines=self.settings.mesher.follows_lines)

    def redivide(self, change: "Remedy | None", size: Size = None) -> None:
        """Divide an edge otherwise in all plates that have it, or None: make all contours even at a size.

        Meshes that do not fit the contours any more go in the same step of undo.
        """
        self.optimizer.finish()
        self.workshop.redivide(change, size)
        self._tell_able()

    def cancel(self) -> None:
        """Give up what is being opened, divided or meshed."""
        self.workshop.cancel()

    def save(self, path: Path) -> None:
        """Write the mesh as it is shown; of a document with several plates each beside it (``OUT-ID.vtu``)."""
        self.optimizer.finish()
        if files := self._files(Path(path)):
            self.workshop.save(files)
            self._tell_able()

    def save_plates(self, path: Path) -> None:
        """Write the plates of the document."""
        self.workshop.save_plates(Path(path))
        self._tell_able()

    def targets(self, path: Path) -> list[Path]:
        """The files that `save` would write."""
        return list(self._files(Path(path)))

    def step(self) -> None:
        """One iteration from the iterate that is shown; while a step goes on, another one after it.

        From a stage of the mesh's making to the next one.
        """
        if self.document.scene.stage is not None:
            self.scrub_by(1)
        elif self.optimizer.is_stepping:
            self.optimizer.step_again()
        else:
            self._optimize(steps=1)

    def run(self) -> None:
        """Iterations from the iterate that is shown, until the method ends or somebody pauses."""
        self._optimize(steps=None)

    def untangle(self) -> None:
        """Turn elements that are inside out the right way, whatever optimiser is chosen."""
        if self.abilities.can_untangle:
            search = Search(optimizer=UNTANGLE)
            self.optimizer.start(planned(self.document.scene, search, self.settings.paper, self.settings.objective))

    def pause(self) -> None:
        """End the run after the iterate in the making."""
        self.optimizer.pause()

    def reset(self) -> None:
        """Go back to the mesh as it was generated or loaded."""
        self.optimizer.finish()
        scene = self.document.scene
        if scene.track is not None and scene.view.key is not None and len(scene.track.iterates) > 1:
            after = scene.state.with_track(scene.view.key, scene.track.as_made)
            self.document.change(self.tr("Reset {plate}").format(plate=scene.view.key), after)

    def scrub(self, position: int) -> None:
        """Show an iterate; while a run goes on it goes on behind it. Below 0 are the stages of the mesh's making."""
        track = self.document.scene.track
        if self.optimizer.is_running:
            self.optimizer.hold(position)
        elif position < 0 and track is not None:
            self.document.look(stage=max(len(track.making) + position, 0))
        else:
            self.document.look(position=position, stage=None)

    def scrub_by(self, iterates: int) -> None:
        """Show an iterate further on, or back."""
        scene = self.document.scene
        if scene.track is not None:
            stages = len(scene.track.making)
            now = scene.position if scene.stage is None else scene.stage - stages
            self.scrub(min(max(now + iterates, -stages), len(scene.track.iterates) - 1))

    def choose_metric(self, key: str) -> None:
        """Show, and optimise by, another metric."""
        self.optimizer.finish()
        self.document.look(metric=metric(key))
        self.settings.metric = key

    def choose_plate(self, key: str) -> None:
        """Show another plate, at the iterate where it was left."""
        self.optimizer.finish()
        track = self.document.scene.state.tracks.get(key)
        self.document.look(key=key, position=-1 if track is None else self._bookmarks.row(key, track), stage=None)

    def select(self, rows: Iterable[int], *, extend: bool = False) -> None:
        """Select elements; `extend` adds them, or takes them away if all of them are selected."""
        selected, chosen = self.document.scene.view.selection, frozenset(rows)
        if extend:
            chosen = selected - chosen if chosen <= selected else selected | chosen
        self.document.look(selection=chosen)

    def set_mesher(self, mesher: Mesher) -> None:
        """Have the next meshes made otherwise."""
        self.settings.mesher = mesher

    def set_paper(self, paper: PaperSettings) -> None:
        """Have the next run use other parameters."""
        self.settings.paper = paper

    def set_search(self, search: Search) -> None:
        """Have the next run use another optimiser or other options."""
        self.settings.search = search

    def choose_objective(self, written: str | None) -> None:
        """Optimise by ``KEY[=WEIGHT][,KEY…]``; None: by the metric that is shown."""
        self.optimizer.finish()
        self.settings.objective = written

    def undo(self) -> None:
        """Take the last edit back; a run that goes on is the last edit."""
        index, is_running = self.document.edits.index(), self.optimizer.is_running
        self.optimizer.finish()
        if not is_running or self.document.edits.index() != index:
            self.document.edits.undo()

    def redo(self) -> None:
        """Do again what was undone."""
        self.optimizer.finish()
        self.document.edits.redo()

    def stop_and_wait(self) -> None:
        """End all threads and the worker before the program ends; no signal of theirs comes any more."""
        self.optimizer.stop_and_wait()
        self.workshop.jobs.stop_and_wait()
        self.document.edits.blockSignals(True)  # it tells of its own end, too

    def _connect(self) -> None:
        workshop = self.workshop
        for source, signal in (
            (workshop.message, self.message),
            (workshop.busy, self.busy),
            (workshop.idle, self.idle),
            (workshop.opened, self.opened),
            (workshop.saved, self.saved),
            (workshop.divided, self.divided),
        ):
            source.connect(signal)
        self.document.changed.connect(self._remember)
        self.opened.connect(self.settings.add_recent)
        self.saved.connect(self._remember_file)
        self.divided.connect(self._tell_able)
        self.busy.connect(self._tell_able)
        self.opened.connect(self.optimizer.forget)
        self.optimizer.ended_unmoved.connect(self._tell_stop)
        self.optimizer.failed.connect(self._tell_failed)
        self.document.edits.canUndoChanged.connect(self._tell_able)
        self.document.edits.canRedoChanged.connect(self._tell_able)
        for job in workshop.jobs.all:
            job.ended.connect(self._tell_able)

    def _optimize(self, steps: int | None) -> None:
        if self.document.scene.stage is not None:
            self.scrub(0)
        asked = plan(self.document.scene, self.settings)
        if asked.optimizer.has_rules and asked.rules is None:
            self.message.emit(self.tr("Which rules are to be met? Choose a rule set to judge by first."))
        elif self.abilities.can_run:
            self.optimizer.start(asked, steps)

    def _files(self, path: Path) -> dict[Path, Mesh]:
        """Shown mesh of every plate that has one, by the file it goes to."""
        state = self.document.scene.state
        meshes = {key: track.iterates[self._bookmarks.row(key, track)].mesh for key, track in state.tracks.items()}
        if len(state.keys) == 1:
            return dict.fromkeys([path], *meshes.values()) if meshes else {}
        return {path.with_name(f"{path.stem}-{key}{path.suffix}"): mesh for key, mesh in meshes.items()}

    def _remember(self, scene: Scene) -> None:
        self._bookmarks.remember(scene)
        self._tell_able()

    def _remember_file(self, files: list[Path]) -> None:
        if len(files) == 1:  # the meshes of many plates would be all that is remembered
            self.settings.add_recent(files[0])

    def _tell_able(self) -> None:
        able = abilities(self.document, self.workshop.jobs, has_odd=self.workshop.has_odd)
        able = attrs.evolve(able, can_step=able.can_step or self.optimizer.is_stepping)
        if able != self.abilities:
            self.abilities = able
            self.able.emit(able)

    def _tell_stop(self, stop: Stop) -> None:
        self.message.emit(f"{stop.reason}. {stop.advice}")

    def _tell_failed(self, problem: Exception) -> None:
        if isinstance(problem, HullquadError):
            self.message.emit(problem)
            return
        logging.error("a run broke down", exc_info=problem)
        text = self.tr("The run broke down and was ended; what came before is kept: {problem}")
        self.message.emit(text.format(problem=f"{type(problem).__name__}: {problem}"))
