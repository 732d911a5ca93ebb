"""The plate document: `hullplate` version 1, in JSON."""

import hashlib
from collections.abc import Callable, Iterator, Sequence
from contextlib import suppress
from functools import partial
from itertools import groupby
from pathlib import Path
from typing import Any, TypeVar

import attrs

from hullquad.documents.entry import Entry, Field, Refused, anything, fields, positive, text, whole
from hullquad.documents.json_text import Positions, decode
from hullquad.errors import PlateError
from hullquad.formats.hullplate.concerns import concerns
from hullquad.formats.hullplate.defects import defects, size_defects
from hullquad.formats.hullplate.plate_entry import is_id
from hullquad.formats.hullplate.plate_entry import plate as plate_of
from hullquad.formats.hullplate.scales import ANGLES, LENGTHS
from hullquad.formats.hullplate.scales import density as density_scale
from hullquad.formats.hullplate.writer import VERSION, signed, write
from hullquad.formats.source import content
from hullquad.plate import Document, Material, Notice, Plate, Refusal
from hullquad.triangulation.concerns import concerns_of, gap_concerns, size_concerns
from hullquad.triangulation.contour import attempts
from hullquad.triangulation.neighbours import neighbours

__all__ = ["concerns", "read", "signed", "survey", "write"]

Finding = TypeVar("Finding", PlateError, Notice)


def read(path: Path) -> Document:
    """Every plate of a document, with the warnings about meshes of its target sizes.

    Raises
    ------
    FileError
        The file cannot be read.
    PlateError
        Something in the document is wrong: the first fault, `others` telling how many more there are.
    """
    document, refusals, positions = _surveyed(path)
    if refusals:
        others = sum(refusal.error.others + 1 for refusal in refusals) - 1
        raise refusals[0].error.among(others)
    notices = [*document.warnings, *_at_target_size(document)]
    return attrs.evolve(document, warnings=_in_order(notices, positions))


def survey(path: Path) -> tuple[Document, tuple[Refusal, ...]]:
    """Sound plates of a document, with the warnings that hold for any size, and the others in their order.

    Raises
    ------
    FileError, PlateError
        Something is wrong that concerns every plate: the file, its units, its materials, an id given twice.
    """
    document, refusals, _ = _surveyed(path)
    return document, refusals


def _surveyed(path: Path) -> tuple[Document, tuple[Refusal, ...], Positions]:
    data = content(path)
    value = decode(data, str(path))
    _refuse_others(value)
    faults: list[PlateError] = []
    found = fields(Entry(value, "", faults), _table(value))
    positions = Positions(value)
    in_order = _in_order(faults, positions)
    if not all(map(_concerns_one_plate, in_order)):
        raise in_order[0].among(len(in_order) - 1)
    conflicts = _conflicts(found["plates"])
    in_order = _in_order([*faults, *conflicts.values()], positions)
    document = Document(
        name=found["name"],
        materials=found["materials"],
        plates=tuple(plate for plate in found["plates"] if plate.id not in conflicts),
        input_hash=hashlib.sha256(data).hexdigest(),
        length_unit=found["units"].get("length", "mm"),
        angle_unit=found["units"].get("angle", "deg"),
    )
    notices = [notice for plate in document.plates for notice in concerns(plate)]
    notices += gap_concerns(document)
    document = attrs.evolve(document, warnings=_in_order(notices, positions))
    return document, tuple(_refusals(in_order, value["plates"])), positions


def _concerns_one_plate(fault: PlateError) -> bool:
    """Whether the other plates can be used in spite of a fault; of an id given twice, nobody knows which is meant."""
    return fault.place.startswith("/plates/") and fault.code != "E_DUP_ID"


def _conflicts(plates: Sequence[Plate]) -> dict[str, PlateError]:
    """By plate id: numbers of divisions that an earlier plate on the same edge forbids."""
    return neighbours(tuple(plate for plate in plates if plate.is_plane)).wishes.conflicts


def _refusals(faults: Sequence[PlateError], plates: list[Any]) -> Iterator[Refusal]:
    """One refusal for each plate with faults: its first fault, which knows how many more it has."""
    for number, group in groupby(faults, key=lambda fault: int(fault.place.split("/")[2])):
        first, *others = group
        name = plates[number].get("id") if isinstance(plates[number], dict) else None
        yield Refusal(str(name) if is_id(name) else "", f"/plates/{number}", first.among(len(others)))


def _at_target_size(document: Document) -> Iterator[Notice]:
    """Warnings about meshes of the plates' target sizes."""
    outcomes = attempts(document)
    for plate in document.plates:
        outcome = outcomes.get(plate.id)
        if outcome is None:
            yield from size_concerns(plate, plate.target_size)
        elif isinstance(outcome, PlateError):
            yield from size_concerns(plate, plate.target_size)
            yield Notice("W_COARSE", outcome.place, outcome.case, outcome.numbers)
        else:
            yield from concerns_of(document, None, outcome)


def _in_order(findings: Sequence[Finding], positions: Positions) -> tuple[Finding, ...]:
    """Errors or warnings as their places follow each other in the document."""
    return tuple(sorted(findings, key=lambda finding: positions(finding.place)))


def _refuse_others(value: Any) -> None:
    """Refuse what is no document of ours, before looking at what is in it."""
    top = Entry(value, "", [])
    if not isinstance(value, dict):
        raise PlateError("E_TYPE", "", "document", shown=top.shown)
    kind, version = (top.at(key, value.get(key)) for key in ("format", "version"))
    if kind.value != "hullplate":
        raise PlateError("E_FORMAT", kind.place, shown=kind.shown)
    if isinstance(version.value, bool) or version.value != VERSION:
        is_newer = isinstance(version.value, int) and version.value > VERSION
        raise PlateError("E_VERSION", version.place, "newer" if is_newer else "", shown=version.shown, known=VERSION)


def _table(value: dict[str, Any]) -> dict[str, Field]:
    """Keys of a document; its plates are read in the units that it names."""
    length, angle = _scales(value.get("units"))
    named = value.get("materials")
    names = named if isinstance(named, dict) else None
    units = {"length": Field(partial(_unit, LENGTHS), "E_UNITS"), "angle": Field(partial(_unit, ANGLES))}
    return {
        "format": Field(anything),
        "version": Field(anything),
        "program": Field(text),
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
    return LENGTHS.get(length, 1.0), ANGLES.get(angle, ANGLES["deg"])


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
    density = positive("E_MATERIAL", density_scale(length))
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
            entry.faults.extend(size_defects(plate) if len(entry.faults) == faults else [])
            sound.extend([plate] if len(entry.faults) == faults else [])
    return sound


def _refuse_known_id(entry: Entry, ids: set[str]) -> None:
    """Refuse an id that an earlier plate has."""
    name = entry.value.get("id") if isinstance(entry.value, dict) else None
    if isinstance(name, str):
        if name in ids:
            entry.at("id").refused("E_DUP_ID", shown=ascii(name))
        ids.add(name)
