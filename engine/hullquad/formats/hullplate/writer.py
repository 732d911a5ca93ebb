"""Plate documents written: what is read again is the same, bit for bit."""

import hashlib
import json
from collections.abc import Iterable, Mapping
from pathlib import Path
from typing import Any

import attrs
import numpy as np

from hullquad import __version__
from hullquad.arrays import Floats
from hullquad.curves import Arc, Curve, EllipseArc
from hullquad.formats import atomic
from hullquad.formats.hullplate.scales import ANGLES, LENGTHS, density, unscaled
from hullquad.plate import Document, Line, Loop, Material, Plate, Sizes
from hullquad.surface import Bezier, Cylinder, Plane

VERSION = 1
_WIDTH = 110
"""Letters in a line; what needs more is written over several."""
_LARGEST_WHOLE = 1e15


def write(document: Document, path: Path) -> None:
    """Put a document into a file, whole or not at all.

    Raises
    ------
    FileError
        It cannot be written; an existing file is as it was.
    """
    atomic.write(path, _content(document))


def signed(document: Document) -> Document:
    """The document with the hash of the file that it is written to: of one that is not as any file has it."""
    return attrs.evolve(document, input_hash=hashlib.sha256(_content(document)).hexdigest())


def _content(document: Document) -> bytes:
    return (_text(described(document)) + "\n").encode("utf-8")


def described(document: Document) -> dict[str, Any]:
    """The document as its JSON value, in its own units; what has nothing to say is left out."""
    units = _Units(LENGTHS[document.length_unit], ANGLES[document.angle_unit])
    return {
        "format": "hullplate",
        "version": VERSION,
        "program": f"hullquad {__version__}",
        "name": document.name,
        "units": {"length": document.length_unit, "angle": document.angle_unit},
        "materials": {name: _material(material, units) for name, material in document.materials.items()},
        "plates": [_plate(plate, units) for plate in document.plates],
    }


@attrs.frozen
class _Units:
    """Millimetres and radians per unit of the document; of coordinates in a plate too, which may be parameters."""

    length: float
    angle: float
    coordinate: float = 0.0

    def lengths(self, values: Iterable[float]) -> list[float]:
        return [_number(unscaled(value, self.length)) for value in values]

    def point(self, point: Floats) -> list[float]:
        return [_number(unscaled(value, self.coordinate)) for value in point]


def _material(material: Material, units: _Units) -> dict[str, float]:
    values = {
        "E": material.elasticity,
        "nu": material.poisson,
        "rho": unscaled(material.density, density(units.length)),
    }
    return values if material.yield_strength is None else values | {"ReH": material.yield_strength}


def _plate(plate: Plate, units: _Units) -> dict[str, Any]:
    units = attrs.evolve(units, coordinate=1.0 if plate.is_parametric else units.length)
    texts = {"title": plate.title, "drawing": plate.drawing, "notes": plate.notes}
    (thickness,) = units.lengths([plate.thickness])
    frame = plate.surface if isinstance(plate.surface, Plane) else plate.surface.frame
    found: dict[str, Any] = {"id": plate.id, **texts, "thickness": thickness, "material": plate.material}
    found["frame"] = {"origin": units.lengths(frame.origin), "u": _numbers(frame.u), "v": _numbers(frame.v)}
    found |= _surface(plate, units)
    found["outer"] = _loop(plate.outer, units)
    found["holes"] = [_loop(hole, units) for hole in plate.holes]
    found["stiffeners"] = [_line(line, units) for line in plate.stiffeners]
    found["seams"] = [_line(line, units) for line in plate.seams]
    found["fixed"] = [units.point(point) for point in plate.fixed]
    found["divisions"] = _divisions(plate)
    (found["target_size"],) = units.lengths([plate.target_size])
    found["sizes"] = _sizes(plate, units)
    return {key: value for key, value in found.items() if value}


def _surface(plate: Plate, units: _Units) -> dict[str, Any]:
    surface = plate.surface
    if isinstance(surface, Cylinder):
        (radius,) = units.lengths([surface.radius])
        angle = _number(unscaled(surface.start_angle, units.angle))
        shape: dict[str, Any] = {"type": "cylinder", "radius": radius, "axis": "u", "start_angle": angle}
    elif isinstance(surface, Bezier):
        rows, columns = (count - 1 for count in surface.control.shape[:2])
        control = [[units.lengths(point) for point in row] for row in surface.control]
        shape = {"type": "bezier", "degree": [columns, rows], "control": control}
    else:
        return {}
    shape |= {"note": surface.note} if surface.note else {}
    return {"surface": shape, "param": True} if plate.is_parametric else {"surface": shape}


def _loop(loop: Loop, units: _Units) -> list[dict[str, Any]]:
    """Vertices in the order, and the sense, of the document."""
    is_turned = not np.array_equal(loop.edges, loop.vertices)
    curves = [loop.curves[i] for i in np.argsort(loop.edges)]
    return [_vertex(curve.reversed() if is_turned else curve, units) for curve in curves]


def _vertex(curve: Curve, units: _Units) -> dict[str, Any]:
    """Where a curve starts, and what makes it round."""
    start = {"p": units.point(curve.start)}
    if isinstance(curve, Arc):
        return start | {"bulge": _number(curve.bulge)}
    if not isinstance(curve, EllipseArc):
        return start
    a, b = units.point(np.array([curve.a, curve.b]))
    ellipse = {"c": units.point(curve.centre), "a": a, "b": b, "rot": _number(unscaled(curve.rotation, units.angle))}
    return start | {"ellipse": ellipse | {"cw": curve.clockwise}}


def _line(line: Line, units: _Units) -> dict[str, Any]:
    ends: dict[str, Any] = {"a": units.point(line.a), "b": units.point(line.b)}
    return ends | {"profile": line.profile} if line.profile else ends


def _divisions(plate: Plate) -> dict[str, Any]:
    """Numbers of the loops that have some; null for an edge that is divided by size."""
    rows = [[number or None for number in numbers] for numbers in plate.divisions]
    found: dict[str, Any] = {"outer": rows[0]} if rows and rows[0] else {}
    return found | {"holes": rows[1:]} if any(rows[1:]) else found


def _sizes(plate: Plate, units: _Units) -> dict[str, float]:
    """Sizes that do not follow from the target size."""
    implied = attrs.asdict(Sizes.of(plate.target_size))
    given: Mapping[str, float] = attrs.asdict(plate.sizes)
    names = [name for name in given if given[name] != implied[name]]
    return dict(zip(names, units.lengths(given[name] for name in names), strict=True))


def _numbers(values: Floats) -> list[float]:
    return [_number(value) for value in values]


def _number(value: float) -> float:
    """The number without a fraction where it has none; but minus zero keeps its sign."""
    value = float(value)
    is_whole = value.is_integer() and abs(value) < _LARGEST_WHOLE and not (value == 0 and np.signbit(value))
    return int(value) if is_whole else value


def _text(value: Any, margin: str = "") -> str:
    """JSON text, each object or list in one line where it fits."""
    line = json.dumps(value, ensure_ascii=False, allow_nan=False)
    if not isinstance(value, dict | list) or len(margin) + len(line) <= _WIDTH:
        return line
    inner = margin + " "
    if isinstance(value, dict):
        items = [f"{json.dumps(key, ensure_ascii=False)}: {_text(item, inner)}" for key, item in value.items()]
        return "{\n" + ",\n".join(inner + item for item in items) + "\n" + margin + "}"
    return "[\n" + ",\n".join(inner + _text(item, inner) for item in value) + "\n" + margin + "]"
