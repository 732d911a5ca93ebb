"""Frame and surface of a plate of a hullplate document."""

from collections.abc import Callable
from typing import Any

import numpy as np

from hullquad.arrays import Floats
from hullquad.documents.entry import Entry, Field, anything, items, number, positive, text, whole
from hullquad.formats.hullplate.loop_entry import Units, vector
from hullquad.surface import Bezier, Cylinder, Plane, Surface

_ORTHONORMAL = 1e-6
"""How far axes may be from unit length, and from square to each other."""
_EXACT = 1e-14
"""Axes as near as this to orthonormal are so but for rounding, and keep their bits."""


def frame(units: Units) -> Callable[[Entry], Plane]:
    """Reader of a frame: origin and two axes."""
    table = {
        "origin": Field(vector(3, units.length), "E_FRAME"),
        "u": Field(vector(3), "E_FRAME"),
        "v": Field(vector(3), "E_FRAME"),
    }

    def read(entry: Entry) -> Plane:
        values = whole(entry, table)
        axes = np.stack([values["u"], values["v"]])
        lengths, dot = np.hypot.reduce(axes, axis=1), float(axes[0] @ axes[1])
        if max(*np.abs(lengths - 1), abs(dot)) > _ORTHONORMAL:
            raise entry.refused("E_FRAME", u=lengths[0], v=lengths[1], dot=dot)
        return Plane(values["origin"], *_orthonormal(axes))

    return read


def _orthonormal(axes: Floats) -> Floats:
    """Nearest two axes of unit length and square to each other: documents have few decimals, planes need all."""
    if np.abs(axes @ axes.T - np.eye(2)).max() <= _EXACT:
        return axes
    left, _, right = np.linalg.svd(axes, full_matrices=False)
    return np.asarray(left @ right)


def surface(entry: Entry, plane: Plane, units: Units) -> Surface:
    """Surface of a plate that has one beside its frame."""
    if not isinstance(entry.value, dict):
        raise entry.refused("E_TYPE", "object", shown=entry.shown)
    kind = entry.at("type", entry.value.get("type"))
    if not isinstance(kind.value, str) or kind.value not in _KINDS:
        raise kind.refused("E_SURFACE", "type", shown=kind.shown, known=", ".join(_KINDS))
    return _KINDS[kind.value](entry, plane, units)


def is_bezier(plate: Any) -> bool:
    """Tell whether a plate, still as it was decoded, is a Bezier patch."""
    described = plate.get("surface") if isinstance(plate, dict) else None
    return isinstance(described, dict) and described.get("type") == "bezier"


def _cylinder(entry: Entry, plane: Plane, units: Units) -> Cylinder:
    table = {
        "type": Field(anything),
        "radius": Field(positive("E_SURFACE", units.length), "E_SURFACE"),
        "axis": Field(_axis),
        "start_angle": Field(number, "E_SURFACE"),
        "note": Field(text),
    }
    values = whole(entry, table)
    return Cylinder(plane, values["radius"], values["start_angle"] * units.angle, values.get("note", ""))


def _axis(entry: Entry) -> str:
    if entry.value != "u":
        raise entry.refused("E_SURFACE", "axis", shown=entry.shown)
    return "u"


def _bezier(entry: Entry, plane: Plane, units: Units) -> Bezier:
    table = {
        "type": Field(anything),
        "degree": Field(lambda item: items(item, _degree), "E_SURFACE"),
        "control": Field(_grid(units), "E_SURFACE"),
        "note": Field(text),
    }
    values = whole(entry, table)
    degree, control = values["degree"], values["control"]
    if len(degree) != 2:
        raise entry.at("degree").refused("E_SURFACE", "degree", shown=str(degree))
    if control.shape != (degree[1] + 1, degree[0] + 1, 3):
        raise entry.at("control").refused("E_SURFACE", "control", rows=degree[1] + 1, columns=degree[0] + 1)
    return Bezier(control, plane, values.get("note", ""))


def _degree(entry: Entry) -> int:
    value = number(entry)
    if value < 1 or value != int(value):
        raise entry.refused("E_SURFACE", "degree", shown=entry.shown)
    return int(value)


def _grid(units: Units) -> Callable[[Entry], Floats]:
    """Reader of rows of control points, all of one length."""

    def read(entry: Entry) -> Floats:
        rows = items(entry, lambda row: items(row, vector(3, units.length)))
        if len({len(row) for row in rows}) != 1 or not rows[0]:
            raise entry.refused("E_SURFACE", "grid")
        return np.array(rows)

    return read


_KINDS: dict[str, Callable[[Entry, Plane, Units], Surface]] = {"cylinder": _cylinder, "bezier": _bezier}
