"""Every limit of every rule set on elements whose value is known in closed form: on the limit, and a millionth beyond.

The shapes are those of textbooks: rectangles, parallelograms, isosceles triangles and trapezoids, folded squares.
"""

from math import isfinite

import numpy as np
import pytest

from hullquad.mesh import Mesh
from hullquad.rules import Elements, Level, assess, rule_sets
from hullquad.topology import rim_states, topology

THICKNESS, SIZE = 12.0, 800.0
STEP = 1e-6


def rectangle(ratio):
    return [[0, 0], [ratio, 0], [ratio, 1], [0, 1]]


def parallelogram(degrees):
    x, y = np.cos(np.radians(degrees)), np.sin(np.radians(degrees))
    return [[0, 0], [1, 0], [1 + x, y], [x, y]]


def isosceles(degrees):
    """Triangle with that angle between two sides of length 1."""
    return [[0, 0], [1, 0], [np.cos(np.radians(degrees)), np.sin(np.radians(degrees))]]


def trapezoid(top, height=1.0):
    """Isosceles, with a base of length 1."""
    return [[0, 0], [1, 0], [0.5 + top / 2, height], [0.5 - top / 2, height]]


def leaning(degrees):
    """Trapezoid whose legs lean towards each other by that angle."""
    return trapezoid(1 - 0.2 * np.tan(np.radians(degrees / 2)), 0.1)


def folded(degrees):
    """A square, folded by that angle along a diagonal: the other diagonal's fold is smaller, and so is none."""
    half = np.sqrt(0.5)
    turn = np.radians(degrees)
    return [[0, -half, 0], [half, 0, 0], [0, half, 0], [-half * np.cos(turn), 0, half * np.sin(turn)]]


SHAPES = {
    ("aspect_ratio", "quads"): rectangle,
    ("aspect_ratio", "triangles"): lambda ratio: isosceles(2 * np.degrees(np.arcsin(0.5 / ratio))),
    ("min_angle", "quads"): parallelogram,
    ("min_angle", "triangles"): isosceles,
    ("max_angle", "quads"): parallelogram,
    ("max_angle", "triangles"): isosceles,
    ("scaled_jacobian", "quads"): lambda sine: parallelogram(np.degrees(np.arcsin(sine))),
    ("shape", "quads"): lambda sine: parallelogram(np.degrees(np.arcsin(sine))),
    ("shear", "quads"): lambda sine: parallelogram(np.degrees(np.arcsin(sine))),
    ("skew", "quads"): lambda sine: parallelogram(np.degrees(np.arcsin(sine))),
    ("condition", "quads"): lambda number: parallelogram(np.degrees(np.arcsin(1 / number))),
    ("taper", "quads"): lambda taper: trapezoid((1 - taper) / (1 + taper), 9.0),
    ("warpage", "quads"): lambda cosine: folded(np.degrees(np.arccos(cosine))),
    ("nastran_skew", "quads"): parallelogram,
    ("nastran_skew", "triangles"): isosceles,
    ("nastran_taper", "quads"): lambda taper: trapezoid((1 - taper) / (1 + taper)),
    ("warp_angle", "quads"): folded,
    ("optistruct_skew", "quads"): lambda skew: parallelogram(90 - skew),
    ("longest_edge", "quads"): lambda length: length * np.array(rectangle(1)),
    ("edge_over_size", "quads"): lambda ratio: ratio * SIZE * np.array(rectangle(1)),
    ("edge_over_thickness", "quads"): lambda ratio: ratio * THICKNESS * np.array(rectangle(1)),
    ("ansys_aspect_ratio", "quads"): rectangle,
    ("ansys_parallel_deviation", "quads"): leaning,
    ("ansys_max_corner_angle", "quads"): parallelogram,
    ("ansys_max_corner_angle", "triangles"): isosceles,
    ("ansys_jacobian_ratio", "quads"): lambda ratio: trapezoid(1 / ratio),
}

CASES = [
    (found, number, kind, side, band)
    for found in rule_sets()
    for number, rule in enumerate(found.rules, 1)
    for kind in ("quads", "triangles")
    if (rule.measure, kind) in SHAPES and rule.elements in (Elements.ALL, Elements(kind))
    for band in ("warn", "error")
    if getattr(rule, band) is not None
    for side in (0, 1)
    if isfinite(getattr(rule, band)[side])
]


def one_element(corners):
    points = np.asarray(corners, dtype=float)
    points = points if points.shape[1] == 3 else np.pad(points, ((0, 0), (0, 1)))
    element = np.array([[*range(len(points)), -1][:4]], dtype=np.int32)
    known = topology(element, rim_states(element, len(points)))
    return Mesh(points=points, topology=known, target_size=SIZE, thickness=THICKNESS, input_hash="known")


@pytest.mark.parametrize(
    ("found", "number", "kind", "side", "band"),
    CASES,
    ids=[f"{found.key}-{found.rules[number - 1].measure}-{kind}-{band}" for found, number, kind, _, band in CASES],
)
def test_a_limit_is_kept_on_it_and_broken_beyond_it(found, number, kind, side, band):
    rule = found.rules[number - 1]
    limit = getattr(rule, band)[side]
    shape = SHAPES[rule.measure, kind]
    beyond = limit * (1 + STEP if side else 1 - STEP)
    on, off = (assess(one_element(shape(value)), found).findings[number] for value in (limit, beyond))
    assert on.values[0] == pytest.approx(limit, rel=1e-10)
    assert off.values[0] == pytest.approx(beyond, rel=1e-10)
    level = Level[band.upper()]
    assert on.levels[0] < level
    assert off.levels[0] == level
    assert off.given[0]


def test_most_limits_have_such_a_shape():
    judged = {(found.key, number, kind) for found, number, kind, _, _ in CASES}
    assert len(judged) >= 70
