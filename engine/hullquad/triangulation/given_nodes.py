"""Nodes that a plate is given before it is meshed, as it shares them with its neighbours."""

from collections.abc import Sequence

import attrs
import numpy as np

from hullquad.arrays import Floats, Longs, floats, longs
from hullquad.curves import is_backwards
from hullquad.plate import Plate
from hullquad.triangulation.joints import EXACT
from hullquad.triangulation.neighbours import Neighbours
from hullquad.triangulation.standing import plane_of
from hullquad.triangulation.strands import Part


@attrs.frozen(eq=False)
class GivenNodes:
    """Nodes of a plate's loops, one after another, then those inside."""

    nodes: Floats = attrs.field(converter=floats)
    """(N, 2) in the plate's plane."""
    points: Floats = attrs.field(converter=floats)
    """(N, 3) in space."""
    loop_starts: Longs = attrs.field(converter=longs)
    inside_places: tuple[str, ...]
    rows: tuple[Longs, ...]
    """Nodes along each edge that stands on the plate."""


def given_nodes(shared: Neighbours, plate: int, sizes: Sequence[float]) -> GivenNodes:
    """Nodes of a plate, for an element size of each of the plates [mm]."""
    owner = shared.frame.plates[plate]
    listing = _Listing()
    starts = [0]
    for i, loop in enumerate(owner.loops):
        for j, curve in enumerate(loop.curves):
            edge = _edge(shared, shared.wires[plate, i, j], sizes)
            listing.add(*(edge.turned() if is_backwards(curve) else edge).without_last())
        starts.append(listing.count)
    places = [item.place for item in shared.joints.inside[plate]]
    for item in shared.joints.inside[plate]:
        listing.add(item.own[None], shared.joints.points[[item.joint]], {0: item.joint})
    rows: dict[tuple[int, int], list[int]] = {}
    for part in shared.strands.standing[plate]:
        line = _line(shared, part, sizes)[1:-1]
        first, last = (shared.joints.breaks[part.wire][i].joint for i in (part.number, part.number + 1))
        row = rows.pop((part.wire, part.number), [listing.joints[first]])
        row += [*range(listing.count, listing.count + len(line)), listing.joints[last]]
        rows[part.wire, part.number + 1] = row  # to be continued by the next part
        listing.add(plane_of(owner).parameters(line), line, {})
        places += [_place(shared, part)] * len(line)
    points = np.concatenate(listing.points)
    nodes = _in_plane(owner, np.concatenate(listing.nodes), points)
    return GivenNodes(nodes, points, starts, tuple(places), tuple(map(longs, rows.values())))


class _Listing:
    """Nodes, one after another, and where the joints are among them."""

    def __init__(self) -> None:
        self.nodes: list[Floats] = []
        self.points: list[Floats] = []
        self.joints: dict[int, int] = {}
        self.count = 0

    def add(self, nodes: Floats, points: Floats, joints: dict[int, int]) -> None:
        """Add nodes, of which some, by number, are joints."""
        self.joints |= {joint: self.count + number for number, joint in joints.items()}
        self.nodes.append(nodes)
        self.points.append(points)
        self.count += len(nodes)


@attrs.frozen(eq=False)
class _Edge:
    """Nodes of an edge from one end to the other."""

    nodes: Floats
    points: Floats
    joints: dict[int, int]

    def turned(self) -> "_Edge":
        """The same edge from its other end."""
        last = len(self.nodes) - 1
        return _Edge(self.nodes[::-1], self.points[::-1], {last - i: joint for i, joint in self.joints.items()})

    def without_last(self) -> tuple[Floats, Floats, dict[int, int]]:
        """Nodes without the last one, with which the next edge begins."""
        last = len(self.nodes) - 1
        joints = {number: joint for number, joint in self.joints.items() if number < last}
        return self.nodes[:-1], self.points[:-1], joints


def _edge(shared: Neighbours, wire: int, sizes: Sequence[float]) -> _Edge:
    """Nodes of an edge from its canonical start to its end."""
    listing = _Listing()
    for part in shared.strands.parts[wire]:
        number = shared.count(part.strand, sizes)
        line = _line(shared, part, sizes)
        own = shared.own(wire, part.number, number)
        joint = shared.joints.breaks[wire][part.number].joint
        listing.add(own[:-1], line[:-1], {0: joint})
    last = shared.joints.breaks[wire][-1]
    listing.add(last.own[None], shared.joints.points[[last.joint]], {0: last.joint})
    joints = {number: joint for joint, number in listing.joints.items()}
    return _Edge(np.concatenate(listing.nodes), np.concatenate(listing.points), joints)


def _line(shared: Neighbours, part: Part, sizes: Sequence[float]) -> Floats:
    """(N, 3) nodes of a part of an edge from its start to its end, with both."""
    line = shared.points(part.strand, shared.count(part.strand, sizes))
    return line[::-1] if part.is_backwards else line


def _in_plane(plate: Plate, own: Floats, points: Floats) -> Floats:
    """(N, 2) places of points on the plate: its own ones where the difference is rounding."""
    plane = plane_of(plate)
    is_own = np.linalg.norm(plane.points(own) - points, axis=1) <= EXACT
    return np.where(is_own[:, None], own, plane.parameters(points))


def _place(shared: Neighbours, part: Part) -> str:
    """Path in the document of the edge that a part belongs to."""
    wire = shared.frame.wires[part.wire]
    return shared.frame.plates[wire.plate].loops[wire.loop].edge_place(wire.edge)
