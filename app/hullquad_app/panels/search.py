"""Which optimiser moves the nodes, by what, and its own options, in plain words."""

import attrs
from PySide6.QtCore import QSignalBlocker, Signal
from PySide6.QtWidgets import QComboBox, QFormLayout, QLabel, QPushButton, QSizePolicy, QVBoxLayout, QWidget

from hullquad.metrics import OBJECTIVES
from hullquad.optimization.objective import Term
from hullquad.optimization.settings import PaperSettings
from hullquad.optimizers import OPTIMIZERS, optimizer
from hullquad_app.colours import COLOUR_MAPS, LIGHT, ColourMap, Palette
from hullquad_app.grouped_box import Choice, GroupedBox, metric_choices, narrow
from hullquad_app.metric_words import name_of
from hullquad_app.objectives import optimised_by, wanted, written
from hullquad_app.panels.explained import explain
from hullquad_app.panels.figures import CAPTION, sized
from hullquad_app.panels.ground import coloured, dress
from hullquad_app.panels.local_options import LocalOptions
from hullquad_app.panels.mode_options import ModeOptions
from hullquad_app.panels.paper_options import PaperOptions
from hullquad_app.panels.weights import Weights
from hullquad_app.plan import PAPER, UNTANGLE
from hullquad_app.scene import Scene
from hullquad_app.search import Search

SEVERAL = ","
"""Data of the row that is no metric: part of every objective of several."""
_LETTERS = 8


class SearchPanel(QWidget):
    """Says by signals what is wanted; `show_settings` tells it what is used."""

    changed = Signal(object)
    """Emitted with `PaperSettings`, when the user has changed them."""
    search_changed = Signal(object)
    """Emitted with a `Search`, when the user has changed it."""
    objective_chosen = Signal(object)
    """Emitted with what to optimise by, ``KEY[=WEIGHT][,KEY…]``; None for the metric that is shown."""

    def __init__(self) -> None:
        super().__init__()
        self._paper, self._search, self._scene = PaperSettings(), Search(), Scene()
        self._objective: str | None = None
        self.optimizer, self.words = QComboBox(), QLabel()
        narrow(self.optimizer)
        for row in OPTIMIZERS:
            self.optimizer.addItem(row.title, row.key)
        self.objective, self.weights = GroupedBox(_LETTERS), Weights()
        several = Choice(self.tr("Several"), self.tr("several metrics, weighted"), SEVERAL)
        self.objective.fill([Choice("", "", None), *metric_choices(OBJECTIVES), several])
        self._name_shown()
        self.options, self.local, self.paper = ModeOptions(self), LocalOptions(), PaperOptions(self)
        self.defaults = QPushButton(self.tr("Reset to defaults"))
        self._form = QFormLayout()
        self._explain()
        self._arrange()
        self.show_settings(PaperSettings(), None, Search())
        self._connect()
        self.set_palette(LIGHT)

    def show_settings(self, paper: PaperSettings, objective: str | None, search: Search) -> None:
        """Show the optimiser, the objective and the options that the next run uses."""
        self._paper, self._objective, self._search = paper, objective, search
        row = optimizer(search.optimizer)
        with QSignalBlocker(self.optimizer):
            self.optimizer.setCurrentIndex(OPTIMIZERS.index(row))
        self.words.setText(row.words)
        terms = wanted(self._scene.view.metric, objective).terms if self._is_weighted else ()
        single = terms[0].metric.key if terms else objective  # the paper's method knows one metric only
        self.objective.show_choice(SEVERAL if terms and row.key != PAPER else single)
        self.weights.show_terms(terms)
        self.options.show_search(search)
        self.local.show_search(search)
        self.paper.show_settings(paper)
        self.defaults.setEnabled((paper, objective, search) != self._usual())
        self._show_rows()

    def show_scene(self, scene: Scene) -> None:
        """Show what the settings come to on what is shown."""
        before, self._scene = self._scene, scene
        if scene.mesh is not before.mesh:
            self.paper.show_mesh(scene.mesh)
        if scene.view.metric is not before.view.metric:
            self._name_shown()
        self.options.rules.show_scene(scene)
        self.local.show_scene(scene)

    def set_palette(self, palette: Palette, _: ColourMap = COLOUR_MAPS[0]) -> None:
        """Draw in the colours of a theme."""
        dress(self, palette)
        coloured(self.words, palette.dim)
        self.paper.set_palette(palette)
        self.local.set_palette(palette)

    @property
    def _is_weighted(self) -> bool:
        return self._objective is not None and not self._objective.isidentifier()

    def _usual(self) -> tuple[PaperSettings, str | None, Search]:
        """The defaults of everything but the optimiser."""
        return PaperSettings(), None, Search(optimizer=self._search.optimizer)

    def _show_rows(self) -> None:
        """Show what the chosen optimiser has, and hide the rest."""
        row = optimizer(self._search.optimizer)
        is_paper = row.key == PAPER
        shown = {*self.options.of(row), *((widget for _, widget in self.paper.rows()) if is_paper else (self.local,))}
        if row.key != UNTANGLE:
            shown |= {self.objective, self.weights} if self._is_weighted and not is_paper else {self.objective}
        for widget in (self.objective, self.weights, self.local, *self._optional()):
            self._form.setRowVisible(widget, widget in shown)

    def _optional(self) -> list[QWidget]:
        return [widget for _, widget in (*self.options.rows(), *self.paper.rows())]

    def _connect(self) -> None:
        self.optimizer.activated.connect(
            lambda row: self._want(search=attrs.evolve(self._search, optimizer=OPTIMIZERS[row].key))
        )
        self.objective.chosen.connect(self._choose_objective)
        self.weights.changed.connect(lambda terms: self._want_objective(written(terms)))
        for part in (self.options, self.local):
            part.changed.connect(lambda search: self._want(search=search))
        self.paper.changed.connect(lambda paper: self._want(paper=paper))
        self.defaults.clicked.connect(self._reset)

    def _want(self, *, paper: PaperSettings | None = None, search: Search | None = None) -> None:
        self.show_settings(paper or self._paper, self._objective, search or self._search)
        if paper is not None:
            self.changed.emit(paper)
        if search is not None:
            self.search_changed.emit(search)

    def _want_objective(self, objective: str | None) -> None:
        self.show_settings(self._paper, objective, self._search)
        self.objective_chosen.emit(objective)

    def _choose_objective(self, data: str | None) -> None:
        if data != SEVERAL:
            self._want_objective(data)
            return
        first = wanted(self._scene.view.metric, self._objective).terms
        others = (row for row in OBJECTIVES if row is not first[0].metric)
        self._want_objective(written((*first[:1], Term(next(others))) if len(first) == 1 else first))

    def _reset(self) -> None:
        paper, objective, search = self._usual()
        self._want(paper=paper, search=search)
        self._want_objective(objective)

    def _name_shown(self) -> None:
        """Say what the first row of the objectives means: not every metric that can be shown has a sum."""
        shown = self._scene.view.metric
        used = optimised_by(shown)
        text = self.tr("the metric that is shown")
        if used is not shown:
            text = self.tr("{used}: {shown} has no sum").format(used=name_of(used), shown=name_of(shown))
        self.objective.setItemText(0, text)

    def _explain(self) -> None:
        explain(self.optimizer, self.tr("Optimiser"), self.tr("How the nodes are moved by Step and Run"))
        explain(
            self.objective,
            self.tr("Optimise by"),
            self.tr("The sum of this metric over all quads is made better; the worst element is judged by it."),
        )
        explain(self.defaults, self.tr("Reset the options to their defaults"))

    def _arrange(self) -> None:
        self.words.setFont(sized(self.font(), CAPTION))
        self.words.setWordWrap(True)
        self.words.setSizePolicy(QSizePolicy.Policy.Ignored, QSizePolicy.Policy.Preferred)
        self._form.setFieldGrowthPolicy(QFormLayout.FieldGrowthPolicy.AllNonFixedFieldsGrow)
        self._form.addRow(self.tr("Optimi&ser"), self.optimizer)
        self._form.addRow(self.words)
        self._form.addRow(self.tr("Optimise &by"), self.objective)
        self._form.addRow(self.weights)
        for title, widget in (*self.options.rows(), (self.tr("Selection"), self.local), *self.paper.rows()):
            self._form.addRow(title, widget)
        self._form.addRow("", self.defaults)
        column = QVBoxLayout(self)
        column.addLayout(self._form)
        column.addStretch()
