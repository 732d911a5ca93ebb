"""Runs of the optimiser on the document: shown while they go on, one step of undo when they end."""

from PySide6.QtCore import QObject, Signal

from hullquad.metrics import Metric
from hullquad.optimization.iterate import Iterate
from hullquad.optimization.settings import PaperSettings
from hullquad.optimization.stops import Stop
from hullquad_app.document import Document
from hullquad_app.metric_words import name_of
from hullquad_app.panels.figures import unit_of
from hullquad_app.recording import Recording
from hullquad_app.run import Run


class Optimizer(QObject):
    """Starts runs from the iterate that the document shows, and records them."""

    ended_unmoved = Signal(object)
    """Emitted with the `Stop` of a run that could do nothing; the document is as it was."""
    failed = Signal(object)
    """Emitted with the exception that ended a run; what came before it is kept."""

    def __init__(self, document: Document, parent: QObject | None = None) -> None:
        super().__init__(parent)
        self.run = Run(self)
        """Tell its `painted` how long a frame took."""
        self._document = document
        self._recording: Recording | None = None
        self._settings = PaperSettings()
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

    def start(self, metric: Metric, settings: PaperSettings, steps: int | None = None) -> None:
        """Improve the shown mesh until the method or `steps` iterations end it, or a pause; drops later iterates."""
        scene = self._document.scene
        if scene.mesh is None or self.is_running:
            return
        self._settings = settings
        self._recording = Recording(scene, metric, is_step=steps == 1)
        self._document.preview(self._recording.track)
        self.run.start(scene.mesh, metric, settings, steps)

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
        self._recording = None

    def hold(self, position: int) -> None:
        """Show an iterate while the run goes on; the newest: follow the run again."""
        self._due = 0
        if self._recording is not None:
            self._recording.hold(position)
            self._preview(self._recording)

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
            self._document.restore(recording.start)
            if stop is not None:
                self.ended_unmoved.emit(stop)
            return
        after = recording.after(self._document.scene.state)
        self._document.change(self._label(recording, stop), after, recording.key, recording.result(stop))
        if due and stop is None:
            self.start(recording.metric, self._settings, steps=1)
            self._due = due - 1

    def _fail(self, problem: Exception) -> None:
        self._due = 0
        self._end(None)
        self.failed.emit(problem)

    def _label(self, recording: Recording, stop: Stop | None) -> str:
        before, after = recording.objectives(stop)
        unit = unit_of(recording.metric)
        text = (
            self.tr("Step {metric}: {before} → {after}")
            if recording.is_step
            else self.tr("Optimize {metric}: {before} → {after}")
        )
        return text.format(metric=name_of(recording.metric), before=f"{before:.2f}{unit}", after=f"{after:.2f}{unit}")
