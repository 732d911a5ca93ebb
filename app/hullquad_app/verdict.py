"""What the shown mesh comes to beyond its values: what the contour gives, and what the chosen rule set says."""

from typing import TYPE_CHECKING

import attrs

from hullquad.arrays import Bools
from hullquad.mesh import Mesh
from hullquad.quality import Quality

if TYPE_CHECKING:
    from hullquad.rules import Assessment, RuleSet


@attrs.frozen(eq=False, kw_only=True)
class Verdict:
    """A mesh judged: reached once for each mesh that is shown, and seldom while a run goes on."""

    mesh: Mesh
    quality: Quality
    given: Bools
    """(E,) fails by the metric, and no node that may move can mend it."""
    assessment: "Assessment | None" = None
    """By the chosen rule set."""

    @property
    def rules(self) -> "RuleSet | None":
        """By which the mesh was assessed."""
        return None if self.assessment is None else self.assessment.rule_set

    def is_of(self, mesh: Mesh, quality: Quality, rules: "RuleSet | None") -> bool:
        """Whether it is about these, and nothing has changed."""
        return self.mesh is mesh and self.quality is quality and self.rules is rules

    def may_stand_for(self, mesh: Mesh, quality: Quality, rules: "RuleSet | None") -> bool:
        """Whether only nodes have moved since, and the yardsticks are the same."""
        is_same_metric = self.quality.metric is quality.metric and self.quality.band == quality.band
        return self.mesh.topology is mesh.topology and is_same_metric and self.rules is rules


def verdict(mesh: Mesh, quality: Quality, rules: "RuleSet | None", before: Verdict | None) -> Verdict:
    """Verdict of a mesh; the part that is known from before is not computed again."""
    if before is not None and before.is_of(mesh, quality, rules):
        return before
    return Verdict(mesh=mesh, quality=quality, given=_given(mesh, quality), assessment=_assessed(mesh, rules, before))


def _given(mesh: Mesh, quality: Quality) -> Bools:
    from hullquad.given import given  # noqa: PLC0415  an empty window does not wait for it

    return given(mesh, quality)


def _assessed(mesh: Mesh, rules: "RuleSet | None", before: Verdict | None) -> "Assessment | None":
    if rules is None:
        return None
    if before is not None and before.mesh is mesh and before.rules is rules:
        return before.assessment
    from hullquad.rules import assess  # noqa: PLC0415

    return assess(mesh, rules)
