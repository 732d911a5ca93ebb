"""Edges of plates by their numbers in the document: how many segments each has, and the edit of that."""

from collections.abc import Iterator

import numpy as np

from hullquad.plate import Document, Plate
from hullquad.triangulation.neighbours import Neighbours, neighbours
from hullquad.triangulation.sizes import element_size


def edge_counts(document: Document, plate_id: str, size: float | str | None = None) -> tuple[tuple[int, ...], ...]:
    """For each loop of a plane plate the number of segments of each edge of the document."""
    shared, sizes = sized(document, size)
    number = shared.numbers[plate_id]
    plate = shared.frame.plates[number]
    rows = [[0] * len(loop.curves) for loop in plate.loops]
    for wire, loop, edge in wires_of(shared, number):
        rows[loop][edge] = wire_count(shared, wire, sizes)
    return tuple(map(tuple, rows))


def redivided(document: Document, plate_id: str, loop: int, edge: int, number: int) -> Document:
    """The same document with an edge of a plane plate in so many segments, in its neighbours too.

    Other numbers that the document gives the same edge follow; 0 leaves the edge to the element size.
    """
    before, sizes = sized(document, None)
    changed = next(wire for wire, i, j in wires_of(before, before.numbers[plate_id]) if (i, j) == (loop, edge))
    same = {part.strand for part in before.strands.parts[changed]}
    others = [item for item in _given(before) if item[1] != changed and same & _strands(before, item[1])]
    for plate, _, i, j in others:
        document = document.with_plate(document.plate(plate.id).with_division(i, j, 0))
    document = document.with_plate(document.plate(plate_id).with_division(loop, edge, number))
    after, _ = sized(document, None)
    for plate, wire, i, j in others if number else ():
        common = [part.strand for part in before.strands.parts[wire] if part.strand in same]
        more = sum(after.count(strand, sizes) - before.count(strand, sizes) for strand in common)
        document = document.with_plate(document.plate(plate.id).with_division(i, j, plate.divisions[i][j] + more))
    return document


def sized(document: Document, size: float | str | None) -> tuple[Neighbours, list[float]]:
    """What the plane plates have in common, and the element size of each [mm]."""
    plates = tuple(plate for plate in document.plates if plate.is_plane)
    return neighbours(plates), [element_size(plate, size) for plate in plates]


def wires_of(shared: Neighbours, plate: int) -> Iterator[tuple[int, int, int]]:
    """Wires of a plate with the loop and the edge of the document."""
    first, last = np.searchsorted(shared.frame.plate_of, [plate, plate + 1])
    for number in range(int(first), int(last)):
        wire = shared.frame.wires[number]
        yield number, wire.loop, int(shared.frame.plates[plate].loops[wire.loop].edges[wire.edge])


def wire_count(shared: Neighbours, wire: int, sizes: list[float]) -> int:
    """Number of segments of an edge, for an element size of each of the plates [mm]."""
    return sum(shared.count(part.strand, sizes) for part in shared.strands.parts[wire])


def is_odd(shared: Neighbours, sizes: list[float], plate: int) -> bool:
    """Whether the contour of a plate has an odd number of segments, so that a triangle is unavoidable."""
    return bool(sum(wire_count(shared, wire, sizes) for wire, _, _ in wires_of(shared, plate)) % 2)


def _given(shared: Neighbours) -> Iterator[tuple[Plate, int, int, int]]:
    """Plate, wire, loop and edge of the document wherever it gives a number of divisions."""
    for number, plate in enumerate(shared.frame.plates):
        for wire, loop, edge in wires_of(shared, number) if plate.divisions else ():
            if plate.divisions[loop] and plate.divisions[loop][edge]:
                yield plate, wire, loop, edge


def _strands(shared: Neighbours, wire: int) -> set[int]:
    return {part.strand for part in shared.strands.parts[wire]}
