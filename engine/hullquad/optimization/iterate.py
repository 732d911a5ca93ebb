"""One state of a running optimisation, and what remains of the run in the end."""

from collections.abc import Iterable

import attrs

from hullquad.mesh import Mesh
from hullquad.optimization.stops import Stop
from hullquad.quality import Quality


@attrs.frozen(eq=False, kw_only=True)
class Iterate:
    """A mesh on the way to a better one."""

    number: int
    """0 is the mesh the run began with."""
    mesh: Mesh
    quality: Quality
    """Judged by the metric of the objective, triangles included."""
    objective: float
    """What the run makes better: a sum over the quads [the metric's unit]."""
    displacement: float = 0.0
    """How far the node that moved most has moved since the last iterate [mm]."""
    is_best: bool = True
    """Whether no earlier iterate of the run is as good."""
    stage: str = ""
    """What the run was about when it got here; empty where it has one stage only."""
    stop: Stop | None = None
    """Set on the last iterate of a run that ended by itself."""


@attrs.frozen(eq=False, kw_only=True)
class Outcome:
    """First, best and last iterate of a run."""

    first: Iterate
    best: Iterate
    last: Iterate


def outcome(iterates: Iterable[Iterate]) -> Outcome:
    """Run to the end; the result of the run is the best iterate, not the last."""
    remaining = iter(iterates)
    first = best = last = next(remaining)
    for last in remaining:
        if last.is_best:
            best = last
    return Outcome(first=first, best=best, last=last)
