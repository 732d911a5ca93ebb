"""The plate document: `hullplate` version 1, in JSON."""

import hashlib
from collections.abc import Callable, Sequence
from contextlib import suppress
from functools import partial
from pathlib import Path
from typing import Any, TypeVar

import attrs
import numpy as np

from hullquad.errors import PlateError
from hullquad.formats.hullplate.concerns import concerns, division_concerns
from hullquad.formats.hullplate.defects import defects
from hullquad.formats.hullplate.entry import Entry, Field, Refused, anything, fields, positive, text, whole
from hullquad.formats.hullplate.json_text import decode, position
from hullquad.formats.hullplate.plate_entry import plate as plate_of
from hullquad.formats.source import content
from hullquad.plate import Document, Material, Notice, Plate
from hullquad.triangulation.contour import attempts, refuse_too_many

_VERSION = 1
_LENGTHS = {"mm": 1.0, "m": 1000.0}
_ANGLES = {"deg": np.pi / 180, "rad": 1.0}
_TONNES_PER_M3 = 1e-9
"""[t/mm3]; densities are in it when lengths are in metres."""

Finding = TypeVar("Finding", PlateError, Notice)


def read(path: Path) -> Document:
    """Every plate of a document.

    Raises
    ------
    FileError
        The file cannot be read.
    PlateError
        Something in the document is wrong: the first fault, `others` telling how many more there are.
    """
    document, faults = survey(path)
    if faults:
        raise _first(faults)
    return document


def survey(path: Path) -> tuple[Document, tuple[PlateError, ...]]:
    """Sound plates of a document, and the faults of the others in the order of the document.

    Raises
    ------
    FileError, PlateError
        Something is wrong that concerns every plate: the file, its units, its materials.
    """
    data = content(path)
    value = decode(data, str(path))
    _refuse_others(value)
    faults: list[PlateError] = []
    found = fields(Entry(value, "", faults), _table(value))
    if not all(fault.place.startswith("/plates/") for fault in faults):
        raise _first(_in_order(faults, value))
    document = Document(
        name=found["name"],
        materials=found["materials"],
        plates=tuple(found["plates"]),
        input_hash=hashlib.sha256(data).hexdigest(),
    )
    document, too_big, notices = _divided(document)
    document = attrs.evolve(document, warnings=_in_order(notices, value))
    return document, _in_order(faults + too_big, value)


def _first(faults: tuple[PlateError, ...]) -> PlateError:
    """First of the faults, which knows how many more there are."""
    first = faults[0]
    return PlateError(first.code, first.place, first.case, **first.numbers, others=len(faults) - 1)


def _in_order(findings: Sequence[Finding], value: Any) -> tuple[Finding, ...]:
    """Errors or warnings as their places follow each other in the document."""
    return tuple(sorted(findings, key=lambda finding: position(value, finding.place)))


def _refuse_others(value: Any) -> None:
    """Refuse what is no document of ours, before looking at what is in it."""
    top = Entry(value, "", [])
    if not isinstance(value, dict):
        raise PlateError("E_TYPE", "", "document", shown=top.shown)
    kind, version = (top.at(key, value.get(key)) for key in ("format", "version"))
    if kind.value != "hullplate":
        raise PlateError("E_FORMAT", kind.place, shown=kind.shown)
    if isinstance(version.value, bool) or version.value != _VERSION:
        is_newer = isinstance(version.value, int) and version.value > _VERSION
        raise PlateError("E_VERSION", version.place, "newer" if is_newer else "", shown=version.shown, known=_VERSION)


def _table(value: dict[str, Any]) -> dict[str, Field]:
    """Keys of a document; its plates are read in the units that it names."""
    length, angle = _scales(value.get("units"))
    named = value.get("materials")
    names = set(named) if isinstance(named, dict) else None
    units = {"length": Field(partial(_unit, _LENGTHS), "E_UNITS"), "angle": Field(partial(_unit, _ANGLES))}
    return {
        "format": Field(anything),
        "version": Field(anything),
        "name": Field(_name, "E_TYPE"),
        "units": Field(lambda entry: whole(entry, units), "E_UNITS"),
        "materials": Field(lambda entry: _materials(entry, length), "E_MATERIAL"),
        "plates": Field(
            lambda entry: _plates(entry, partial(plate_of, length=length, angle=angle, materials=names)), "E_EMPTY"
        ),
    }


def _scales(units: Any) -> tuple[float, float]:
    """Millimetres and radians per unit; those of mm and degrees where the units cannot be read."""
    named = units if isinstance(units, dict) else {}
    length, angle = str(named.get("length")), str(named.get("angle"))
    return _LENGTHS.get(length, 1.0), _ANGLES.get(angle, _ANGLES["deg"])


def _unit(known: dict[str, float], entry: Entry) -> str:
    if not isinstance(entry.value, str) or entry.value not in known:
        raise entry.refused("E_UNITS", shown=entry.shown, known=" or ".join(map(ascii, known)))
    return entry.value


def _name(entry: Entry) -> str:
    if not text(entry).strip():
        raise entry.refused("E_TYPE", "name")
    return str(entry.value)


def _materials(entry: Entry, length: float) -> dict[str, Material]:
    above_zero = positive("E_MATERIAL")
    density = positive("E_MATERIAL", 1.0 if length == 1 else _TONNES_PER_M3)
    table = {
        "E": Field(above_zero, "E_MATERIAL"),
        "nu": Field(_poisson, "E_MATERIAL"),
        "rho": Field(density, "E_MATERIAL"),
        "ReH": Field(above_zero),
    }
    if not isinstance(entry.value, dict):
        raise entry.refused("E_TYPE", "object", shown=entry.shown)
    rows = whole(entry, {name: Field(lambda item: whole(item, table)) for name in entry.value})
    return {name: Material(name, row["E"], row["nu"], row["rho"], row.get("ReH")) for name, row in rows.items()}


def _poisson(entry: Entry) -> float:
    value = positive("E_MATERIAL")(entry)
    if value >= 0.5:
        raise entry.refused("E_MATERIAL", "poisson", shown=entry.shown)
    return value


def _plates(entry: Entry, read_plate: Callable[[Entry], Plate]) -> list[Plate]:
    """Sound plates."""
    if not isinstance(entry.value, list):
        raise entry.refused("E_TYPE", "list", shown=entry.shown)
    if not entry.value:
        raise entry.refused("E_EMPTY")
    ids: set[str] = set()
    sound = []
    for i, described in enumerate(entry.value):
        faults = len(entry.faults)
        item = entry.at(i, described)
        with suppress(Refused):
            _refuse_known_id(item, ids)
            plate = read_plate(item)
            entry.faults.extend(defects(plate))
            sound.extend([plate] if len(entry.faults) == faults else [])
    return sound


def _refuse_known_id(entry: Entry, ids: set[str]) -> None:
    """Refuse an id that an earlier plate has."""
    name = entry.value.get("id") if isinstance(entry.value, dict) else None
    if isinstance(name, str):
        if name in ids:
            entry.at("id").refused("E_DUP_ID", shown=ascii(name))
        ids.add(name)


def _divided(document: Document) -> tuple[Document, list[PlateError], list[Notice]]:
    """Document without the plates that are too big, the errors of these, and the warnings about the others."""
    contours = attempts(document)
    too_big: list[PlateError] = []
    notices: list[Notice] = []
    kept = []
    for plate in document.plates:
        outcome = contours[plate.id] if plate.is_plane else _too_big(plate)
        if isinstance(outcome, PlateError) and outcome.code == "E_TOO_BIG":
            too_big.append(outcome)
        else:
            kept.append(plate)
            notices += [*concerns(plate), *division_concerns(plate, outcome)]
    return attrs.evolve(document, plates=tuple(kept)), too_big, notices


def _too_big(plate: Plate) -> PlateError | None:
    """Error of a curved plate with too many elements; where the coordinates are no lengths, nobody can tell."""
    try:
        refuse_too_many(plate, np.inf if plate.is_parametric else plate.target_size)
    except PlateError as error:
        return error
    return None
