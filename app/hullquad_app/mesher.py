"""How the user wants plates to be meshed: remembered from day to day."""

import attrs

from hullquad.quads.settings import GRADING, MeshSettings, Preference

BEST, PAPER = "best", "paper"
MESHERS = (BEST, PAPER)
PREFERENCES = tuple(preference.value for preference in Preference)


@attrs.frozen(kw_only=True)
class Mesher:
    """A mesher and its options, but the element size."""

    name: str = BEST
    """One of `MESHERS`; the paper's has no options but the lines."""
    prefer: str = Preference.QUADS.value
    """One of `PREFERENCES`."""
    grading: float = GRADING
    """By how much elements may grow per length away from short segments."""
    follows_lines: bool = False
    """Whether elements follow stiffeners and seams as a whole, of either mesher; else only their ends are nodes."""

    @property
    def settings(self) -> MeshSettings:
        """The options of the best mesher."""
        return MeshSettings(prefer=Preference(self.prefer), grading=self.grading)
