"""Plates and the document they come in, as values; always in millimetres and radians."""

from functools import cached_property
from typing import TYPE_CHECKING, Any

import attrs
import numpy as np
import numpy.typing as npt

from hullquad.arrays import Floats, Ints, floats, ints
from hullquad.curves import Curve, chord_error, polyline
from hullquad.errors import HullquadError, PlateError
from hullquad.sentences import SENTENCES
from hullquad.surface import Bezier, Plane, Surface

if TYPE_CHECKING:
    import shapely  # 0.05 s that an empty window would wait for

SNAP = 0.5
"""Distance within which the end of a line lies on the contour, and two fixed nodes are one [mm]."""
JOIN = 1.0
"""Distance in space within which two plates have their nodes and edges in common [mm]."""
LEAST_LENGTH = 1.0
"""Length of the shortest edge or line, and width of the narrowest strip between two loops [mm]."""
LEAST_PARAMETER = 1e-6
"""The same two for a plate whose parameters run over 0..1."""
CHORD_ERROR = 0.02
"""How far the polylines by which contours are compared leave their arcs [mm]."""
_CHORDS = 32
"""Of each edge of a curved plate, when it is shown."""


@attrs.frozen(eq=False)
class Notice:
    """Something the user should know of, though the plate can be used."""

    code: str
    place: str
    case: str = ""
    numbers: dict[str, Any] = attrs.field(factory=dict)

    @property
    def text(self) -> str:
        """The English sentence."""
        return SENTENCES[f"{self.code}:{self.case}" if self.case else self.code].format(**self.numbers)

    def __str__(self) -> str:
        return f"{self.code} at {self.place}: {self.text}"


@attrs.frozen(eq=False)
class Refusal:
    """A plate of a document that cannot be used."""

    plate_id: str
    """Empty when it has none."""
    place: str
    """Path in the document: ``/plates/3``."""
    error: PlateError
    """The first thing that is wrong with it."""


@attrs.frozen
class Material:
    """An isotropic elastic material."""

    name: str
    elasticity: float
    """E [MPa]"""
    poisson: float
    density: float
    """[t/mm3]"""
    yield_strength: float | None = None
    """ReH [MPa]"""


@attrs.frozen(eq=False)
class Line:
    """A stiffener or a seam."""

    a: Floats = attrs.field(converter=floats)
    b: Floats = attrs.field(converter=floats)
    place: str
    profile: str = ""


@attrs.frozen(eq=False)
class Loop:
    """A closed row of edges with the plate on its left: the outer loop counter-clockwise, a hole clockwise."""

    curves: tuple[Curve, ...]
    edges: Ints = attrs.field(converter=ints)
    """(E,) number in the document of each edge, which is that of the vertex it leaves there."""
    vertices: Ints = attrs.field(converter=ints)
    """(E,) number in the document of the vertex where each curve starts."""
    place: str

    def edge_place(self, edge: int) -> str:
        """Path in the document of a curve of this loop."""
        return f"{self.place}/{self.edges[edge]}"

    def vertex_place(self, edge: int) -> str:
        """Path in the document of the vertex where a curve of this loop starts."""
        return f"{self.place}/{self.vertices[edge]}"

    def outline(self, tolerance: float) -> Floats:
        """(N, 2) corners of the polygon within `tolerance` of the loop."""
        return np.concatenate([polyline(curve, tolerance)[:-1] for curve in self.curves])

    def samples(self, chords: int) -> Floats:
        """(N, 2) corners of a polygon with so many chords for each edge, also a straight one."""
        parts = np.arange(chords) / chords
        return np.concatenate([curve.points(parts * curve.length) for curve in self.curves])


@attrs.frozen
class Sizes:
    """Element sizes by name [mm]."""

    coarse: float
    fine: float
    very_fine: float

    @classmethod
    def of(cls, target: float, **given: float) -> "Sizes":
        """Sizes as they follow from the target size, but for the given ones."""
        return cls(**({"coarse": target, "fine": target / 4, "very_fine": target / 16} | given))


@attrs.frozen(eq=False, kw_only=True)
class Plate:
    """A piece of plating: its contour, the lines on it and how large its elements should be."""

    id: str
    title: str = ""
    drawing: str = ""
    notes: str = ""
    thickness: float
    """[mm]"""
    material: str
    surface: Surface
    outer: Loop
    holes: tuple[Loop, ...] = ()
    stiffeners: tuple[Line, ...] = ()
    seams: tuple[Line, ...] = ()
    fixed: Floats = attrs.field(factory=lambda: np.empty((0, 2)), converter=floats)
    """(K, 2) further fixed points."""
    divisions: tuple[tuple[int, ...], ...] = ()
    """For each loop (outer, holes) the wished number of segments of each edge of the document; 0 for an edge that is
    divided by size, () where all are."""
    target_size: float
    """[mm]"""
    sizes: Sizes
    place: str
    """Path in the document: ``/plates/3``."""

    @property
    def loops(self) -> tuple[Loop, ...]:
        """The outer loop, then the holes."""
        return (self.outer, *self.holes)

    @property
    def lines(self) -> tuple[Line, ...]:
        """The stiffeners, then the seams."""
        return (*self.stiffeners, *self.seams)

    @property
    def is_parametric(self) -> bool:
        """True when the coordinates run over 0..1 instead of being lengths."""
        return isinstance(self.surface, Bezier)

    @property
    def is_plane(self) -> bool:
        """True when the plate is flat."""
        return isinstance(self.surface, Plane)

    def with_division(self, loop: int, edge: int, number: int) -> "Plate":
        """The same plate with a number of segments of an edge (by its number in the document); 0 for by size."""
        given = self.divisions or ((),) * len(self.loops)
        rows = [list(row or [0] * len(known.curves)) for row, known in zip(given, self.loops, strict=True)]
        rows[loop][edge] = number
        kept = [tuple(row) if any(row) else () for row in rows]
        # a document lists the holes together, or none
        holes = [row or (0,) * len(known.curves) for row, known in zip(kept[1:], self.holes, strict=True)]
        return attrs.evolve(self, divisions=(kept[0], *(holes if any(kept[1:]) else kept[1:])))

    @property
    def least_length(self) -> float:
        """Length of the shortest edge allowed, in the unit of the coordinates."""
        return LEAST_PARAMETER if self.is_parametric else LEAST_LENGTH

    @property
    def unit(self) -> str:
        """What a sentence says after a length in the plane of the plate; parameters are none."""
        return "" if self.is_parametric else " mm"

    @property
    def snap(self) -> float:
        """Distance within which a point lies on the contour, in the unit of the coordinates."""
        return LEAST_PARAMETER if self.is_parametric else SNAP

    @property
    def chord_error(self) -> float:
        """Tolerance of outlines for comparisons, in the unit of the coordinates."""
        return CHORD_ERROR * self.least_length

    @cached_property
    def outline_error(self) -> float:
        """How far the outlines leave the contour, at most: more than `chord_error` only for arcs larger than plates."""
        curves = [curve for loop in self.loops for curve in loop.curves]
        return max(chord_error(curve, polyline(curve, self.chord_error)) for curve in curves)

    @cached_property
    def outlines(self) -> tuple[Floats, ...]:
        """Fine polygon of each loop."""
        return tuple(floats(loop.outline(self.chord_error)) for loop in self.loops)

    @cached_property
    def rims(self) -> tuple[Floats, ...]:
        """Polygon of each loop in space, (N, 3) [mm]."""
        flat = self.outlines if self.is_plane else tuple(loop.samples(_CHORDS) for loop in self.loops)
        return tuple(floats(self.surface.points(outline)) for outline in flat)

    @cached_property
    def box(self) -> Floats:
        """(2, 2) least and greatest coordinates."""
        return floats([self.outlines[0].min(axis=0), self.outlines[0].max(axis=0)])

    @cached_property
    def region(self) -> "shapely.Polygon":
        """The plate as a fine polygon with holes."""
        import shapely  # noqa: PLC0415

        region = shapely.Polygon(self.outlines[0], self.outlines[1:])
        shapely.prepare(region)
        return region

    @cached_property
    def openings(self) -> npt.NDArray[np.object_]:
        """(H,) each hole as a fine polygon."""
        import shapely  # noqa: PLC0415

        return np.array([shapely.Polygon(hole) for hole in self.outlines[1:]], dtype=object)

    @cached_property
    def rows(self) -> npt.NDArray[np.object_]:
        """(L,) each stiffener and seam as a line string."""
        import shapely  # noqa: PLC0415

        return np.array([shapely.LineString([line.a, line.b]) for line in self.lines], dtype=object)

    def place_of(self, finding: HullquadError | Notice) -> Floats:
        """Where on the plate an error is, or what is worth a notice.

        Returns
        -------
        (N, 3) float array
            A point [mm] where the finding quotes one, else the loop, edge, stiffener or seam that its place names, as
            a polyline; none where it is of the whole plate, or the plate is curved.
        """
        if not isinstance(self.surface, Plane):
            return floats(np.empty((0, 3)))
        is_point = {"u", "v"} <= finding.numbers.keys()
        named = finding.numbers.get("where", finding.place)  # an edge that would help says more than the whole plate
        quoted = [[finding.numbers["u"], finding.numbers["v"]]] if is_point else self._named(named)
        return floats(self.surface.points(floats(quoted)))

    def _named(self, place: str) -> Floats:
        """(N, 2) polyline of the smallest part of the plate that a path of the document leads into."""
        parts = {line.place: np.stack([line.a, line.b]) for line in self.lines}
        for loop, outline in zip(self.loops, self.outlines, strict=True):
            parts[loop.place] = np.concatenate([outline, outline[:1]])
            for edge, curve in enumerate(loop.curves):
                parts[loop.edge_place(edge)] = polyline(curve, self.chord_error)
        while place and place not in parts:
            place = place.rpartition("/")[0]
        return parts.get(place, np.empty((0, 2)))

    @cached_property
    def clipped_lines(self) -> Floats:
        """(K, 2, 2) ends of the pieces of stiffeners and seams that are left when the holes cut them."""
        import shapely  # noqa: PLC0415

        pieces = shapely.get_parts(shapely.difference(self.rows, shapely.union_all(self.openings)))
        pieces = pieces[shapely.length(pieces) > self.snap]
        return floats([shapely.get_coordinates(piece)[[0, -1]] for piece in pieces] or np.empty((0, 2, 2)))


@attrs.frozen(eq=False, kw_only=True)
class Document:
    """The plates of one file."""

    name: str
    materials: dict[str, Material]
    plates: tuple[Plate, ...]
    warnings: tuple[Notice, ...] = ()
    input_hash: str = ""
    """SHA-256 of the file."""
    length_unit: str = "mm"
    """Of the file; everything here is in millimetres."""
    angle_unit: str = "deg"

    def plate(self, plate_id: str) -> Plate:
        """Plate of that id."""
        return next(plate for plate in self.plates if plate.id == plate_id)

    def with_plate(self, plate: Plate) -> "Document":
        """The same document with a plate in the place of the one of its id."""
        return attrs.evolve(self, plates=tuple(plate if known.id == plate.id else known for known in self.plates))


def closed_loop(curves: list[Curve], place: str, *, is_hole: bool) -> Loop:
    """Loop of the curves in the order of the document, turned over when it runs the wrong way."""
    count = len(curves)
    numbers = np.arange(count)
    loop = Loop(tuple(curves), numbers, numbers, place)
    longest = max(curve.length for curve in curves)
    if (signed_area(loop.outline(1e-3 * longest)) < 0) == is_hole:
        return loop
    backwards = tuple(curve.reversed() for curve in reversed(curves))
    return Loop(backwards, numbers[::-1], (numbers[::-1] + 1) % count, place)


def signed_area(corners: Floats) -> float:
    """Area of a polygon (N, 2), negative when it runs clockwise."""
    x, y = (corners - corners[0]).T
    return float(x @ np.roll(y, -1) - y @ np.roll(x, -1)) / 2
