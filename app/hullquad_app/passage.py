"""A run as part of a track."""

import attrs

from hullquad.optimization.objective import Objective


@attrs.frozen(eq=False, kw_only=True)
class Passage:
    """What the iterates after one came of; a run that was paused and went on is one passage."""

    start: int
    """Number of the iterate that the run began with."""
    optimizer: str
    """Key of the optimiser."""
    objective: Objective
    seconds: float
    """Time that its iterates took to make."""
