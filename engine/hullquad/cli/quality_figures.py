"""What is told of the quality of a mesh, as figures: the same for people and for programs."""

from math import isfinite
from typing import Any

import numpy as np

from hullquad.arrays import Bools, Floats
from hullquad.mesh import Mesh
from hullquad.metrics import Band
from hullquad.quality import Quality
from hullquad.rules import MEASURES, Assessment, Finding, Level

LOW_SHARE, HIGH_SHARE = 0.05, 0.95


def metric_figures(mesh: Mesh, quality: Quality, given: Bools) -> dict[str, Any]:
    """How the elements stand by one metric."""
    shown = quality.values[quality.is_on_scale]
    least, low, high, most = _ranks(shown)
    return {
        "worst": quality.worst,
        "worst_element": int(mesh.topology.element_labels[quality.worst_element]),
        "min": least,
        "p05": low,
        "mean": quality.mean,
        "p95": high,
        "max": most,
        "failing": quality.failing_count,
        "failing_share": quality.failing_count / len(quality.values),
        "given": int(given.sum()),
    }


def rules_figures(mesh: Mesh, assessment: Assessment) -> dict[str, Any]:
    """What the rules of a set say, rule by rule."""
    found = assessment.rule_set
    return {
        "key": found.key,
        "title": found.title,
        "edition": found.edition,
        "source": found.source,
        "note": found.note,
        "rules": [finding_figures(mesh, finding) for finding in assessment.findings],
    }


def finding_figures(mesh: Mesh, finding: Finding) -> dict[str, Any]:
    """What one rule says."""
    rule = finding.rule
    worst = finding.rows[0] if len(finding.rows) else None
    return {
        "measure": rule.measure or None,
        "title": rule.title,
        "unit": MEASURES[rule.measure].unit if rule.measure else "",
        "elements": rule.elements.value,
        "warn": _ends(rule.warn),
        "error": _ends(rule.error),
        "text": rule.text,
        "source": rule.source,
        "status": rule.status.value,
        "not_evaluated": finding.not_evaluated,
        "warnings": finding.count(Level.WARN),
        "errors": finding.count(Level.ERROR),
        "given": int(finding.given.sum()),
        "worst": None if worst is None else float(finding.values[worst]),
        "worst_element": None if worst is None else int(mesh.topology.element_labels[worst]),
    }


def _ranks(values: Floats) -> tuple[float, ...]:
    """Least, 5 %, 95 % and greatest of the values, each one of them; nan where there are none."""
    if not len(values):
        return (float("nan"),) * 4
    last = len(values) - 1
    places = [0, round(LOW_SHARE * last), round(HIGH_SHARE * last), last]
    return tuple(np.partition(values, places)[places].tolist())


def _ends(band: Band | None) -> list[float | None] | None:
    return None if band is None else [end if isfinite(end) else None for end in band]
