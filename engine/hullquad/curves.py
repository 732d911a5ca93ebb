"""Edges of a contour in the plate's plane: straight, circular or elliptic, measured by their length."""

from functools import cached_property, lru_cache

import attrs
import numpy as np

from hullquad.arrays import Floats, floats

_ROUND_EDGES_KEPT = 1024
"""Fine polylines that are kept, each of about 40 points: documents are divided again and again."""
_MOST_CHORDS = 4000
"""Of a polyline; half a circle of 500 m is within 0.02 mm of so many, and nothing larger is a plate."""


@attrs.frozen(eq=False)
class Straight:
    """A straight edge [mm]."""

    start: Floats = attrs.field(converter=floats)
    end: Floats = attrs.field(converter=floats)

    @cached_property
    def length(self) -> float:
        """Length of the edge [mm]."""
        return float(np.hypot(*(self.end - self.start)))

    def points(self, lengths: Floats) -> Floats:
        """(N, 2) points at (N,) lengths from the start; the ends keep their bits."""
        return _with_exact_ends(self, lengths, self.start + (lengths / self.length)[:, None] * (self.end - self.start))

    def headings(self, lengths: Floats) -> Floats:
        """(N,) directions of the tangent at (N,) lengths from the start [rad]."""
        return np.full(len(lengths), _heading(self.end - self.start))

    def stations(self, tolerance: float) -> Floats:  # noqa: ARG002 - the same question for every curve
        """(N,) lengths whose points make a polyline within `tolerance` of the edge."""
        return np.array([0.0, self.length])

    def reversed(self) -> "Straight":
        """The same edge, run through the other way."""
        return Straight(self.end, self.start)


@attrs.frozen(eq=False)
class Arc:
    """A circular edge [mm]; `bulge` is the tangent of a quarter of its sweep, positive counter-clockwise."""

    start: Floats = attrs.field(converter=floats)
    end: Floats = attrs.field(converter=floats)
    bulge: float

    @cached_property
    def sweep(self) -> float:
        """Angle that the arc turns, positive counter-clockwise [rad]."""
        return float(4 * np.arctan(self.bulge))

    @cached_property
    def radius(self) -> float:
        """Radius of the circle [mm]."""
        chord = float(np.hypot(*(self.end - self.start)))
        return chord * (1 / abs(self.bulge) + abs(self.bulge)) / 4

    @cached_property
    def length(self) -> float:
        """Length of the edge [mm]."""
        return self.radius * abs(self.sweep)

    def points(self, lengths: Floats) -> Floats:
        """(N, 2) points at (N,) lengths from the start; the ends keep their bits.

        Notes
        -----
        Along and across the chord, from its middle: without the centre, which is far away when the bulge is small.
        """
        angles = (lengths / self.length - 0.5) * self.sweep
        half = self.sweep / 2
        along = np.sin(angles) / (2 * np.sin(half))
        across = np.sin((half + angles) / 2) * np.sin((half - angles) / 2) / np.sin(half)
        chord = self.end - self.start
        right = np.array([chord[1], -chord[0]])
        middle = (self.start + self.end) / 2
        return _with_exact_ends(self, lengths, middle + along[:, None] * chord + across[:, None] * right)

    def headings(self, lengths: Floats) -> Floats:
        """(N,) directions of the tangent at (N,) lengths from the start [rad], without jumps."""
        return _heading(self.end - self.start) + (lengths / self.length - 0.5) * self.sweep

    def stations(self, tolerance: float) -> Floats:
        """(N,) lengths whose points make a polyline within `tolerance` of the edge."""
        return np.linspace(0, self.length, _pieces(self.sweep, self.radius, tolerance) + 1)

    def reversed(self) -> "Arc":
        """The same edge, run through the other way."""
        return Arc(self.end, self.start, -self.bulge)


@attrs.frozen(eq=False)
class EllipseArc:
    """Part of an ellipse [mm]; its ends are taken as they are, also when they lie beside it."""

    start: Floats = attrs.field(converter=floats)
    end: Floats = attrs.field(converter=floats)
    centre: Floats = attrs.field(converter=floats)
    a: float
    """Half axis along `rotation` [mm]."""
    b: float
    """The other half axis [mm]."""
    rotation: float = 0.0
    """[rad]"""
    clockwise: bool = False

    def on_unit_circle(self, point: Floats) -> Floats:
        """(2,) the point in the frame where the ellipse is the unit circle."""
        cos, sin = np.cos(self.rotation), np.sin(self.rotation)
        x, y = point - self.centre
        return np.array([(cos * x + sin * y) / self.a, (cos * y - sin * x) / self.b])

    @cached_property
    def first(self) -> float:
        """Eccentric angle of the start [rad]."""
        return _heading(self.on_unit_circle(self.start))

    @cached_property
    def sweep(self) -> float:
        """Eccentric angle from start to end, positive counter-clockwise [rad]."""
        turn = _heading(self.on_unit_circle(self.end)) - self.first
        return -((-turn) % (2 * np.pi)) if self.clockwise else turn % (2 * np.pi)

    @cached_property
    def length(self) -> float:
        """Length of the edge [mm]."""
        return float(self._lengths(np.array([self.first + self.sweep]))[0])

    def points(self, lengths: Floats) -> Floats:
        """(N, 2) points at (N,) lengths from the start; the ends keep their bits."""
        angles = self._angles(lengths)
        along, across = self.a * np.cos(angles), self.b * np.sin(angles)
        cos, sin = np.cos(self.rotation), np.sin(self.rotation)
        points = self.centre + np.stack([cos * along - sin * across, sin * along + cos * across], axis=1)
        return _with_exact_ends(self, lengths, points)

    def headings(self, lengths: Floats) -> Floats:
        """(N,) directions of the tangent at (N,) lengths from the start [rad], without jumps."""
        angles = self._angles(lengths)
        of_circle = angles + np.pi / 2
        tangent = -self.a * np.sin(angles) + 1j * self.b * np.cos(angles)
        beside_circle = np.angle(tangent * np.exp(-1j * of_circle))  # never reaches a right angle: no jumps
        return np.asarray(of_circle + beside_circle + self.rotation + (np.pi if self.clockwise else 0))

    def stations(self, tolerance: float) -> Floats:
        """(N,) lengths whose points make a polyline within `tolerance` of the edge."""
        pieces = _pieces(self.sweep, max(self.a, self.b), tolerance)
        lengths = self._lengths(self.first + self.sweep * np.linspace(0, 1, pieces + 1))
        lengths[-1] = self.length
        return lengths

    def reversed(self) -> "EllipseArc":
        """The same edge, run through the other way."""
        return attrs.evolve(self, start=self.end, end=self.start, clockwise=not self.clockwise)

    def _lengths(self, angles: Floats) -> Floats:
        """(N,) lengths from the start to eccentric angles: an elliptic integral of the second kind."""
        return np.asarray(np.abs(self.b * (self._integral(angles) - self._integral_at_start)))

    @cached_property
    def _integral_at_start(self) -> Floats:
        return self._integral(np.array(self.first))

    def _integral(self, angles: Floats) -> Floats:
        from scipy.special import ellipeinc  # noqa: PLC0415  slow to import, and ellipses are rare

        return np.asarray(ellipeinc(angles, 1 - (self.a / self.b) ** 2))

    def _angles(self, lengths: Floats) -> Floats:
        """(N,) eccentric angles at lengths from the start, by Newton's method from a table."""
        table, lengths_of_table = self._table
        angles: Floats = np.interp(lengths, lengths_of_table, table)
        low, high = sorted((table[0], table[-1]))
        for _ in range(8):
            before = angles
            speeds = np.hypot(self.a * np.sin(angles), self.b * np.cos(angles))
            steps = (lengths - self._lengths(angles)) / speeds
            angles = np.clip(angles + np.copysign(1, self.sweep) * steps, low, high)
            if np.array_equal(angles, before):
                break
        return angles

    @cached_property
    def _table(self) -> tuple[Floats, Floats]:
        """(65,) eccentric angles from start to end, and the lengths from the start to them."""
        angles = floats(self.first + self.sweep * np.linspace(0, 1, 65))
        return angles, floats(self._lengths(angles))


Curve = Straight | Arc | EllipseArc


def canonical(curve: Curve) -> Curve:
    """The curve run through from its lesser end: loops that meet it either way divide it into the same nodes."""
    return curve.reversed() if is_backwards(curve) else curve


def is_backwards(curve: Curve) -> bool:
    """True when the canonical curve runs the other way."""
    return tuple(curve.start) > tuple(curve.end)


def polyline(curve: Curve, tolerance: float) -> Floats:
    """(N, 2) points from start to end of a polyline within `tolerance` of the curve."""
    return curve.points(curve.stations(tolerance))


def chord_error(curve: Curve, row: Floats) -> float:
    """How far a curve leaves a polyline of equal steps along it, at most [mm]."""
    if isinstance(curve, Straight):
        return 0.0
    radius = curve.radius if isinstance(curve, Arc) else max(curve.a, curve.b)
    return radius * (curve.sweep / (len(row) - 1)) ** 2 / 8


def nearest(curve: Curve, point: Floats) -> float:
    """Length from the start at which the curve is nearest to a point beside it."""
    if isinstance(curve, Straight):
        return float(np.clip((point - curve.start) @ (curve.end - curve.start) / curve.length, 0, curve.length))
    stations, row = _finely_divided(curve)
    guess = np.argmin(np.hypot(*(row - point).T))
    at = stations[guess : guess + 1]
    for _ in range(12):
        before, heading = at, curve.headings(at)[0]
        step = (point - curve.points(at)[0]) @ np.array([np.cos(heading), np.sin(heading)])
        at = np.clip(at + step, 0, curve.length)
        if at == before:
            break
    return float(at[0])


@lru_cache(maxsize=_ROUND_EDGES_KEPT)
def _finely_divided(curve: Arc | EllipseArc) -> tuple[Floats, Floats]:
    """(N,) lengths from the start, and the points there (N, 2), of a polyline within a thousandth of a round edge."""
    stations = floats(curve.stations(curve.length / 1000))
    return stations, floats(curve.points(stations))


def _heading(vector: Floats) -> float:
    return float(np.arctan2(vector[1], vector[0]))


def _pieces(sweep: float, radius: float, tolerance: float) -> int:
    """Number of chords that keep within `tolerance` of an arc: at least 8 a turn, and never more than 4000."""
    step = min(np.sqrt(8 * tolerance / radius), np.pi / 4)
    return max(1, int(min(np.ceil(abs(sweep) / step), _MOST_CHORDS)))


def _with_exact_ends(curve: Curve, lengths: Floats, points: Floats) -> Floats:
    points[lengths <= 0] = curve.start
    points[lengths >= curve.length] = curve.end
    return points
