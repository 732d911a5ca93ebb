"""What is told of the quality of a mesh, as text for people."""

from collections.abc import Iterator
from itertools import groupby
from math import isfinite, isnan
from textwrap import wrap
from typing import Any

from hullquad.metrics import METRICS, Metric
from hullquad.sentences import counted

Figures = dict[str, Any]

_METRIC_LINE = "{:<34}{:>14}{:>12}{:>12}{:>12}{:>10}{:>9}{:>8}"
_METRIC_HEAD = ("acceptable", "worst", "at element", "mean", "outside", "", "given")
_RULE_LINE = "  {:<33}{:<10}{:>13}{:>14}{:>10}{:>8}{:>7}{:>10}{:>12}  {}"
_WIDTH = 110
_RULE_HEAD = ("rule", "of", "warn", "error", "warnings", "errors", "given", "worst", "at element", "limits are")


def quality_text(figures: Figures) -> str:
    """All that is told of a mesh; `figures` are those of ``--json``."""
    things = [counted(figures[f"{noun}s"], noun) for noun in ("quad", "triangle", "node")]
    states = [f"{figures[state]} {state}" for state in ("inverted", "reversed")]
    lines = [", ".join(things + states), *_metrics(figures["metrics"])]
    if figures["triangles"]:
        lines += ["", *_of_triangles()]
    if figures["rules"] is not None:
        lines += ["", *_rules(figures["rules"])]
    elements = figures["quads"] + figures["triangles"]
    return "\n".join(line.rstrip() for line in (*lines, "", _verdict(figures, elements)))


def _metrics(by_key: dict[str, Figures]) -> Iterator[str]:
    """A table of all metrics, group by group."""
    for group, rows in groupby(METRICS, key=lambda row: row.group):
        yield ""
        yield _METRIC_LINE.format(group, *_METRIC_HEAD)
        yield from (_metric(row, by_key[row.key]) for row in rows)


def _metric(row: Metric, found: Figures) -> str:
    return _METRIC_LINE.format(
        "  " + _with_unit(row.title, row.unit),
        _band(row.band),
        f"{found['worst']:.4g}",
        found["worst_element"],
        "" if isnan(found["mean"]) else f"{found['mean']:.4g}",
        found["failing"],
        _share(found["failing_share"]) if found["failing"] else "",
        found["given"] or "",
    )


def _of_triangles() -> list[str]:
    by_shape = [row.title[0].lower() + row.title[1:] for row in METRICS if row.triangles is None]
    metrics = f"{', '.join(by_shape[:-1])} and {by_shape[-1]}"
    return wrap(f"Triangles are judged by their own bands; by their shape under {metrics}.", _WIDTH)


def _rules(found: Figures) -> Iterator[str]:
    """What a rule set says: a table of the rules that could be judged, and a list of the others."""
    yield f"{found['title']}; {found['edition']}" if found["edition"] else found["title"]
    if found["note"]:
        yield "  " + found["note"]
    yield _RULE_LINE.format(*_RULE_HEAD)
    yield from (_rule(rule) for rule in found["rules"] if rule["not_evaluated"] is None)
    others = [rule for rule in found["rules"] if rule["not_evaluated"] is not None]
    if others:
        yield "  not evaluated:"
    for rule in others:
        words = f": {rule['text']}" if rule["text"] else ""
        told = f"{rule['title']}{words} ({rule['not_evaluated']})"
        yield from wrap(told, _WIDTH, initial_indent="    ", subsequent_indent="      ")


def _rule(rule: Figures) -> str:
    return _RULE_LINE.format(
        _with_unit(rule["title"], rule["unit"]),
        rule["elements"],
        _band(rule["warn"]),
        _band(rule["error"]),
        rule["warnings"],
        rule["errors"],
        rule["given"] or "",
        "" if rule["worst"] is None else f"{rule['worst']:.4g}",
        "" if rule["worst_element"] is None else rule["worst_element"],
        rule["status"],
    )


def _verdict(figures: Figures, elements: int) -> str:
    """The last line: how many elements are how good, and what moving nodes cannot mend."""
    by = figures["rules"]["title"] if figures["rules"] else "Table 1 (errors) and the other metrics (warnings)"
    counts = figures["elements"]
    shares = (
        f"{counts[level]} {word} ({_share(counts[level] / elements)})"
        for level, word in (("ok", "fine"), ("warn", "with warnings"), ("error", "with errors"))
    )
    given = f"Given by the contour, so that moving nodes cannot mend them: {figures['given']}."
    return f"By {by}: {', '.join(shares)}.\n{given}"


def _band(band: Any) -> str:
    """A pair of ends in words; an open end is None or infinite."""
    if band is None:
        return ""
    low, high = (end if end is not None and isfinite(end) else None for end in band)
    if low is not None and high is not None:
        return f"{low:g} to {high:g}"
    return f"at least {low:g}" if low is not None else f"at most {high:g}"


def _share(part: float) -> str:
    """A part in per cent; no part of anything is told as 0, nor all but a part as 100."""
    return f"{min(max(100 * part, 0.1), 99.9):.1f} %" if 0 < part < 1 else f"{100 * part:.0f} %"


def _with_unit(title: str, unit: str) -> str:
    return f"{title} [{unit}]" if unit else title
