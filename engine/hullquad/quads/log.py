"""What happens to a draft written down as states, as far as somebody watches."""

import numpy as np

from hullquad.arrays import Floats, Longs
from hullquad.quads.draft import Draft
from hullquad.quads.stages import States, Step, written


class Log:
    """The last state that was written down of a draft.

    Parameters
    ----------
    is_watched
        Whether anything is written down at all.
    """

    def __init__(self, *, is_watched: bool) -> None:
        self.is_watched = is_watched
        self._last: States | None = None
        self._nodes: Floats = np.empty((0, 2))
        self._elements: Longs = np.empty((0, 4), dtype=np.int64)

    def begin(self, made: Draft, states: States) -> None:
        """Go on from a whole state that a draft has just been made from."""
        self._last = states
        if self.is_watched:
            self._nodes, self._elements = made.nodes.copy(), made.elements.copy()

    def compared(self, step: Step, made: Draft) -> States | None:
        """The state of a draft, if it is another one than the last."""
        if not self.is_watched:
            return None
        rows = np.flatnonzero((made.elements != self._elements).any(axis=1))
        nodes = np.flatnonzero((made.nodes != self._nodes).any(axis=1))
        return self._written(step, made, rows, nodes) if len(rows) or len(nodes) else None

    def changed(self, step: Step, made: Draft, rows: Longs, nodes: Longs) -> States | None:
        """The state of a draft in which only these rows of elements and these nodes are others, if it is."""
        return self._written(step, made, rows, nodes) if self.is_watched else None

    def _written(self, step: Step, made: Draft, rows: Longs, nodes: Longs) -> States:
        self._nodes[nodes], self._elements[rows] = made.nodes[nodes], made.elements[rows]
        self._last = written(step, self._last, rows, made.elements[rows], nodes, made.nodes[nodes])
        return self._last
