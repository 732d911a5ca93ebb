import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from hullquad.curves import Arc, EllipseArc, Straight, canonical, chord_error, nearest, polyline

coordinates = st.floats(-1e4, 1e4)
points = st.tuples(coordinates, coordinates)
bulges = st.floats(1e-9, 20).flatmap(lambda bulge: st.sampled_from([bulge, -bulge]))


@st.composite
def curves(draw):
    start, end = draw(points), draw(points)
    if np.hypot(*np.subtract(end, start)) < 1:
        end = (start[0] + 100, start[1])
    return (
        draw(st.sampled_from([Straight(start, end), Arc(start, end, draw(bulges))]))
        if draw(st.booleans())
        else ellipse(
            draw(st.floats(300, 3000)), draw(st.floats(300, 3000)), *draw(st.tuples(st.floats(0, 6), st.floats(0.1, 6)))
        )
    )


def ellipse(a, b, first, sweep, rotation=0.3, clockwise=False):
    ends = [first, first + sweep]
    turn = np.array([[np.cos(rotation), -np.sin(rotation)], [np.sin(rotation), np.cos(rotation)]])
    start, end = ([100, 200] + turn @ [a * np.cos(t), b * np.sin(t)] for t in ends)
    return EllipseArc(start, end, [100, 200], a, b, rotation, clockwise)


@given(curves())
@settings(max_examples=80, deadline=None)
def test_ends_keep_their_bits(curve):
    ends = curve.points(np.array([0, curve.length]))
    assert np.array_equal(ends, [curve.start, curve.end])


@given(curves())
@settings(max_examples=60, deadline=None)
def test_length_is_that_of_a_fine_polyline(curve):
    fine = curve.points(np.linspace(0, curve.length, 4001))
    assert np.hypot(*np.diff(fine, axis=0).T).sum() == pytest.approx(curve.length, rel=1e-4)


@given(curves())
@settings(max_examples=60, deadline=None)
def test_equal_lengths_are_equal_distances(curve):
    steps = np.hypot(*np.diff(curve.points(np.linspace(0, curve.length, 10_001)), axis=0).T)
    np.testing.assert_allclose(steps, curve.length / 10_000, rtol=1e-2)


@given(curves(), st.floats(0, 1))
@settings(max_examples=60, deadline=None)
def test_the_canonical_curve_has_the_same_bits_whichever_way_it_is_given(curve, part):
    one, other = canonical(curve), canonical(curve.reversed())
    at = np.array([part * one.length])
    assert one.length == other.length
    assert np.array_equal(one.points(at), other.points(at))


@given(curves(), st.floats(0.02, 0.98))
@settings(max_examples=60, deadline=None)
def test_nearest_finds_the_place_of_a_point_on_the_curve(curve, part):
    point = curve.points(np.array([part * curve.length]))
    foot = curve.points(np.array([nearest(curve, point[0])]))
    assert foot == pytest.approx(point, abs=1e-6)


@pytest.mark.parametrize("bulge", [1, -1])
def test_a_bulge_of_one_is_a_semicircle(bulge):
    arc = Arc([0, 0], [200, 0], bulge)
    assert arc.length == pytest.approx(100 * np.pi)
    assert arc.points(np.array([arc.length / 2]))[0] == pytest.approx([100, -100 * bulge])
    assert arc.headings(np.array([0, arc.length])) == pytest.approx([-bulge * np.pi / 2, bulge * np.pi / 2])


def test_a_nearly_straight_arc_lies_on_its_chord():
    arc = Arc([0, 0], [1e4, 0], 1e-9)
    assert arc.points(np.array([arc.length / 2]))[0] == pytest.approx([5e3, -5e-6], abs=1e-9)


def test_an_ellipse_turns_as_its_tangent_does():
    arc = ellipse(300, 100, 0, np.pi)
    assert np.diff(arc.headings(np.array([0, arc.length])))[0] == pytest.approx(np.pi)


def test_a_clockwise_ellipse_runs_the_other_way_round():
    forwards, backwards = ellipse(300, 100, 0, 1, 0.0), ellipse(300, 100, 0, 1, 0.0, clockwise=True)
    assert forwards.length < backwards.length
    assert backwards.points(np.array([backwards.length / 2]))[0][1] < 200


@given(curves(), st.sampled_from([0.5, 5]))
@settings(max_examples=40, deadline=None)
def test_a_polyline_keeps_its_tolerance(curve, tolerance):
    import shapely

    row = polyline(curve, tolerance)
    fine = curve.points(np.linspace(0, curve.length, 500))
    away = shapely.distance(shapely.LineString(row), shapely.points(fine)).max()
    assert away <= max(tolerance, chord_error(curve, row)) * 1.01


@pytest.mark.parametrize("radius", [1e3, 187e3, 2.5e5])
def test_the_polyline_of_an_arc_as_large_as_a_plate_keeps_the_finest_tolerance(radius):
    half = Arc([-radius, 0], [radius, 0], 1.0)
    assert chord_error(half, polyline(half, 0.02)) <= 0.02


def test_an_arc_larger_than_any_plate_has_no_endless_polyline():
    assert len(polyline(Arc([-1e9, 0], [1e9, 0], 1.0), 0.02)) == 4001
