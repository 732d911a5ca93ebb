"""Rule sets of class societies, solvers and users, and what they say of a mesh."""

from hullquad.rules.assessing import NO_INVERTED, assess
from hullquad.rules.assessment import Assessment, Finding
from hullquad.rules.built_in import read_rule_set, rule_set, rule_sets
from hullquad.rules.measures import MEASURES, Measure
from hullquad.rules.rule import Elements, Level, Rule, RuleSet, Status

__all__ = [
    "MEASURES",
    "NO_INVERTED",
    "Assessment",
    "Elements",
    "Finding",
    "Level",
    "Measure",
    "Rule",
    "RuleSet",
    "Status",
    "assess",
    "read_rule_set",
    "rule_set",
    "rule_sets",
]
