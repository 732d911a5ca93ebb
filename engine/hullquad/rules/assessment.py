"""What the rules of a set say of a mesh: which elements break which rule, how badly, and whether nodes can mend it."""

from functools import cached_property

import attrs
import numpy as np

from hullquad.arrays import Bools, Bytes, Floats, Longs, longs, small_ints
from hullquad.metrics import Metric
from hullquad.rules.rule import Level, Rule, RuleSet


@attrs.frozen(eq=False, kw_only=True)
class Finding:
    """What one rule says of every element."""

    rule: Rule
    metric: Metric | None
    """By what elements are measured; None for what only the whole mesh has, and where nothing is evaluated."""
    values: Floats
    """(E,) of the rule's measure, also of elements that the rule is not for; zeros where nothing is evaluated."""
    levels: Bytes
    """(E,) `Level`; OK where the rule is not for the element."""
    given: Bools
    """(E,) breaks the rule, and no move of free nodes can take it below its level: the contour gives it so."""
    not_evaluated: str | None = None
    """Why the mesh does not tell whether the rule is kept."""

    @property
    def mendable(self) -> Bools:
        """(E,) breaks the rule, and moving nodes may mend it."""
        return np.asarray((self.levels > Level.OK) & ~self.given)

    def count(self, level: Level) -> int:
        """Number of elements at exactly that level."""
        return int(np.count_nonzero(self.levels == level))

    @cached_property
    def rows(self) -> Longs:
        """(V,) rows of the elements that break the rule, errors first, then by how far they are beyond its limit."""
        found = np.flatnonzero(self.levels)
        return longs(found[np.lexsort((-self.rule.excess(self.values[found]), -self.levels[found]))])


@attrs.frozen(eq=False, kw_only=True)
class Assessment:
    """What the rules of a set say of a mesh."""

    rule_set: RuleSet
    findings: tuple[Finding, ...]
    """One for every rule, after the one that no element is inverted, which every set contains."""

    @cached_property
    def levels(self) -> Bytes:
        """(E,) worst `Level` of each element over all rules."""
        return small_ints(np.max([finding.levels for finding in self.findings], axis=0))

    @cached_property
    def given(self) -> Bools:
        """(E,) breaks a rule, and no move of free nodes can take it below its worst level."""
        at_worst = [finding.given & (finding.levels == self.levels) for finding in self.findings]
        return np.asarray(np.any(at_worst, axis=0))

    @property
    def violated(self) -> tuple[Finding, ...]:
        """Findings of the rules that are broken somewhere, in the order of the set."""
        return tuple(finding for finding in self.findings if len(finding.rows))

    @property
    def not_evaluated(self) -> tuple[Finding, ...]:
        """Findings of the rules of which this mesh tells nothing."""
        return tuple(finding for finding in self.findings if finding.not_evaluated is not None)

    @property
    def counts(self) -> dict[Level, int]:
        """Number of elements at each level."""
        return {level: int(np.count_nonzero(self.levels == level)) for level in Level}

    @property
    def worst(self) -> Level:
        """Level of the worst element."""
        return Level(int(self.levels.max(initial=Level.OK)))
