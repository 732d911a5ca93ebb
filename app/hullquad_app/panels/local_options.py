"""Optimising the selected elements only, with some rings of elements around them."""

from contextlib import ExitStack
from typing import Any

import attrs
from PySide6.QtCore import QSignalBlocker, Signal
from PySide6.QtWidgets import QCheckBox, QHBoxLayout, QLabel, QSizePolicy, QSpinBox, QVBoxLayout, QWidget

from hullquad.optimization.selection import rings
from hullquad_app.colours import Palette
from hullquad_app.panels.explained import explain
from hullquad_app.panels.figures import CAPTION, counted, sized
from hullquad_app.panels.ground import coloured
from hullquad_app.scene import Scene
from hullquad_app.search import MOST_RINGS, Search


class LocalOptions(QWidget):
    """A check box, the number of rings, and how many nodes may move then."""

    changed = Signal(object)
    """Emitted with a `Search`, when the user has changed it."""

    def __init__(self) -> None:
        super().__init__()
        self._search, self._scene = Search(), Scene()
        self.only = QCheckBox(self.tr("only, with"))
        self.rings = QSpinBox(minimum=0, maximum=MOST_RINGS, suffix=self.tr(" rings"))
        self.rings.setKeyboardTracking(False)
        self.extent = QLabel()
        self.extent.setFont(sized(self.font(), CAPTION))
        self.extent.setWordWrap(True)
        self.extent.setSizePolicy(QSizePolicy.Policy.Ignored, QSizePolicy.Policy.Preferred)
        self._explain()
        self._arrange()
        self.show_search(self._search)
        self.only.toggled.connect(lambda value: self._change(is_local=value))
        self.rings.valueChanged.connect(lambda value: self._change(rings=value))

    def show_search(self, search: Search) -> None:
        """Show what the next run does."""
        self._search = search
        with ExitStack() as quiet:
            for widget in (self.only, self.rings):
                quiet.enter_context(QSignalBlocker(widget))
            self.only.setChecked(search.is_local)
            self.rings.setValue(search.rings)
        self._tell()

    def show_scene(self, scene: Scene) -> None:
        """Show what it comes to on a mesh with a selection."""
        before, self._scene = self._scene, scene
        if _extent(scene) != _extent(before):
            self._tell()

    def set_palette(self, palette: Palette) -> None:
        """Draw in the colours of a theme."""
        coloured(self.extent, palette.dim)

    def _change(self, **changes: Any) -> None:
        self.show_search(attrs.evolve(self._search, **changes))
        self.changed.emit(self._search)

    def _tell(self) -> None:
        mesh, selection = self._scene.mesh, self._scene.view.selection
        self.only.setEnabled(bool(selection))
        self.rings.setEnabled(bool(selection) and self._search.is_local)
        if mesh is None or not selection:
            self.extent.setText(self.tr("nothing is selected: every free node may move"))
            return
        is_free = mesh.topology.is_free
        may_move = rings(mesh, selection, self._search.rings) & is_free if self._search.is_local else is_free
        text = self.tr("{count} of {free} free nodes may move")
        self.extent.setText(text.format(count=counted(int(may_move.sum())), free=counted(int(is_free.sum()))))

    def _explain(self) -> None:
        explain(
            self.only,
            self.tr("Optimise the selected elements only"),
            self.tr("Only nodes of the selected elements and of the rings around them move; all others stay."),
        )
        explain(
            self.rings,
            self.tr("Rings around the selection"),
            self.tr("So many rings of elements around the selected ones may change, too."),
        )

    def _arrange(self) -> None:
        line = QHBoxLayout()
        line.addWidget(self.only)
        line.addWidget(self.rings)
        line.addStretch()
        column = QVBoxLayout(self)
        column.setContentsMargins(0, 0, 0, 0)
        column.addLayout(line)
        column.addWidget(self.extent)


def _extent(scene: Scene) -> tuple[object, ...]:
    """All of a scene that the number of nodes depends on."""
    return None if scene.mesh is None else id(scene.mesh.topology), scene.view.selection
