"""Moving nodes so that as few elements as possible break a rule set."""

from collections.abc import Iterator
from math import isfinite

import numpy as np

from hullquad.arrays import Bools
from hullquad.mesh import Mesh
from hullquad.metrics import Band, Metric, metric
from hullquad.optimization import energies
from hullquad.optimization.demand import Demand
from hullquad.optimization.iterate import Iterate
from hullquad.optimization.looks import Rank, looks
from hullquad.optimization.objective import Objective
from hullquad.optimization.settings import SearchSettings
from hullquad.optimization.stages import continued, course_of, evened, mended, opened
from hullquad.optimization.untangle import folded_count
from hullquad.rules.assessing import assess
from hullquad.rules.assessment import Assessment
from hullquad.rules.measures import MEASURES
from hullquad.rules.rule import Elements, Level, Rule, RuleSet

_WEIGHTS = {Level.WARN: 1.0, Level.ERROR: 3.0}


def rules_iterates(
    mesh: Mesh, objective: Objective, rule_set: RuleSet, settings: SearchSettings | None = None
) -> Iterator[Iterate]:
    """Iterates towards the fewest violations of a rule set, then the objective's sum.

    Elements of which the contour itself breaks a rule are left out of the chase. The best has the fewest errors,
    then the fewest warnings, then the best exact sum with its floor.
    """
    settings = settings or SearchSettings()
    course = course_of(mesh, settings)
    course.weigh(np.where(chased(assess(mesh, rule_set)), 1.0, 0.0))
    exact = energies.merit(objective, mesh.target_size, mesh.areas, None, settings.floor)

    def stages() -> Iterator[str]:
        yield from opened(course)
        yield from evened(course)
        yield from continued(course, objective, settings)
        yield from mended(course, demands(mesh, rule_set), objective, settings)

    def rank() -> Rank:
        counts = assess(course.mesh(), rule_set).counts
        violations = (-float(counts[level]) for level in (Level.ERROR, Level.WARN))
        return -float(folded_count(course)), *violations, -course.value(exact)

    yield from looks(mesh, objective, course, stages(), rank)


def demands(mesh: Mesh, rule_set: RuleSet) -> tuple[Demand, ...]:
    """What the rules of a set ask of each element by itself, as far as this mesh tells."""
    return tuple(demand for rule in rule_set.rules for demand in _demands(mesh, rule))


def chased(assessment: Assessment) -> Bools:
    """(E,) which elements are not broken for good: the contour gives none of their violations."""
    return np.asarray(~np.any([finding.given for finding in assessment.findings], axis=0))


def _demands(mesh: Mesh, rule: Rule) -> Iterator[Demand]:
    measure = MEASURES.get(rule.measure)
    if rule.not_evaluated or measure is None or not measure.metric or not measure.is_told_by(mesh):
        return
    length = measure.length(mesh)
    if not isinstance(length, float | int):
        return
    row = metric(measure.metric)
    for level, band in ((Level.WARN, rule.warn), (Level.ERROR, rule.error)):
        if band is not None:
            yield from _ends(row, band, float(length), rule.elements, _WEIGHTS[level])


def _ends(row: Metric, band: Band, length: float, elements: Elements, weight: float) -> Iterator[Demand]:
    for limit, is_upper in ((band[0], False), (band[1], True)):
        if isfinite(limit):
            inside = limit * length / row.factor
            way = abs(row.quads.ideal / row.factor - inside) or max(abs(inside), 1.0)
            yield Demand(
                metric=row,
                limit=inside,
                is_upper=is_upper,
                scale=1.0 / way,
                weight=weight,
                is_of_quads=elements is not Elements.TRIANGLES,
                is_of_triangles=elements is not Elements.QUADS and row.triangles is not None,
            )
