"""The table of optimisers: every way of moving nodes, by the key that command line, window and scripts use."""

from collections.abc import Iterator
from typing import TYPE_CHECKING

import attrs

from hullquad.errors import HullquadError
from hullquad.mesh import Mesh
from hullquad.optimization.iterate import Iterate
from hullquad.optimization.objective import Objective
from hullquad.optimization.settings import FINE, PaperSettings, SearchSettings

if TYPE_CHECKING:
    from hullquad.rules import RuleSet


@attrs.frozen
class Optimizer:
    """One row of the table."""

    key: str
    title: str
    words: str
    """What it does, for people."""
    has_floor: bool = False
    """Whether `SearchSettings.floor` counts."""
    has_rules: bool = False
    """Whether it needs a rule set."""


OPTIMIZERS = (
    Optimizer(
        "default",
        "Best sum",
        "Brings the sum of the metric to its optimum, and pushes no element below the floor for it.",
        has_floor=True,
    ),
    Optimizer(
        "fine",
        "Best sum, to the last digit",
        "The same with more and finer stages: a little better, several times as long.",
        has_floor=True,
    ),
    Optimizer(
        "worst",
        "Best worst element",
        "Raises the worst element as far as it goes, then the sum without lowering it again.",
    ),
    Optimizer(
        "worst_quad",
        "Best worst quad",
        "The same for quads alone, where a triangle that is left over would be the worst; the floor holds triangles.",
        has_floor=True,
    ),
    Optimizer(
        "rules",
        "Fewest violations",
        "Brings as many elements as possible within a rule set, then makes the sum better.",
        has_floor=True,
        has_rules=True,
    ),
    Optimizer(
        "untangle",
        "Open folded elements",
        "Turns elements that are inside out the right way, and evens the mesh out.",
    ),
    Optimizer(
        "paper",
        "The paper's method",
        "Kniat's steps along the numerical gradient of the sum.",
    ),
)

_BY_KEY = {row.key: row for row in OPTIMIZERS}


def optimizer(key: str) -> Optimizer:
    """The table's row with that key; an error that names the known ones where there is none."""
    try:
        return _BY_KEY[key]
    except KeyError:
        raise HullquadError("E_OPTIMIZER", key, known=", ".join(_BY_KEY)) from None


def iterates(
    key: str,
    mesh: Mesh,
    objective: Objective,
    search: SearchSettings | None = None,
    paper: PaperSettings | None = None,
    rule_set: "RuleSet | None" = None,
) -> Iterator[Iterate]:
    """Iterates of an optimiser, the given mesh first; see the modes themselves.

    Raises
    ------
    HullquadError
        E_OPTIMIZER: there is none of that key, or it needs a rule set. E_CURVED: the paper's method on a mesh that
        lies on no known surface.
    """
    from hullquad.optimization import modes  # noqa: PLC0415  all of these bring Numba: half a second
    from hullquad.optimization.paper import paper_iterates  # noqa: PLC0415
    from hullquad.rules.chase import rules_iterates  # noqa: PLC0415

    chosen, search = optimizer(key), search or SearchSettings()
    if chosen.key == "paper":
        return paper_iterates(mesh, objective.metric, paper)
    if chosen.key == "untangle":
        return modes.untangle_iterates(mesh, objective, search)
    if chosen.key in {"worst", "worst_quad"}:
        return modes.worst_iterates(mesh, objective, attrs.evolve(search, is_for_quads=chosen.key == "worst_quad"))
    if chosen.has_rules:
        if rule_set is None:
            raise HullquadError("E_OPTIMIZER", key, "rules")
        return rules_iterates(mesh, objective, rule_set, search)
    if chosen.key == "fine":
        search = attrs.evolve(search, schedule=FINE)
    return modes.default_iterates(mesh, objective, search)
