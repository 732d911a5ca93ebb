r"""What formulas on one quad are made of, compiled.

Nodes and edges, counter-clockwise as seen against the normal (notation of Kniat's Table 1)::

        d ---- e2 ---- c          e0 = b - a    corner 0 at a, between e3 and e0
        |              |          e1 = c - b    corner 1 at b, between e0 and e1
       e3              e1         e2 = d - c    corner 2 at c, between e1 and e2
        |              |          e3 = a - d    corner 3 at d, between e2 and e3
        a ---- e0 ---- b

The **Jacobian** of a corner, Eq. (1), is the product of its two edges projected on the quad's mean plane.
Angles are in radians.
"""

from math import atan2, pi, sqrt

from hullquad.metrics.compiled import compiled
from hullquad.metrics.vectors import Vector, cross, difference, dot, length, scaled, square, total, unit

Numbers4 = tuple[float, float, float, float]
Vectors4 = tuple[Vector, Vector, Vector, Vector]

FLAT = 1e-12
"""A corner's Jacobian over the square of the longest edge from which on a corner counts as open."""


@compiled
def edges(a: Vector, b: Vector, c: Vector, d: Vector) -> Vectors4:
    """The four edges, each from a node to the next."""
    return difference(b, a), difference(c, b), difference(d, c), difference(a, d)


@compiled
def size(sides: Vectors4) -> float:
    """Largest component of the edges."""
    largest = 0.0
    for x, y, z in sides:
        largest = max(largest, abs(x), abs(y), abs(z))
    return largest


@compiled
def resized(sides: Vectors4, size: float) -> Vectors4:
    """The edges over `size`, so that no product of them is too small or too large for a float."""
    factor = 1.0 / size if size > 0.0 else 0.0
    return scaled(factor, sides[0]), scaled(factor, sides[1]), scaled(factor, sides[2]), scaled(factor, sides[3])


@compiled
def squares(sides: Vectors4) -> Numbers4:
    """Squared lengths of the edges."""
    return square(sides[0]), square(sides[1]), square(sides[2]), square(sides[3])


@compiled
def diagonals(sides: Vectors4) -> tuple[Vector, Vector]:
    """From a to c and from b to d."""
    return total(sides[0], sides[1]), total(sides[1], sides[2])


@compiled
def axes(sides: Vectors4) -> tuple[Vector, Vector]:
    """The principal axes: twice the lines between the mid-points of opposite edges."""
    return difference(sides[0], sides[2]), difference(sides[1], sides[3])


@compiled
def corner_normals(sides: Vectors4) -> Vectors4:
    """Products of the two edges at each corner."""
    e0, e1, e2, e3 = sides
    return cross(e3, e0), cross(e0, e1), cross(e1, e2), cross(e2, e3)


@compiled
def area_vector(sides: Vectors4) -> Vector:
    """Normal to the mean plane, four times the projected area long: the sum of the corner normals."""
    x1, x2 = axes(sides)
    return cross(x1, x2)


@compiled
def centre_normal(sides: Vectors4, normal: Vector) -> Vector:
    """Unit normal of the mean plane, on the side of `normal`; of the quad's own sense where `normal` is zero.

    A quad whose projected area is zero (a symmetric bow-tie) gets `normal` itself.
    """
    own = unit(area_vector(sides))
    side = dot(own, normal)
    if side < 0.0:
        return -own[0], -own[1], -own[2]
    if own[0] == 0.0 and own[1] == 0.0 and own[2] == 0.0:
        return normal
    return own


@compiled
def jacobians(sides: Vectors4, normal: Vector) -> Numbers4:
    """Eq. (1) at the four corners: negative where concave, or where the quad runs against `normal`."""
    centre = centre_normal(sides, normal)
    n0, n1, n2, n3 = corner_normals(sides)
    return dot(centre, n0), dot(centre, n1), dot(centre, n2), dot(centre, n3)


@compiled
def is_open(sides: Vectors4, normal: Vector) -> bool:
    """Whether every corner is open: convex, not collapsed, not against `normal`."""
    return min(jacobians(sides, normal)) > FLAT * max(squares(sides))


@compiled
def is_valid(a: Vector, b: Vector, c: Vector, d: Vector, normal: Vector) -> bool:
    """Whether every corner is open: convex, not collapsed, not against `normal`."""
    sides = edges(a, b, c, d)
    return is_open(resized(sides, size(sides)), normal)


@compiled
def angle_between(a: Vector, b: Vector) -> float:
    """Angle between two vectors from 0 to pi [rad]; by the arc tangent, exact near 0 and pi."""
    return atan2(length(cross(a, b)), dot(a, b))


@compiled
def angles(sides: Vectors4) -> Numbers4:
    """Interior angles from 0 to pi [rad]; by the arc tangent, exact near 0 and pi."""
    e0, e1, e2, e3 = sides
    n0, n1, n2, n3 = corner_normals(sides)
    return (
        atan2(length(n0), -dot(e3, e0)),
        atan2(length(n1), -dot(e0, e1)),
        atan2(length(n2), -dot(e1, e2)),
        atan2(length(n3), -dot(e2, e3)),
    )


@compiled
def interior_angles(sides: Vectors4, normal: Vector) -> Numbers4:
    """Interior angles from 0 to 2 pi [rad]: above pi at a concave corner."""
    j0, j1, j2, j3 = jacobians(sides, normal)
    t0, t1, t2, t3 = angles(sides)
    return _reflex(t0, j0), _reflex(t1, j1), _reflex(t2, j2), _reflex(t3, j3)


@compiled
def _reflex(angle: float, jacobian: float) -> float:
    return 2.0 * pi - angle if jacobian < 0.0 else angle


@compiled
def ratio(dividend: float, divisor: float, otherwise: float) -> float:
    """A quotient of numbers that are not negative; `otherwise` over zero."""
    return dividend / divisor if divisor > 0.0 else otherwise


@compiled
def root_ratio(dividend: float, divisor: float, otherwise: float) -> float:
    """Square root of a quotient; `otherwise` over zero."""
    return sqrt(dividend / divisor) if divisor > 0.0 else otherwise
