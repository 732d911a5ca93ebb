"""ANSYS's shape metrics: formulas of an element.

Ansys Theory Reference 12.1, "Element Shape Testing"; skewness: Ansys Meshing. VTK has none of them.
"""

from math import inf, sqrt

from hullquad.metrics.element import Element
from hullquad.metrics.expression import Arrow, Number, arc, choice, cross, dot, root
from hullquad.metrics.extremes import greatest, least
from hullquad.metrics.table_1 import deviations

OF_DIFFERENT_SIGN = -100.0
"""Raw Jacobian ratio of a quad with both open and concave corners."""


def aspect_ratio(element: Element) -> Number:
    """Longer side over shorter of the most stretched rectangle through the mid-points of the edges.

    Rectangles stand on each line between mid-points of opposite edges; the largest ratio is that of the longer
    line to the part of the shorter one across it. Of triangles they stand on the medians and on the mid-lines
    across them, where the longest median decides; over √3, so that an equilateral one has 1.
    """
    if element.count == 4:
        first, second = element.axes
        longer = greatest([first.square, second.square], element.doublings)
        return longer.over(element.sum_of_normals.length, inf)
    half = 0.5 * (element.squares[0] + element.squares[1] + element.squares[2])
    medians = [half - 0.75 * square for square in element.squares]
    return greatest(medians, element.doublings).over(sqrt(3.0) * element.area, inf)


def jacobian_ratio(element: Element) -> Number:
    """Largest corner Jacobian over the least; -100 if their signs differ."""
    low, high = least(element.jacobians, element.doublings), greatest(element.jacobians, element.doublings)
    reversed_or_flat = choice(high, choice(-low, OF_DIFFERENT_SIGN, inf), (-low).over(-high, inf))
    return choice(low, high.over(low, inf), reversed_or_flat)


def warping_factor(element: Element) -> Number:
    """Distance of the diagonals from each other over the root of the projected area."""
    normal = element.sum_of_normals
    return abs(dot(normal, element.sides[0])).over(normal.length * root(element.area), inf)


def parallel_deviation(element: Element) -> Number:
    """Largest angle between two opposite edges [rad]."""
    e0, e1, e2, e3 = element.sides
    return greatest([angle_between(e0, -e2), angle_between(e1, -e3)], element.doublings)


def skewness(element: Element) -> Number:
    """Largest deviation of an interior angle from 90°, of triangles from 60°, over the farthest it can be."""
    return greatest(deviations(element), element.doublings)


def angle_between(a: Arrow, b: Arrow) -> Number:
    """Angle between two vectors, from 0 to pi [rad]."""
    return arc(cross(a, b).length, dot(a, b))
