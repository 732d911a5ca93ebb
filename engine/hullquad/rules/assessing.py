"""Judging a mesh by the rules of a set."""

from math import inf

import attrs
import numpy as np

from hullquad.arrays import Bools, Bytes, Floats, floats, small_ints
from hullquad.given import beyond_mending, inverted_for_good
from hullquad.mesh import Mesh
from hullquad.metrics import metric
from hullquad.rules.assessment import Assessment, Finding
from hullquad.rules.measures import MEASURES, TRIANGLE_SHARE, VALID, Measure
from hullquad.rules.rule import Level, Rule, RuleSet, Status, widened
from hullquad.sentences import SENTENCES

NO_INVERTED = Rule(
    measure=VALID,
    title=MEASURES[VALID].title,
    error=(1.0, inf),
    text="no element is inverted, concave or collapsed",
    source="every solver",
    status=Status.READ,
)
"""What every set contains: the first finding of every assessment."""


@attrs.frozen(eq=False)
class _Judged:
    """A mesh, and the values that some rules look at."""

    mesh: Mesh
    values: dict[str, Floats]
    """(E,) by the key of the metric."""
    valid: Bools
    """(E,)"""


def assess(mesh: Mesh, rule_set: RuleSet) -> Assessment:
    """What the rules of a set say of a mesh.

    Where the share of triangles is too large, every triangle breaks the rule. What the mesh does not tell
    (its thickness, its element size, where the stiffeners are) is a finding that is not evaluated.
    """
    judged = _judged(mesh, rule_set)
    findings = tuple(_finding(judged, rule) for rule in (NO_INVERTED, *rule_set.rules))
    return Assessment(rule_set=rule_set, findings=findings)


def _judged(mesh: Mesh, rule_set: RuleSet) -> _Judged:
    from hullquad.metrics.values import all_judged  # noqa: PLC0415  brings Numba: half a second

    measures = (MEASURES[rule.measure] for rule in rule_set.rules if rule.measure)
    metrics = [metric(key) for key in dict.fromkeys(measure.metric for measure in measures if measure.metric)]
    values, valid = all_judged(mesh.points, mesh.topology.elements, mesh.normals, mesh.reference_areas, metrics)
    return _Judged(mesh, {row.key: floats(column) for row, column in zip(metrics, values.T, strict=True)}, valid)


def _finding(judged: _Judged, rule: Rule) -> Finding:
    if rule.not_evaluated:
        return _unevaluated(judged, rule, rule.not_evaluated)
    measure = MEASURES[rule.measure]
    if not measure.is_told_by(judged.mesh):
        return _unevaluated(judged, rule, SENTENCES[f"N_UNTOLD:{measure.needs}"])
    if measure.key == VALID:
        return _validity(judged, rule)
    if measure.key == TRIANGLE_SHARE:
        return _triangle_share(judged, rule)
    return _by_metric(judged, rule, measure)


def _unevaluated(judged: _Judged, rule: Rule, reason: str) -> Finding:
    count = len(judged.valid)
    return Finding(
        rule=rule,
        metric=None,
        values=floats(np.zeros(count)),
        levels=small_ints(np.zeros(count)),
        given=np.zeros(count, dtype=bool),
        not_evaluated=reason,
    )


def _by_metric(judged: _Judged, rule: Rule, measure: Measure) -> Finding:
    """Finding of a rule whose measure is a metric, or one over a length."""
    by, length = metric(measure.metric), np.asarray(measure.length(judged.mesh))
    values = judged.values[by.key]
    if measure.needs:
        values = floats(np.where(np.isfinite(values), values / length, values))
    levels = _levels(judged, rule, values)
    given = np.zeros(len(levels), dtype=bool)
    for level, band in ((Level.WARN, rule.warn), (Level.ERROR, rule.error)):
        rows = np.flatnonzero(levels == level)
        if band is not None and len(rows):
            there = np.broadcast_to(length, levels.shape)[rows]
            low, high = (np.where(np.isfinite(end), end * there, end) for end in widened(band))
            given[rows] = beyond_mending(judged.mesh, by, (low, high), rows)
    return Finding(rule=rule, metric=by, values=values, levels=levels, given=given)


def _validity(judged: _Judged, rule: Rule) -> Finding:
    values, rows = floats(judged.valid), np.flatnonzero(~judged.valid)
    given = np.zeros(len(values), dtype=bool)
    given[rows] = inverted_for_good(judged.mesh, rows)
    return Finding(rule=rule, metric=None, values=values, levels=_levels(judged, rule, values), given=given)


def _triangle_share(judged: _Judged, rule: Rule) -> Finding:
    """Every triangle breaks the rule where they are too many; it is given where no mesh of the contour has fewer."""
    is_triangle = judged.mesh.topology.is_triangle
    count = int(is_triangle.sum())
    values = floats(np.full(len(is_triangle), count / max(1, len(is_triangle))))
    levels = small_ints(np.where(is_triangle, rule.levels(values), Level.OK))
    is_forced = count == judged.mesh.triangles_unavoidable
    return Finding(rule=rule, metric=None, values=values, levels=levels, given=np.asarray((levels > 0) & is_forced))


def _levels(judged: _Judged, rule: Rule, values: Floats) -> Bytes:
    """(E,) levels of the elements that the rule is for, OK of the others."""
    chosen = rule.elements.chosen(judged.mesh.topology.is_triangle)
    return small_ints(np.where(chosen, rule.levels(values), Level.OK))
