"""Write the tables of metrics and of rules from the program's own: ``python assets/make_tables.py``."""

from collections.abc import Iterator
from itertools import groupby
from math import isfinite
from pathlib import Path

from hullquad.metrics import METRICS, Band, Metric, Scale
from hullquad.rules import MEASURES, Rule, RuleSet, rule_sets

FOLDER = Path(__file__).parent / "docs"
OF_METRICS = """\
Every metric of the program, with the key by which commands and files name it. Elements fail outside of the
*acceptable* band unless another limit is set. Triangles have bands of their own, and are judged by their shape where
a metric has no form for them."""
OF_RULES = """\
Every rule set of the program; `hullquad quality MESH --rules KEY` judges by it. *read*: the limit stands so in the
source; *unverified*: it is from experience, and to be checked against the current edition. That no element is inverted
belongs to every set. What a mesh cannot tell is listed as not evaluated."""
NOTE = "<!-- written by assets/make_tables.py from the program's own table: change that -->"


def metrics_page() -> Iterator[str]:
    """Lines of the page of metrics."""
    yield from ("# Metrics", "", NOTE, "")
    yield OF_METRICS
    for group, rows in groupby(METRICS, key=lambda row: row.group):
        yield from ("", f"## {group}", "")
        yield from table("key", "metric", "what it is", "range", "ideal", "acceptable", "triangles", "source")
        for row in rows:
            yield line(*_metric(row))


def rules_page() -> Iterator[str]:
    """Lines of the page of rule sets."""
    yield from ("# Rule sets", "", NOTE, "")
    yield OF_RULES
    for found in rule_sets():
        yield from _rule_set(found)


def _metric(row: Metric) -> tuple[str, ...]:
    title = f"{row.title} [{row.unit}]" if row.unit else row.title
    of_triangles = band(row.triangle_band) if row.triangles else "by shape"
    ends = (span(row.quads), f"{row.quads.ideal:g}", band(row.band), of_triangles)
    return f"`{row.key}`", title, row.formula, *ends, row.source


def _rule_set(found: RuleSet) -> Iterator[str]:
    yield from (
        "",
        f"## {found.title}",
        "",
        f"`{found.key}`: {found.edition}. Source: {found.source}. {found.note}".strip(),
        "",
    )
    yield from table("measure", "of", "warning unless", "error unless", "rule", "limit")
    for rule in found.rules:
        if rule.measure:
            yield line(*_rule(rule, found.source))
    others = [rule for rule in found.rules if rule.not_evaluated]
    if others:
        yield from ("", "Not evaluated:", "")
    for rule in others:
        yield f"- {rule.title}: {rule.text} ({rule.not_evaluated})"


def _rule(rule: Rule, source: str) -> tuple[str, ...]:
    unit = MEASURES[rule.measure].unit
    title = f"{rule.title} [{unit}]" if unit else rule.title
    limits = (band(rule.warn) if rule.warn else "", band(rule.error) if rule.error else "")
    status = rule.status.value if rule.source == source else f"{rule.status.value}: {rule.source}"
    return f"{title} `{rule.measure}`", rule.elements.value, *limits, rule.text, status


def band(ends: Band) -> str:
    """A band in words."""
    low, high = ends
    if isfinite(low) and isfinite(high):
        return f"{low:g} to {high:g}"
    return f"≥ {low:g}" if isfinite(low) else f"≤ {high:g}"


def span(scale: Scale) -> str:
    """The range of a scale."""
    low, high = (f"{end:g}".replace("inf", "∞").replace("-", "−") for end in (scale.low, scale.high))
    return f"{low} … {high}"


def table(*heading: str) -> Iterator[str]:
    """Heading of a table."""
    yield line(*heading)
    yield "|" + "---|" * len(heading)


def line(*cells: str) -> str:
    """Row of a table."""
    return "| " + " | ".join(cell.replace("|", "\\|") for cell in cells) + " |"


PAGES = {"metrics.md": metrics_page, "rules.md": rules_page}


def text(name: str) -> str:
    """What belongs on a page."""
    return "\n".join(PAGES[name]()) + "\n"


def main() -> None:
    """Write them all."""
    FOLDER.mkdir(exist_ok=True)
    for name in PAGES:
        (FOLDER / name).write_text(text(name), encoding="utf-8")


if __name__ == "__main__":
    main()
