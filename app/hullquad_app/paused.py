"""A run that was paused, and can go on."""

import attrs

from hullquad.optimization.iterate import Iterate
from hullquad_app.plan import Plan
from hullquad_app.source import Source


@attrs.frozen(eq=False, kw_only=True)
class Paused:
    """What is kept of a run between two presses: optimisers remember the way that they have come."""

    source: Source
    plan: Plan
    start: int
    """Number of the iterate that the run began with."""
    last: Iterate
    """The newest one of its track."""

    def goes_on(self, shown: Iterate | None, plan: Plan) -> bool:
        """Whether to go on from the shown iterate with a plan is to go on with this run."""
        return shown is self.last and plan == self.plan
