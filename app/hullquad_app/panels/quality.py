"""Quality distribution: key figures over the histogram."""

from PySide6.QtCore import Signal
from PySide6.QtWidgets import QVBoxLayout, QWidget

from hullquad_app.colours import COLOUR_MAPS, LIGHT, ColourMap, Palette
from hullquad_app.panels.ground import dress
from hullquad_app.panels.histogram import HistogramChart
from hullquad_app.panels.key_figures import KeyFigures
from hullquad_app.scene import Scene


class QualityPanel(QWidget):
    """How good the shown mesh is by the chosen metric; its limit can be moved here."""

    limit_dragged = Signal(int, float)
    """Number and value of a limit while the mouse has it."""
    limit_released = Signal(int, float)
    """Number and value of a limit where it was left, by mouse or key."""
    limit_reset = Signal()
    """The metric's own limits are wanted again."""
    selected = Signal(object, bool)
    """Rows of the elements of a bar (frozenset), and whether they extend the selection."""

    def __init__(self) -> None:
        super().__init__()
        self._palette = LIGHT
        self._scene = Scene()
        self.figures, self.chart = KeyFigures(), HistogramChart()
        self.chart.limit_dragged.connect(self.limit_dragged)
        self.chart.limit_released.connect(self.limit_released)
        self.chart.limit_reset.connect(self.limit_reset)
        self.chart.selected.connect(self.selected)
        column = QVBoxLayout(self)
        gap = self.fontMetrics().height() // 3
        column.setContentsMargins(2 * gap, gap, 2 * gap, gap)
        column.addWidget(self.figures)
        column.addWidget(self.chart, stretch=1)
        dress(self, LIGHT)

    def show_scene(self, scene: Scene) -> None:
        """Show the quality of a scene."""
        before, self._scene = self._scene, scene
        if scene.quality is not before.quality or scene.given is not before.given:
            self.figures.show_quality(scene.quality, self._palette, scene.given)
        self.chart.show_scene(scene)

    def set_palette(self, palette: Palette, chosen: ColourMap = COLOUR_MAPS[0]) -> None:
        """Draw in the colours of a theme and a map."""
        self._palette = palette
        dress(self, palette)
        self.figures.show_quality(self._scene.quality, palette, self._scene.given)
        self.chart.set_palette(palette, chosen)
