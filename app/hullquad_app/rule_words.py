"""Rules in words: limits, where they come from, and what a whole set is."""

from textwrap import fill
from typing import TYPE_CHECKING

from PySide6.QtCore import QCoreApplication

from hullquad.metrics import Band
from hullquad_app.panels.figures import signed

if TYPE_CHECKING:
    from hullquad.rules import Rule, RuleSet

_VALID = "valid"
_WIDTH = 72
"""Letters in a line of a tooltip."""


def about(rules: "RuleSet") -> str:
    """Title, edition, source and number of rules of a set."""
    parts = [rules.title, rules.edition, rules.source, rules.note]
    lines = list(dict.fromkeys(filter(None, parts)))
    return "\n".join(fill(line, _WIDTH) for line in lines)


def limit_of(rule: "Rule", unit: str) -> str:
    """What a rule accepts: ``≤ 3``, ``45° – 135°``, or both limits where warnings begin before errors."""
    if rule.measure == _VALID:
        return ""  # it is so, or it is not
    both = [band for band in (rule.warn, rule.error) if band is not None]
    texts = [_accepted(band, unit) for band in both]
    if len(texts) == 2 and texts[0] != texts[1]:
        return _tr("{warn}, fails unless {error}").format(warn=texts[0], error=texts[1])
    return texts[0] if texts else ""


def kind_of(rule: "Rule") -> str:
    """What a rule is for, where it is not for every element: ``quads``, ``triangles``."""
    return {"quads": _tr("quads"), "triangles": _tr("triangles")}.get(rule.elements.value, "")


def mark_of(rule: "Rule") -> str:
    """Whether the limit was read in its source."""
    return {"read": _tr("read"), "unverified": _tr("unverified")}[rule.status.value]


def source_of(rule: "Rule") -> str:
    """The rule in words, and where it stands, on several lines."""
    stands = {
        "read": _tr("It stands so in: {source}"),
        "unverified": _tr("Unverified, to be checked against the current edition of: {source}"),
    }[rule.status.value]
    lines = [rule.title, rule.text, stands.format(source=rule.source) if rule.source else "", rule.not_evaluated]
    return "\n".join(fill(line[:1].upper() + line[1:], _WIDTH) for line in lines if line)


def _accepted(band: Band, unit: str) -> str:
    low, high = (signed(f"{end:.4g}") + (f"\N{NO-BREAK SPACE}{unit}" if unit.isalpha() else unit) for end in band)
    if band[0] == float("-inf"):
        return f"≤ {high}"
    return f"≥ {low}" if band[1] == float("inf") else f"{low} – {high}"


def _tr(text: str) -> str:
    return QCoreApplication.translate("Rules", text)
