"""What makes an odd contour even: one segment more or fewer on an edge."""

from collections.abc import Iterator
from functools import cache, partial

import attrs
import numpy as np

from hullquad.plate import Document
from hullquad.triangulation import division
from hullquad.triangulation.edges import is_odd, redivided, sized, wire_count, wires_of
from hullquad.triangulation.neighbours import Neighbours
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


def remedy(document: Document, plate_id: str, size: float | str | None = None) -> Remedy | None:
    """The change of one edge by one segment that makes a contour even and suits the document best.

    It makes as many contours even as it can and as few odd; then the new segments nearest to the size are chosen. None
    for a contour that is even, or has no edge that can change.
    """
    shared, sizes = sized(document, size)
    owner = shared.numbers[plate_id]
    known = cache(partial(is_odd, shared, sizes))
    if not known(owner):
        return None
    found = [
        (sum(-1 if known(plate) else 1 for plate in flipped), len(flipped), misfit, change)
        for flipped, misfit, change in changes(shared, sizes, owner)
    ]
    if not found:
        return None
    difference, _, _, change = min(found, key=lambda item: (*item[:3], item[3].loop, item[3].edge, -item[3].number))
    return attrs.evolve(change, odd=difference)


def remedied(document: Document, change: Remedy) -> Document:
    """The document with a remedy carried out, in the neighbours too."""
    return redivided(document, change.plate, change.loop, change.edge, change.number)


def edge_place(document: Document, change: Remedy) -> str:
    """Path in the document of the edge that a remedy changes."""
    plate = document.plate(change.plate)
    return f"{plate.loops[change.loop].place}/{change.edge}"


def changes(shared: Neighbours, sizes: list[float], plate: int) -> Iterator[tuple[set[int], float, Remedy]]:
    """Every change of an edge by one segment: the plates whose contours it makes odd or even, and its misfit."""
    name = shared.frame.plates[plate].id
    for wire, loop, edge in wires_of(shared, plate):
        before = wire_count(shared, wire, sizes)
        for number in (before + 1, before - 1):
            found = _changed(shared, wire, number, sizes)
            if found is not None:
                flipped, misfit = found
                others = tuple(shared.frame.plates[other].id for other in sorted(flipped - {plate}))
                yield flipped, misfit, Remedy(name, loop, edge, before, number, others)


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
