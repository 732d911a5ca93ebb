"""A dock that makes its panel when somebody sees it, or asks for it."""

from collections.abc import Callable
from typing import Generic, Protocol, TypeVar

from PySide6.QtWidgets import QDockWidget, QScrollArea, QWidget

from hullquad_app.colours import COLOUR_MAPS, LIGHT, ColourMap, Palette
from hullquad_app.scene import Scene


class Panel(Protocol):
    """A widget that shows scenes."""

    def show_scene(self, scene: Scene) -> None:
        """Show a scene."""

    def set_palette(self, palette: Palette, chosen: ColourMap, /) -> None:
        """Draw in the colours of a theme and a map."""


Shown = TypeVar("Shown", bound=Panel)


class PanelDock(QDockWidget, Generic[Shown]):
    """Shows scenes on its panel while that is seen; an empty window waits for no panel that is not.

    Parameters
    ----------
    name
        By which its place is remembered.
    make
        Gives the panel, ready for its first scene.
    is_form
        May need more height than there is, and scrolls then.
    """

    def __init__(self, name: str, title: str, make: Callable[[], Shown], *, is_form: bool = False) -> None:
        super().__init__(title)
        self.setObjectName(name)
        self._make, self._is_form = make, is_form
        self._panel: Shown | None = None
        self._scene = self._shown = Scene()
        self._palette, self._map = LIGHT, COLOUR_MAPS[0]
        self._is_seen = False
        self.visibilityChanged.connect(self._turn)

    @property
    def panel(self) -> Shown:
        """The panel, with the newest scene on it."""
        return self._caught_up()

    @property
    def is_in_front(self) -> bool:
        """Whether the panel is seen, and not only its tab."""
        return self.isVisible() and not self.visibleRegion().isEmpty()

    def show_scene(self, scene: Scene) -> None:
        """Show a scene, as soon as the panel is seen."""
        self._scene = scene
        if self._is_seen:
            self._caught_up()

    def wake(self) -> None:
        """Have the newest scene on the panel, though nobody may see it: others wait for what it asks for."""
        self._caught_up()

    def set_palette(self, palette: Palette, chosen: ColourMap) -> None:
        """Take the colours of a theme, and the map by which elements are coloured."""
        self._palette, self._map = palette, chosen
        if self._panel is not None:
            self._panel.set_palette(palette, chosen)

    def _turn(self, is_seen: bool) -> None:
        self._is_seen = is_seen
        if is_seen:
            self._caught_up()

    def _caught_up(self) -> Shown:
        if self._panel is None:
            self._panel = self._made()
        if self._shown is not self._scene:
            self._shown = self._scene
            self._panel.show_scene(self._scene)
        return self._panel

    def _made(self) -> Shown:
        panel = self._make()
        panel.set_palette(self._palette, self._map)
        assert isinstance(panel, QWidget)  # no protocol can say so
        self.setWidget(_scrolled(panel) if self._is_form else panel)
        return panel


def _scrolled(form: QWidget) -> QScrollArea:
    area = QScrollArea()
    area.setWidget(form)
    area.setWidgetResizable(True)
    area.setFrameShape(QScrollArea.Shape.NoFrame)
    return area
