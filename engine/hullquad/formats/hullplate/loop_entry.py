"""Points, vertices and loops of a hullplate document."""

from collections.abc import Callable
from typing import Any

import attrs
import numpy as np

from hullquad.arrays import Floats
from hullquad.curves import Arc, Curve, EllipseArc, Straight
from hullquad.documents.entry import Entry, Field, Refused, flag, items, number, positive, whole
from hullquad.plate import LEAST_LENGTH, LEAST_PARAMETER, Loop, closed_loop

_FARTHEST = 1e9
"""[mm]; farther away, floats are too coarse for a plate."""
_FLATTEST, _ROUNDEST = 1e-9, 1e3
"""Bulges below are straight, bulges above are full circles."""
_OFF_ELLIPSE = 1e-3
_LONGEST_ELLIPSE = 1e3


@attrs.frozen
class Units:
    """What a number of the document is, for one plate."""

    coordinate: float
    """Millimetres per unit of a coordinate in the plate; 1 when the coordinates are parameters."""
    length: float
    """Millimetres per unit of length."""
    angle: float
    """Radians per unit of angle."""
    parametric: bool = False

    @property
    def unit(self) -> str:
        """What a sentence says after a length in the plate; parameters are none."""
        return "" if self.parametric else " mm"

    @property
    def least_length(self) -> float:
        """Shortest edge allowed, in the unit of the coordinates."""
        return LEAST_PARAMETER if self.parametric else LEAST_LENGTH


def vector(count: int, scale: float = 1.0) -> Callable[[Entry], Floats]:
    """Reader of `count` coordinates, times `scale`."""

    def read(entry: Entry) -> Floats:
        if not isinstance(entry.value, list) or len(entry.value) != count:
            shown = len(entry.value) if isinstance(entry.value, list) else entry.shown
            raise entry.refused("E_POINT", "count", count=count, shown=shown)
        values = np.array(items(entry, number)) * scale
        if np.abs(values).max() > _FARTHEST:
            raise entry.refused("E_POINT", "far", shown=", ".join(f"{value:g}" for value in values))
        return values

    return read


def point(units: Units) -> Callable[[Entry], Floats]:
    """Reader of a point in the plate."""

    def read(entry: Entry) -> Floats:
        values = vector(2, units.coordinate)(entry)
        if units.parametric and np.abs(values - 0.5).max() > 0.5 + LEAST_PARAMETER:
            raise entry.refused("E_POINT", "range", u=values[0], v=values[1])
        return values

    return read


def loop(units: Units, *, is_hole: bool) -> Callable[[Entry], Loop]:
    """Reader of a list of vertices."""

    def read(entry: Entry) -> Loop:
        vertices = items(entry, lambda item: _vertex(item, units))
        round_edges = any("bulge" in vertex or "ellipse" in vertex for vertex in vertices)
        if len(vertices) < (2 if round_edges else 3):
            raise entry.refused("E_OUTER", count=len(vertices))
        places = [entry.at(i) for i in range(len(vertices))]
        pairs = zip(vertices, [*vertices[1:], vertices[0]], places, strict=True)
        faults = len(entry.faults)
        curves = [_curve(vertex, following["p"], place, units) for vertex, following, place in pairs]
        if len(entry.faults) > faults:
            raise Refused
        return closed_loop(curves, entry.place, is_hole=is_hole)

    return read


def _vertex(entry: Entry, units: Units) -> dict[str, Any]:
    """Point of a vertex, and what makes the edge that leaves it round."""
    table = {"p": Field(point(units)), "bulge": Field(_bulge), "ellipse": Field(lambda item: _ellipse(item, units))}
    if isinstance(entry.value, dict) and "p" not in entry.value:
        raise entry.refused("E_VERTEX", "missing")
    vertex = whole(entry, table)
    if "bulge" in vertex and "ellipse" in vertex:
        raise entry.refused("E_VERTEX", "both")
    if abs(vertex.get("bulge", 1)) < _FLATTEST:
        del vertex["bulge"]
    return vertex


def _bulge(entry: Entry) -> float:
    bulge = number(entry)
    if abs(bulge) > _ROUNDEST:
        raise entry.refused("E_NUMBER", "bulge", shown=entry.shown, most=_ROUNDEST)
    return bulge


def _ellipse(entry: Entry, units: Units) -> dict[str, Any]:
    half_axis = positive("E_ELLIPSE", units.coordinate)
    table = {
        "c": Field(vector(2, units.coordinate), "E_ELLIPSE"),
        "a": Field(half_axis, "E_ELLIPSE"),
        "b": Field(half_axis, "E_ELLIPSE"),
        "rot": Field(number),
        "cw": Field(flag),
    }
    values = whole(entry, table)
    a, b = values["a"], values["b"]
    if max(a, b) > _LONGEST_ELLIPSE * min(a, b):
        raise entry.refused("E_ELLIPSE", "thin", a=a, b=b, most=_LONGEST_ELLIPSE)
    rotation = values.get("rot", 0.0) * units.angle
    return {"centre": values["c"], "a": a, "b": b, "rotation": rotation, "clockwise": values.get("cw", False)}


def _curve(vertex: dict[str, Any], end: Floats, entry: Entry, units: Units) -> Curve:
    """Curve of the edge that leaves a vertex; what is wrong with it is written down."""
    start = vertex["p"]
    length = float(np.hypot(*(end - start)))
    if length < units.least_length:
        entry.refused("E_SHORT_EDGE", u=start[0], v=start[1], length=length, least=units.least_length, unit=units.unit)
        return Straight(start, end)
    if "bulge" in vertex:
        return Arc(start, end, vertex["bulge"])
    if "ellipse" not in vertex:
        return Straight(start, end)
    curve = EllipseArc(start, end, **vertex["ellipse"])
    for end_point in (start, end):
        off = abs(float(np.hypot(*curve.on_unit_circle(end_point))) - 1)
        if off > _OFF_ELLIPSE:
            entry.at("ellipse").refused("E_ELLIPSE", "off", u=end_point[0], v=end_point[1], percent=100 * off)
            break
    return curve
