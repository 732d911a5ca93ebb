"""What of a document is in files: what would not be lost."""

from collections.abc import Mapping
from pathlib import Path

import attrs

from hullquad.plate import Document
from hullquad_app.scene import State
from hullquad_app.track import Track


@attrs.frozen(eq=False)
class Kept:
    """Plates and meshes as they were opened or written last."""

    path: Path | None = None
    """File of the plates; where a mesh was opened, its."""
    plates: Document | None = None
    tracks: Mapping[str, Track] = attrs.field(factory=dict)

    @classmethod
    def of(cls, state: State) -> "Kept":
        """All of a state."""
        return cls(state.path, state.plates, state.tracks)

    def has_plates(self, state: State) -> bool:
        """Whether the plates of a state are in a file."""
        return state.plates is None or state.plates is self.plates

    def has_meshes(self, state: State) -> bool:
        """Whether every mesh of a state is in a file."""
        return all(track is self.tracks.get(key) for key, track in state.tracks.items())
