"""Parts of edges between joints: what several plates have in common is one strand, divided once for all of them."""

from collections.abc import Iterator, Sequence

import attrs
import numpy as np

from hullquad.arrays import Floats
from hullquad.plate import JOIN
from hullquad.triangulation.joints import Joints
from hullquad.triangulation.standing import heights, is_inside, plane_of
from hullquad.triangulation.wireframe import Wireframe

_PROBES = np.array([0.25, 0.5, 0.75])


@attrs.frozen(eq=False)
class Part:
    """A part of an edge between two breaks that follow each other."""

    wire: int
    number: int
    """Of the part on its wire, from the start."""
    strand: int
    is_backwards: bool
    """True where the strand runs the other way."""


@attrs.frozen(eq=False)
class Strand:
    """A line in space between two joints, of one or more plates."""

    joints: tuple[int, int]
    """From the first to the second."""
    parts: tuple[tuple[int, int], ...]
    """Wire and number of each part that lies on it; the first one gives it its shape."""
    faces: tuple[int, ...] = ()
    """Plates on whose faces it stands."""


@attrs.frozen(eq=False)
class Strands:
    """All strands of a document, and which of them the plates have."""

    strands: tuple[Strand, ...]
    parts: tuple[tuple[Part, ...], ...]
    """Of each wire, from start to end."""
    standing: tuple[tuple[Part, ...], ...]
    """Of each plate, the parts of others' edges that stand on its face."""


def strands(frame: Wireframe, met: Joints) -> Strands:
    """Strands between the joints of a wireframe."""
    probes = _probes(frame, met)
    found: list[list[tuple[int, int]]] = []
    ways: list[tuple[int, int]] = []
    alike: dict[tuple[int, int], list[int]] = {}
    parts: list[tuple[Part, ...]] = []
    for wire, breaks in enumerate(met.breaks):
        row = []
        for number in range(len(breaks) - 1):
            way = breaks[number].joint, breaks[number + 1].joint
            known = alike.setdefault((min(way), max(way)), [])
            same = (k for k in known if _lies_along(probes, found[k][0], (wire, number), turned=ways[k] != way))
            strand = next(same, len(found))
            if strand == len(found):
                known.append(strand)
                found.append([])
                ways.append(way)
            found[strand].append((wire, number))
            row.append(Part(wire, number, strand, ways[strand] != way))
        parts.append(tuple(row))
    standing = tuple(_standing(frame, met, plate, parts, probes) for plate in range(len(frame.plates)))
    faces: list[list[int]] = [[] for _ in found]
    for plate, on_face in enumerate(standing):
        for part in on_face:
            faces[part.strand].append(plate)
    rows = zip(ways, found, faces, strict=True)
    return Strands(tuple(Strand(way, tuple(on), tuple(below)) for way, on, below in rows), tuple(parts), standing)


def lengths(met: Joints, wire: int, number: int) -> tuple[float, float]:
    """Where a part starts and ends on its wire [mm]."""
    return met.breaks[wire][number].length, met.breaks[wire][number + 1].length


def _probes(frame: Wireframe, met: Joints) -> list[Floats]:
    """(P, 3, 3) of each wire, points along each of its parts."""
    rows = []
    for wire, breaks in zip(frame.wires, met.breaks, strict=True):
        ends = np.array([item.length for item in breaks])
        at = ends[:-1, None] + np.diff(ends)[:, None] * _PROBES
        rows.append(wire.points(at.ravel()).reshape(-1, 3, 3))
    return rows


def _lies_along(probes: Sequence[Floats], one: tuple[int, int], other: tuple[int, int], *, turned: bool) -> bool:
    """Whether two parts between the same joints are one line, within the tolerance."""
    here, there = probes[one[0]][one[1]], probes[other[0]][other[1]]
    away = np.linalg.norm(here - (there[::-1] if turned else there), axis=1)
    return bool(away.max() <= JOIN)


def _standing(
    frame: Wireframe, met: Joints, plate: int, parts: Sequence[Sequence[Part]], probes: Sequence[Floats]
) -> tuple[Part, ...]:
    """Parts of edges on the face of a plate, in the order of the document; of those on one strand the first."""
    known = set(_joints_of(frame, met, plate))
    own = {part.strand for wire in _wires_of(frame, plate) for part in parts[wire]}
    found: dict[int, Part] = {}
    candidates = [part for wire in met.standing[plate] for part in parts[wire] if part.strand not in own]
    for part in candidates:
        points = probes[part.wire][part.number]
        ends = {met.breaks[part.wire][i].joint for i in (part.number, part.number + 1)}
        if ends <= known and _is_on_face(frame, plate, points):
            found.setdefault(part.strand, part)
    return tuple(found.values())


def _is_on_face(frame: Wireframe, plate: int, points: Floats) -> bool:
    owner = frame.plates[plate]
    feet = plane_of(owner).parameters(points)
    return bool(is_inside(owner, feet).all() and (heights(owner, points) <= JOIN).all())


def _wires_of(frame: Wireframe, plate: int) -> range:
    first, last = np.searchsorted(frame.plate_of, [plate, plate + 1])
    return range(int(first), int(last))


def _joints_of(frame: Wireframe, met: Joints, plate: int) -> Iterator[int]:
    yield from (item.joint for wire in _wires_of(frame, plate) for item in met.breaks[wire])
    yield from (item.joint for item in met.inside[plate])
