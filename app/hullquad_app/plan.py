"""What a run is to do, resolved from what is shown and what is set."""

from collections.abc import Generator
from math import inf
from typing import TYPE_CHECKING

import attrs

from hullquad.arrays import Bools
from hullquad.mesh import Mesh
from hullquad.optimization.iterate import Iterate
from hullquad.optimization.objective import Objective
from hullquad.optimization.selection import rings
from hullquad.optimization.settings import PaperSettings, SearchSettings
from hullquad.optimizers import Optimizer, iterates, optimizer
from hullquad_app.objectives import wanted
from hullquad_app.scene import Scene
from hullquad_app.search import Search
from hullquad_app.settings import Settings
from hullquad_app.source import Source

if TYPE_CHECKING:
    from hullquad.rules import RuleSet

PAPER = "paper"
UNTANGLE = "untangle"


@attrs.frozen(kw_only=True)
class Plan:
    """A run that was paused goes on where an equal plan is asked for; what the optimiser does not read is left out."""

    optimizer: Optimizer
    objective: Objective
    search: Search
    paper: PaperSettings | None = None
    rules: "RuleSet | None" = None
    selection: frozenset[int] | None = None
    """Rows of the elements that are optimised, with the rings around them; None: all."""

    def source(self, mesh: Mesh) -> Source:
        """The iterates of a new run from a mesh; the first one that is asked for loads what they need."""
        return Source(self._iterates(mesh), self.search.seconds or inf)

    def _iterates(self, mesh: Mesh) -> Generator[Iterate, None, None]:
        settings = SearchSettings(floor=self.search.floor, iterations=self.search.iterations, chosen=self.chosen(mesh))
        yield from iterates(self.optimizer.key, mesh, self.objective, settings, self.paper, self.rules)

    def chosen(self, mesh: Mesh) -> Bools | None:
        """(N,) nodes that may move if they are free; None: all of these."""
        return None if self.selection is None else rings(mesh, self.selection, self.search.rings)


def plan(scene: Scene, settings: Settings) -> Plan:
    """What the next run does to a scene."""
    return planned(scene, settings.search, settings.paper, settings.objective)


def planned(scene: Scene, search: Search, paper: PaperSettings, objective: str | None) -> Plan:
    """The same by other settings than those that are remembered."""
    row, view = optimizer(search.optimizer), scene.view
    is_paper, by = row.key == PAPER, wanted(view.metric, objective)
    return Plan(
        optimizer=row,
        objective=Objective(by.terms[:1]) if is_paper else by,
        search=search,
        paper=paper if is_paper else None,
        rules=view.rules if row.has_rules else None,
        selection=view.selection if search.is_local and view.selection and not is_paper else None,
    )
