"""An element as formulas see it: edges, corners, angles, for quads and triangles alike.

::

        d ---- e2 ---- c          e0 = b - a    corner 0 at a, between e3 and e0
        |              |          e1 = c - b    corner 1 at b, between e0 and e1
       e3              e1         e2 = d - c    corner 2 at c, between e1 and e2
        |              |          e3 = a - d    corner 3 at d, between e2 and e3
        a ---- e0 ---- b          triangles: e2 = a - c, corner 0 between e2 and e0

The **normal of a corner** is the vector product of its two edges; its **Jacobian**, Eq. (1) of Kniat's paper, is the
part of that along the normal of the mean plane: negative where concave, or where the element runs against the
direction that it must face.
"""

from functools import cached_property
from math import pi
from typing import TypeVar

from hullquad.metrics.expression import (
    Arrow,
    Number,
    Op,
    arc,
    choice,
    cross,
    dot,
    openness,
    part,
    shrinking,
    shrunk_edge,
)

_Item = TypeVar("_Item")


class Element:
    """Expressions of one quad or triangle, each made when it is first asked for."""

    def __init__(self, count: int, doublings: int | None = None, *, is_judged: bool = False) -> None:
        self.count = count
        """Number of nodes: 4 or 3."""
        self.doublings = doublings
        """Of the exponent of smooth extremes; None for exact ones."""
        self.is_judged = is_judged
        """Whether openness is asked for, which gives some other numbers along; nothing has slopes then."""
        self.points = [Arrow(Op.INPUT, value=node) for node in range(count)]
        self.facing = Arrow(Op.INPUT, value=count)
        """Direction that it must face; zero where only its own sense is known."""
        self.reference = Number(Op.INPUT, value=count + 1)
        """What its area is relative to [as the points, squared]."""
        self.weight = Number(Op.INPUT, value=count + 2)
        """How much it counts beside others, where somebody asks for it."""

    @cached_property
    def shrinking(self) -> Number:
        """1 over the largest component of the edges; 0 where all nodes are in one place."""
        return shrinking(self.points)

    @property
    def size(self) -> Number:
        """Largest component of the edges [as the points]."""
        return 1.0 / self.shrinking

    @cached_property
    def sides(self) -> list[Arrow]:
        """Edges over size, so that no product of them is too small or too large for a float."""
        ends = zip(self.points, _turned(self.points, 1), strict=True)
        return [shrunk_edge(self.shrinking, start, end) for start, end in ends]

    @property
    def sides_before(self) -> list[Arrow]:
        """For each corner the edge that ends there."""
        return _turned(self.sides, -1)

    @cached_property
    def squares(self) -> list[Number]:
        """Squared lengths of the edges."""
        if self.is_judged:
            return [part(self.openness, 1 + side) for side in range(self.count)]
        return [side.square for side in self.sides]

    @property
    def squares_before(self) -> list[Number]:
        """For each corner the squared length of the edge that ends there."""
        return _turned(self.squares, -1)

    @cached_property
    def normals(self) -> list[Arrow]:
        """Products of the two edges at each corner."""
        return [cross(before, side) for before, side in zip(self.sides_before, self.sides, strict=True)]

    @cached_property
    def sum_of_normals(self) -> Arrow:
        """Normal to the mean plane, as long as four times the projected area of a quad, six times of a triangle."""
        if self.count == 4:
            return cross(*self.axes)
        return 3.0 * self.normals[0]

    @cached_property
    def area(self) -> Number:
        """Projected area, never negative [size squared]."""
        return (0.25 if self.count == 4 else 1.0 / 6.0) * self.sum_of_normals.length

    @cached_property
    def centre(self) -> Arrow:
        """Unit normal of the mean plane, on the side that the element must face; zero without an area."""
        turn = choice(-dot(self.sum_of_normals, self.facing), -1.0, 1.0)
        return (turn / self.sum_of_normals.length) * self.sum_of_normals

    @cached_property
    def jacobians(self) -> list[Number]:
        """Corner normals along the centre normal."""
        return [dot(self.centre, normal) for normal in self.normals]

    @cached_property
    def openness(self) -> Number:
        """1 where every corner is open (convex, not collapsed) and the element faces as it must, else 0."""
        return openness(self.sides, self.facing)

    @cached_property
    def relative_area(self) -> Number:
        """Projected area over what it is relative to."""
        return self.area * (self.size / self.reference * self.size)

    @cached_property
    def axes(self) -> tuple[Arrow, Arrow]:
        """Principal axes of a quad: twice the lines between the mid-points of opposite edges."""
        e0, e1, e2, e3 = self.sides
        return e0 - e2, e1 - e3

    @cached_property
    def diagonals(self) -> tuple[Arrow, Arrow]:
        """From a to c and from b to d."""
        return self.sides[0] + self.sides[1], self.sides[1] + self.sides[2]

    @cached_property
    def squared_diagonals(self) -> list[Number]:
        """Squared lengths of the diagonals."""
        if self.is_judged:
            return [part(self.openness, 5), part(self.openness, 6)]
        return [diagonal.square for diagonal in self.diagonals]

    @cached_property
    def sines(self) -> list[Number]:
        """Lengths of the corner normals: sine of each angle times its two edges."""
        return [normal.length for normal in self.normals]

    @cached_property
    def cosines(self) -> list[Number]:
        """Cosine of each angle times its two edges."""
        return [-dot(before, side) for before, side in zip(self.sides_before, self.sides, strict=True)]

    @cached_property
    def angles(self) -> list[Number]:
        """Angles between the two edges of each corner, up to pi [rad]."""
        return [arc(sine, cosine) for sine, cosine in zip(self.sines, self.cosines, strict=True)]

    @cached_property
    def interior_angles(self) -> list[Number]:
        """The same, above pi at a concave corner [rad]."""
        turned = zip(self.angles, self.jacobians, strict=True)
        return [choice(-jacobian, 2.0 * pi - angle, angle) for angle, jacobian in turned]


def _turned(items: list[_Item], by: int) -> list[_Item]:
    return items[by:] + items[:by]
