"""The view: a plate in space, turned, enlarged and picked with the mouse."""

from collections.abc import Iterable
from typing import TYPE_CHECKING

import numpy as np
from PySide6.QtCore import QEvent, QPointF, Qt, Signal
from PySide6.QtGui import QCloseEvent, QKeyEvent, QMouseEvent, QResizeEvent, QWheelEvent
from PySide6.QtWidgets import QWidget

from hullquad.arrays import Floats, floats
from hullquad.sight import plan
from hullquad_app.canvas.legend import legend_of
from hullquad_app.canvas.overlay import Overlay
from hullquad_app.canvas.picker import Picker, corners, nodes_of
from hullquad_app.canvas.pointer import Pointer
from hullquad_app.canvas.tip import tip
from hullquad_app.canvas.viewpoint import Viewpoint
from hullquad_app.colours import BROKEN, LIGHT, ColourMap, Palette
from hullquad_app.division import Division
from hullquad_app.scene import Scene
from hullquad_app.turns import Turns

if TYPE_CHECKING:
    from hullquad_app.canvas.pane import Pane
    from hullquad_app.canvas.stage import Stage

_NOWHERE = floats(np.empty((0, 3)))
_WHEEL_STEP = 1.2
"""How much a notch of the wheel enlarges."""
_ARROWS = {
    Qt.Key.Key_Left: (-40, 0),
    Qt.Key.Key_Right: (40, 0),
    Qt.Key.Key_Up: (0, 40),
    Qt.Key.Key_Down: (0, -40),
}
"""How far the arrow keys move the plate to the right and up [pixels]."""
_ZOOMS = {Qt.Key.Key_Plus: 1.25, Qt.Key.Key_Equal: 1.25, Qt.Key.Key_Minus: 0.8}


class Canvas(QWidget):
    """Shows a scene and reports what is clicked; holds nothing of it but where the camera stands.

    Left drag turns, middle (or Shift and left) drag moves, the wheel enlarges at the cursor; arrow keys move, with
    Shift they turn, plus and minus enlarge.
    """

    picked = Signal(int, bool)
    """Emitted with the row of a clicked element, and whether it is to extend the selection."""
    opened = Signal(int)
    """Emitted with the row of an element that was clicked twice."""
    missed = Signal()
    """Emitted by a click where no element is."""
    hovered = Signal(int)
    """Emitted with the row of the element below the cursor when it changes; -1 for none."""
    painted = Signal(float)
    """Emitted with the seconds that drawing the plate took, when it is on the screen."""

    def __init__(self, parent: QWidget | None = None, turns: Turns | None = None) -> None:
        super().__init__(parent)
        self._turns = turns or Turns(self)
        self.setMouseTracking(True)
        self.setFocusPolicy(Qt.FocusPolicy.StrongFocus)
        self.setAutoFillBackground(True)
        self.setAccessibleName(self.tr("View of the plate"))
        self.stage: Stage | None = None
        """What VTK shows; None before `start` and after `stop`."""
        self.viewpoint = Viewpoint(self)
        self.viewpoint.changed.connect(self._refresh)
        self.overlay = Overlay(self)
        self._pane: Pane | None = None
        self._scene = Scene()
        self._subject: object = None
        self._place: Floats = _NOWHERE
        self._division: Division | None = None
        self._palette, self._map, self._shows_edges = LIGHT, BROKEN, True
        self._picker, self._pointer = Picker(), Pointer()
        self._cursor: QPointF | None = None
        self._row, self._inspects = -1, False
        self.set_palette(LIGHT)

    def start(self) -> None:
        """Fill the view; takes a second, so the window is shown before."""
        if self._pane is not None:
            return
        from hullquad_app.canvas.pane import Pane  # noqa: PLC0415  brings VTK
        from hullquad_app.canvas.stage import Stage  # noqa: PLC0415

        self._pane = Pane(self, self._turns)
        self._pane.painted.connect(self.painted)
        self._pane.setGeometry(self.rect())
        self._pane.lower()
        self._pane.show()
        self.stage = Stage(self._pane.renderer, self._palette)
        self.stage.set_colour_map(self._map)
        self.stage.show_edges(self._shows_edges)
        self.stage.show_place(self._place)
        self.stage.show_division(self._division)
        self.show_scene(self._scene)

    def stop(self) -> None:
        """Close the view; it stays empty from then on."""
        self._turns.stop()
        pane, self._pane, self.stage = self._pane, None, None
        if pane is not None:
            pane.painted.disconnect(self.painted)
            pane.finish()
            pane.deleteLater()

    @property
    def is_smooth(self) -> bool:
        """Whether the view is at rest and its lines are smoothed."""
        return self._pane is not None and self._pane.is_smooth

    def show_scene(self, scene: Scene) -> None:
        """Show a scene; only what differs from the one before is touched."""
        before, self._scene = self._scene, scene
        self.overlay.set_notice(self._notice())
        if self.stage is None:
            return
        self.stage.show(scene)
        self.viewpoint.points = self.stage.points
        self.overlay.set_loops(self.stage.loops)
        self.overlay.set_legend(*legend_of(scene))
        self.overlay.set_inspection(scene.inspection if self._inspects else None)
        subject = _subject(scene)
        if scene.state.plates is not before.state.plates or subject is not self._subject:
            self.show_place(_NOWHERE)
        if subject is not self._subject:
            self._subject = subject
            self._set_plan()
            self.viewpoint.look("plan")
        else:
            self._refresh()
        self._hover()

    def show_division(self, division: Division) -> None:
        """Draw the nodes of a division on plates without a mesh, until another one."""
        self._division = division
        if self.stage is not None:
            self.stage.show_division(division)
            self._refresh()

    def show_place(self, points: Floats) -> None:
        """Show a place on the plate, a polyline (N, 3) or a point (3,), until another one; none takes it away."""
        self._place = points.reshape(-1, 3)
        if self.stage is not None:
            self.stage.show_place(self._place)
            self._refresh()

    def set_palette(self, palette: Palette) -> None:
        """Take the colours of a theme."""
        self._palette = palette
        colours = self.palette()
        colours.setColor(self.backgroundRole(), palette.view)
        self.setPalette(colours)
        self.overlay.set_palette(palette)
        if self.stage is not None:
            self.stage.set_palette(palette)
            self._refresh()

    def set_colour_map(self, chosen: ColourMap) -> None:
        """Colour elements by another map."""
        self._map = chosen
        if self.stage is not None:
            self.stage.set_colour_map(chosen)
            self._refresh()

    def show_edges(self, shown: bool) -> None:
        """Draw edges of elements that are large enough, or none."""
        self._shows_edges = shown
        if self.stage is not None:
            self.stage.show_edges(shown)
            self._refresh()

    def toggle_edges(self) -> None:
        """Draw edges of elements, or leave them out."""
        self.show_edges(not self._shows_edges)

    def inspect(self, wanted: bool) -> None:
        """Write lengths and angles at the selected element, or leave them out."""
        self._inspects = wanted
        self.overlay.set_inspection(self._scene.inspection if wanted else None)

    def fit(self) -> None:
        """Show the whole plate."""
        self.viewpoint.fit()

    def look(self, name: str) -> None:
        """Show the whole plate from a standard view: plan, front, top, side or isometric."""
        self.viewpoint.look(name)

    def reveal(self, rows: Iterable[int]) -> None:
        """Bring elements into the picture, if they are not."""
        if self._scene.mesh is not None and (chosen := list(rows)):
            self.viewpoint.reveal(nodes_of(self._scene.mesh, chosen))

    def zoom_to(self, rows: Iterable[int]) -> None:
        """Show elements large, with their surroundings."""
        if self._scene.mesh is not None and (chosen := list(rows)):
            self.viewpoint.zoom_to(nodes_of(self._scene.mesh, chosen))

    def mousePressEvent(self, event: QMouseEvent) -> None:
        """Begin a click or a drag."""
        self._pointer.press(event)

    def mouseMoveEvent(self, event: QMouseEvent) -> None:
        """Drag, or look what is below the cursor."""
        step = self._pointer.drag(event)
        if step is not None:
            (self.viewpoint.pan if self._pointer.pans else self.viewpoint.orbit)(step.x(), -step.y())
        elif not self._pointer.is_down:
            self._cursor = event.position()
            self._hover()

    def mouseReleaseEvent(self, event: QMouseEvent) -> None:
        """End a drag, or pick what was clicked."""
        if self._pointer.release(event):
            row = self._row_at(event.position())
            if row < 0:
                self.missed.emit()
            else:
                self.picked.emit(row, self._pointer.extends)

    def mouseDoubleClickEvent(self, event: QMouseEvent) -> None:
        """Look into what was clicked twice."""
        row = self._row_at(event.position())
        if row >= 0 and event.button() == Qt.MouseButton.LeftButton:
            self.opened.emit(row)

    def wheelEvent(self, event: QWheelEvent) -> None:
        """Enlarge at the cursor."""
        place = event.position()
        self.viewpoint.zoom(_WHEEL_STEP ** (event.angleDelta().y() / 120), place.x(), place.y())

    def keyPressEvent(self, event: QKeyEvent) -> None:
        """Move, turn or enlarge; other keys belong to the window."""
        key = Qt.Key(event.key())
        if key in _ARROWS:
            turns = event.modifiers() & Qt.KeyboardModifier.ShiftModifier
            (self.viewpoint.orbit if turns else self.viewpoint.pan)(*_ARROWS[key])
        elif key in _ZOOMS:
            self.viewpoint.zoom(_ZOOMS[key], self.width() / 2, self.height() / 2)
        else:
            super().keyPressEvent(event)

    def leaveEvent(self, event: QEvent) -> None:
        """Nothing is below the cursor any more."""
        self._cursor = None
        self._hover()
        super().leaveEvent(event)

    def resizeEvent(self, event: QResizeEvent) -> None:
        """Keep the plate in the middle."""
        self.overlay.setGeometry(self.rect())
        if self._pane is not None:
            self._pane.setGeometry(self.rect())
        self.viewpoint.resize(event.size())

    def changeEvent(self, event: QEvent) -> None:
        """Follow the window to another screen."""
        if event.type() == QEvent.Type.DevicePixelRatioChange:
            self._refresh()
        super().changeEvent(event)

    def closeEvent(self, event: QCloseEvent) -> None:
        """Close the view with its widget."""
        self.stop()
        super().closeEvent(event)

    def _refresh(self) -> None:
        """Paint as the camera sees it now."""
        camera = self.viewpoint.camera
        self.overlay.set_camera(camera if len(self.viewpoint.points) else None)
        if self.stage is None or self._pane is None:
            self.overlay.update()
            return
        camera.apply(self.stage.renderer.GetActiveCamera(), self.height(), self.stage.box)
        self.stage.look(camera.towards, camera.pixel, self.devicePixelRatioF())
        self._pane.refresh()

    def _row_at(self, position: QPointF) -> int:
        place = self.viewpoint.place(position.x(), position.y())
        return self._picker.element_at(self._scene.mesh, self.viewpoint.camera, place)

    def _hover(self) -> None:
        """Say what is below the cursor."""
        row = -1 if self._cursor is None else self._row_at(self._cursor)
        mesh, quality = self._scene.mesh, self._scene.quality
        if row < 0 or mesh is None or quality is None or self._cursor is None:
            self.overlay.hover("", QPointF(), None)
        else:
            self.overlay.hover(tip(mesh.topology, quality, row, self._scene.given), self._cursor, corners(mesh, row))
        if row != self._row:
            self._row = row
            self.hovered.emit(row)

    def _set_plan(self) -> None:
        scene = self._scene
        if scene.mesh is not None:
            self.viewpoint.plan = plan(scene.mesh)
        elif scene.plate is not None:
            self.viewpoint.plan = scene.plate.surface.directions

    def _notice(self) -> str:
        plate = self._scene.plate
        if plate is None or plate.is_plane or self._scene.mesh is not None:
            return ""
        return self.tr("{plate} is curved. Curved plates cannot be meshed yet.").format(plate=plate.id)


def _subject(scene: Scene) -> object:
    """What the view is about: when that changes, the camera starts anew. Edges divided otherwise change nothing."""
    if scene.plate is not None:
        return scene.plate.outer
    return None if scene.track is None else scene.track.first.mesh.topology
