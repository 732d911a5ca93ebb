"""A plate's contour as it is divided: the nodes that are given before there is a mesh, and what follows from them."""

from functools import cached_property

import attrs
import numpy as np
import shapely

from hullquad.arrays import Floats, Longs, floats, longs
from hullquad.plate import Plate, signed_area
from hullquad.triangulation.anchors import Snap
from hullquad.triangulation.clearance import segments
from hullquad.triangulation.cutting import Cut
from hullquad.triangulation.sides import Sides, sides


@attrs.frozen(eq=False, kw_only=True)
class Followed:
    """Lines that elements follow, by the nodes of a contour."""

    ends: Floats = attrs.field(converter=floats)
    """(P, 2, 3) ends of each piece of a stiffener or seam in space; those that are not followed come last [mm]."""
    places: tuple[str, ...]
    """(P,) path in the document of the line that each belongs to; empty without a document."""
    count: int
    """Number of pieces that are followed."""
    edges: Longs = attrs.field(converter=longs)
    """(K, 2) segments of all pieces, and of the rows of nodes that other plates have on this one."""
    edge_pieces: Longs = attrs.field(converter=longs)
    """(K,) piece of each edge, -1 for those of rows."""
    node_lines: Longs = attrs.field(converter=longs)
    """(N,) piece that a node divides, else -1."""


@attrs.frozen(eq=False, kw_only=True)
class Contour:
    """Nodes that are given before a plate is meshed: of its loops, one after another, then those inside.

    Inside are the fixed nodes, and then those on followed lines.
    """

    plate: Plate
    size: float
    """Length that an element's edge should have [mm]."""
    nodes: Floats = attrs.field(converter=floats)
    """(N, 2) in the plate's plane [mm]."""
    loop_starts: Longs = attrs.field(converter=longs)
    """(L + 1,) loop i is ``nodes[loop_starts[i]:loop_starts[i + 1]]``; the outer one
    counter-clockwise, holes clockwise."""
    points: Floats = attrs.field(
        default=attrs.Factory(lambda self: self.plate.surface.points(self.nodes), takes_self=True), converter=floats
    )
    """(N, 3) the nodes in space [mm]; those in common with other plates have the same bits there."""
    inside_places: tuple[str, ...] = ()
    """Paths in the document of the fixed nodes inside, without those on followed lines."""
    rows: tuple[Longs, ...] = ()
    """Nodes in a row, from end to end, along each edge of another plate that stands on the face of this one."""
    snaps: tuple[Snap, ...] = ()
    """What was moved: line ends and fixed points onto the contour or each other, nodes to where neighbours have them.
    """

    followed: Followed | None = None
    """Lines that elements follow; without, they follow none."""

    @cached_property
    def lines(self) -> Floats:
        """(L, 2, 3) ends of stiffeners and seams in space, cut by the holes [mm].

        Followed ones are cut where they meet, too.
        """
        if self.followed is not None:
            return self.followed.ends
        ends = self.plate.clipped_lines
        return floats(self.plate.surface.points(ends.reshape(-1, 2)).reshape(-1, 2, 3))

    @property
    def edge_count(self) -> int:
        """Number of segments, and of nodes on the loops."""
        return int(self.loop_starts[-1])

    @property
    def is_odd(self) -> bool:
        """Whether the contour as a whole has an odd number of edges, so that one more or fewer makes it even."""
        return self.edge_count % 2 == 1

    @property
    def triangles_unavoidable(self) -> int:
        """Regions with an odd number of sides: no all-quad mesh of such a one exists.

        A plate without followed lines is one region.
        """
        return self.edge_count % 2 if self.followed is None else len(self.sides.odd)

    @cached_property
    def line_edges(self) -> Longs:
        """(K, 2) nodes of the edges that followed lines are made of."""
        return longs(np.empty((0, 2))) if self.followed is None else self.followed.edges

    @cached_property
    def node_lines(self) -> Longs:
        """(N,) row of `lines` that a node may slide on, else -1."""
        return longs(np.full(len(self.nodes), -1)) if self.followed is None else self.followed.node_lines

    @cached_property
    def sides(self) -> Sides:
        """Sides of the regions that the followed lines make."""
        return sides(self.nodes, self.segments, self.line_edges)

    @cached_property
    def cut(self) -> Cut:
        """The nodes of these regions, each with its own."""
        return Cut(self.sides, len(self.nodes))

    @cached_property
    def segments(self) -> Longs:
        """(E, 2) nodes of every segment, with the plate on its left."""
        return longs(segments(self.edge_count, self.loop_starts.tolist()))

    @property
    def rings(self) -> list[Floats]:
        """(N, 2) nodes of each loop."""
        return np.split(self.nodes[: self.edge_count], self.loop_starts[1:-1])

    @property
    def inside(self) -> Floats:
        """(K, 2) fixed nodes inside."""
        return self.nodes[self.edge_count :]

    @cached_property
    def region(self) -> shapely.Polygon:
        """The polygon with holes whose edges are the segments."""
        outer, *holes = self.rings
        return shapely.Polygon(outer, holes)

    @cached_property
    def area(self) -> float:
        """Area of that polygon, which is the sum of its elements' areas [mm2]."""
        return sum(signed_area(ring) for ring in self.rings)

    @cached_property
    def hole_points(self) -> Floats:
        """(H, 2) a point in each hole."""
        inner = [shapely.Polygon(ring).representative_point() for ring in self.rings[1:]]
        return floats([(point.x, point.y) for point in inner] or np.empty((0, 2)))
