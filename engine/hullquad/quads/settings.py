"""What a user can ask of the best mesher: apart from it, so that asking loads no compiled kernel."""

from enum import Enum

import attrs

GRADING = 0.4
LEAST_GRADING, LARGEST_GRADING = 0.05, 2.0
"""Less makes elements without end, more is no limit any more."""


class Preference(Enum):
    """What matters most where one mesh cannot have both."""

    QUADS = "quads"
    """The fewest triangles, then the lowest cost."""
    QUALITY = "quality"
    """The best worst element, even if triangles stay that could be avoided."""


@attrs.frozen(kw_only=True)
class MeshSettings:
    """How the best mesher works."""

    prefer: Preference = Preference.QUADS
    grading: float = GRADING
    """By how much elements may grow per length away from short segments: less makes more and better elements."""
