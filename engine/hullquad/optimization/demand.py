"""What a rule asks of an element, as a minimiser sees it."""

import attrs

from hullquad.metrics import Metric


@attrs.frozen
class Demand:
    """One end of a rule's band."""

    metric: Metric
    limit: float
    """[the kernel's unit: angles in radians]"""
    is_upper: bool
    """Whether values above the limit break it, not those below."""
    scale: float
    """1 over the way from the limit to the ideal."""
    weight: float
    is_of_quads: bool
    is_of_triangles: bool
