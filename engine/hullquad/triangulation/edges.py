"""Edges of a contour by their numbers in the document: how many segments each has, and what a change of it does."""

from collections.abc import Iterator
from functools import cache, partial

import attrs
import numpy as np

from hullquad.plate import Document, Plate
from hullquad.triangulation import division
from hullquad.triangulation.neighbours import Neighbours, neighbours
from hullquad.triangulation.sizes import element_size
from hullquad.triangulation.strands import lengths

_MOST_STRETCHED = 2.0
"""A segment may become so many times longer or shorter than it is."""
_DIGITS = 9
"""Of the logarithm of two lengths; the last ones are rounding, and must not decide."""


@attrs.frozen
class Remedy:
    """One segment more or fewer on an edge, so that a contour has an even number of them."""

    plate: str
    loop: int
    """0 for the outer one, then the holes."""
    edge: int
    """Number in the document of the edge of that loop."""
    before: int
    number: int
    """Segments of the edge."""
    neighbours: tuple[str, ...] = ()
    """Ids of other plates that get the change too."""
    odd: int = 0
    """Difference in the number of plates of the document that need a triangle: -1, at best -2."""


def edge_counts(document: Document, plate_id: str, size: float | str | None = None) -> tuple[tuple[int, ...], ...]:
    """For each loop of a plane plate the number of segments of each edge of the document."""
    shared, sizes = _shared(document, size)
    number = shared.numbers[plate_id]
    plate = shared.frame.plates[number]
    rows = [[0] * len(loop.curves) for loop in plate.loops]
    for wire, loop, edge in _wires(shared, number):
        rows[loop][edge] = _count(shared, wire, sizes)
    return tuple(map(tuple, rows))


def redivided(document: Document, plate_id: str, loop: int, edge: int, number: int) -> Document:
    """The same document with an edge of a plane plate in so many segments, in its neighbours too.

    Other numbers that the document gives the same edge follow; 0 leaves the edge to the element size.
    """
    before, sizes = _shared(document, None)
    changed = next(wire for wire, i, j in _wires(before, before.numbers[plate_id]) if (i, j) == (loop, edge))
    same = {part.strand for part in before.strands.parts[changed]}
    others = [item for item in _given(before) if item[1] != changed and same & _strands(before, item[1])]
    for plate, _, i, j in others:
        document = document.with_plate(document.plate(plate.id).with_division(i, j, 0))
    document = document.with_plate(document.plate(plate_id).with_division(loop, edge, number))
    after, _ = _shared(document, None)
    for plate, wire, i, j in others if number else ():
        common = [part.strand for part in before.strands.parts[wire] if part.strand in same]
        more = sum(after.count(strand, sizes) - before.count(strand, sizes) for strand in common)
        document = document.with_plate(document.plate(plate.id).with_division(i, j, plate.divisions[i][j] + more))
    return document


def remedy(document: Document, plate_id: str, size: float | str | None = None) -> Remedy | None:
    """The change of one edge by one segment that makes a contour even and suits the document best.

    It makes as many contours even as it can and as few odd; then the new segments nearest to the size are chosen. None
    for a contour that is even, or has no edge that can change.
    """
    shared, sizes = _shared(document, size)
    owner = shared.numbers[plate_id]
    is_odd = cache(partial(_is_odd, shared, sizes))
    if not is_odd(owner):
        return None
    best: tuple[tuple[float, ...], Remedy] | None = None
    for wire, loop, edge in _wires(shared, owner):
        before = _count(shared, wire, sizes)
        for number in (before + 1, before - 1):
            found = _changed(shared, wire, number, sizes)
            if found is None:
                continue
            plates, misfit = found
            difference = sum(-1 if is_odd(plate) else 1 for plate in plates)
            cost = (float(difference), len(plates), misfit, float(loop), float(edge), -float(number))
            names = tuple(shared.frame.plates[plate].id for plate in sorted(plates - {owner}))
            if best is None or cost < best[0]:
                best = cost, Remedy(plate_id, loop, edge, before, number, names, difference)
    return None if best is None else best[1]


def remedied(document: Document, change: Remedy) -> Document:
    """The document with a remedy carried out, in the neighbours too."""
    return redivided(document, change.plate, change.loop, change.edge, change.number)


def edge_place(document: Document, change: Remedy) -> str:
    """Path in the document of the edge that a remedy changes."""
    plate = document.plate(change.plate)
    return f"{plate.loops[change.loop].place}/{change.edge}"


def _shared(document: Document, size: float | str | None) -> tuple[Neighbours, list[float]]:
    plates = tuple(plate for plate in document.plates if plate.is_plane)
    return neighbours(plates), [element_size(plate, size) for plate in plates]


def _wires(shared: Neighbours, plate: int) -> Iterator[tuple[int, int, int]]:
    """Wires of a plate with the loop and the edge of the document."""
    first, last = np.searchsorted(shared.frame.plate_of, [plate, plate + 1])
    for number in range(int(first), int(last)):
        wire = shared.frame.wires[number]
        yield number, wire.loop, int(shared.frame.plates[plate].loops[wire.loop].edges[wire.edge])


def _given(shared: Neighbours) -> Iterator[tuple[Plate, int, int, int]]:
    """Plate, wire, loop and edge of the document wherever it gives a number of divisions."""
    for number, plate in enumerate(shared.frame.plates):
        for wire, loop, edge in _wires(shared, number) if plate.divisions else ():
            if plate.divisions[loop] and plate.divisions[loop][edge]:
                yield plate, wire, loop, edge


def _strands(shared: Neighbours, wire: int) -> set[int]:
    return {part.strand for part in shared.strands.parts[wire]}


def _count(shared: Neighbours, wire: int, sizes: list[float]) -> int:
    return sum(shared.count(part.strand, sizes) for part in shared.strands.parts[wire])


def _is_odd(shared: Neighbours, sizes: list[float], plate: int) -> bool:
    return bool(sum(_count(shared, wire, sizes) for wire, _, _ in _wires(shared, plate)) % 2)


def _changed(shared: Neighbours, wire: int, number: int, sizes: list[float]) -> tuple[set[int], float] | None:
    """Plates whose contours change between odd and even with a number of segments, and how far those miss the size.

    None where the edge cannot have that number.
    """
    parts = shared.strands.parts[wire]
    curve = shared.frame.wires[wire].curve
    ends = [lengths(shared.joints, wire, part.number) for part in parts]
    shares = division.shared_out(number, [end - start for start, end in ends])
    after = [division.turning_little(curve, *end, share) for end, share in zip(ends, shares, strict=True)]
    before = [shared.count(part.strand, sizes) for part in parts]
    if number < 1 or sum(after) != number:
        return None
    steps = [abs(np.log(new / old)) for new, old in zip(after, before, strict=True)]
    if max(steps) > np.log(_MOST_STRETCHED):
        return None
    misfits = [
        abs(np.log((end - start) / new / shared.size(part.strand, sizes)))
        for part, (start, end), new, old in zip(parts, ends, after, before, strict=True)
        if new != old
    ]
    flipped: set[int] = set()
    for part, new, old in zip(parts, after, before, strict=True):
        on_contours = {shared.frame.wires[other].plate for other, _ in shared.strands.strands[part.strand].parts}
        flipped ^= on_contours if (new - old) % 2 else set()
    return flipped, round(float(max(misfits)), _DIGITS)
