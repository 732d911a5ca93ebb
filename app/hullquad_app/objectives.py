"""By what is optimised: by what was chosen for it, else by the metric that is shown."""

from hullquad.metrics import OBJECTIVES, Metric, metric
from hullquad.optimization.objective import Objective, Term, objective
from hullquad_app.metric_words import name_of

INSTEAD = metric("shape")
"""Where the shown metric has no sum that could be made better: it grows with every kind of distortion."""


def optimised_by(shown: Metric) -> Metric:
    """The metric of the next run where none was chosen for it."""
    return shown if shown in OBJECTIVES else INSTEAD


def wanted(shown: Metric, chosen: str | None = None) -> Objective:
    """The objective of the next run; `chosen` is written ``KEY[=WEIGHT][,KEY…]``."""
    return Objective((Term(optimised_by(shown)),)) if chosen is None else objective(chosen)


def written(terms: tuple[Term, ...]) -> str:
    """Terms as `wanted` reads them."""
    return ",".join(f"{term.metric.key}={term.weight:.6g}" for term in terms)


def objective_name(by: Objective) -> str:
    """An objective within a sentence: ``stretch + 2 shape``."""
    if len(by.terms) == 1:
        return name_of(by.metric)
    weights = ("" if term.weight == 1 else f"{term.weight:.6g} " for term in by.terms)
    return " + ".join(f"{weight}{name_of(term.metric)}" for weight, term in zip(weights, by.terms, strict=True))
