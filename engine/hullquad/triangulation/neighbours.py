"""What the plates of a document have in common, whatever the size of the elements."""

from collections.abc import Sequence
from functools import cached_property, lru_cache

import attrs
import numpy as np

from hullquad.arrays import Floats, floats
from hullquad.plate import Plate
from hullquad.triangulation import division
from hullquad.triangulation.anchors import Anchors, Snap, anchors
from hullquad.triangulation.joints import EXACT, Break, Inside, Joints, joints
from hullquad.triangulation.standing import plane_of
from hullquad.triangulation.strands import Strands, lengths, strands
from hullquad.triangulation.wireframe import Wireframe, wireframe
from hullquad.triangulation.wishes import Wishes, wishes

_DOCUMENTS_KEPT = 4


@attrs.frozen(eq=False)
class Neighbours:
    """Plane plates with the joints and strands that they share."""

    frame: Wireframe
    fixed: tuple[Anchors, ...]
    """Of each plate."""
    joints: Joints
    strands: Strands
    wishes: Wishes

    @cached_property
    def numbers(self) -> dict[str, int]:
        """Number of each plate, by its id."""
        return {plate.id: i for i, plate in enumerate(self.frame.plates)}

    @cached_property
    def wires(self) -> dict[tuple[int, int, int], int]:
        """Number of the wire of each plate, loop and edge."""
        return {(wire.plate, wire.loop, wire.edge): i for i, wire in enumerate(self.frame.wires)}

    @cached_property
    def plates_of(self) -> tuple[tuple[int, ...], ...]:
        """Plates that have each strand, on their contour or on their face."""
        owners = self.frame.plate_of.tolist()
        return tuple(
            tuple(sorted({*(owners[wire] for wire, _ in strand.parts), *strand.faces}))
            for strand in self.strands.strands
        )

    def size(self, strand: int, sizes: Sequence[float]) -> float:
        """Element size of a strand: the least of those of its plates [mm]."""
        return min(sizes[plate] for plate in self.plates_of[strand])

    def count(self, strand: int, sizes: Sequence[float]) -> int:
        """Number of segments of a strand: the wished one, or that of the least size (by plate) [mm]."""
        wished = self.wishes.counts.get(strand)
        if wished:
            return wished
        on_wires = self.strands.strands[strand].parts
        start, end = lengths(self.joints, *on_wires[0])
        number = division.equal(end - start, self.size(strand, sizes))
        for wire, part in on_wires:
            number = division.turning_little(self.frame.wires[wire].curve, *lengths(self.joints, wire, part), number)
        return number

    def points(self, strand: int, number: int) -> Floats:
        """(number + 1, 3) nodes of a strand, from its first joint to its second."""
        found = self.strands.strands[strand]
        wire, part = found.parts[0]
        row = plane_of(self.frame.plates[self.frame.wires[wire].plate]).points(self.own(wire, part, number))
        ends = self.joints.points[list(found.joints)]
        moved = ends - row[[0, -1]]
        along = (np.arange(number + 1) / number)[:, None]
        row = row + (1 - along) * moved[0] + along * moved[1]
        row[[0, -1]] = ends
        return floats(row)

    def own(self, wire: int, part: int, number: int) -> Floats:
        """(number + 1, 2) nodes of a part of an edge, where the edge itself would have them."""
        first, last = self.joints.breaks[wire][part : part + 2]
        return division.nodes(self.frame.wires[wire].curve, first, last, number)

    def snaps(self, plate: int) -> tuple[Snap, ...]:
        """Nodes of a plate that are not where it has them itself, but where a neighbour has them."""
        first, last = np.searchsorted(self.frame.plate_of, [plate, plate + 1])
        items: list[Break | Inside] = [*self.joints.inside[plate]]
        for wire in range(int(first), int(last)):
            items += self.joints.breaks[wire]
        known = list({item.joint: item for item in items}.values())  # what ends an edge begins another one
        plane = plane_of(self.frame.plates[plate])
        there = self.joints.points[[item.joint for item in known]]
        moved = np.linalg.norm(plane.points(floats([item.own for item in known])) - there, axis=1) > EXACT
        return tuple(self._snap(plate, known[i]) for i in np.flatnonzero(moved))

    def _snap(self, plate: int, item: Break | Inside) -> Snap:
        plane, point = plane_of(self.frame.plates[plate]), self.joints.points[item.joint]
        node = plane.parameters(point[None])[0]
        other = self.joints.first_plates[item.joint]
        name = self.frame.plates[other].id if other >= 0 else ""
        return Snap(item.place, item.own, node, float((point - plane.origin) @ plane.normal), name)


@attrs.frozen(eq=False)
class _Shapes:
    """Plates of which only the shape counts: an edit of divisions or sizes finds what is known."""

    plates: tuple[Plate, ...]

    @property
    def _parts(self) -> tuple[int, ...]:
        parts = ("surface", "outer", "holes", "stiffeners", "seams", "fixed")
        return tuple(id(getattr(plate, name)) for plate in self.plates for name in parts)

    def __hash__(self) -> int:
        return hash(self._parts)

    def __eq__(self, other: object) -> bool:
        return isinstance(other, _Shapes) and self._parts == other._parts


@lru_cache(maxsize=_DOCUMENTS_KEPT)
def neighbours(plates: tuple[Plate, ...]) -> Neighbours:
    """What plane plates have in common; kept for the documents last asked for."""
    frame, fixed, met, found = _shared(_Shapes(plates))
    frame = attrs.evolve(frame, plates=plates)
    return Neighbours(frame, fixed, met, found, wishes(frame, met, found))


@lru_cache(maxsize=_DOCUMENTS_KEPT)
def _shared(shapes: _Shapes) -> tuple[Wireframe, tuple[Anchors, ...], Joints, Strands]:
    frame = wireframe(shapes.plates)
    fixed = tuple(anchors(plate) for plate in shapes.plates)
    met = joints(frame, fixed)
    return frame, fixed, met, strands(frame, met)
