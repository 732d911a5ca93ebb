"""Judging a mesh by the rules of a set."""

from collections.abc import Callable
from functools import cache
from math import inf

import numpy as np

from hullquad.arrays import Bytes, Floats, floats, small_ints
from hullquad.given import beyond_mending, inverted_for_good
from hullquad.mesh import Mesh
from hullquad.metrics import metric
from hullquad.quality import Quality, quality
from hullquad.rules.assessment import Assessment, Finding
from hullquad.rules.measures import MEASURES, TRIANGLE_SHARE, VALID, Measure
from hullquad.rules.rule import Level, Rule, RuleSet, Status, widened
from hullquad.sentences import SENTENCES
from hullquad.topology import rim_edge_count

NO_INVERTED = Rule(
    measure=VALID,
    title=MEASURES[VALID].title,
    error=(1.0, inf),
    text="no element is inverted, concave or collapsed",
    source="every solver",
    status=Status.READ,
)
"""What every set contains: the first finding of every assessment."""

_Judged = Callable[[str], Quality]


def assess(mesh: Mesh, rule_set: RuleSet) -> Assessment:
    """What the rules of a set say of a mesh.

    Where the share of triangles is too large, every triangle breaks the rule. What the mesh does not tell
    (its thickness, its element size, where the stiffeners are) is a finding that is not evaluated.
    """
    judged = cache(lambda key: quality(mesh, metric(key)))
    findings = tuple(_finding(mesh, rule, judged) for rule in (NO_INVERTED, *rule_set.rules))
    return Assessment(rule_set=rule_set, findings=findings)


def _finding(mesh: Mesh, rule: Rule, judged: _Judged) -> Finding:
    measure = MEASURES.get(rule.measure)
    length = None if measure is None else measure.length(mesh)
    if measure is None:
        return _unevaluated(mesh, rule, rule.not_evaluated)
    if length is None:
        return _unevaluated(mesh, rule, SENTENCES[f"N_LENGTH:{measure.over}"])
    if measure.key == VALID:
        return _validity(mesh, rule, judged)
    if measure.key == TRIANGLE_SHARE:
        return _triangle_share(mesh, rule)
    return _by_metric(mesh, rule, measure, length, judged)


def _unevaluated(mesh: Mesh, rule: Rule, reason: str) -> Finding:
    count = len(mesh.topology.elements)
    return Finding(
        rule=rule,
        metric=None,
        values=floats(np.zeros(count)),
        levels=small_ints(np.zeros(count)),
        given=np.zeros(count, dtype=bool),
        not_evaluated=reason,
    )


def _by_metric(mesh: Mesh, rule: Rule, measure: Measure, length: float, judged: _Judged) -> Finding:
    """Finding of a rule whose measure is a metric, or one over a length."""
    by_metric = judged(measure.metric)
    values = floats(by_metric.values / length)
    levels = _levels(mesh, rule, values)
    given = np.zeros(len(levels), dtype=bool)
    for level, band in ((Level.WARN, rule.warn), (Level.ERROR, rule.error)):
        rows = np.flatnonzero(levels == level)
        if band is not None and len(rows):
            low, high = widened(band)
            given[rows] = beyond_mending(mesh, by_metric, (low * length, high * length), rows)
    return Finding(rule=rule, metric=by_metric.metric, values=values, levels=levels, given=given)


def _validity(mesh: Mesh, rule: Rule, judged: _Judged) -> Finding:
    valid = judged("shape").valid
    levels, rows = _levels(mesh, rule, floats(valid)), np.flatnonzero(~valid)
    given = np.zeros(len(valid), dtype=bool)
    given[rows] = inverted_for_good(mesh, rows)
    return Finding(rule=rule, metric=None, values=floats(valid), levels=levels, given=given)


def _triangle_share(mesh: Mesh, rule: Rule) -> Finding:
    """Every triangle breaks the rule where they are too many; they are given where no mesh of the contour has less."""
    is_triangle = mesh.topology.is_triangle
    values = floats(np.full(len(is_triangle), is_triangle.mean() if len(is_triangle) else 0.0))
    levels = small_ints(np.where(is_triangle, rule.levels(values), Level.OK))
    unavoidable = rim_edge_count(mesh.topology.elements) % 2
    given = (levels > Level.OK) & (int(is_triangle.sum()) <= unavoidable)
    return Finding(rule=rule, metric=None, values=values, levels=levels, given=np.asarray(given))


def _levels(mesh: Mesh, rule: Rule, values: Floats) -> Bytes:
    """(E,) levels of the elements that the rule is for, OK of the others."""
    chosen = rule.elements.chosen(mesh.topology.is_triangle)
    return small_ints(np.where(chosen, rule.levels(values), Level.OK))
