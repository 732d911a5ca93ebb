r"""Formulas on one quad, compiled.

Nodes and edges, counter-clockwise as seen against the normal (notation of Kniat's Table 1)::

        d ---- e2 ---- c          e0 = b - a    corner 0 at a, between e3 and e0
        |              |          e1 = c - b    corner 1 at b, between e0 and e1
       e3              e1         e2 = d - c    corner 2 at c, between e1 and e2
        |              |          e3 = a - d    corner 3 at d, between e2 and e3
        a ---- e0 ---- b

The **Jacobian** of a corner, Eq. (1), is the product of its two edges projected on the quad's mean plane.
Every formula gives the *raw* value; angles are in radians.
"""

from math import atan2, inf, pi, sqrt

from hullquad.metrics.compiled import compiled
from hullquad.metrics.vectors import Vector, cross, difference, dot, length, square, unit

Numbers4 = tuple[float, float, float, float]
Vectors4 = tuple[Vector, Vector, Vector, Vector]

FLAT = 1e-12
"""A corner's Jacobian over the square of the longest edge from which on a corner counts as open."""


@compiled
def edges(a: Vector, b: Vector, c: Vector, d: Vector) -> Vectors4:
    """The four edges, each from a node to the next."""
    return difference(b, a), difference(c, b), difference(d, c), difference(a, d)


@compiled
def squares(sides: Vectors4) -> Numbers4:
    """Squared lengths of the edges."""
    return square(sides[0]), square(sides[1]), square(sides[2]), square(sides[3])


@compiled
def corner_normals(sides: Vectors4) -> Vectors4:
    """Products of the two edges at each corner."""
    e0, e1, e2, e3 = sides
    return cross(e3, e0), cross(e0, e1), cross(e1, e2), cross(e2, e3)


@compiled
def centre_normal(sides: Vectors4, normal: Vector) -> Vector:
    """Unit normal of the mean plane, on the side of `normal`; of the quad's own sense where `normal` is zero.

    A quad whose projected area is zero (a symmetric bow-tie) gets `normal` itself.
    """
    e0, e1, e2, e3 = sides
    own = unit(cross(difference(e0, e2), difference(e1, e3)))
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
def is_valid(a: Vector, b: Vector, c: Vector, d: Vector, normal: Vector) -> bool:
    """Whether every corner is open: convex, not collapsed, not against `normal`."""
    sides = edges(a, b, c, d)
    return min(jacobians(sides, normal)) > FLAT * max(squares(sides))


@compiled
def stretch(a: Vector, b: Vector, c: Vector, d: Vector) -> float:
    """sqrt(2) times the shortest edge over the longest diagonal; 0 where both diagonals are points."""
    longest = max(square(difference(c, a)), square(difference(d, b)))
    return sqrt(2.0 * min(squares(edges(a, b, c, d))) / longest) if longest > 0.0 else 0.0


@compiled
def aspect_ratio(a: Vector, b: Vector, c: Vector, d: Vector) -> float:
    """Longest edge over shortest; inf where an edge is a point."""
    lengths = squares(edges(a, b, c, d))
    return sqrt(max(lengths) / min(lengths)) if min(lengths) > 0.0 else inf


@compiled
def scaled_jacobian(a: Vector, b: Vector, c: Vector, d: Vector, normal: Vector) -> float:
    """Least corner Jacobian over the lengths of the edges there; 0 at an edge that is a point."""
    sides = edges(a, b, c, d)
    j0, j1, j2, j3 = jacobians(sides, normal)
    l0, l1, l2, l3 = squares(sides)
    return min(_ratio(j0, l3, l0), _ratio(j1, l0, l1), _ratio(j2, l1, l2), _ratio(j3, l2, l3))


@compiled
def _ratio(jacobian: float, square_in: float, square_out: float) -> float:
    area = sqrt(square_in) * sqrt(square_out)
    return jacobian / area if area > 0.0 else 0.0


@compiled
def shape(a: Vector, b: Vector, c: Vector, d: Vector, normal: Vector) -> float:
    """Least of twice a corner's Jacobian over the squares of the edges there; 0 where that is negative."""
    sides = edges(a, b, c, d)
    j0, j1, j2, j3 = jacobians(sides, normal)
    l0, l1, l2, l3 = squares(sides)
    least = min(_share(j0, l3 + l0), _share(j1, l0 + l1), _share(j2, l1 + l2), _share(j3, l2 + l3))
    return max(0.0, least)


@compiled
def _share(jacobian: float, squares_there: float) -> float:
    return 2.0 * jacobian / squares_there if squares_there > 0.0 else 0.0


@compiled
def skew(a: Vector, b: Vector, c: Vector, d: Vector, normal: Vector) -> float:
    """4 over the sum of 1 / sin(angle) of the corners; 0 for an invalid quad."""
    if not is_valid(a, b, c, d, normal):
        return 0.0
    sides = edges(a, b, c, d)
    n0, n1, n2, n3 = corner_normals(sides)
    l0, l1, l2, l3 = length(sides[0]), length(sides[1]), length(sides[2]), length(sides[3])
    return 4.0 / (l3 * l0 / length(n0) + l0 * l1 / length(n1) + l1 * l2 / length(n2) + l2 * l3 / length(n3))


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
def min_angle(a: Vector, b: Vector, c: Vector, d: Vector) -> float:
    """Smallest interior angle [rad]."""
    return min(angles(edges(a, b, c, d)))


@compiled
def max_angle(a: Vector, b: Vector, c: Vector, d: Vector, normal: Vector) -> float:
    """Largest interior angle; above pi at a concave corner [rad]."""
    sides = edges(a, b, c, d)
    j0, j1, j2, j3 = jacobians(sides, normal)
    t0, t1, t2, t3 = angles(sides)
    return max(_reflex(t0, j0), _reflex(t1, j1), _reflex(t2, j2), _reflex(t3, j3))


@compiled
def _reflex(angle: float, jacobian: float) -> float:
    return 2.0 * pi - angle if jacobian < 0.0 else angle
