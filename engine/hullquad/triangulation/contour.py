"""The contour of a plate divided into segments: what a mesh has on its rim, settled before there is a mesh."""

from collections.abc import Sequence
from functools import cached_property

import attrs
import numpy as np
import shapely

from hullquad.arrays import Floats, Longs, floats, longs
from hullquad.errors import PlateError
from hullquad.plate import Document, Plate, signed_area
from hullquad.triangulation.anchors import Snap
from hullquad.triangulation.clearance import crossing, near_segments, segments
from hullquad.triangulation.given_nodes import given_nodes
from hullquad.triangulation.neighbours import Neighbours, neighbours
from hullquad.triangulation.sizes import MOST_ELEMENTS, element_size, elements_needed, refuse_size

__all__ = ["MOST_ELEMENTS", "Contour", "attempts", "contours", "element_size", "elements_needed", "refuse_size"]

_CLEARANCE = 0.01
"""Distance that nodes keep from the segments of others, so that the triangulation can tell them apart [mm]."""
_TRIES = 8
_HALVINGS = 4
"""Steps by which a size that helps is approached from below: to a sixteenth."""


@attrs.frozen(eq=False, kw_only=True)
class Contour:
    """Nodes that are given before a plate is meshed: of its loops, one after another, then fixed ones inside."""

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
    """Paths in the document of the fixed nodes inside."""
    rows: tuple[Longs, ...] = ()
    """Nodes in a row, from end to end, along each edge of another plate that stands on the face of this one."""
    snaps: tuple[Snap, ...] = ()
    """What was moved: line ends and fixed points onto the contour or each other, nodes to where neighbours have them.
    """

    @cached_property
    def lines(self) -> Floats:
        """(L, 2, 3) ends of stiffeners and seams in space, cut by the holes [mm]."""
        ends = self.plate.clipped_lines
        return floats(self.plate.surface.points(ends.reshape(-1, 2)).reshape(-1, 2, 3))

    @property
    def edge_count(self) -> int:
        """Number of segments, and of nodes on the loops."""
        return int(self.loop_starts[-1])

    @property
    def triangles_unavoidable(self) -> int:
        """1 when no all-quad mesh exists: quads have an even number of contour edges."""
        return self.edge_count % 2

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


def contours(document: Document, size: float | str | None = None) -> dict[str, Contour]:
    """Divide the contours of a document's plane plates, by plate id.

    What plates have in common is divided once, with the finest of their sizes; they all get the same nodes.

    Parameters
    ----------
    document : Document
        Curved plates are left out.
    size : float, str or None
        Length of the segments [mm]; ``"coarse"``, ``"fine"`` or ``"very_fine"`` for the plates' own sizes;
        None for their target sizes.

    Raises
    ------
    PlateError
        A plate cannot be divided so: the first of them in the document.
    """
    found = attempts(document, size)
    for outcome in found.values():
        if isinstance(outcome, PlateError):
            raise outcome
    return {key: outcome for key, outcome in found.items() if isinstance(outcome, Contour)}


def attempts(document: Document, size: float | str | None = None) -> dict[str, Contour | PlateError]:
    """Contour of each plane plate as of `contours`, or why there is none: one plate does not stop the others."""
    plates = tuple(plate for plate in document.plates if plate.is_plane)
    shared = neighbours(plates)
    refused = dict(shared.wishes.conflicts)
    below = "/target_size" if size is None else ""
    for plate in plates:
        try:
            refuse_size(plate, element_size(plate, size), plate.place + below)
        except PlateError as error:
            refused.setdefault(plate.id, error)
    sizes = [np.inf if plate.id in refused else element_size(plate, size) for plate in plates]
    return {plate.id: refused.get(plate.id) or _attempt(shared, number, sizes) for number, plate in enumerate(plates)}


def _attempt(shared: Neighbours, plate: int, sizes: Sequence[float]) -> Contour | PlateError:
    contour = _divided(shared, plate, sizes)
    flaw = _flaw(contour)
    return contour if flaw is None else _too_coarse(shared, plate, sizes, flaw)


def _divided(shared: Neighbours, plate: int, sizes: Sequence[float]) -> Contour:
    given = given_nodes(shared, plate, sizes)
    return Contour(
        plate=shared.frame.plates[plate],
        size=sizes[plate],
        nodes=given.nodes,
        points=given.points,
        loop_starts=given.loop_starts,
        inside_places=given.inside_places,
        rows=given.rows,
        snaps=(*shared.fixed[plate].snaps, *shared.snaps(plate)),
    )


def _flaw(contour: Contour) -> tuple[str, Floats] | None:
    """Place and point where the straight segments, unlike the edges they stand for, cross or touch something."""
    rim = contour.nodes[: contour.edge_count]
    starts: Sequence[int] = contour.loop_starts.tolist()
    if not contour.region.is_valid:
        at = crossing(contour.region)
        away = [shapely.distance(shapely.linearrings(ring), shapely.Point(at)) for ring in contour.rings]
        nearest_last = len(away) - 1 - int(np.argmin(np.round(away[::-1], 6)))
        return contour.plate.loops[nearest_last].place, at
    touching = near_segments(rim, rim, starts, _CLEARANCE)
    if len(touching):
        node = touching[0, 0]
        return contour.plate.loops[int(np.searchsorted(starts, node, side="right")) - 1].place, rim[node]
    outside = ~shapely.contains_xy(contour.region, contour.inside)
    outside[near_segments(contour.inside, rim, starts, _CLEARANCE)[:, 0]] = True
    return next(((contour.inside_places[i], contour.inside[i]) for i in np.flatnonzero(outside)), None)


def _too_coarse(shared: Neighbours, plate: int, sizes: Sequence[float], flaw: tuple[str, Floats]) -> PlateError:
    """Error that says about the largest size that would do."""
    place, (u, v) = flaw
    size, owner = sizes[plate], shared.frame.plates[plate]

    def helps(finer: float) -> bool:
        is_small = elements_needed(owner, finer) <= MOST_ELEMENTS
        return is_small and _flaw(_divided(shared, plate, [*sizes[:plate], finer, *sizes[plate + 1 :]])) is None

    helping = next(filter(helps, (size / 2**i for i in range(1, _TRIES))), None)
    if helping is None:
        return PlateError("E_COARSE", place, "always", u=u, v=v, size=size)
    refused = min(2 * helping, size)
    for _ in range(_HALVINGS):
        middle = _rounded_down((helping + refused) / 2)
        helping, refused = (middle, refused) if middle > helping and helps(middle) else (helping, middle)
    return PlateError("E_COARSE", place, u=u, v=v, size=size, helping=helping)


def _rounded_down(size: float) -> float:
    """A size in three digits, not above."""
    digit = 10.0 ** (np.floor(np.log10(size)) - 2)
    return float(np.floor(size / digit) * digit)
