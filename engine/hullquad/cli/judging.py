"""The command quality: a mesh judged by every metric, and by a rule set."""

import sys
from argparse import Namespace
from pathlib import Path
from typing import Any

import attrs
import numpy as np

from hullquad.arrays import Bools, Bytes, small_ints
from hullquad.cli.clock import Clock
from hullquad.cli.codes import DONE, VIOLATED
from hullquad.cli.interrupt import ending_at_once
from hullquad.cli.loading import load
from hullquad.cli.output import say, say_json
from hullquad.cli.quality_figures import metric_figures, rules_figures
from hullquad.cli.quality_text import quality_text
from hullquad.cli.report import mesh_figures
from hullquad.formats import atomic, read_mesh
from hullquad.given import given
from hullquad.mesh import Mesh
from hullquad.metrics import METRICS
from hullquad.metrics.row import MILLIMETRES
from hullquad.metrics.table import TABLE_1
from hullquad.pipeline import prepare_judging
from hullquad.quality import quality
from hullquad.rules import Level, RuleSet, assess, rule_set

_THRESHOLDS = {"warn": Level.WARN, "error": Level.ERROR}


@attrs.frozen(eq=False)
class _Verdict:
    """What is said of every element."""

    levels: Bytes
    """(E,) values of `Level`."""
    given: Bools
    """(E,) which cannot be taken below their level by moving nodes."""


def judge_mesh(options: Namespace) -> int:
    """Judge a mesh; the exit code."""
    rules = None if options.rules is None else rule_set(options.rules)
    mesh = read_mesh(options.input)
    clock = Clock("import", "prepare", "judge")
    load(clock, prepare_judging)
    with clock.running("judge"):
        mesh = attrs.evolve(mesh, reference_areas=mesh.areas)  # worked out once, not for each metric
        verdict, figures = _by_metrics(mesh)
        if rules is not None:
            verdict, figures["rules"] = _by_rules(mesh, rules)
        figures |= {"elements": _counts(verdict.levels), "given": int(verdict.given.sum())}
    if options.csv:
        _write_table(mesh, verdict, options.csv, clock, with_verdict=rules is not None)
    if options.json:
        say_json({**figures, "seconds": clock.taken()})
    elif options.csv != "-":
        say(quality_text(figures))
    threshold = _THRESHOLDS.get(options.fail_on)
    return DONE if threshold is None or verdict.levels.max() < threshold else VIOLATED


def _by_metrics(mesh: Mesh) -> tuple[_Verdict, dict[str, Any]]:
    """What the metrics say, one after the other, so that the values of one are held at a time.

    What a metric of Table 1 does not accept is an error, what another one does not accept a warning; how large
    elements should be is for rules to say.
    """
    broken, stuck = np.zeros((2, len(Level), len(mesh.topology.elements)), dtype=bool)
    figures: dict[str, Any] = {}
    for row in METRICS:
        judged = quality(mesh, row)
        is_given = given(mesh, judged)
        figures[row.key] = metric_figures(mesh, judged, is_given)
        level = Level.ERROR if row.group == TABLE_1 else Level.OK if row.unit == MILLIMETRES else Level.WARN
        broken[level] |= judged.failing
        stuck[level] |= is_given
    levels = np.where(broken[Level.ERROR], Level.ERROR, np.where(broken[Level.WARN], Level.WARN, Level.OK))
    at_level = np.where(broken[Level.ERROR], stuck[Level.ERROR], stuck[Level.WARN])
    return _Verdict(small_ints(levels), at_level), {**mesh_figures(mesh, judged), "metrics": figures, "rules": None}


def _by_rules(mesh: Mesh, rules: RuleSet) -> tuple[_Verdict, dict[str, Any]]:
    """What a rule set says."""
    found = assess(mesh, rules)
    return _Verdict(found.levels, found.given), rules_figures(mesh, found)


def _counts(levels: Bytes) -> dict[str, int]:
    return {level.name.lower(): int(np.count_nonzero(levels == level)) for level in Level}


def _write_table(mesh: Mesh, verdict: _Verdict, name: str, clock: Clock, *, with_verdict: bool) -> None:
    """Write the CSV to a file or to standard output, a block of elements at a time."""
    from hullquad.cli import element_table  # noqa: PLC0415  brings Numba

    with ending_at_once(), clock.running("prepare"):
        element_table.prepare()
    table = element_table.ElementTable(mesh, verdict.given, verdict.levels if with_verdict else None)
    if name == "-":
        sys.stdout.writelines(block.decode() for block in table.lines())
    else:
        atomic.write(Path(name), table.lines())
