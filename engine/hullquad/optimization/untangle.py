"""Opening folded elements: Winslow's energy with a regularisation that goes to zero."""

from collections.abc import Iterator
from math import sqrt

from hullquad.optimization.course import Course
from hullquad.optimization.energy import WINSLOW, Energy
from hullquad.optimization.winslow import chi

_SMALLEST = 1e-9
_OUTER, _INNER = 100, 60
_GAIN = 1e-4
"""Least gain of an iteration over the energy."""
_LEAST_PROGRESS = 0.1


def untangling(course: Course) -> Iterator[int]:
    """Stages that open every folded element, or as many as can be; yields the number of each iteration.

    The regularisation follows Garanzha et al. (2021), Eq. (6): it shrinks with the energy, and with the least
    Jacobian as that becomes positive.
    """
    count, least = course.folded
    epsilon = max(1.0, -least)
    for _ in range(_OUTER):
        if not count or course.is_complete:
            return
        energy = winslow(course, epsilon)
        before = course.value(energy)
        yield from course.stage(energy, _INNER, _GAIN * before)
        count, least = course.folded
        epsilon = _next(epsilon, least, course.value(energy) / before)


def relaxing(course: Course, most: int) -> Iterator[int]:
    """A stage that evens out an open mesh: the start of everything that follows; a folded one is left alone."""
    if not course.folded[0]:
        yield from course.stage(winslow(course, _SMALLEST), most, _GAIN * evenness(course))


def evenness(course: Course) -> float:
    """Winslow's energy as it is: 1 for each square, half for an equilateral triangle, huge where folded."""
    return course.value(winslow(course, _SMALLEST))


def winslow(course: Course, epsilon: float) -> Energy:
    """Winslow's energy, which opens elements and never needs to be told to keep them so."""
    return Energy(kind=WINSLOW, size=course.problem.size, keeps_valid=False, epsilon=epsilon, floor=0.0)


def _next(epsilon: float, least: float, share: float) -> float:
    """The next regularisation, when a stage has left this share of the energy."""
    wanted = (1.0 - max(1.0 - share, _LEAST_PROGRESS)) * chi(least, epsilon)
    return max(_SMALLEST, 2.0 * sqrt(wanted * (wanted - least))) if least < wanted else _SMALLEST
