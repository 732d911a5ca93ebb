"""The surface a plate lies on: from its parameter plane to space."""

import attrs
import numpy as np

from hullquad.arrays import Floats, floats


@attrs.frozen(eq=False)
class Plane:
    """A plane; its parameters are the lengths along `u` and `v` from `origin` [mm]."""

    origin: Floats = attrs.field(converter=floats)
    u: Floats = attrs.field(converter=floats)
    v: Floats = attrs.field(converter=floats)

    @property
    def normal(self) -> Floats:
        """(3,) unit normal u x v."""
        return floats(np.cross(self.u, self.v))

    def points(self, parameters: Floats) -> Floats:
        """(N, 3) points in space [mm] of (N, 2) parameters."""
        return self.origin + parameters[:, :1] * self.u + parameters[:, 1:] * self.v

    def parameters(self, points: Floats) -> Floats:
        """(N, 2) parameters of the points' feet on the plane; `points` is (N, 3) [mm]."""
        return np.stack([(points - self.origin) @ self.u, (points - self.origin) @ self.v], axis=1)

    def tangents(self, parameters: Floats) -> Floats:
        """(N, 2, 3) Jacobian: change of the point with either parameter."""
        return np.broadcast_to(np.stack([self.u, self.v]), (len(parameters), 2, 3))


@attrs.frozen(eq=False)
class Cylinder:
    """A patch of a cylinder whose axis is the frame's `u`; the second parameter is arc length [mm].

    ``point = origin + p u + radius (cos a v + sin a n)`` with ``a = start_angle + q / radius`` and n = u x v.
    """

    frame: Plane
    radius: float
    start_angle: float
    """[rad]"""


@attrs.frozen(eq=False)
class Bezier:
    """A tensor-product Bezier patch; both parameters run over 0..1.

    `control` is (m + 1, n + 1, 3) [mm], rows along the second parameter.
    """

    control: Floats = attrs.field(converter=floats)


Surface = Plane | Cylinder | Bezier
