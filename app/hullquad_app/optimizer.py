"""Runs of the optimiser on the document: shown while they go on, one step of undo when they end."""

from PySide6.QtCore import QObject, Signal

from hullquad.optimization.iterate import Iterate
from hullquad.optimization.stops import Stop
from hullquad_app.document import Document
from hullquad_app.paused import Paused
from hullquad_app.plan import Plan
from hullquad_app.recording import Recording
from hullquad_app.run import Run
from hullquad_app.run_words import run_label
from hullquad_app.scene import Scene


class Optimizer(QObject):
    """Starts runs from the iterate that the document shows, and records them."""

    ended_unmoved = Signal(object)
    """Emitted with the `Stop` of a run that could do nothing; the document is as it was."""
    run_began = Signal()
    """Emitted when a run is shown from now on, but a single step."""
    run_ended = Signal()
    """Emitted when it is in the document."""
    failed = Signal(object)
    """Emitted with the exception that ended a run; what came before it is kept."""

    def __init__(self, document: Document, parent: QObject | None = None) -> None:
        super().__init__(parent)
        self.run = Run(self)
        """Tell its `painted` how long a frame took."""
        self._document = document
        self._recording: Recording | None = None
        self._paused: Paused | None = None
        self._due = 0
        """Steps asked for while one goes on."""
        self.run.advanced.connect(self._show)
        self.run.ended.connect(self._end)
        self.run.failed.connect(self._fail)

    @property
    def is_running(self) -> bool:
        """Whether a run goes on."""
        return self._recording is not None

    @property
    def is_stepping(self) -> bool:
        """Whether a single step goes on."""
        return self._recording is not None and self._recording.is_step

    def step_again(self) -> None:
        """Have another step begin when the one that goes on ends, unless something else is wanted before."""
        self._due += 1

    def start(self, plan: Plan, steps: int | None = None) -> None:
        """Improve the shown mesh until the method or `steps` iterations end it, or a pause; drops later iterates.

        A run that was paused where the shown mesh is goes on, if the plan is still the same: `steps` presses of a
        button and one run of as many iterations come to the same.
        """
        scene = self._document.scene
        if scene.mesh is None or self.is_running:
            return
        paused = self._taken_up(scene, plan)
        self._recording = Recording(scene, plan, is_step=steps == 1, paused=paused)
        self._document.preview(self._recording.track)
        if not self._recording.is_step:
            self.run_began.emit()
        self.run.start(self._recording.source, None if steps is None else steps + self._recording.is_new)

    def pause(self) -> None:
        """End the run after the iterate in the making; returns at once."""
        self._due = 0
        self.run.pause()

    def finish(self) -> None:
        """Pause, and have the run in the document before this returns."""
        self._due = 0
        self.run.finish()

    def stop_and_wait(self) -> None:
        """End the run and its thread, recording nothing."""
        self.run.stop_and_wait()
        if self._recording is not None:
            self._recording.source.close()
        self._recording = None
        self.forget()

    def forget(self) -> None:
        """Let the run that was paused not go on."""
        if self._paused is not None:
            self._paused.source.close()
        self._paused = None

    def hold(self, position: int) -> None:
        """Show an iterate while the run goes on; the newest: follow the run again."""
        self._due = 0
        if self._recording is not None:
            self._recording.hold(position)
            self._preview(self._recording)

    def _taken_up(self, scene: Scene, plan: Plan) -> Paused | None:
        """The run that was paused, if it goes on; what cannot go on is given up."""
        if self._paused is not None and not self._paused.goes_on(scene.iterate, plan):
            self.forget()
        paused, self._paused = self._paused, None
        return paused

    def _preview(self, recording: Recording) -> None:
        self._document.preview(recording.track, recording.position)

    def _show(self, iterates: list[Iterate]) -> None:
        if self._recording is not None:
            self._recording.add(iterates)
            self._preview(self._recording)

    def _end(self, stop: Stop | None) -> None:
        recording, self._recording = self._recording, None
        due, self._due = self._due, 0
        if recording is None:
            return
        if recording.is_empty:
            self._leave(recording, stop)
            return
        self._keep(recording, stop)
        if stop is None:
            self._paused = recording.paused()
        if due and stop is None:
            self.start(recording.plan, steps=1)
            self._due = due - 1

    def _leave(self, recording: Recording, stop: Stop | None) -> None:
        """Have the document as it was before a run that has moved nothing."""
        self._document.restore(recording.start)
        recording.source.close()
        if stop is not None:
            self.ended_unmoved.emit(stop)

    def _keep(self, recording: Recording, stop: Stop | None) -> None:
        """Have a run in the document, as one step of undo."""
        label = run_label(recording.plan, *recording.ends(stop), is_step=recording.is_step)
        after = self._document.scene.state.with_track(recording.key, recording.track)
        self._document.change(label, after, recording.key, recording.result(stop))
        if not recording.is_step:
            self.run_ended.emit()

    def _fail(self, problem: Exception) -> None:
        self._due = 0
        self._end(None)
        self.forget()
        self.failed.emit(problem)
