"""The surface a plate lies on: from its parameter plane to space."""

from functools import cached_property
from math import comb

import attrs
import numpy as np

from hullquad.arrays import Floats, floats


@attrs.frozen(eq=False)
class Plane:
    """A plane; its parameters are the lengths along `u` and `v` from `origin` [mm]."""

    origin: Floats = attrs.field(converter=floats)
    u: Floats = attrs.field(converter=floats)
    v: Floats = attrs.field(converter=floats)

    @cached_property
    def normal(self) -> Floats:
        """(3,) unit normal u x v."""
        return floats(np.cross(self.u, self.v))

    def points(self, parameters: Floats) -> Floats:
        """(N, 3) points in space [mm] of (N, 2) parameters."""
        return self.origin + parameters[:, :1] * self.u + parameters[:, 1:] * self.v

    @property
    def directions(self) -> tuple[Floats, Floats]:
        """(3,) unit vectors to the right and up of a plan view."""
        return self.u, self.v

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
    note: str = ""

    def points(self, parameters: Floats) -> Floats:
        """(N, 3) points in space [mm] of (N, 2) parameters."""
        along, angles = parameters[:, :1], self.start_angle + parameters[:, 1:] / self.radius
        across = np.cos(angles) * self.frame.v + np.sin(angles) * self.frame.normal
        return self.frame.origin + along * self.frame.u + self.radius * across

    @property
    def directions(self) -> tuple[Floats, Floats]:
        """(3,) unit vectors to the right and up of a plan view: the axis, and across it."""
        return self.frame.directions


@attrs.frozen(eq=False)
class Bezier:
    """A tensor-product Bezier patch; both parameters run over 0..1.

    `control` is (m + 1, n + 1, 3) [mm], rows along the second parameter.
    """

    control: Floats = attrs.field(converter=floats)
    frame: Plane = Plane([0, 0, 0], [1, 0, 0], [0, 1, 0])
    """What the document gives beside the control points, which need none."""
    note: str = ""

    def points(self, parameters: Floats) -> Floats:
        """(N, 3) points in space [mm] of (N, 2) parameters."""
        rows, columns, _ = self.control.shape
        weights = _bernstein(rows - 1, parameters[:, 1]), _bernstein(columns - 1, parameters[:, 0])
        return floats(np.einsum("nj,ni,jik->nk", *weights, self.control))

    @property
    def directions(self) -> tuple[Floats, Floats]:
        """(3,) unit vectors to the right and up of a plan view: along the first parameter, and square to it."""
        first, second = self.control[0, -1] - self.control[0, 0], self.control[-1, 0] - self.control[0, 0]
        right = first / np.linalg.norm(first)
        up = second - (second @ right) * right
        return floats(right), floats(up / np.linalg.norm(up))


def _bernstein(degree: int, parameters: Floats) -> Floats:
    """(N, degree + 1) Bernstein polynomials at (N,) parameters."""
    powers = np.arange(degree + 1)
    binomials = np.array([comb(degree, int(power)) for power in powers])
    return floats(binomials * parameters[:, None] ** powers * (1 - parameters[:, None]) ** (degree - powers))


Surface = Plane | Cylinder | Bezier
