"""Numbers of divisions that a document gives its edges, as numbers of segments of the strands they are made of."""

from collections.abc import Iterator, Sequence

import attrs

from hullquad.errors import PlateError
from hullquad.triangulation import division
from hullquad.triangulation.joints import Joints
from hullquad.triangulation.strands import Part, Strands, lengths
from hullquad.triangulation.wireframe import Wireframe


@attrs.frozen(eq=False)
class Wishes:
    """What the divisions of a document ask of its strands."""

    counts: dict[int, int]
    """Number of segments, by strand; the others are divided by size."""
    conflicts: dict[str, PlateError]
    """By plate id: a number that cannot be had, because that of an earlier plate holds on the same edge."""


def wishes(frame: Wireframe, met: Joints, found: Strands) -> Wishes:
    """Numbers for strands; short edges come first, so that a long one takes what is left."""
    counts: dict[int, int] = {}
    asked_by: dict[int, str] = {}
    conflicts: dict[str, PlateError] = {}
    asked = sorted(_asked(frame), key=lambda item: (len(found.parts[item[0]]), item[0]))
    for wire, wished in asked:
        parts = found.parts[wire]
        owner = frame.plates[frame.wires[wire].plate]
        numbers = _shared_out(frame, met, wire, parts, wished, counts)
        if numbers is None:
            others = [asked_by[part.strand] for part in parts if part.strand in asked_by]
            bound = sum(counts.get(part.strand, 0) for part in parts)
            conflicts.setdefault(owner.id, _conflict(frame, wire, wished, bound, others[0]))
            continue
        for part, number in zip(parts, numbers, strict=True):
            counts.setdefault(part.strand, number)
            asked_by.setdefault(part.strand, owner.id)
    return Wishes(counts, conflicts)


def _asked(frame: Wireframe) -> Iterator[tuple[int, int]]:
    """Wires with a number of divisions, and that."""
    for number, wire in enumerate(frame.wires):
        plate = frame.plates[wire.plate]
        numbers = plate.divisions[wire.loop] if plate.divisions else ()
        wished = numbers[plate.loops[wire.loop].edges[wire.edge]] if numbers else 0
        if wished:
            yield number, wished


def _shared_out(
    frame: Wireframe, met: Joints, wire: int, parts: Sequence[Part], wished: int, counts: dict[int, int]
) -> list[int] | None:
    """Numbers of segments of the parts of a wire, in agreement with those known; None if there are none."""
    ends = [lengths(met, wire, part.number) for part in parts]
    curve = frame.wires[wire].curve
    free = [i for i, part in enumerate(parts) if part.strand not in counts]
    known = sum(counts[part.strand] for part in parts if part.strand in counts)
    least = sum(division.turning_little(curve, *ends[i], 1) for i in free)
    if free and known + least <= max(wished, len(parts)):
        shares = division.shared_out(wished - known, [ends[i][1] - ends[i][0] for i in free])
        given = dict(zip(free, shares, strict=True))
        return [
            division.turning_little(curve, *ends[i], given[i]) if i in given else counts[part.strand]
            for i, part in enumerate(parts)
        ]
    own = division.shared_out(wished, [end - start for start, end in ends])
    total = sum(division.turning_little(curve, *end, number) for end, number in zip(ends, own, strict=True))
    numbers = [counts.get(part.strand) or division.turning_little(curve, *ends[i], 1) for i, part in enumerate(parts)]
    return numbers if sum(numbers) == total else None


def _conflict(frame: Wireframe, wire: int, wished: int, bound: int, other: str) -> PlateError:
    owner = frame.wires[wire]
    plate = frame.plates[owner.plate]
    edge = plate.loops[owner.loop].edges[owner.edge]
    below = "outer" if owner.loop == 0 else f"holes/{owner.loop - 1}"
    place = f"{plate.place}/divisions/{below}/{edge}"
    return PlateError("E_DIVISIONS", place, "neighbour", wished=wished, bound=bound, other=other)
