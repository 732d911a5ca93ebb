"""A run on its way to become one step of undo."""

from collections.abc import Sequence

from hullquad.optimization.iterate import Iterate
from hullquad.optimization.stops import Stop
from hullquad_app.passage import Passage
from hullquad_app.paused import Paused
from hullquad_app.plan import Plan
from hullquad_app.scene import Scene
from hullquad_app.source import Source
from hullquad_app.track import Track


class Recording:
    """The track of a run as it grows, from the iterate that a scene shows; of a paused run, as it grows on."""

    def __init__(self, start: Scene, plan: Plan, *, is_step: bool, paused: Paused | None = None) -> None:
        assert start.track is not None  # nothing runs without a mesh
        assert start.mesh is not None
        self.start, self.plan, self.is_step = start, plan, is_step
        self.source: Source = plan.source(start.mesh) if paused is None else paused.source
        self.track: Track = start.track.until(start.position)
        self.held: int | None = None
        """Number of the iterate that somebody looks at while the run goes on; None: always the newest."""
        self._first = None if paused is None else start.iterate
        self._offset = self.track.last.number if paused is None else paused.start
        self._begun = self.track.last.number

    @property
    def is_new(self) -> bool:
        """Whether the run has still to give the mesh that it begins with."""
        return self._first is None

    @property
    def is_empty(self) -> bool:
        """Whether no node has been moved."""
        return self.track.last.number == self._begun

    @property
    def position(self) -> int:
        """Of the iterate to show now."""
        return -1 if self.held is None else self.track.row(self.held)

    @property
    def key(self) -> str:
        """Id of the plate."""
        assert self.start.view.key is not None  # it has a mesh
        return self.start.view.key

    def add(self, iterates: Sequence[Iterate]) -> None:
        """Take new iterates of the run."""
        if self._first is None:
            self._first = iterates[0]
            track = self.track.with_run(iterates)
        else:
            track = self.track.with_more(iterates, self._offset)
        self.track = track.with_passage(self._passage())

    def hold(self, position: int) -> None:
        """Have an iterate shown, and kept on the screen unless it is the newest."""
        is_newest = not 0 <= position < len(self.track.iterates) - 1
        self.held = None if is_newest else self.track.iterates[position].number

    def result(self, stop: Stop | None) -> int:
        """Position to show after the end: what somebody looks at, else what came of the run."""
        return self._end(stop) if self.held is None else self.position

    def ends(self, stop: Stop | None) -> tuple[Iterate, Iterate]:
        """The iterate before, and what came of it, whatever is looked at."""
        assert self._first is not None  # the recording is not empty
        return self._first, self.track.iterates[self._end(stop)]

    def paused(self) -> Paused:
        """The run as it can go on after this."""
        return Paused(source=self.source, plan=self.plan, start=self._offset, last=self.track.last)

    def _end(self, stop: Stop | None) -> int:
        """Position of what came of the run: the best if it ended by itself, else the last."""
        return len(self.track.iterates) - 1 if stop is None else self.track.best_of_run(0)

    def _passage(self) -> Passage:
        plan = self.plan
        return Passage(
            start=self._offset,
            optimizer=plan.optimizer.key,
            objective=plan.objective,
            seconds=self.source.seconds,
        )
