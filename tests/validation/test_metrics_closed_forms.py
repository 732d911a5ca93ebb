"""Metrics of families of quads whose values are known in closed form, and of the shapes of MacNeal and Harder.

R. H. MacNeal, R. L. Harder: A proposed standard set of problems to test finite element accuracy, Finite Elements in
Analysis and Design 1 (1985) 3-20: patch test (Fig. 1), slender beam of trapezoids and parallelograms (Fig. 3).
"""

from math import acos, atan, atan2, cos, degrees, hypot, radians, sin, sqrt

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from hullquad.metrics import METRICS, metric
from hullquad.metrics.values import all_judged, judged_values

QUAD = np.array([[0, 1, 2, 3]], dtype=np.int32)
LENGTHS = st.floats(0.05, 20)
# of every planar quad
FLAT = {"warpage": 1, "ansys_warping_factor": 0, "nastran_warp": 0, "warp_angle": 0, "abaqus_shape_factor": 1}


def assert_has(points, expected: dict[str, float]) -> None:
    space = np.zeros((4, 3))
    nodes = np.array(points, dtype=float)
    space[:, : nodes.shape[1]] = nodes
    found, valid = all_judged(space, QUAD, areas=np.ones(2), metrics=[metric(key) for key in expected])
    assert valid.all()
    # angles near 0 and 180 degrees are exact, the cosines that they are worked out from here are not
    np.testing.assert_allclose(found[0], list(expected.values()), rtol=1e-12, atol=1e-11, err_msg=str(list(expected)))


@given(a=LENGTHS, b=LENGTHS)
def test_rectangles(a, b):
    long, short = max(a, b), min(a, b)
    area = a * b
    size = min(area, 1 / area)
    assert_has(
        [(0, 0), (a, 0), (a, b), (0, b)],
        FLAT | {
            "stretch": sqrt(2) * short / hypot(a, b), "aspect_ratio": long / short, "scaled_jacobian": 1,
            "shape": 2 * area / (a * a + b * b), "skew": 1, "min_angle": 90, "max_angle": 90, "taper": 0,
            "condition": (a * a + b * b) / (2 * area), "shear": 1, "relative_size": size, "shear_and_size": size,
            "shape_and_size": size * 2 * area / (a * a + b * b), "distortion": 1, "ansys_aspect_ratio": long / short,
            "ansys_jacobian_ratio": 1, "ansys_parallel_deviation": 0, "ansys_max_corner_angle": 90,
            "ansys_skewness": 0, "nastran_skew": 90, "nastran_taper": 0, "optistruct_skew": 0,
            "patran_aspect_ratio": long / short, "verdict_aspect_ratio": (a + b) / (2 * short),
            "cubit_aspect_ratio": long / short, "longest_edge": long, "corner_angle": 90,
        },
    )  # fmt: skip


def parallelogram(a: float, b: float, angle: float) -> tuple[list[tuple[float, float]], dict[str, float]]:
    """Sides a and b with an angle up to 90 degrees between them."""
    t, long, short = radians(angle), max(a, b), min(a, b)
    shape = 2 * a * b * sin(t) / (a * a + b * b)
    size = min(a * b * sin(t), 1 / (a * b * sin(t)))
    return [(0, 0), (a, 0), (a + b * cos(t), b * sin(t)), (b * cos(t), b * sin(t))], FLAT | {
        "stretch": sqrt(2) * short / sqrt(a * a + b * b + 2 * a * b * cos(t)), "aspect_ratio": long / short,
        "scaled_jacobian": sin(t), "shape": shape, "skew": sin(t), "min_angle": angle, "max_angle": 180 - angle,
        "taper": 0, "condition": 1 / shape, "shear": sin(t), "relative_size": size, "shear_and_size": size * sin(t),
        "shape_and_size": size * shape, "distortion": 1, "ansys_aspect_ratio": long / (short * sin(t)),
        "ansys_jacobian_ratio": 1, "ansys_parallel_deviation": 0, "ansys_max_corner_angle": 180 - angle,
        "ansys_skewness": 1 - angle / 90, "nastran_skew": angle, "nastran_taper": 0, "optistruct_skew": 90 - angle,
        "patran_aspect_ratio": long / (short * sin(t)), "verdict_aspect_ratio": (a + b) / (2 * short * sin(t)),
        "cubit_aspect_ratio": long / short, "longest_edge": long, "corner_angle": 180 - angle,
    }  # fmt: skip


@given(a=LENGTHS, b=LENGTHS, angle=st.floats(2, 89))
def test_parallelograms(a, b, angle):
    assert_has(*parallelogram(a, b, angle))


@given(side=LENGTHS, angle=st.floats(2, 89))
def test_rhombi(side, angle):
    points, expected = parallelogram(side, side, angle)
    t = radians(angle)
    assert_has(points, expected | {"shape": sin(t), "stretch": sqrt(0.5) / cos(t / 2), "aspect_ratio": 1})


def trapezoid(p: float, q: float, h: float) -> tuple[list[tuple[float, float]], dict[str, float]]:
    """Symmetric, with parallel edges of 2p and 2q, q not above p, and height h."""
    base, leg = degrees(atan2(h, p - q)), hypot(p - q, h)
    edges = [2 * p, 2 * q, leg]
    t = radians(base)
    wide, narrow = 4 * p * leg * sin(t) / (4 * p * p + leg * leg), 4 * q * leg * sin(t) / (4 * q * q + leg * leg)
    mean = (p + q) / h
    return [(-p, 0), (p, 0), (q, h), (-q, h)], FLAT | {
        "stretch": sqrt(2) * min(edges) / hypot(p + q, h), "aspect_ratio": max(edges) / min(edges),
        "scaled_jacobian": sin(t), "shape": min(wide, narrow), "skew": sin(t), "min_angle": base,
        "max_angle": 180 - base, "taper": (p - q) / min(p + q, h), "distortion": 2 * q / (p + q),
        "ansys_aspect_ratio": max(mean, 1 / mean), "ansys_jacobian_ratio": p / q,
        "ansys_parallel_deviation": 180 - 2 * base, "ansys_skewness": 1 - base / 90, "nastran_skew": 90,
        "nastran_taper": (p - q) / (p + q), "optistruct_skew": 0,
        "verdict_aspect_ratio": max(edges) * (p + q + leg) / (2 * (p + q) * h),
        "cubit_aspect_ratio": max(mean, 1 / mean), "longest_edge": max(edges),
    }  # fmt: skip


@given(p=LENGTHS, share=st.floats(0.05, 1), h=LENGTHS)
def test_trapezoids(p, share, h):
    assert_has(*trapezoid(p, share * p, h))


@given(h=st.floats(0.001, 3))
def test_twisted_squares(h):
    """Unit squares seen from above, their nodes by h above and below the mean plane in turn."""
    square = 1 + 4 * h * h
    assert_has(
        [(0, 0, h), (1, 0, -h), (1, 1, h), (0, 1, -h)],
        {
            "stretch": sqrt(square), "aspect_ratio": 1, "scaled_jacobian": 1 / square, "shape": 1 / square,
            "skew": sqrt(1 - (4 * h * h / square) ** 2), "min_angle": degrees(acos(4 * h * h / square)),
            "max_angle": degrees(acos(4 * h * h / square)), "taper": 4 * h / 2,
            "warpage": (1 - 8 * h * h) / (1 + 8 * h * h), "condition": square, "relative_size": 1, "distortion": 1,
            "ansys_aspect_ratio": 1, "ansys_jacobian_ratio": 1, "ansys_warping_factor": 2 * h,
            "nastran_warp": h / sqrt(2), "warp_angle": degrees(2 * atan(2 * sqrt(2) * h)), "nastran_skew": 90,
            "verdict_aspect_ratio": square, "longest_edge": sqrt(square),
        },
    )  # fmt: skip


@given(a=LENGTHS, b=LENGTHS)
def test_right_triangles(a, b):
    c = hypot(a, b)
    points = np.array([(0, 0, 0), (a, 0, 0), (0, b, 0)])
    expected = {
        "aspect_ratio": c / min(a, b), "scaled_jacobian": 2 / sqrt(3) * min(a, b) / c,
        "shape": sqrt(3) * a * b / (c * c), "condition": c * c / (sqrt(3) * a * b), "max_angle": 90,
        "min_angle": degrees(atan2(min(a, b), max(a, b))),
        "ansys_aspect_ratio": (max(a, b) ** 2 + min(a, b) ** 2 / 4) * 2 / (sqrt(3) * a * b),
        "patran_aspect_ratio": sqrt(3) / 2 * c * c / (a * b),
        "verdict_aspect_ratio": c * (a + b + c) / (2 * sqrt(3) * a * b), "longest_edge": c,
        "abaqus_shape_factor": 8 / (3 * sqrt(3)) * a * b / (c * c),
    }  # fmt: skip
    rows = [metric(key) for key in expected]
    found, _ = all_judged(points, np.array([[0, 1, 2, -1]], dtype=np.int32), metrics=rows)
    np.testing.assert_allclose(found[0], list(expected.values()), rtol=1e-12, err_msg=str(list(expected)))


@pytest.mark.parametrize(
    ("points", "expected"),
    [trapezoid(0.6, 0.4, 0.2), parallelogram(1.0, 0.2 * sqrt(2), 45.0)],
    ids=["trapezoid", "parallelogram"],
)
def test_elements_of_the_slender_beam(points, expected):
    assert expected["min_angle"] == pytest.approx(45)
    assert_has(points, expected)


def test_elements_of_the_patch_test_fill_the_patch_and_pass():
    nodes = np.array(
        [(0, 0), (0.24, 0), (0.24, 0.12), (0, 0.12), (0.04, 0.02), (0.18, 0.03), (0.16, 0.08), (0.08, 0.08)]
    )
    points = np.pad(nodes, ((0, 0), (0, 1)))
    quads = np.array([(0, 1, 5, 4), (1, 2, 6, 5), (2, 3, 7, 6), (3, 0, 4, 7), (4, 5, 6, 7)], dtype=np.int32)
    areas, valid = judged_values(metric("relative_size"), points, quads, areas=np.ones(2))
    assert valid.all()
    assert areas.sum() == pytest.approx(0.24 * 0.12, rel=1e-14)
    x, y = nodes[quads, 0], nodes[quads, 1]
    shoelace = 0.5 * (x * np.roll(y, -1, axis=1) - y * np.roll(x, -1, axis=1)).sum(axis=1)
    np.testing.assert_allclose(areas, shoelace, rtol=1e-13)
    heading = np.roll(x, -1, axis=1) - x + 1j * (np.roll(y, -1, axis=1) - y)
    turns = np.angle(heading / np.roll(heading, 1, axis=1))
    np.testing.assert_allclose(judged_values(metric("scaled_jacobian"), points, quads)[0], np.sin(turns).min(axis=1))
    np.testing.assert_allclose(
        judged_values(metric("max_angle"), points, quads)[0], 180 - np.degrees(turns.min(axis=1))
    )


def test_every_metric_is_in_a_family():
    told = set(parallelogram(1, 2, 30)[1]) | set(FLAT)
    assert told == {row.key for row in METRICS}
