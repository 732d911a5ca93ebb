"""What a run does, in the words of the Edit menu."""

from PySide6.QtCore import QCoreApplication

from hullquad.mesh import Mesh
from hullquad.optimization.iterate import Iterate
from hullquad_app.count_words import number_of
from hullquad_app.objectives import objective_name
from hullquad_app.panels.figures import counted, unit_of, valued
from hullquad_app.plan import UNTANGLE, Plan


def run_label(plan: Plan, first: Iterate, last: Iterate, *, is_step: bool) -> str:
    """What was done, to how many nodes if not to all, what came of it: ``Optimize stretch: 16.65 → 17.94``."""
    what, before, after = _figures(plan, first, last)
    if (chosen := plan.chosen(first.mesh)) is not None:
        count = int((chosen & first.mesh.topology.is_free).sum())
        what = f"{what} ({number_of('node', count)})"
    text = _tr("Step {what}: {before} → {after}") if is_step else _tr("Optimize {what}: {before} → {after}")
    return text.format(what=what, before=before, after=after)


def _figures(plan: Plan, first: Iterate, last: Iterate) -> tuple[str, str, str]:
    """What the optimiser is about, before and after."""
    key, name = plan.optimizer.key, objective_name(plan.objective)
    if key == UNTANGLE:
        before, after = (counted(iterate.quality.inverted_count) for iterate in (first, last))
        return _tr("inverted elements"), before, after
    if plan.rules is not None:
        before, after = (counted(_violations(plan, iterate.mesh)) for iterate in (first, last))
        return _tr("violations of {rules}").format(rules=plan.rules.title), before, after
    if key == "worst":
        before, after = (valued(iterate.quality.worst, plan.objective.metric) for iterate in (first, last))
        return _tr("worst {metric}").format(metric=name), before, after
    if key == "worst_quad":
        before, after = (valued(iterate.quality.worst_quad, plan.objective.metric) for iterate in (first, last))
        return _tr("worst {metric} of a quad").format(metric=name), before, after
    unit = unit_of(plan.objective.metric) if len(plan.objective.terms) == 1 else ""
    return name, f"{first.objective:.2f}{unit}", f"{last.objective:.2f}{unit}"


def _violations(plan: Plan, mesh: Mesh) -> int:
    """Number of elements that are outside a rule, if only with a warning."""
    from hullquad.rules import Level, assess  # noqa: PLC0415  an empty window does not wait for it

    assert plan.rules is not None  # it is what the run is about
    return len(mesh.topology.elements) - assess(mesh, plan.rules).counts[Level.OK]


def _tr(text: str) -> str:
    return QCoreApplication.translate("Run", text)
