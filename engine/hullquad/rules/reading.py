"""The file of a rule set: ``hullquad rules`` version 1, in JSON.

::

    {"format": "hullquad rules", "version": 1, "title": "Our yard", "edition": "2026", "source": "QA 12",
     "rules": [{"measure": "aspect_ratio", "warn": [null, 2], "error": [null, 4], "elements": "quads",
                "text": "close to 1", "source": "QA 12, 3.1", "status": "read"},
               {"title": "Elements over the depth", "text": "three or more", "not_evaluated": "depths are unknown"}]}

A limit is the pair of the least and the greatest acceptable value, null where nothing is too much.
"""

from collections.abc import Iterator
from functools import partial
from typing import Any

import attrs

from hullquad.documents.entry import Entry, Field, Refused, anything, items, text, whole
from hullquad.metrics import Band, metric
from hullquad.rules.document import band, choice, name, opened
from hullquad.rules.measures import MEASURES
from hullquad.rules.rule import Elements, Rule, RuleSet, Status

FORMAT = "hullquad rules"


def parsed(content: bytes, place: str) -> RuleSet:
    """The rule set in the bytes of a file; errors name `place` and the path in it.

    Raises
    ------
    FileError, RuleError
        It is not JSON, of another format, or faulty: the first fault, `others` telling how many more there are.
    """
    return opened(content, place, FORMAT, _rule_set)


def _rule_set(entry: Entry) -> RuleSet:
    found = whole(
        entry,
        {
            "format": Field(anything),
            "version": Field(anything),
            "key": Field(name),
            "title": Field(name, "E_RULE"),
            "edition": Field(text),
            "source": Field(text),
            "note": Field(text),
            "rules": Field(_rules, "E_RULE"),
        },
    )
    source = found.get("source", "")
    return RuleSet(
        key=found.get("key", found["title"]),
        title=found["title"],
        edition=found.get("edition", ""),
        source=source,
        note=found.get("note", ""),
        rules=tuple(attrs.evolve(rule, source=rule.source or source) for rule in found["rules"]),
    )


def _rules(entry: Entry) -> list[Rule]:
    rules = items(entry, _rule)
    if not rules:
        raise entry.refused("E_RULE", "empty")
    for number, earlier in _repeated(rules):
        entry.at(number).refused("E_RULE", "twice", measure=rules[number].measure, earlier=earlier)
    if any(_repeated(rules)):
        raise Refused
    return rules


def _repeated(rules: list[Rule]) -> Iterator[tuple[int, int]]:
    """Numbers of the rules that measure what an earlier one measures already, and of that one."""
    for number, rule in enumerate(rules):
        for earlier, other in enumerate(rules[:number]):
            meet = Elements.ALL in (rule.elements, other.elements) or rule.elements is other.elements
            if rule.measure and rule.measure == other.measure and meet:
                yield number, earlier


def _rule(entry: Entry) -> Rule:
    found = whole(
        entry,
        {
            "measure": Field(partial(choice, known=list(MEASURES), code="E_MEASURE")),
            "title": Field(name),
            "elements": Field(partial(choice, known=[kind.value for kind in Elements], code="E_CHOICE")),
            "warn": Field(_limit),
            "error": Field(_limit),
            "text": Field(text),
            "source": Field(text),
            "status": Field(partial(choice, known=[status.value for status in Status], code="E_CHOICE")),
            "not_evaluated": Field(name),
        },
    )
    _refuse_senseless(entry, found)
    measure = found.get("measure", "")
    return Rule(
        measure=measure,
        title=found.get("title") or MEASURES[measure].title,
        elements=Elements(found.get("elements", "all")),
        warn=found.get("warn"),
        error=found.get("error"),
        text=found.get("text", ""),
        source=found.get("source", ""),
        status=Status(found.get("status", "unverified")),
        not_evaluated=found.get("not_evaluated", ""),
    )


def _limit(entry: Entry) -> Band | None:
    return None if entry.value is None else band(entry)


def _refuse_senseless(entry: Entry, found: dict[str, Any]) -> None:
    """Refuse a rule whose keys are sound, but not together."""
    measure, warn, error = found.get("measure", ""), found.get("warn"), found.get("error")
    if found.get("not_evaluated"):
        if measure or warn or error:
            raise entry.refused("E_RULE", "both")
        if "title" not in found:
            raise entry.at("title").refused("E_RULE", "missing", key="title")
        return
    if not measure:
        raise entry.at("measure").refused("E_RULE", "missing", key="measure")
    if warn is None and error is None:
        raise entry.refused("E_RULE", "no_limit")
    if warn and error and (warn[0] < error[0] or warn[1] > error[1]):
        raise entry.at("warn").refused("E_BAND", "beyond")
    by = MEASURES[measure].metric
    if by and metric(by).triangles is None and found.get("elements", "all") != Elements.QUADS.value:
        raise entry.at("elements").refused("E_RULE", "quads_only", measure=measure)
