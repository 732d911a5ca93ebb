"""From where the plate is looked at: a camera in parallel projection, as a value."""

from typing import Any

import attrs
import numpy as np

from hullquad.arrays import Floats, floats

_ROOT = np.sqrt([1 / 2, 1 / 3, 1 / 6])

VIEWS: dict[str, tuple[tuple[float, ...], tuple[float, ...]]] = {
    "front": ((0, 1, 0), (0, 0, 1)),
    "top": ((1, 0, 0), (0, 1, 0)),
    "side": ((1, 0, 0), (0, 0, 1)),
    "isometric": ((_ROOT[0], _ROOT[0], 0), (-_ROOT[2], _ROOT[2], 2 * _ROOT[2])),
}
"""Directions to the right and up of the standard views; x runs ahead, y to port, z up."""

_LEAST_PIXEL, _MOST_PIXEL = 1e-5, 1e5
"""[mm]"""


@attrs.frozen(eq=False, kw_only=True)
class Camera:
    """What is in the middle of the picture, which way is right and up, and how large it is."""

    centre: Floats = attrs.field(default=(0.0, 0.0, 0.0), converter=floats)
    right: Floats = attrs.field(default=(1.0, 0.0, 0.0), converter=floats)
    up: Floats = attrs.field(default=(0.0, 1.0, 0.0), converter=floats)
    pixel: float = 1.0
    """Length of a pixel [mm]."""

    @property
    def towards(self) -> Floats:
        """(3,) unit vector from the plate to the viewer."""
        return floats(np.cross(self.right, self.up))

    def place(self, x: float, y: float) -> Floats:
        """(2,) place across the view [mm], as of `sight`, at `x` to the right of the middle and `y` up [pixels]."""
        return floats([self.centre @ self.right + x * self.pixel, self.centre @ self.up + y * self.pixel])

    def pixels(self, points: Floats) -> Floats:
        """(N, 2) pixels to the right of the middle and up of points (N, 3)."""
        away = points - self.centre
        return np.stack([(away * self.right).sum(axis=1), (away * self.up).sum(axis=1)], axis=1) / self.pixel

    def turned(self, right: Floats, up: Floats) -> "Camera":
        """Another direction, the same centre."""
        return attrs.evolve(self, right=right, up=up)

    def orbited(self, x: float, y: float, pivot: Floats) -> "Camera":
        """The plate turned about `pivot` as if dragged by pixels to the right and up: 200 for a quarter."""
        rotation = _rotation(self.up, -x * np.pi / 400) @ _rotation(self.right, y * np.pi / 400)
        right = rotation @ self.right
        right /= np.linalg.norm(right)
        up = np.cross(rotation @ self.towards, right)
        centre = pivot + rotation @ (self.centre - pivot)
        return attrs.evolve(self, centre=centre, right=right, up=up / np.linalg.norm(up))

    def panned(self, x: float, y: float) -> "Camera":
        """The plate dragged by pixels to the right and up."""
        return self.centred(self.centre - self.pixel * (x * self.right + y * self.up))

    def zoomed(self, factor: float, x: float = 0.0, y: float = 0.0) -> "Camera":
        """Enlarged by a factor; what is at `x`, `y` [pixels] from the middle stays there."""
        pixel = float(np.clip(self.pixel / factor, _LEAST_PIXEL, _MOST_PIXEL))
        moved = self.panned(-x, -y)
        return attrs.evolve(moved, pixel=pixel).panned(x, y)

    def centred(self, centre: Floats) -> "Camera":
        """Another point in the middle."""
        return attrs.evolve(self, centre=centre)

    def fitted(self, points: Floats, width: float, height: float, margin: float) -> "Camera":
        """All points (N, 3) in a picture of that size, `margin` pixels from its rim."""
        if len(points) == 0:
            return self
        seen = self.pixels(points) * self.pixel
        low, high = seen.min(axis=0), seen.max(axis=0)
        room = np.maximum([width - 2 * margin, height - 2 * margin], 10.0)
        pixel = float(np.clip(((high - low) / room).max(), _LEAST_PIXEL, _MOST_PIXEL))
        middle = (low + high) / 2
        centre = self.centre + middle[0] * self.right + middle[1] * self.up
        towards = self.towards
        depths = (points - centre) @ towards
        centre = centre + (depths.min() + depths.max()) / 2 * towards
        return attrs.evolve(self, centre=centre, pixel=pixel)

    def apply(self, vtk_camera: Any, height: float, box: Floats) -> None:
        """Look so through a VTK camera; `height` of the picture [pixels], `box` (2, 3) around all there is."""
        towards = self.towards
        corners = np.stack(np.meshgrid(*box.T), axis=-1).reshape(-1, 3)
        depths = (corners - self.centre) @ towards
        reach = max(float(np.ptp(depths)), 100 * self.pixel)
        distance = float(depths.max()) + reach
        vtk_camera.ParallelProjectionOn()
        vtk_camera.SetFocalPoint(*self.centre)
        vtk_camera.SetPosition(*(self.centre + distance * towards))
        vtk_camera.SetViewUp(*self.up)
        vtk_camera.SetParallelScale(self.pixel * height / 2)
        vtk_camera.SetClippingRange(reach / 2, distance - float(depths.min()) + reach / 2)


def _rotation(axis: Floats, angle: float) -> Floats:
    """(3, 3) rotation about a unit vector, by Rodrigues' formula."""
    x, y, z = axis
    cross = np.array([[0, -z, y], [z, 0, -x], [-y, x, 0]])
    return np.asarray(np.eye(3) + np.sin(angle) * cross + (1 - np.cos(angle)) * cross @ cross)
