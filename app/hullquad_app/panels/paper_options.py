"""The parameters of the paper's method, in plain words."""

from contextlib import ExitStack
from typing import Any

import attrs
from PySide6.QtCore import QObject, QSignalBlocker, Signal
from PySide6.QtWidgets import QCheckBox, QLabel, QSizePolicy, QSpinBox, QWidget

from hullquad.mesh import Mesh
from hullquad.optimization.settings import PaperSettings
from hullquad_app.colours import Palette
from hullquad_app.panels.explained import explain
from hullquad_app.panels.figures import CAPTION, sized
from hullquad_app.panels.ground import coloured
from hullquad_app.panels.scale_spin import ScaleSpin
from hullquad_app.search import MOST_ITERATIONS


class PaperOptions(QObject):
    """Controls for a form; says by `changed` what is wanted, `show_settings` tells it what is used."""

    changed = Signal(object)
    """Emitted with `PaperSettings`, when the user has changed them."""

    def __init__(self, parent: QWidget) -> None:
        super().__init__(parent)
        self._settings = PaperSettings()
        self._mesh: Mesh | None = None
        self.step = ScaleSpin(1e-7, 10.0)
        self.step.setSuffix(self.tr(" · h²"))
        self.length = QLabel()
        self.length.setFont(sized(self.length.font(), CAPTION))
        self.length.setSizePolicy(QSizePolicy.Policy.Ignored, QSizePolicy.Policy.Preferred)
        self.iterations = QSpinBox(minimum=1, maximum=MOST_ITERATIONS)
        self.iterations.setKeyboardTracking(False)
        self.iterations.setGroupSeparatorShown(True)
        self.tolerance = ScaleSpin(1e-12, 1.0)
        self.guard = QCheckBox(self.tr("keep every element valid"))
        self._explain()
        self.step.valueChanged.connect(lambda value: self._change(step=value))
        self.iterations.valueChanged.connect(lambda value: self._change(iterations=value))
        self.tolerance.valueChanged.connect(lambda value: self._change(tolerance=value))
        self.guard.toggled.connect(lambda value: self._change(guard=value))

    def rows(self) -> tuple[tuple[str, QWidget], ...]:
        """Rows of a form: what is written at the left, and the control."""
        return (
            (self.tr("Step &length c"), self.step),
            ("", self.length),
            (self.tr("Most &iterations"), self.iterations),
            (self.tr("Least &gain per quad"), self.tolerance),
            (self.tr("Guard"), self.guard),
        )

    def show_settings(self, settings: PaperSettings) -> None:
        """Show the parameters that the next run uses."""
        self._settings = settings
        with ExitStack() as quiet:
            for widget in (self.step, self.iterations, self.tolerance, self.guard):
                quiet.enter_context(QSignalBlocker(widget))
            self.step.setValue(settings.step)
            self.iterations.setValue(settings.iterations)
            self.tolerance.setValue(settings.tolerance)
            self.guard.setChecked(settings.guard)
        self.show_mesh(self._mesh)

    def show_mesh(self, mesh: Mesh | None) -> None:
        """Tell how long a step is on a mesh."""
        self._mesh = mesh
        if mesh is None:
            self.length.setText(self.tr("h: the element size of the mesh"))
            return
        size = mesh.target_size
        text = self.tr("= {length} mm² at h = {size} mm")
        self.length.setText(text.format(length=f"{self._settings.step * size**2:.4g}", size=f"{size:.4g}"))

    def set_palette(self, palette: Palette) -> None:
        """Draw in the colours of a theme."""
        coloured(self.length, palette.dim)

    def _change(self, **changes: Any) -> None:
        self.show_settings(attrs.evolve(self._settings, **changes))
        self.changed.emit(self._settings)

    def _explain(self) -> None:
        explain(
            self.step,
            self.tr("Step length c"),
            self.tr(
                "How far nodes go along the gradient in one iteration: c times the square of the element size h. "
                "Smaller is slower and steadier; a larger one jumps to and fro around the optimum. "
                "Between 0.001 and 0.003 is usual."
            ),
        )
        explain(
            self.iterations,
            self.tr("Most iterations"),
            self.tr("The run ends after so many iterations; it can be run on from there."),
        )
        explain(
            self.tolerance,
            self.tr("Least gain per quad"),
            self.tr(
                "The run ends when the best sum has gained less than this per quad over the last "
                "{window} iterations, in the unit of the metric."
            ).format(window=self._settings.window),
        )
        explain(
            self.guard,
            self.tr("Guard: keep every element valid"),
            self.tr(
                "Nodes of an element that a step would fold or turn over stay where they are in that step. "
                "Without it the run is the paper's to the letter and may fold elements, which most metrics "
                "do not notice; such elements are counted as inverted, and drawn in magenta."
            ),
        )
