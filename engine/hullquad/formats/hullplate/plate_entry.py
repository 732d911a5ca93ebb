"""One plate of a hullplate document: its keys, and what they mean."""

import re
from collections.abc import Callable, Collection
from functools import partial
from itertools import islice
from typing import Any

import numpy as np

from hullquad.arrays import Floats
from hullquad.documents.entry import (
    Entry,
    Field,
    Refused,
    anything,
    fields,
    flag,
    items,
    number,
    positive,
    text,
    whole,
)
from hullquad.formats.hullplate.loop_entry import Units, loop, point
from hullquad.formats.hullplate.surface_entry import frame, is_bezier, surface
from hullquad.plate import Line, Plate, Sizes
from hullquad.surface import Bezier, Plane

_ID = re.compile(r"[\w.\-]{1,64}")
_MOST_DIVISIONS = 100_000
_MOST_TOLD = 20
_AS_THEY_ARE = ("id", "title", "drawing", "notes", "thickness", "material", "outer", "target_size")
_STAND_INS: dict[str, Any] = {
    "id": "",
    "title": "",
    "drawing": "",
    "notes": "",
    "thickness": 1.0,
    "material": "",
    "frame": Plane([0, 0, 0], [1, 0, 0], [0, 1, 0]),
    "holes": [],
    "stiffeners": [],
    "seams": [],
    "fixed": [],
    "divisions": {},
    "target_size": 1.0,
    "sizes": {},
}
"""What a plate has where nothing is given, and where what is given was refused."""
_NO_PATCH = Bezier(np.zeros((2, 2, 3)))


def plate(entry: Entry, length: float, angle: float, materials: Collection[str] | None) -> Plate:
    """Plate as far as it can be read; what is wrong is written down, and stands for something harmless.

    Parameters
    ----------
    entry : Entry
        The plate's object.
    length, angle : float
        Millimetres and radians per unit of the document.
    materials : collection of str, optional
        Names of the document's materials, when they can be read.

    Raises
    ------
    Refused
        It has no contour that could be looked at.
    """
    units = _units(entry, length, angle)
    values = fields(entry, _table(units, materials))
    if "frame" in values and "surface" in values:
        _read_surface(entry, values, units)
    _check_param(entry, units)
    if "outer" not in values:
        raise Refused
    if "holes" in values or "holes" not in entry.value:
        _check_divisions(entry, values)
    return _assembled(entry, _STAND_INS | values, units)


def is_id(value: Any) -> bool:
    """Whether a value of a document can be the id of a plate."""
    return isinstance(value, str) and _ID.fullmatch(value) is not None


def _units(entry: Entry, length: float, angle: float) -> Units:
    """Units of the plate; the coordinates of a Bezier patch are no lengths."""
    parametric = is_bezier(entry.value)
    return Units(1.0 if parametric else length, length, angle, parametric)


def _table(units: Units, materials: Collection[str] | None) -> dict[str, Field]:
    """Every key of a plate, in the order in which missing ones are told."""
    size = Field(positive("E_SIZE", units.length))
    sizes = dict.fromkeys(("coarse", "fine", "very_fine"), size)
    return {
        "id": Field(_id, "E_ID"),
        "title": Field(text),
        "drawing": Field(text),
        "notes": Field(text),
        "thickness": Field(positive("E_THICKNESS", units.length), "E_THICKNESS"),
        "material": Field(partial(_material, materials=materials), "E_MATERIAL"),
        "frame": Field(frame(units), "E_FRAME"),
        "surface": Field(anything),
        "param": Field(flag),
        "outer": Field(loop(units, is_hole=False), "E_OUTER"),
        "holes": Field(lambda entry: items(entry, loop(units, is_hole=True))),
        "stiffeners": Field(lambda entry: items(entry, _line(units, "profile"))),
        "seams": Field(lambda entry: items(entry, _line(units))),
        "fixed": Field(lambda entry: items(entry, point(units))),
        "divisions": Field(_divisions),
        "target_size": Field(positive("E_SIZE", units.length), "E_SIZE"),
        "sizes": Field(lambda entry: whole(entry, sizes)),
    }


def _id(entry: Entry) -> str:
    if not is_id(entry.value):
        raise entry.refused("E_ID", shown=entry.shown)
    return str(entry.value)


def _material(entry: Entry, materials: Collection[str] | None) -> str:
    name = text(entry)
    if materials is not None and name not in materials:
        known = ", ".join([*map(ascii, islice(materials, _MOST_TOLD)), *["..."][: len(materials) > _MOST_TOLD]])
        raise entry.refused("E_MATERIAL", "unknown" if known else "none", shown=entry.shown, known=known)
    return name


def _line(units: Units, *further: str) -> Callable[[Entry], Line]:
    """Reader of a line with ends `a` and `b`."""
    end = Field(point(units), "E_POINT")
    table = {"a": end, "b": end} | dict.fromkeys(further, Field(text))

    def read(entry: Entry) -> Line:
        values = whole(entry, table)
        length = float(np.hypot(*(values["b"] - values["a"])))
        if length < units.least_length:
            u, v = values["a"]
            raise entry.refused("E_SHORT_LINE", u=u, v=v, length=length, least=units.least_length, unit=units.unit)
        return Line(place=entry.place, **values)

    return read


def _divisions(entry: Entry) -> dict[str, Any]:
    numbers = partial(items, read=_division)
    return whole(entry, {"outer": Field(numbers), "holes": Field(lambda item: items(item, numbers))})


def _division(entry: Entry) -> int:
    if entry.value is None:
        return 0  # by size
    value = number(entry)
    if value != int(value) or not 1 <= value <= _MOST_DIVISIONS:
        raise entry.refused("E_DIVISIONS", shown=entry.shown, most=_MOST_DIVISIONS)
    return int(value)


def _read_surface(entry: Entry, values: dict[str, Any], units: Units) -> None:
    try:
        values["surface"] = surface(entry.at("surface", values["surface"]), values["frame"], units)
    except Refused:
        del values["surface"]


def _check_param(entry: Entry, units: Units) -> None:
    if entry.value.get("param") is True and not units.parametric:
        entry.at("param").refused("E_SURFACE", "param")


def _check_divisions(entry: Entry, values: dict[str, Any]) -> None:
    """Refuse divisions that are not one number per edge."""
    divisions = values.get("divisions", {})
    below = entry.at("divisions")
    if "outer" in divisions:
        _check_count(below.at("outer"), "edges", divisions["outer"], values["outer"].curves)
    if "holes" in divisions:
        holes = values.get("holes", [])
        _check_count(below.at("holes"), "holes", divisions["holes"], holes)
        for i, (numbers, hole) in enumerate(zip(divisions["holes"], holes, strict=False)):
            _check_count(below.at("holes").at(i), "edges", numbers, hole.curves)


def _check_count(entry: Entry, case: str, numbers: list[Any], things: Any) -> None:
    if len(numbers) != len(things):
        entry.refused("E_DIVISIONS", case, count=len(numbers), wanted=len(things))


def _assembled(entry: Entry, values: dict[str, Any], units: Units) -> Plate:
    holes, divisions = values["holes"], values["divisions"]
    by_loop = [divisions.get("outer", []), *divisions.get("holes", [[]] * len(holes))]
    described = values.get("surface", _NO_PATCH if units.parametric else values["frame"])
    return Plate(
        **{key: values[key] for key in _AS_THEY_ARE},
        surface=values["frame"] if isinstance(described, dict) else described,
        holes=tuple(holes),
        stiffeners=tuple(values["stiffeners"]),
        seams=tuple(values["seams"]),
        fixed=_stacked(values["fixed"]),
        divisions=tuple(tuple(numbers) for numbers in by_loop),
        sizes=Sizes.of(values["target_size"], **values["sizes"]),
        place=entry.place,
    )


def _stacked(points: list[Floats]) -> Floats:
    return np.array(points).reshape(-1, 2)
