"""Measures of solvers and class rules: formulas of an element."""

from math import inf, pi, sqrt

from hullquad.metrics.ansys import angle_between
from hullquad.metrics.element import Element
from hullquad.metrics.expression import Number, arc, choice, dot, number, root
from hullquad.metrics.extremes import greatest, least
from hullquad.metrics.table_1 import distortion, distortions, min_angle, positive

_TIE = 1e-9
"""Difference of two angles that is none [rad]."""


def axes_angle(element: Element) -> Number:
    """Angle between the lines of mid-points of opposite edges, from 0 to pi / 2 [rad]."""
    acute = arc(element.sum_of_normals.length, abs(dot(*element.axes)))
    return least([acute, pi - acute], element.doublings)


def nastran_skew(element: Element) -> Number:
    """Angle between the lines of mid-points (Q4_SKEW); of triangles the smallest angle (T3_SKEW) [rad]."""
    return axes_angle(element) if element.count == 4 else min_angle(element)


def nastran_tapers(element: Element) -> list[Number]:
    """|Triangle at each corner over half of the quad - 1|."""
    return [abs(each - 1.0) for each in distortions(element)]


def nastran_taper(element: Element) -> Number:
    """Largest |triangle at a corner over half of the quad - 1|, in the mean plane (Q4_TAPER).

    MSC's largest deviation and NX's (greatest - half) / half agree, because the triangles at opposite corners add up
    to the quad: it is 1 - distortion.
    """
    return 1.0 - distortion(element)


def nastran_warp(element: Element) -> Number:
    """Distance of a node from the mean plane over the mean length of the diagonals (Q4_WARP)."""
    first, second = element.diagonals
    normal = element.sum_of_normals
    return abs(dot(normal, element.sides[0])).over(normal.length * (first.length + second.length), inf)


def warp_angle(element: Element) -> Number:
    """Larger angle between the two triangles that either diagonal makes [rad]: the arc cosine of warpage."""
    n0, n1, n2, n3 = element.normals
    return greatest([angle_between(n0, n2), angle_between(n1, n3)], element.doublings)


def optistruct_skew(element: Element) -> Number:
    """90° less the least angle between the lines of mid-points; of triangles between a median and the mid-line across.

    The mid-line across is parallel to the edge that the median halves.
    """
    if element.count == 4:
        return 0.5 * pi - axes_angle(element)
    e0, e1, e2 = element.sides
    doubled = 4.0 * element.area
    halved = [(e2 - e1, e0), (e0 - e2, e1), (e1 - e0, e2)]
    return 0.5 * pi - least([arc(doubled, abs(dot(*pair))) for pair in halved], element.doublings)


def patran_triangle_aspect_ratio(element: Element) -> Number:
    """Largest of √3/2 times a side over the height on it; of quads Patran's is ANSYS's."""
    return greatest(element.squares, element.doublings).over(4.0 / sqrt(3.0) * element.area, inf)


def verdict_aspect_ratio(element: Element) -> Number:
    """Longest edge times the sum of the edges over four times the area, of triangles 4√3 times.

    VTK's AspectRatio.
    """
    longest = root(greatest(element.squares, element.doublings))
    around = root(element.squares[0])
    for square in element.squares[1:]:
        around = around + root(square)
    return (longest * around).over((4.0 if element.count == 4 else 4.0 * sqrt(3.0)) * element.area, inf)


def cubit_aspect_ratio(element: Element) -> Number:
    """Longer principal axis over the shorter one. VTK's MaxEdgeRatio."""
    lengths = [axis.square for axis in element.axes]
    return root(greatest(lengths, element.doublings).over(least(lengths, element.doublings), inf))


def longest_edge(element: Element) -> Number:
    """Length of the longest edge [as the points]."""
    return root(greatest(element.squares, element.doublings)) * element.size


def corner_angle(element: Element) -> Number:
    """Interior angle that is farthest from 90°, of triangles from 60° [rad].

    It jumps where the smallest and the largest angle are equally far: there is no smooth form of it. There, as in
    every parallelogram, the largest counts.
    """
    ideal = 0.5 * pi if element.count == 4 else pi / 3.0
    low, high = least(element.interior_angles, None), greatest(element.interior_angles, None)
    return choice((ideal - low) - (high - ideal) - _TIE, low, high)


def abaqus_shape_factor(element: Element) -> Number:
    """Area over that of the equilateral triangle with the same circumscribed circle; 1 for quads."""
    if element.count == 4:
        return number(1.0)
    l0, l1, l2 = element.squares
    doubled = positive(element.jacobians[0])
    return 8.0 / (3.0 * sqrt(3.0)) * doubled * doubled * doubled / (l0 * l1 * l2)
