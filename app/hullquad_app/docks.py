"""The panels round the view, each in a dock that can float, be tabbed and come back."""

from collections.abc import Callable
from functools import partial
from typing import TYPE_CHECKING, Any

from PySide6.QtCore import QObject, Qt, Signal
from PySide6.QtGui import QAction
from PySide6.QtWidgets import QMainWindow

from hullquad_app import panel_makers
from hullquad_app.canvas import Canvas
from hullquad_app.colours import ColourMap, Palette
from hullquad_app.panel_dock import PanelDock, Shown
from hullquad_app.panel_makers import House
from hullquad_app.scene import Scene
from hullquad_app.session import Session

if TYPE_CHECKING:
    from hullquad_app.panels.element import ElementPanel
    from hullquad_app.panels.meshing import MeshingPanel
    from hullquad_app.panels.objective import ObjectivePanel
    from hullquad_app.panels.outcome import OutcomePanel
    from hullquad_app.panels.plates import PlatesPanel
    from hullquad_app.panels.quality import QualityPanel
    from hullquad_app.panels.rules import RulesPanel
    from hullquad_app.panels.search import SearchPanel
    from hullquad_app.panels.worst import WorstPanel

_WIDTH = 66
"""Of the column of panels, in letters."""
_MOST = 0.45
"""Of the window's width, for that column."""
_HEIGHTS = {"quality": 36, "objective": 25, "worst": 39}
"""Shares of the column."""
_WHEN_MESHING = {"quality": 24, "objective": 18, "meshing": 58}
_WHEN_INSPECTING = {"quality": 30, "element": 42, "worst": 28}
_WHEN_CHOOSING = {"quality": 30, "search": 42, "worst": 28}


class Docks(QObject):
    """Makes the docks of a window and arranges them in its right column."""

    rules_file_wanted = Signal()
    """Emitted when a file of rules is to be chosen."""
    place_wanted = Signal(object)
    """Emitted with a `Notice`, when its place is to be shown on the plate."""

    def __init__(self, window: QMainWindow, session: Session, canvas: Canvas) -> None:
        super().__init__(window)
        self._window, made = window, panel_makers
        self._house = House(session, canvas, self.rules_file_wanted.emit, self.place_wanted.emit)
        self._docks: dict[str, PanelDock[Any]] = {}
        self._quality = self._dock("quality", self.tr("Quality distribution"), made.quality)
        self._objective = self._dock("objective", self.tr("Objective history"), made.objective)
        self._outcome = self._dock("outcome", self.tr("Result"), made.outcome, is_form=True)
        self._element = self._dock("element", self.tr("Element"), made.element, is_form=True)
        self._search = self._dock("search", self.tr("Optimiser"), made.search, is_form=True)
        self._worst = self._dock("worst", self.tr("Worst elements"), made.worst)
        self._rules = self._dock("rules", self.tr("Rules"), made.rules, is_form=True)
        self._meshing = self._dock("meshing", self.tr("Mesh"), made.meshing, is_form=True)
        self._plates = self._dock("plates", self.tr("Plates"), made.plates)
        self._shown, self._has_room = Scene(), False
        self._element.visibilityChanged.connect(canvas.inspect)
        canvas.opened.connect(self.inspect)
        session.optimizer.run_began.connect(partial(self._exchange, self._outcome, self._objective))
        session.optimizer.run_ended.connect(partial(self._exchange, self._objective, self._outcome))

    @property
    def quality(self) -> "QualityPanel":
        """Quality distribution."""
        return self._quality.panel

    @property
    def objective(self) -> "ObjectivePanel":
        """Objective history."""
        return self._objective.panel

    @property
    def outcome(self) -> "OutcomePanel":
        """What a run has brought."""
        return self._outcome.panel

    @property
    def element(self) -> "ElementPanel":
        """The element inspector."""
        return self._element.panel

    @property
    def search(self) -> "SearchPanel":
        """The optimiser and its options."""
        return self._search.panel

    @property
    def worst(self) -> "WorstPanel":
        """Worst elements."""
        return self._worst.panel

    @property
    def rules(self) -> "RulesPanel":
        """What the chosen rule set says."""
        return self._rules.panel

    @property
    def meshing(self) -> "MeshingPanel":
        """How a plate is meshed."""
        return self._meshing.panel

    @property
    def plates(self) -> "PlatesPanel":
        """The plates of the document."""
        return self._plates.panel

    @property
    def watched(self) -> tuple[PanelDock[Any], ...]:
        """Docks that follow every frame of a run."""
        return (self._quality,)

    @property
    def read(self) -> tuple[tuple[PanelDock[Any], ...], ...]:
        """Groups of docks that follow a few times a second; of each one is seen, unless somebody has moved them."""
        return (
            (self._objective, self._outcome, self._search, self._element),
            (self._worst, self._rules, self._meshing, self._plates),
        )

    def arrange(self) -> None:
        """Put every dock where it is at first."""
        column = Qt.DockWidgetArea.RightDockWidgetArea
        for dock in (self._quality, self._objective, self._worst):
            self._window.addDockWidget(column, dock)
        for front, *behind in self.read:
            for dock in behind:
                self._window.tabifyDockWidget(front, dock)
            front.raise_()

    def set_width(self) -> None:
        """Give the column of docks its width and its parts their heights; Qt does so only when it is shown."""
        letters = self._window.fontMetrics().averageCharWidth() * _WIDTH
        width = min(letters, round(_MOST * self._window.width()))
        self._window.resizeDocks([self._quality], [width], Qt.Orientation.Horizontal)
        self._share(_HEIGHTS)

    def show_scene(self, scene: Scene) -> None:
        """Show a scene on every panel, and bring up the one that is of use with it."""
        before, self._shown = self._shown, scene
        for dock in self._docks.values():
            dock.show_scene(scene)
        if scene.state.plates is not None and scene.state.plates is not before.state.plates:
            self._meshing.wake()  # has the contours divided, whose nodes the view draws
        if scene.view.rules is not before.view.rules:
            (self._worst if scene.view.rules is None else self._rules).raise_()
        if scene.state.keys != before.state.keys:
            self._plates.setVisible(len(scene.state.keys) > 1)
        if (scene.mesh is None) != (before.mesh is None) or _source(scene) != _source(before):
            is_to_mesh = scene.mesh is None and scene.plate is not None
            (self._meshing if is_to_mesh else self._worst).raise_()
            self._objective.raise_()
            self._make_room(is_to_mesh=is_to_mesh)

    def set_palette(self, palette: Palette, chosen: ColourMap) -> None:
        """Take the colours of a theme, and the map by which elements are coloured."""
        for dock in self._docks.values():
            dock.set_palette(palette, chosen)

    def toggles(self) -> list[QAction]:
        """Actions that show and hide the docks."""
        return [dock.toggleViewAction() for dock in self._docks.values()]

    def mesh_plate(self) -> None:
        """Mesh the plate that is shown, as the panel says."""
        self.meshing.one.click()

    def mesh_all_plates(self) -> None:
        """Mesh every plate of the document, as the panel says."""
        self.meshing.all_plates.click()

    def make_even(self) -> None:
        """Make all contours of the document even, at the size that the panel says."""
        self.meshing.prospect.evening_wanted.emit()

    def next_worst(self) -> None:
        """Select the element after the selected one, or the worst."""
        self.worst.next()

    def previous_worst(self) -> None:
        """Select the element before the selected one."""
        self.worst.previous()

    def inspect(self) -> None:
        """Bring up the element inspector, with room for its table."""
        if not self._element.is_in_front:
            self._bring_up(self._element, _WHEN_INSPECTING)

    def toggle_inspector(self) -> None:
        """Bring up the element inspector, or the objective history in its place."""
        if self._element.is_in_front:
            self._bring_up(self._objective, _HEIGHTS)
        else:
            self.inspect()

    def toggle_search(self) -> None:
        """Bring up the optimiser's options, with room for them, or the objective history in their place."""
        if self._search.is_in_front:
            self._bring_up(self._objective, _HEIGHTS)
        else:
            self._bring_up(self._search, _WHEN_CHOOSING)
            self.search.optimizer.setFocus()

    def _bring_up(self, dock: PanelDock[Any], heights: dict[str, int]) -> None:
        dock.show()
        dock.raise_()
        self._share(heights)

    def _exchange(self, seen: PanelDock[Any], wanted: PanelDock[Any]) -> None:
        """Bring another dock up in the place of one that is in front: the run to watch, or what came of it."""
        if seen.is_in_front:
            wanted.raise_()

    def _make_room(self, *, is_to_mesh: bool) -> None:
        """Give the form that meshes the room of the charts that are empty then, and take it back."""
        if is_to_mesh != self._has_room:
            self._has_room = is_to_mesh
            self._share(_WHEN_MESHING if is_to_mesh else _HEIGHTS)

    def _share(self, heights: dict[str, int]) -> None:
        docks = [self._docks[name] for name in heights]
        self._window.resizeDocks(docks, list(heights.values()), Qt.Orientation.Vertical)

    def _dock(
        self, name: str, title: str, make: Callable[[House], Shown], *, is_form: bool = False
    ) -> PanelDock[Shown]:
        dock = PanelDock(name, title, partial(make, self._house), is_form=is_form)
        self._docks[name] = dock
        return dock


def _source(scene: Scene) -> tuple[object, ...]:
    """What a scene was opened from."""
    return scene.state.path, scene.state.title
