"""The panels: each is loaded and made when it is needed, and connected with all that it asks for."""

from collections.abc import Callable
from functools import partial
from typing import TYPE_CHECKING

import attrs
from PySide6.QtWidgets import QAbstractSpinBox, QWidget

from hullquad_app.canvas import Canvas
from hullquad_app.session import Session

if TYPE_CHECKING:
    from hullquad.plate import Notice
    from hullquad_app.panels.element import ElementPanel
    from hullquad_app.panels.meshing import MeshingPanel
    from hullquad_app.panels.objective import ObjectivePanel
    from hullquad_app.panels.outcome import OutcomePanel
    from hullquad_app.panels.plates import PlatesPanel
    from hullquad_app.panels.quality import QualityPanel
    from hullquad_app.panels.rules import RulesPanel
    from hullquad_app.panels.search import SearchPanel
    from hullquad_app.panels.worst import WorstPanel


@attrs.frozen(eq=False)
class House:
    """What the panels of a window belong to."""

    session: Session
    canvas: Canvas
    choose_rules: Callable[[], object]
    """Asks for a file of rules."""
    show_place: Callable[["Notice"], object]
    """Shows on the plate what a notice is about."""


def quality(house: House) -> "QualityPanel":
    """Quality distribution."""
    from hullquad_app.panels.quality import QualityPanel  # noqa: PLC0415  so it is with all of them

    panel, judging = QualityPanel(), house.session.judging
    panel.limit_dragged.connect(judging.set_limit)
    panel.limit_released.connect(judging.set_limit)
    panel.limit_reset.connect(judging.reset_limit)
    panel.selected.connect(partial(_select, house.session))
    return panel


def objective(house: House) -> "ObjectivePanel":
    """Objective history."""
    from hullquad_app.panels.objective import ObjectivePanel  # noqa: PLC0415

    panel = ObjectivePanel()
    panel.position_chosen.connect(house.session.scrub)
    return panel


def outcome(_: House) -> "OutcomePanel":
    """What a run has brought."""
    from hullquad_app.panels.outcome import OutcomePanel  # noqa: PLC0415

    return OutcomePanel()


def element(house: House) -> "ElementPanel":
    """The element inspector."""
    from hullquad_app.panels.element import ElementPanel  # noqa: PLC0415

    panel = ElementPanel()
    panel.metric_wanted.connect(house.session.choose_metric)
    return panel


def search(house: House) -> "SearchPanel":
    """The optimiser and its options."""
    from hullquad_app.panels.search import SearchPanel  # noqa: PLC0415

    panel, session, settings = SearchPanel(), house.session, house.session.settings
    panel.changed.connect(session.set_paper)
    panel.search_changed.connect(session.set_search)
    panel.objective_chosen.connect(session.choose_objective)
    panel.options.rules.picked.connect(session.judging.judge_by)
    panel.options.rules.file_wanted.connect(house.choose_rules)
    panel.options.rules.offer(lambda: settings.rule_files)
    panel.show_settings(settings.paper, settings.objective, settings.search)
    _leave_numbers(panel, house.canvas)
    return panel


def worst(house: House) -> "WorstPanel":
    """Worst elements."""
    from hullquad_app.panels.worst import WorstPanel  # noqa: PLC0415

    panel, canvas = WorstPanel(), house.canvas
    panel.selected.connect(partial(_select, house.session))
    panel.selected.connect(lambda rows, _: canvas.reveal(rows))
    panel.zoom_wanted.connect(lambda row: canvas.zoom_to({row}))
    return panel


def rules(house: House) -> "RulesPanel":
    """What the chosen rule set says."""
    from hullquad_app.panels.rules import RulesPanel  # noqa: PLC0415

    panel = RulesPanel()
    panel.selected.connect(partial(_select, house.session))
    panel.zoom_wanted.connect(house.canvas.zoom_to)
    return panel


def meshing(house: House) -> "MeshingPanel":
    """How a plate is meshed."""
    from hullquad_app.panels.meshing import MeshingPanel  # noqa: PLC0415

    panel, session = MeshingPanel(), house.session
    panel.size_chosen.connect(session.divide)
    panel.requested.connect(lambda size, all_plates: session.mesh(size, all_plates=all_plates))
    panel.remedy_wanted.connect(session.redivide)
    panel.mesher.changed.connect(session.set_mesher)
    panel.mesher.changed.connect(panel.ask)  # what is to come of a size depends on whether lines are followed
    panel.mesher.show_mesher(session.settings.mesher)
    panel.cancelled.connect(session.cancel)
    panel.prospect.place_wanted.connect(house.show_place)
    session.divided.connect(panel.show_division)
    session.able.connect(panel.show_abilities)
    session.busy.connect(panel.show_progress)
    session.idle.connect(panel.show_idle)
    panel.show_abilities(session.abilities)
    _leave_numbers(panel, house.canvas)
    return panel


def plates(house: House) -> "PlatesPanel":
    """The plates of the document."""
    from hullquad_app.panels.plates import PlatesPanel  # noqa: PLC0415

    panel = PlatesPanel()
    panel.chosen.connect(house.session.choose_plate)
    return panel


def _select(session: Session, rows: frozenset[int], extend: bool) -> None:
    session.select(rows, extend=extend)


def _leave_numbers(panel: QWidget, canvas: Canvas) -> None:
    """Have Enter in a box for numbers lead back to the view: letters are keys again there."""
    for box in panel.findChildren(QAbstractSpinBox):
        box.lineEdit().returnPressed.connect(canvas.setFocus)
