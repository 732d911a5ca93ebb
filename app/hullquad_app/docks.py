"""The panels round the view, each in a dock that can float, be tabbed and come back."""

from PySide6.QtCore import QObject, Qt
from PySide6.QtGui import QAction
from PySide6.QtWidgets import QAbstractSpinBox, QDockWidget, QMainWindow, QScrollArea, QWidget

from hullquad_app.canvas import Canvas
from hullquad_app.colours import ColourMap, Palette
from hullquad_app.panels.element import ElementPanel
from hullquad_app.panels.meshing import MeshingPanel
from hullquad_app.panels.objective import ObjectivePanel
from hullquad_app.panels.outcome import OutcomePanel
from hullquad_app.panels.plates import PlatesPanel
from hullquad_app.panels.quality import QualityPanel
from hullquad_app.panels.rules import RulesPanel
from hullquad_app.panels.search import SearchPanel
from hullquad_app.panels.worst import WorstPanel
from hullquad_app.scene import Scene
from hullquad_app.session import Session

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
    """Makes the panels of a window and arranges them in its right column."""

    def __init__(self, window: QMainWindow) -> None:
        super().__init__(window)
        self._window = window
        self.quality, self.objective, self.worst = QualityPanel(), ObjectivePanel(), WorstPanel()
        self.meshing, self.search, self.plates = MeshingPanel(), SearchPanel(), PlatesPanel()
        self.rules, self.element, self.outcome = RulesPanel(), ElementPanel(), OutcomePanel()
        self._panels = (
            self.quality,
            self.objective,
            self.outcome,
            self.element,
            self.worst,
            self.rules,
            self.meshing,
            self.search,
            self.plates,
        )
        self._docks = {
            name: self._dock(name, title, panel)
            for name, title, panel in (
                ("quality", self.tr("Quality distribution"), self.quality),
                ("objective", self.tr("Objective history"), self.objective),
                ("outcome", self.tr("Result"), self.outcome),
                ("element", self.tr("Element"), self.element),
                ("search", self.tr("Optimiser"), self.search),
                ("worst", self.tr("Worst elements"), self.worst),
                ("rules", self.tr("Rules"), self.rules),
                ("meshing", self.tr("Mesh"), self.meshing),
                ("plates", self.tr("Plates"), self.plates),
            )
        }
        self._shown, self._has_room = Scene(), False

    def arrange(self) -> None:
        """Put every panel where it is at first."""
        column = Qt.DockWidgetArea.RightDockWidgetArea
        for name in ("quality", "objective", "worst"):
            self._window.addDockWidget(column, self._docks[name])
        for name, neighbour in (
            ("outcome", "objective"),
            ("search", "objective"),
            ("element", "objective"),
            ("rules", "worst"),
            ("meshing", "worst"),
            ("plates", "worst"),
        ):
            self._window.tabifyDockWidget(self._docks[neighbour], self._docks[name])
        for name in ("objective", "worst"):
            self._docks[name].raise_()

    def set_width(self) -> None:
        """Give the column of panels its width and its parts their heights; Qt does so only when it is shown."""
        letters = self._window.fontMetrics().averageCharWidth() * _WIDTH
        width = min(letters, round(_MOST * self._window.width()))
        self._window.resizeDocks([self._docks["quality"]], [width], Qt.Orientation.Horizontal)
        self._share(_HEIGHTS)

    def show_scene(self, scene: Scene) -> None:
        """Show a scene on every panel, and bring up the one that is of use with it."""
        before, self._shown = self._shown, scene
        for panel in self._panels:
            panel.show_scene(scene)
        if scene.view.rules is not before.view.rules:
            self._docks["worst" if scene.view.rules is None else "rules"].raise_()
        if scene.state.keys != before.state.keys:
            self._docks["plates"].setVisible(len(scene.state.keys) > 1)
        if (scene.mesh is None) != (before.mesh is None) or _source(scene) != _source(before):
            is_to_mesh = scene.mesh is None and scene.plate is not None
            self._docks["meshing" if is_to_mesh else "worst"].raise_()
            self._docks["objective"].raise_()
            self._make_room(is_to_mesh=is_to_mesh)

    def _make_room(self, *, is_to_mesh: bool) -> None:
        """Give the form that meshes the room of the charts that are empty then, and take it back."""
        if is_to_mesh != self._has_room:
            self._has_room = is_to_mesh
            self._share(_WHEN_MESHING if is_to_mesh else _HEIGHTS)

    def set_palette(self, palette: Palette, chosen: ColourMap) -> None:
        """Take the colours of a theme, and the map by which elements are coloured."""
        for panel in (self.quality, self.objective, self.element, self.worst, self.rules, self.plates):
            panel.set_palette(palette, chosen)
        for form in (self.meshing, self.search, self.outcome):
            form.set_palette(palette)

    def inspect(self) -> None:
        """Bring up the element inspector, with room for its table."""
        if not self._is_inspecting:
            self._docks["element"].show()
            self._docks["element"].raise_()
            self._share(_WHEN_INSPECTING)

    def toggle_inspector(self) -> None:
        """Bring up the element inspector, or the objective history in its place."""
        if self._is_inspecting:
            self._docks["objective"].raise_()
            self._share(_HEIGHTS)
        else:
            self.inspect()

    def toggle_search(self) -> None:
        """Bring up the optimiser's options, with room for them, or the objective history in their place."""
        if _is_in_front(self.search):
            self._docks["objective"].raise_()
            self._share(_HEIGHTS)
            return
        self._docks["search"].show()
        self._docks["search"].raise_()
        self._share(_WHEN_CHOOSING)
        self.search.optimizer.setFocus()

    @property
    def _is_inspecting(self) -> bool:
        return _is_in_front(self.element)

    def _share(self, heights: dict[str, int]) -> None:
        docks = [self._docks[name] for name in heights]
        self._window.resizeDocks(docks, list(heights.values()), Qt.Orientation.Vertical)

    def connect_to(self, session: Session, canvas: Canvas) -> None:
        """Pass on what the user wants in the panels."""
        self.quality.limit_dragged.connect(session.judging.set_limit)
        self.quality.limit_released.connect(session.judging.set_limit)
        self.quality.limit_reset.connect(session.judging.reset_limit)
        for panel in (self.quality, self.worst, self.rules):
            panel.selected.connect(lambda rows, extend: session.select(rows, extend=extend))
        self.rules.zoom_wanted.connect(canvas.zoom_to)
        self.element.metric_wanted.connect(session.choose_metric)
        self._docks["element"].visibilityChanged.connect(canvas.inspect)
        canvas.opened.connect(self.inspect)
        self.worst.selected.connect(lambda rows, _: canvas.reveal(rows))
        self.worst.zoom_wanted.connect(lambda row: canvas.zoom_to({row}))
        self.objective.position_chosen.connect(session.scrub)
        self.plates.chosen.connect(session.choose_plate)
        self._connect_search(session)
        self._connect_meshing(session)

    def _connect_search(self, session: Session) -> None:
        self.search.changed.connect(session.set_paper)
        self.search.search_changed.connect(session.set_search)
        self.search.objective_chosen.connect(session.choose_objective)
        self.search.options.rules.picked.connect(session.judging.judge_by)
        self.search.options.rules.offer(lambda: session.settings.rule_files)
        settings = session.settings
        self.search.show_settings(settings.paper, settings.objective, settings.search)
        session.optimizer.run_began.connect(lambda: self._exchange(self.outcome, "objective"))
        session.optimizer.run_ended.connect(lambda: self._exchange(self.objective, "outcome"))

    def _exchange(self, shown: QWidget, name: str) -> None:
        """Bring another panel up in the place of one that is in front: the run to watch, or what came of it."""
        if _is_in_front(shown):
            self._docks[name].raise_()

    def _connect_meshing(self, session: Session) -> None:
        self.meshing.size_chosen.connect(session.divide)
        self.meshing.requested.connect(lambda size, all_plates: session.mesh(size, all_plates=all_plates))
        self.meshing.remedy_wanted.connect(session.redivide)
        self.meshing.mesher.changed.connect(session.set_mesher)
        self.meshing.mesher.show_mesher(session.settings.mesher)
        self.meshing.cancelled.connect(session.cancel)
        session.divided.connect(self.meshing.show_division)
        session.able.connect(self.meshing.show_abilities)
        session.busy.connect(self.meshing.show_progress)
        session.idle.connect(self.meshing.show_idle)

    def number_boxes(self) -> list[QAbstractSpinBox]:
        """Where numbers are typed: all keys are letters there."""
        return [box for panel in (self.meshing, self.search) for box in panel.findChildren(QAbstractSpinBox)]

    def toggles(self) -> list[QAction]:
        """Actions that show and hide the panels."""
        return [dock.toggleViewAction() for dock in self._docks.values()]

    def _dock(self, name: str, title: str, panel: QWidget) -> QDockWidget:
        dock = QDockWidget(title, self._window)
        dock.setObjectName(name)
        dock.setWidget(_scrolled(panel) if panel in (self.search, self.meshing, self.outcome) else panel)
        return dock


def _source(scene: Scene) -> tuple[object, ...]:
    """What a scene was opened from."""
    return scene.state.path, scene.state.title


def _is_in_front(panel: QWidget) -> bool:
    """Whether a panel is seen, and not only its tab."""
    return panel.isVisible() and not panel.visibleRegion().isEmpty()


def _scrolled(form: QWidget) -> QScrollArea:
    """A form that may be taller than its place."""
    area = QScrollArea()
    area.setWidget(form)
    area.setWidgetResizable(True)
    area.setFrameShape(QScrollArea.Shape.NoFrame)
    return area
