"""Opening folded elements: Winslow's energy with a regularisation that goes to zero."""

from collections.abc import Iterator
from math import sqrt

import numpy as np

from hullquad.arrays import Floats, Ints
from hullquad.optimization.course import Course
from hullquad.optimization.energies import winslow

_SMALLEST = 1e-9
_OUTER, _INNER = 100, 60
_GAIN = 1e-4
"""Least gain of an iteration over the energy."""
_LEAST_PROGRESS = 0.1


def untangling(course: Course) -> Iterator[int]:
    """Stages that open every folded element, or as many as can be; yields the number of each iteration.

    The regularisation begins at the depth of the worst fold and follows Garanzha et al. (2021), Eq. (6): it shrinks
    with the energy, and with the least Jacobian as that becomes positive.
    """
    size, count = course.problem.size, folded_count(course)
    epsilon = max(1.0, -_least_jacobian(course)) if count else 0.0
    for _ in range(_OUTER):
        if not count or course.is_complete:
            return
        energy = winslow(size, epsilon)
        before = course.value(energy)
        yield from course.stage(energy, _INNER, _GAIN * before)
        count, least = folded_count(course), _least_jacobian(course)
        epsilon = _next(epsilon, least, course.value(energy) / before)


def relaxing(course: Course, most: int) -> Iterator[int]:
    """A stage that evens out an open mesh: the start of everything that follows; a folded one is left alone."""
    energy = winslow(course.problem.size, _SMALLEST)
    value, openness = course.look(energy)
    if not folded(openness):
        yield from course.stage(energy, most, _GAIN * value)


def evenness(course: Course) -> float:
    """Winslow's energy as it is: 1 for each square, half for an equilateral triangle, huge where folded."""
    return course.value(winslow(course.problem.size, _SMALLEST))


def folded_count(course: Course) -> int:
    """Number of elements that are not open."""
    return folded(course.look(winslow(course.problem.size, 1.0))[1])


def folded(openness: Floats) -> int:
    """Number of elements that are not open."""
    return int(np.count_nonzero(~(openness > 0)))


def _next(epsilon: float, least: float, share: float) -> float:
    """The next regularisation, when a stage has left this share of the energy."""
    root = sqrt(epsilon**2 + least**2)
    chi = 0.5 * (least + root) if least > 0 else 0.5 * epsilon**2 / (root - least)
    wanted = (1.0 - max(1.0 - share, _LEAST_PROGRESS)) * chi
    return max(_SMALLEST, 2.0 * sqrt(wanted * (wanted - least))) if least < wanted else _SMALLEST


def _least_jacobian(course: Course) -> float:
    """Least corner Jacobian of all elements, seen against what they must face [element size squared]."""
    known, size = course.elements, course.problem.size
    parts = known.nodes[: known.quads], known.nodes[known.quads :, :3]
    facing = np.broadcast_to(known.facing, (len(known.nodes), 3))
    found = [
        _jacobians(course.points, elements, normals).min(initial=np.inf)
        for elements, normals in zip(parts, (facing[: known.quads], facing[known.quads :]), strict=True)
    ]
    return float(min(found)) / size**2


def _jacobians(points: Floats, elements: Ints, normals: Floats) -> Floats:
    """(E, 4 or 3) corner Jacobians [mm²]."""
    corners = points[elements]
    ahead, back = np.roll(corners, -1, axis=1) - corners, np.roll(corners, 1, axis=1) - corners
    return np.asarray((np.cross(ahead, back) * normals[:, None]).sum(axis=2))
