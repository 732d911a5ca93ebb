"""Where the camera stands, and how it moves about the plate."""

import numpy as np
from PySide6.QtCore import QObject, QSize, Signal

from hullquad.arrays import Floats, floats
from hullquad_app.canvas.camera import VIEWS, Camera

_MARGIN = 48.0
"""Room around the plate when it is fitted [pixels]."""


class Viewpoint(QObject):
    """A camera that knows the size of its picture and what is to be seen."""

    changed = Signal()

    def __init__(self, parent: QObject | None = None) -> None:
        super().__init__(parent)
        self.camera = Camera()
        self.points: Floats = floats(np.empty((0, 3)))
        """(N, 3) all that is to be seen."""
        self.plan = (self.camera.right, self.camera.up)
        """Directions to the right and up of the plan view."""
        self.is_fitted = True
        """Whether the whole plate is kept in the picture: until the user moves or enlarges it."""
        self._size = QSize(1, 1)

    def resize(self, size: QSize) -> None:
        """Take another size of the picture: the same place stays in its middle."""
        self._size = size
        if self.is_fitted:
            self.fit()
        else:
            self.changed.emit()

    def place(self, x: float, y: float) -> Floats:
        """(2,) place across the view of a point of the picture [pixels from its upper left corner]."""
        return self.camera.place(*self._from_middle(x, y))

    def fit(self) -> None:
        """Show the whole plate."""
        self._set(self._fitted(self.camera, self.points, _MARGIN), is_fitted=True)

    def look(self, name: str) -> None:
        """Show the whole plate from a standard view: plan, front, top, side or isometric."""
        right, up = self.plan if name == "plan" else VIEWS[name]
        self._set(self._fitted(self.camera.turned(floats(right), floats(up)), self.points, _MARGIN), is_fitted=True)

    def orbit(self, x: float, y: float) -> None:
        """Turn the plate about its middle, dragged by pixels to the right and up."""
        pivot = (self.points.min(axis=0) + self.points.max(axis=0)) / 2 if len(self.points) else self.camera.centre
        self._set(self.camera.orbited(x, y, pivot))

    def pan(self, x: float, y: float) -> None:
        """Move the plate by pixels to the right and up."""
        self._set(self.camera.panned(x, y))

    def zoom(self, factor: float, x: float, y: float) -> None:
        """Enlarge; what is at a point of the picture stays there [pixels from its upper left corner]."""
        self._set(self.camera.zoomed(factor, *self._from_middle(x, y)))

    def reveal(self, points: Floats) -> None:
        """Bring points (N, 3) into the picture, if they are not: moved to its middle, made smaller if need be."""
        across = self.camera.pixels(points)
        half = np.array([self._size.width(), self._size.height()]) / 2
        if (np.abs(across) > half - _MARGIN / 2).any():
            closer = self._fitted(self.camera, points, _MARGIN)
            zoom = min(self.camera.pixel / closer.pixel, 1.0)
            self._set(self.camera.centred(closer.centre).zoomed(zoom))

    def zoom_to(self, points: Floats) -> None:
        """Show points (N, 3) large, with their surroundings."""
        self._set(self._fitted(self.camera, points, 0.35 * min(self._size.width(), self._size.height())))

    def _from_middle(self, x: float, y: float) -> tuple[float, float]:
        return x - self._size.width() / 2, self._size.height() / 2 - y

    def _fitted(self, camera: Camera, points: Floats, margin: float) -> Camera:
        return camera.fitted(points, self._size.width(), self._size.height(), margin)

    def _set(self, camera: Camera, *, is_fitted: bool = False) -> None:
        self.camera, self.is_fitted = camera, is_fitted
        self.changed.emit()
