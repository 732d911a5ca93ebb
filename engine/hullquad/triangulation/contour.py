"""The contour of a plate divided into segments: what a mesh has on its rim, settled before there is a mesh."""

from collections.abc import Sequence
from functools import cached_property

import attrs
import numpy as np
import shapely

from hullquad.arrays import Floats, Longs, floats, longs
from hullquad.curves import canonical, is_backwards
from hullquad.errors import PlateError
from hullquad.plate import Document, Plate, signed_area
from hullquad.triangulation import division
from hullquad.triangulation.anchors import Anchors, Snap, anchors
from hullquad.triangulation.clearance import crossing, near_segments, segments

MOST_ELEMENTS = 5_000_000
"""Per plate."""
_LARGEST_SIZE = 1e9
"""Elements as large as the largest coordinate are longer than any plate; squares of the size do not overflow [mm]."""
_CLEARANCE = 0.01
"""Distance that nodes keep from the segments of others, so that the triangulation can tell them apart [mm]."""
_TRIES = 8


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
    inside_places: tuple[str, ...] = ()
    """Paths in the document of the fixed nodes inside."""
    snaps: tuple[Snap, ...] = ()
    """Line ends and fixed points that were moved onto the contour or onto each other."""

    @cached_property
    def points(self) -> Floats:
        """(N, 3) the nodes in space [mm]."""
        return self._in_space(self.nodes)

    @cached_property
    def lines(self) -> Floats:
        """(L, 2, 3) ends of stiffeners and seams in space, cut by the holes [mm]."""
        ends = self.plate.clipped_lines
        return floats(self._in_space(ends.reshape(-1, 2)).reshape(-1, 2, 3))

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

    def _in_space(self, parameters: Floats) -> Floats:
        return floats(self.plate.surface.points(parameters))  # type: ignore[union-attr]  # only of plane plates


def contours(document: Document, size: float | str | None = None) -> dict[str, Contour]:
    """Divide the contours of a document's plane plates, by plate id.

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
    plates = [plate for plate in document.plates if plate.is_plane]
    fixed = {plate.id: anchors(plate) for plate in plates}
    # edges that plates have in common: their anchors and sizes are to be joined here, before any is divided
    below = "/target_size" if size is None else ""
    return {
        plate.id: _attempt(plate, fixed[plate.id], element_size(plate, size), plate.place + below) for plate in plates
    }


def element_size(plate: Plate, size: float | str | None) -> float:
    """Element size of a plate, when `size` is asked for all [mm]."""
    if size is None:
        return plate.target_size
    return float(getattr(plate.sizes, size)) if isinstance(size, str) else size


def elements_needed(plate: Plate, size: float) -> float:
    """Estimate of the number of elements of a size: of the area, and of those that the contour's segments ask for."""
    count, length = _segments_asked_for(plate)
    return float(plate.region.area) / size / size + (count + length / size) / 2


def refuse_size(plate: Plate, size: float, place: str) -> None:
    """Refuse what is no size, and a size that would make more elements than can be handled.

    Raises
    ------
    PlateError
        E_SIZE, E_TOO_BIG
    """
    if not size > 0:
        raise PlateError("E_SIZE", place, "positive", shown=f"{size:g}")
    if size > _LARGEST_SIZE:
        raise PlateError("E_SIZE", place, "large", size=size, most=_LARGEST_SIZE)
    if elements_needed(plate, size) > MOST_ELEMENTS:
        raise _too_big(plate, size, place)


def _too_big(plate: Plate, size: float, place: str) -> PlateError:
    """Error that says which size would do."""
    count, length = _segments_asked_for(plate)
    left = MOST_ELEMENTS - count / 2  # left x**2 - length x / 2 - area = 0 is solved by the least size
    if left <= 0:
        return PlateError("E_TOO_BIG", f"{plate.place}/divisions", "divisions", count=count, most=MOST_ELEMENTS)
    root = np.sqrt((length / 4) ** 2 + left * plate.region.area)
    least = _rounded_up(float((length / 4 + root) / left))
    return PlateError("E_TOO_BIG", place, size=size, most=MOST_ELEMENTS, least=least)


def _segments_asked_for(plate: Plate) -> tuple[int, float]:
    """Number of segments whatever the size is, and length of the edges that are divided by it [mm]."""
    count, length = 0, 0.0
    for i, loop in enumerate(plate.loops):
        wishes = plate.divisions[i] if plate.divisions else ()
        count += sum(wishes) if wishes else len(loop.curves)
        length += 0.0 if wishes else sum(curve.length for curve in loop.curves)
    return count, length


def _rounded_up(size: float) -> float:
    """A size in three digits, not below."""
    digit = 10.0 ** (np.floor(np.log10(size)) - 2)
    return float(np.ceil(size / digit) * digit)


def _attempt(plate: Plate, fixed: Anchors, size: float, place: str) -> Contour | PlateError:
    try:
        refuse_size(plate, size, place)
        contour = _divided(plate, fixed, size)
        flaw = _flaw(contour)
    except PlateError as error:
        return error
    return contour if flaw is None else _too_coarse(plate, fixed, size, flaw)


def _divided(plate: Plate, fixed: Anchors, size: float) -> Contour:
    rings = [_loop_nodes(plate, i, fixed, size) for i in range(len(plate.loops))]
    return Contour(
        plate=plate,
        size=size,
        nodes=np.concatenate([*rings, fixed.inside]),
        loop_starts=np.cumsum([0, *map(len, rings)]),
        inside_places=fixed.inside_places,
        snaps=fixed.snaps,
    )


def _loop_nodes(plate: Plate, number: int, fixed: Anchors, size: float) -> Floats:
    """(N, 2) nodes of a loop of the plate."""
    loop = plate.loops[number]
    wishes = plate.divisions[number] if plate.divisions else ()
    rows = []
    for i, curve in enumerate(loop.curves):
        on_edge = fixed.on_edges.get((number, i), [])
        wished = wishes[loop.edges[i]] if wishes else None
        forwards = canonical(curve)
        row = division.nodes(forwards, on_edge, division.counts(forwards, on_edge, size, wished))
        rows.append(row[:0:-1] if is_backwards(curve) else row[:-1])
    return np.concatenate(rows)


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


def _too_coarse(plate: Plate, fixed: Anchors, size: float, flaw: tuple[str, Floats]) -> PlateError:
    """Error that says which size would do."""
    place, (u, v) = flaw
    sizes = [size / 2**i for i in range(1, _TRIES)]
    for helping in (helping for helping in sizes if elements_needed(plate, helping) <= MOST_ELEMENTS):
        if _flaw(_divided(plate, fixed, helping)) is None:
            return PlateError("E_COARSE", place, u=u, v=v, size=size, helping=helping)
    return PlateError("E_COARSE", place, "always", u=u, v=v, size=size)
