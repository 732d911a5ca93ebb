"""The optimiser's parameters, in plain words, and what the optimisation has brought."""

from contextlib import ExitStack

import attrs
from PySide6.QtCore import QSignalBlocker, Signal
from PySide6.QtWidgets import (
    QCheckBox,
    QFormLayout,
    QFrame,
    QLabel,
    QPushButton,
    QSizePolicy,
    QSpinBox,
    QVBoxLayout,
    QWidget,
)

from hullquad.metrics import OBJECTIVES
from hullquad.optimization.settings import PaperSettings
from hullquad_app.colours import LIGHT, Palette
from hullquad_app.grouped_box import Choice, GroupedBox, metric_choices
from hullquad_app.metric_words import name_of
from hullquad_app.objectives import optimised_by
from hullquad_app.panels.figures import CAPTION, sized
from hullquad_app.panels.ground import coloured, dress
from hullquad_app.panels.outcome import Outcome
from hullquad_app.panels.scale_spin import ScaleSpin
from hullquad_app.scene import Scene

_MOST_ITERATIONS = 1_000_000


class SearchPanel(QWidget):
    """Says by `changed` which parameters are wanted; `show_settings` tells it those that are used."""

    changed = Signal(object)
    """Emitted with `PaperSettings`, when the user has changed them."""
    objective_chosen = Signal(object)
    """Emitted with the key of the metric to optimise by, None for the one that is shown."""

    def __init__(self) -> None:
        super().__init__()
        self._settings = PaperSettings()
        self._scene = Scene()
        self.objective = GroupedBox()
        self.objective.fill([Choice("", "", None), *metric_choices(OBJECTIVES)])
        self._name_shown()
        self.step = ScaleSpin(1e-7, 10.0)
        self.step.setSuffix(self.tr(" · h²"))
        self.length = QLabel()
        self.iterations = QSpinBox(minimum=1, maximum=_MOST_ITERATIONS)
        self.iterations.setKeyboardTracking(False)
        self.iterations.setGroupSeparatorShown(True)
        self.tolerance = ScaleSpin(1e-12, 1.0)
        self.guard = QCheckBox(self.tr("keep every element valid"))
        self.defaults = QPushButton(self.tr("Reset to defaults"))
        self.outcome = Outcome()
        self.rule = QFrame(frameShape=QFrame.Shape.HLine, frameShadow=QFrame.Shadow.Plain)
        self._explain()
        self._arrange()
        self.show_settings(PaperSettings(), None)
        self._connect()
        self.set_palette(LIGHT)

    def show_settings(self, settings: PaperSettings, objective: str | None) -> None:
        """Show the parameters and the objective that the next run uses."""
        self._settings = settings
        with ExitStack() as quiet:
            for widget in (self.objective, self.step, self.iterations, self.tolerance, self.guard):
                quiet.enter_context(QSignalBlocker(widget))
            self.objective.show_choice(objective)
            self.step.setValue(settings.step)
            self.iterations.setValue(settings.iterations)
            self.tolerance.setValue(settings.tolerance)
            self.guard.setChecked(settings.guard)
        self.defaults.setEnabled(settings != PaperSettings() or objective is not None)
        self._show_length()

    def show_scene(self, scene: Scene) -> None:
        """Show what the optimisation has brought."""
        before, self._scene = self._scene, scene
        if scene.mesh is not before.mesh:
            self._show_length()
        if scene.view.metric is not before.view.metric:
            self._name_shown()
        self.outcome.show_scene(scene)

    def set_palette(self, palette: Palette) -> None:
        """Draw in the colours of a theme."""
        dress(self, palette)
        coloured(self.length, palette.dim)
        coloured(self.rule, palette.rule)
        self.outcome.set_palette(palette)

    def _connect(self) -> None:
        self.objective.chosen.connect(self._choose_objective)
        self.step.valueChanged.connect(lambda value: self._change(attrs.evolve(self._settings, step=value)))
        self.iterations.valueChanged.connect(lambda value: self._change(attrs.evolve(self._settings, iterations=value)))
        self.tolerance.valueChanged.connect(lambda value: self._change(attrs.evolve(self._settings, tolerance=value)))
        self.guard.toggled.connect(lambda value: self._change(attrs.evolve(self._settings, guard=value)))
        self.defaults.clicked.connect(self._reset)

    def _change(self, settings: PaperSettings) -> None:
        self.show_settings(settings, self.objective.currentData())
        self.changed.emit(self._settings)

    def _choose_objective(self) -> None:
        self.show_settings(self._settings, self.objective.currentData())
        self.objective_chosen.emit(self.objective.currentData())

    def _reset(self) -> None:
        self.show_settings(PaperSettings(), None)
        self.objective_chosen.emit(None)
        self.changed.emit(self._settings)

    def _name_shown(self) -> None:
        """Say what the first row of the objectives means: not every metric that can be shown has a sum."""
        shown = self._scene.view.metric
        used = optimised_by(shown)
        text = self.tr("the metric that is shown")
        if used is not shown:
            text = self.tr("{used}: {shown} has no sum").format(used=name_of(used), shown=name_of(shown))
        self.objective.setItemText(0, text)

    def _show_length(self) -> None:
        mesh = self._scene.mesh
        if mesh is None:
            self.length.setText(self.tr("h: the element size of the mesh"))
            return
        size = mesh.target_size
        text = self.tr("= {length} mm² at h = {size} mm")
        self.length.setText(text.format(length=f"{self._settings.step * size**2:.4g}", size=f"{size:.4g}"))

    def _explain(self) -> None:
        """Accessible names and tips of all controls."""
        window = self._settings.window
        texts = (
            (self.objective, self.tr("Optimise by"), self.tr("The sum of this metric over all quads is made better.")),
            (
                self.step,
                self.tr("Step length c"),
                self.tr(
                    "How far nodes go along the gradient in one iteration: c times the square of the element size h. "
                    "Smaller is slower and steadier; a larger one jumps to and fro around the optimum. "
                    "Between 0.001 and 0.003 is usual."
                ),
            ),
            (
                self.iterations,
                self.tr("Most iterations"),
                self.tr("The run ends after so many iterations; it can be run on from there."),
            ),
            (
                self.tolerance,
                self.tr("Least gain per quad"),
                self.tr(
                    "The run ends when the best sum has gained less than this per quad over the last "
                    "{window} iterations, in the unit of the metric."
                ).format(window=window),
            ),
            (
                self.guard,
                self.tr("Guard: keep every element valid"),
                self.tr(
                    "Nodes of an element that a step would fold or turn over stay where they are in that step. "
                    "Without it the run is the paper's to the letter and may fold elements, which most metrics "
                    "do not notice; such elements are counted as inverted, and drawn in magenta."
                ),
            ),
            (self.defaults, self.tr("Reset the parameters to their defaults"), ""),
        )
        for widget, name, tip in texts:
            widget.setAccessibleName(name)
            widget.setAccessibleDescription(tip)
            widget.setToolTip(tip)

    def _arrange(self) -> None:
        self.length.setFont(sized(self.font(), CAPTION))
        self.length.setSizePolicy(QSizePolicy.Policy.Ignored, QSizePolicy.Policy.Preferred)
        form = QFormLayout()
        form.setFieldGrowthPolicy(QFormLayout.FieldGrowthPolicy.AllNonFixedFieldsGrow)
        form.addRow(self.tr("&Optimise by"), self.objective)
        form.addRow(self.tr("Step &length c"), self.step)
        form.addRow("", self.length)
        form.addRow(self.tr("Most &iterations"), self.iterations)
        form.addRow(self.tr("Least &gain per quad"), self.tolerance)
        form.addRow(self.tr("Guard"), self.guard)
        form.addRow("", self.defaults)
        column = QVBoxLayout(self)
        column.addWidget(self.outcome)
        column.addWidget(self.rule)
        column.addLayout(form)
        column.addStretch()
