"""A run in figures: the mesh before it and the mesh that is shown, by what the run made better."""

import attrs

from hullquad.mesh import Mesh
from hullquad.metrics import Band, Metric
from hullquad.optimization.objective import Objective, Term
from hullquad.optimizers import Optimizer, optimizer
from hullquad.quality import Quality, quality
from hullquad_app.scene import Scene


@attrs.frozen(eq=False, kw_only=True)
class Side:
    """One of the two meshes."""

    mesh: Mesh
    objective: float
    """What the run makes better."""
    quality: Quality
    """By the objective's metric and the user's limits."""
    given_count: int
    """Number of failing elements that no move of the nodes can mend."""


@attrs.frozen(eq=False, kw_only=True)
class Balance:
    """Both of them, and what it took to come from one to the other."""

    before: Side
    now: Side
    objective: Objective
    """Of the run."""
    optimizer: Optimizer | None
    """None where no run is known."""
    iterations: int
    seconds: float | None
    """Time that the whole run took."""
    displacement: float
    """How far apart the two places of a node are at most [mm]."""

    @property
    def metric(self) -> Metric:
        """By which both meshes are judged."""
        return self.objective.metric

    @property
    def is_weighted(self) -> bool:
        """Whether the objective is made of several metrics."""
        return len(self.objective.terms) > 1

    @property
    def is_sacrifice(self) -> bool:
        """Whether the sum has become better and the worst element worse."""
        by, before, now = self.metric, self.before, self.now
        is_better = (
            now.objective > before.objective if self.is_weighted else by.is_worse(before.objective, now.objective)
        )
        return is_better and by.is_worse(now.quality.worst, before.quality.worst)


def balance(scene: Scene, known: Balance | None = None) -> Balance | None:
    """The balance of the run that the shown iterate came of; sides that are known are not computed again."""
    track = scene.track
    if track is None:
        return None
    now = track.iterates[scene.position]
    passage = track.passage_at(now.number)
    by = Objective((Term(now.quality.metric),)) if passage is None else passage.objective
    start = track.first if passage is None else track.iterates[track.row(passage.start)]
    band = scene.view.bands.get(by.metric.key, by.metric.band)
    return Balance(
        before=_side(start.mesh, by, band, known),
        now=_side(now.mesh, by, band, known),
        objective=by,
        optimizer=None if passage is None else optimizer(passage.optimizer),
        iterations=now.number - start.number,
        seconds=None if passage is None else passage.seconds,
        displacement=_farthest(start.mesh, now.mesh),
    )


def _side(mesh: Mesh, by: Objective, band: Band, known: Balance | None) -> Side:
    from hullquad.given import given  # noqa: PLC0415  an empty window does not wait for it

    if known is not None and known.objective == by and known.before.quality.band == band:
        for side in (known.before, known.now):
            if side.mesh is mesh:
                return side
    judged = quality(mesh, by.metric, band)
    return Side(mesh=mesh, objective=by.total(mesh), quality=judged, given_count=int(given(mesh, judged).sum()))


def _farthest(before: Mesh, now: Mesh) -> float:
    from hullquad.optimization.looks import farthest_move  # noqa: PLC0415  brings Numba: half a second

    return 0.0 if before is now else farthest_move(before.points, now.points)
