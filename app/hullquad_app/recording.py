"""A run on its way to become one step of undo."""

from collections.abc import Sequence

from hullquad.metrics import Metric
from hullquad.optimization.iterate import Iterate
from hullquad.optimization.stops import Stop
from hullquad_app.scene import Scene, State
from hullquad_app.track import Track


class Recording:
    """The track of a run as it grows, from the iterate that a scene shows."""

    def __init__(self, start: Scene, metric: Metric, *, is_step: bool) -> None:
        assert start.track is not None  # nothing runs without a mesh
        self.start, self.metric, self.is_step = start, metric, is_step
        self.track: Track = start.track.until(start.position)
        self.held: int | None = None
        """Number of the iterate that somebody looks at while the run goes on; None: always the newest."""
        self._offset = self.track.last.number
        self._first: Iterate | None = None

    @property
    def is_empty(self) -> bool:
        """Whether no node has been moved."""
        return self.track.last.number == self._offset

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
            self.track = self.track.with_run(iterates)
        else:
            self.track = self.track.with_more(iterates, self._offset)

    def hold(self, position: int) -> None:
        """Have an iterate shown, and kept on the screen unless it is the newest."""
        is_newest = not 0 <= position < len(self.track.iterates) - 1
        self.held = None if is_newest else self.track.iterates[position].number

    def result(self, stop: Stop | None) -> int:
        """Position to show after the end: what somebody looks at, else what came of the run."""
        return self._end(stop) if self.held is None else self.position

    def after(self, state: State) -> State:
        """The state with the run in it."""
        return state.with_track(self.key, self.track)

    def objectives(self, stop: Stop | None) -> tuple[float, float]:
        """Objective before the run, and what came of it, whatever is looked at."""
        assert self._first is not None  # the recording is not empty
        return self._first.objective, self.track.iterates[self._end(stop)].objective

    def _end(self, stop: Stop | None) -> int:
        """Position of what came of the run: the best if it ended by itself, else the last."""
        return len(self.track.iterates) - 1 if stop is None else self.track.best_of_run(0)
