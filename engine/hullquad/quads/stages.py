"""The states that a mesh goes through while it is made."""

from enum import Enum

import attrs

from hullquad.arrays import Floats, Ints, floats, ints


class Step(Enum):
    """What has just been done."""

    TRIANGULATED = "triangulated"
    JOINED = "joined"
    REPAIRED = "repaired"
    CLEANED = "cleaned"
    SMOOTHED = "smoothed"
    SHAKEN = "shaken"


@attrs.frozen(eq=False, kw_only=True)
class Draught:
    """Nodes in the plate's plane and elements, after a step."""

    step: Step
    nodes: Floats = attrs.field(converter=floats)
    """(N, 2) those given by the contour first [mm]."""
    elements: Ints = attrs.field(converter=ints)
    """(E, 4) counter-clockwise; a triangle ends with -1."""
    cost: float = 0.0
    """See `quads.cost`; the triangulation has none."""
