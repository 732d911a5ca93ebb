"""Constrained Delaunay triangles, refined by Shewchuk's Triangle: the one module that knows it.

Triangle trusts its input: what it does not expect crashes it, hangs it, or gives nonsense without a word. So
what it gets is checked before, what it gives is checked after, and it runs in the supervised process.
"""

import attrs
import numpy as np
import numpy.typing as npt

from hullquad import worker
from hullquad.arrays import Floats, Ints, Longs, floats, ints, longs
from hullquad.errors import MeshingError
from hullquad.topology import paired_sides
from hullquad.triangulation.refusals import expected_triangles, refuse_limits, refuse_too_many, sound_region
from hullquad.triangulation.region import Region, box_around

MEMORY = 512 * 1024**2
"""Bytes for any call: what a contour that Triangle despairs of may fill before it is given up."""

MEMORY_PER_TRIANGLE = 1024
"""Bytes; measured: 150 in Triangle, 250 with its answer."""


@attrs.frozen(eq=False)
class Triangulation:
    """Triangles of a region."""

    nodes: Floats = attrs.field(converter=floats)
    """(N, 2) the region's own nodes first, bit for bit."""
    triangles: Ints = attrs.field(converter=ints)
    """(T, 3) nodes of each triangle, counter-clockwise."""


def triangulate(
    nodes: npt.ArrayLike,
    loop_starts: npt.ArrayLike,
    *,
    area: float | None,
    min_angle: float = 30.0,
    place: str,
    lines: npt.ArrayLike = (),
    seconds: float = 30.0,
    element_limit: int = 5_000_000,
) -> Triangulation:
    """Triangles of a polygon with holes; new nodes appear only inside, never on its contour or on lines.

    Parameters
    ----------
    nodes : (K, 2) array
        Loop after loop, the outer one counter-clockwise, the holes clockwise; then points inside that
        become nodes. No loop repeats its first node at its end.
    loop_starts : (L + 1,) int array
        Loop i is ``nodes[loop_starts[i]:loop_starts[i + 1]]``.
    area
        Largest area of a triangle, to be derived from the spacing of the contour: triangles at contour edges
        that are too long for it exceed it, and the smallest angle too, without a word, as no node may
        be added there. None: no new nodes, the Delaunay triangles of the given ones.
    min_angle
        Smallest angle [degrees], up to 33.
    place
        What errors name: ``plate H1``.
    lines : (S, 2) int array, optional
        Nodes of segments inside that become edges of triangles; they have nothing in common but their ends.
    seconds
        Time limit.
    element_limit
        Most triangles.

    Raises
    ------
    MeshingError
        E_CONTOUR: the contour is not one; E_TRIANGLE: it cannot be triangulated so.
    WorkerError
        E_TIME, E_CANCELLED, or what should never happen: E_CRASH, E_WORKER.
    """
    refuse_limits(area, min_angle, place)
    given = sound_region(nodes, loop_starts, place)
    inner = longs(np.reshape(lines, (-1, 2)))
    if len(inner) and not (inner.min() >= 0 and inner.max() < len(given.nodes)):
        raise MeshingError("E_TRIANGLE", place, "lines")
    expected = expected_triangles(given, area)
    refuse_too_many(expected, element_limit, place)
    box = box_around(given.nodes)
    region = Region(box.into(given.nodes), given.starts)
    switches = "p" if area is None else _switches(box.area_into(area), min_angle, element_limit)
    work = (switches, region.nodes, np.concatenate([region.edges, inner]), region.hole_points)
    memory = MEMORY + int(MEMORY_PER_TRIANGLE * expected)
    try:
        found, triangles = worker.call(_triangle, *work, seconds=seconds, memory=memory, place=place)
    except worker.WorkerError as error:
        if error.code != "E_MEMORY":
            raise
        raise MeshingError("E_TRIANGLE", place, "given_up") from error
    refuse_too_many(len(triangles), element_limit, place)
    found, triangles = _used(found, triangles, len(region.nodes))
    _refuse_disagreement(region, inner, found, triangles, place)
    added = box.out_of(found[len(region.nodes) :])
    return Triangulation(np.concatenate([given.nodes, added]), triangles)


def _switches(area: float, min_angle: float, element_limit: int) -> str:
    """Switches of Triangle, which reads numbers without an exponent only."""
    angle, largest = np.format_float_positional(min_angle), np.format_float_positional(min(area, 1.0))
    return f"pq{angle}a{largest}YYS{element_limit}"


def _triangle(switches: str, nodes: Floats, edges: Longs, hole_points: Floats) -> tuple[Floats, Ints]:
    """Triangle's answer; runs in the child process."""
    import triangle  # noqa: PLC0415  # never loaded into the program itself

    given = {"vertices": nodes.copy(), "segments": edges.copy(), "holes": hole_points.copy()}  # it wants to write
    if not len(hole_points):
        del given["holes"]
    try:
        answer = triangle.triangulate(given, switches)
    except RuntimeError as error:
        raise MemoryError from error  # its word for every failure; on checked input memory is the one that is left
    return answer["vertices"], answer["triangles"]


def _used(nodes: Floats, triangles: Ints, given: int) -> tuple[Floats, Ints]:
    """Without the added nodes that no triangle has."""
    kept = np.bincount(triangles.ravel(), minlength=len(nodes)) > 0
    kept[:given] = True
    return nodes[kept], ints((np.cumsum(kept) - 1)[triangles])


def _refuse_disagreement(region: Region, lines: Longs, nodes: Floats, triangles: Ints, place: str) -> None:
    """Refuse triangles that are not exactly those of the region."""
    if not np.array_equal(nodes[: len(region.nodes)], region.nodes):
        raise MeshingError("E_TRIANGLE", place, "moved")
    unused = np.bincount(triangles.ravel(), minlength=len(nodes)) == 0
    if unused.any():
        raise MeshingError("E_TRIANGLE", place, "unused", count=int(unused.sum()))
    if not np.array_equal(_sorted(_rim(triangles)), _sorted(region.edges)):
        raise MeshingError("E_TRIANGLE", place, "contour")
    if not _has_edges(triangles, lines):
        raise MeshingError("E_TRIANGLE", place, "lines")
    areas = _areas(nodes[triangles])
    if not ((areas > 0).all() and np.isclose(areas.sum(), region.polygon.area, rtol=1e-9, atol=0)):
        raise MeshingError("E_TRIANGLE", place, "areas")


def _has_edges(triangles: Ints, lines: Longs) -> bool:
    """Whether triangles have all of these edges."""
    sides = np.stack([triangles, np.roll(triangles, -1, axis=1)], axis=2).reshape(-1, 2)
    width = int(triangles.max()) + 1
    known = np.sort(sides, axis=1).astype(np.int64) @ [width, 1]
    return bool(np.isin(np.sort(lines, axis=1) @ [width, 1], known).all())


def _rim(triangles: Ints) -> Ints:
    """(R, 2) sides of triangles that no single neighbour runs the other way."""
    sides = np.stack([triangles, np.roll(triangles, -1, axis=1)], axis=2).reshape(-1, 2)
    one, other = paired_sides(sides)
    is_inner = sides[one, 0] == sides[other, 1]
    return ints(np.delete(sides, np.concatenate([one[is_inner], other[is_inner]]), axis=0))


def _sorted(sides: Ints | Longs) -> Longs:
    return longs(sides[np.lexsort(sides.T)])


def _areas(corners: Floats) -> Floats:
    """(T,) signed areas of (T, 3, 2) corners."""
    (x1, y1), (x2, y2) = (corners[:, 1] - corners[:, 0]).T, (corners[:, 2] - corners[:, 0]).T
    return floats((x1 * y2 - x2 * y1) / 2)
