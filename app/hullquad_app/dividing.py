"""Edits that divide edges otherwise, and what becomes of the meshes made before."""

from collections.abc import Generator
from typing import TYPE_CHECKING

import attrs
import numpy as np

from hullquad.errors import PlateError
from hullquad.plate import Document
from hullquad_app.division import Attempt, Size
from hullquad_app.scene import State

if TYPE_CHECKING:
    from hullquad.triangulation.remedies import Remedy


@attrs.frozen(eq=False)
class Redivided:
    """A document in which some edges are divided otherwise."""

    before: Document
    plates: Document
    """The same as before where no way was found."""
    other: frozenset[str]
    """Ids of the plates whose contours are others now."""
    change: "Remedy | None"
    """None where all contours were to be made even."""

    def meshes_lost(self, state: State) -> tuple[str, ...]:
        """Ids of the plates whose meshes do not fit their contours any more."""
        return tuple(key for key in state.tracks if key in self.other)

    def after(self, state: State) -> State:
        """A state with the new plates, without the meshes that do not fit them."""
        lost = self.meshes_lost(state)
        tracks = {key: track for key, track in state.tracks.items() if key not in lost} if lost else state.tracks
        return attrs.evolve(state, plates=self.plates, tracks=tracks)


def redividing(before: Document, change: "Remedy | None", size: Size) -> Generator[int, None, Redivided]:
    """One edge divided otherwise, or None: all contours of a document made even, as far as a way is found.

    Yields how many contours are still to be made even.
    """
    from hullquad.formats.hullplate import signed  # noqa: PLC0415  all of these bring Shapely
    from hullquad.triangulation.contour import attempts  # noqa: PLC0415
    from hullquad.triangulation.evening import evening  # noqa: PLC0415
    from hullquad.triangulation.remedies import remedied  # noqa: PLC0415

    after = (yield from evening(before, size)) if change is None else remedied(before, change)
    if after is before:
        return Redivided(before, before, frozenset(), change)
    old, new = attempts(before, size), attempts(after, size)
    other = frozenset(key for key in new if not _is_same(old[key], new[key]))
    return Redivided(before, signed(after), other, change)


def _is_same(one: Attempt, other: Attempt) -> bool:
    if isinstance(one, PlateError) or isinstance(other, PlateError):
        return False
    return np.array_equal(one.points, other.points)
