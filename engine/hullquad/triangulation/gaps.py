"""Edges that lie beside those of other plates, or beside their faces, too far off to be joined: probably a slip."""

from collections.abc import Iterator
from itertools import groupby

import attrs
import numpy as np

from hullquad.arrays import Floats, floats
from hullquad.plate import JOIN
from hullquad.triangulation.neighbours import Neighbours
from hullquad.triangulation.standing import heights, is_inside, plane_of, standing
from hullquad.triangulation.wireframe import Wireframe

WIDEST = 5.0
"""What is farther apart is meant to be [mm]."""
_SLOPE = 50
"""Edges lie beside each other when they do so for as many times their distance."""


@attrs.frozen(eq=False)
class Gap:
    """An edge beside another plate, not joined to it."""

    wire: int
    plate: int
    """Number of the other plate."""
    distance: float
    """The widest of the gap [mm]."""


def gaps(shared: Neighbours) -> tuple[Gap, ...]:
    """Gaps between the plates, the widest one of each edge and plate, in the order of the document."""
    found: dict[tuple[int, int], float] = {}
    for gap in (*_beside_edges(shared), *_beside_faces(shared)):
        key = gap.wire, gap.plate
        found[key] = max(gap.distance, found.get(key, 0.0))
    return tuple(Gap(wire, plate, distance) for (wire, plate), distance in sorted(found.items()))


def _beside_edges(shared: Neighbours) -> Iterator[Gap]:
    frame = shared.frame
    joined = {
        frozenset((one, other))
        for strand in shared.strands.strands
        for one, _ in strand.parts
        for other, _ in strand.parts
    }
    for (wire, other), contacts in groupby(sorted(_contacts(frame)), key=lambda item: item[:2]):
        places, away = np.array([contact[2:] for contact in contacts]).T
        if _is_gap(np.ptp(places), away.max()) and frozenset((wire, other)) not in joined:
            yield Gap(wire, frame.wires[other].plate, float(away.max()))


def _beside_faces(shared: Neighbours) -> Iterator[Gap]:
    frame = shared.frame
    probes = _probes(frame)
    for plate, wires in enumerate(standing(frame, WIDEST)):
        owner = frame.plates[plate]
        others = wires[~np.isin(wires, shared.joints.standing[plate])]
        above = others[is_inside(owner, plane_of(owner).parameters(probes[others, 1]))]
        for wire, away in zip(above, heights(owner, probes[above]).max(axis=1), strict=True):
            if _is_gap(frame.lengths[wire], away):
                yield Gap(int(wire), plate, float(away))


def _is_gap(length: float, away: float) -> bool:
    return bool(away > JOIN and length >= _SLOPE * away)


def _contacts(frame: Wireframe) -> Iterator[tuple[int, int, float, float]]:
    """Two wires of different plates; the place on the first where an end or the middle of one is near; how near."""
    points = _probes(frame).reshape(-1, 3)
    number, wire, lengths, away = frame.near(points, WIDEST)
    for i in np.flatnonzero(frame.plate_of[number // 3] != frame.plate_of[wire]):
        own, probe = divmod(int(number[i]), 3)
        at = frame.lengths[own] * probe / 2
        if own < wire[i]:
            yield own, int(wire[i]), float(at), float(away[i])
        else:
            yield int(wire[i]), own, float(lengths[i]), float(away[i])


def _probes(frame: Wireframe) -> Floats:
    """(W, 3, 3) start, middle and end of each wire."""
    rows = [wire.points(wire.curve.length * np.array([0, 0.5, 1])) for wire in frame.wires]
    return floats(np.reshape(rows, (-1, 3, 3)))
