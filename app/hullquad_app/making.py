"""What a mesh was made from, stage by stage: thousands of them, each put together when it is shown."""

from collections.abc import Sequence
from functools import cached_property
from typing import TYPE_CHECKING

import attrs

from hullquad.metrics import Metric
from hullquad.optimization.iterate import Iterate

if TYPE_CHECKING:
    from hullquad.pipeline import MeshStage

MOST = 300
"""Stages that are kept, about: as many as one can tell apart on the slider, beside the iterates of runs."""
_KEPT = 4
"""Stages that were shown last, so that the same mesh is shown while one looks at it otherwise."""


@attrs.frozen(eq=False)
class Making:
    """The stages from the triangles to the last one before the finished mesh, as iterates with numbers below 0."""

    stages: "Sequence[MeshStage]" = ()
    metric: Metric | None = None
    """What the finished mesh is judged by; None where there are no stages."""
    _shown: dict[int, Iterate] = attrs.field(factory=dict, init=False)

    @classmethod
    def of(cls, stages: "Sequence[MeshStage]", metric: Metric) -> "Making":
        """All stages, or so many alike apart that there are not too many, and the last one of every step."""
        stride = -(-len(stages) // MOST)
        kept = (row for row in range(len(stages)) if row % stride == 0 or _ends_step(stages, row))
        return cls([stages[row] for row in kept], metric)

    def __len__(self) -> int:
        return len(self.stages)

    def __getitem__(self, row: int) -> Iterate:
        row = range(len(self.stages))[row]
        if row not in self._shown:
            self._shown[row] = self._iterate(row)
            for other in [*self._shown][:-_KEPT]:
                del self._shown[other]
        return self._shown[row]

    @cached_property
    def steps(self) -> frozenset[str]:
        """What is done on the way."""
        return frozenset(stage.step.value for stage in self.stages)

    def _iterate(self, row: int) -> Iterate:
        from hullquad.optimization.paper import unmoved  # noqa: PLC0415  brings Numba: half a second

        assert self.metric is not None  # there are stages
        stage = self.stages[row]
        iterate = unmoved(stage.mesh(), self.metric)
        return attrs.evolve(iterate, number=row - len(self.stages), is_best=False, stage=stage.step.value)


def _ends_step(stages: "Sequence[MeshStage]", row: int) -> bool:
    return row + 1 == len(stages) or stages[row + 1].step is not stages[row].step
