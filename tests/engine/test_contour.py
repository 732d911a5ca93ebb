import re

import attrs
import numpy as np
import pytest
import shapely
from hypothesis import given, settings
from hypothesis import strategies as st

from hullquad import pipeline
from hullquad.curves import Arc, EllipseArc, Straight, nearest
from hullquad.errors import PlateError
from hullquad.formats.hullplate.defects import defects
from hullquad.plate import Document, Line, Plate, Sizes, closed_loop
from hullquad.surface import Plane
from hullquad.triangulation.concerns import division_concerns, size_concerns
from hullquad.triangulation.contour import attempts, contours, elements_needed, refuse_size

RECTANGLE = [(0, 0), (2000, 0), (2000, 1000), (0, 1000)]


def straight(corners):
    return [Straight(a, b) for a, b in zip(corners, [*corners[1:], corners[0]], strict=True)]


def circle(u, v, radius):
    ends = (u - radius, v), (u + radius, v)
    return [Arc(ends[0], ends[1], 1.0), Arc(ends[1], ends[0], 1.0)]


def plate(outer=None, holes=(), lines=(), fixed=(), size=100.0, divisions=(), plate_id="P"):
    return Plate(
        id=plate_id,
        thickness=10,
        material="A",
        surface=Plane([0, 0, 500], [0, 1, 0], [0, 0, 1]),
        outer=closed_loop(outer or straight(RECTANGLE), "/plates/0/outer", is_hole=False),
        holes=tuple(closed_loop(hole, f"/plates/0/holes/{i}", is_hole=True) for i, hole in enumerate(holes)),
        stiffeners=tuple(Line(a, b, f"/plates/0/stiffeners/{i}") for i, (a, b) in enumerate(lines)),
        fixed=np.array(fixed, dtype=float).reshape(-1, 2),
        divisions=divisions,
        target_size=size,
        sizes=Sizes(size, size / 4, size / 16),
        place="/plates/0",
    )


def contour(*, size=None, **described):
    return contours(Document(name="d", materials={}, plates=(plate(**described),)), size)["P"]


def row_lengths(found):
    return np.hypot(*np.diff(found.nodes[found.segments], axis=1)[:, 0].T)


def test_a_rectangle_is_divided_equally():
    found = contour()
    assert found.edge_count == 60
    assert row_lengths(found) == pytest.approx(np.full(60, 100))
    assert found.area == pytest.approx(2e6)
    assert found.triangles_unavoidable == 0


@pytest.mark.parametrize(("size", "edges"), [(None, 60), ("coarse", 60), ("fine", 240), (500, 12), (1e6, 4)])
def test_the_size_may_be_named_or_given(size, edges):
    assert contour(size=size).edge_count == edges


def test_nodes_lie_in_space_on_the_plane():
    assert contour(size=1000).points[1] == pytest.approx([0, 1000, 500])


def test_loops_follow_one_another_with_the_plate_on_their_left():
    found = contour(holes=[circle(500, 500, 100), straight([(1000, 400), (1000, 600), (1200, 600)])])
    outer, *holes = found.rings
    assert list(map(len, found.rings)) == list(np.diff(found.loop_starts))
    assert shapely.LinearRing(outer).is_ccw
    assert not any(shapely.LinearRing(hole).is_ccw for hole in holes)
    assert found.area == pytest.approx(found.region.area)
    assert all(
        shapely.Polygon(hole).contains(shapely.Point(at)) for hole, at in zip(holes, found.hole_points, strict=True)
    )


def test_an_arc_turns_at_most_60_degrees_a_segment():
    assert len(contour(holes=[circle(500, 500, 100)], size=5000).rings[1]) == 6


def test_the_tip_of_an_ellipse_turns_at_most_60_degrees_a_segment():
    ends = (400, 500), (1600, 500)
    oval = [EllipseArc(a, b, (1000, 500), 600, 60) for a, b in (ends, ends[::-1])]
    ring = contour(holes=[oval], size=5000).rings[1]
    upper = ring[ring[:, 1] >= 500]
    places = np.sort([nearest(oval[1], node) for node in upper])
    assert np.abs(np.diff(oval[1].headings(places))).max() == pytest.approx(np.radians(60), abs=np.radians(3))


def test_nodes_of_an_arc_lie_on_it_at_equal_distances():
    found = contour(holes=[circle(500, 500, 100)], size=37)
    ring = found.rings[1]
    assert np.hypot(*(ring - 500).T) == pytest.approx(np.full(len(ring), 100), abs=1e-9)
    sides = np.hypot(*(ring - np.roll(ring, 1, axis=0)).T)
    assert sides == pytest.approx(np.full(len(ring), sides.mean()), rel=1e-9)


def test_divisions_override_the_size():
    assert contour(divisions=((7, 1, 1, 2),)).edge_count == 11


def test_a_fixed_node_splits_a_division_by_length():
    found = contour(lines=[((500, 0), (500, 500))], divisions=((8, 1, 1, 1),))
    bottom = np.sort(found.nodes[: found.edge_count][found.nodes[: found.edge_count, 1] == 0][:, 0])
    assert bottom == pytest.approx(np.arange(0, 2001, 250))


def test_every_part_of_a_division_has_a_segment():
    found = contour(lines=[((500, 0), (500, 500)), ((501, 0), (501, 400))], divisions=((1, 1, 1, 1),))
    assert found.edge_count == 6


def test_an_odd_contour_needs_a_triangle():
    assert contour(divisions=((7, 1, 1, 1),)).triangles_unavoidable == 0
    assert contour(divisions=((8, 1, 1, 1),)).triangles_unavoidable == 1


def test_the_end_of_a_line_is_a_node_on_the_edge():
    found = contour(lines=[((500.25, 0), (500, 500))])
    assert [500.25, 0] in found.nodes[: found.edge_count].tolist()
    assert found.inside.tolist() == [[500, 500]]
    assert found.snaps == ()


def test_an_end_beside_the_contour_is_moved_onto_it_and_told():
    found = contour(lines=[((500, 0.4), (500, 500))])
    assert [500, 0] in found.nodes[: found.edge_count].tolist()
    assert [(snap.place, snap.distance) for snap in found.snaps] == [("/plates/0/stiffeners/0/a", pytest.approx(0.4))]


def test_an_end_beside_a_vertex_is_that_vertex():
    found = contour(lines=[((0.3, 0.3), (500, 500))])
    assert found.edge_count == 60
    assert found.snaps[0].node.tolist() == [0, 0]


def test_fixed_nodes_nearer_than_the_tolerance_become_one():
    found = contour(fixed=[(500, 500), (500.3, 500), (1000, 0), (1000.3, 0)])
    assert found.inside.tolist() == [[500, 500]]
    assert found.edge_count == 60
    assert len(found.snaps) == 2


def test_an_end_in_a_hole_is_no_node():
    assert len(contour(holes=[circle(500, 500, 100)], lines=[((500, 500), (500, 900))]).inside) == 1


def test_lines_are_cut_by_holes():
    lines = contour(holes=[circle(500, 500, 100)], lines=[((100, 500), (900, 500))]).lines
    assert lines[:, :, 1] == pytest.approx(np.array([[100, 400], [600, 900]]), abs=0.05)


def test_a_plate_with_too_many_elements_is_refused():
    with pytest.raises(PlateError) as caught:
        contour(size=0.1)
    assert (caught.value.code, caught.value.place) == ("E_TOO_BIG", "/plates/0")
    with pytest.raises(PlateError) as caught:
        contours(Document(name="d", materials={}, plates=(plate(size=0.1),)))
    assert (caught.value.code, caught.value.place) == ("E_TOO_BIG", "/plates/0/target_size")


@given(st.floats(1, 1e5), st.floats(1, 1e5), st.integers(0, 30_000))
@settings(max_examples=60, deadline=None)
def test_the_size_told_is_the_least_that_is_allowed(width, height, wished):
    corners = [(0, 0), (width, 0), (width, height), (0, height)]
    described = plate(outer=straight(corners), divisions=((wished,) * 4,) if wished else ())
    with pytest.raises(PlateError) as caught:
        refuse_size(described, 1e-4, "")
    told = float(re.search("choose ([0-9.e+-]+) mm", caught.value.text)[1])
    refuse_size(described, told, "")
    with pytest.raises(PlateError):
        refuse_size(described, told / 1.02, "")
    triangles = 2 * elements_needed(described, told) + 2 * 4 * max(wished, 1)
    assert triangles < pipeline._MOST_TRIANGLES


def test_divisions_too_many_for_any_size_are_refused():
    with pytest.raises(PlateError) as caught:
        contour(divisions=((10**7, 1, 1, 1),))
    assert (caught.value.key, caught.value.place) == ("E_TOO_BIG:divisions", "/plates/0/divisions")
    assert "10,000,003 segments" in caught.value.text


@pytest.mark.parametrize("size", [1e-320, 0.0, -1.0, float("nan"), float("inf"), 1e155])
def test_a_size_that_is_none_is_refused(size):
    with pytest.raises(PlateError) as caught:
        contour(size=size)
    assert "inf elements" not in caught.value.text


@given(st.floats(1e3, 1e8), st.floats(0.1, 1), st.floats(0.05, 0.95), st.sampled_from([1, -1]), st.booleans())
@settings(max_examples=80, deadline=None)
def test_points_exactly_on_an_arc_are_nodes_on_it(radius, width, part, sense, as_line):
    """Decks have cambers of hundreds of metres: their chords are farther from them than any tolerance."""
    chord = width * min(2 * radius, 4e5)
    bulge = sense * np.tan(np.arcsin(chord / 2 / radius) / 2)
    arc = Arc((0, 0), (chord, 0), bulge)
    below = -chord
    outer = [arc.reversed(), *straight([(0, 0), (0, below), (chord, below), (chord, 0)])[:3]]
    on_arc = arc.points(np.array([part * arc.length]))[0]
    points = {"lines": [(on_arc, (on_arc[0], below))]} if as_line else {"fixed": [on_arc]}
    described = plate(outer=outer, size=chord / 7, **points)
    assert defects(described) == []
    found = contours(Document(name="d", materials={}, plates=(described,)))["P"]
    assert tuple(on_arc) in set(map(tuple, found.nodes[: found.edge_count]))
    assert not len(found.inside)
    assert not found.snaps


@pytest.mark.parametrize("size", [100.0, 700.0, 23.0])
def test_warnings_are_those_of_the_size_that_is_used(size):
    holes = [circle(500, 500, 150)]
    found = contour(holes=holes, divisions=((7, 3, 6, 2), (3, 3)), fixed=[(1000, 30)], size=size)
    notices = {notice.code: notice for notice in division_concerns(found)}
    assert notices.keys() == {100.0: set(), 700.0: {"W_SMALL_HOLE", "W_NEAR"}, 23.0: set()}[size]
    assert all(notice.numbers["size"] == size and notice.text for notice in notices.values())


def test_an_odd_contour_is_warned_about():
    (notice,) = division_concerns(contour(divisions=((7, 3, 6, 3),), size=500))
    assert (notice.code, notice.numbers) == ("W_ODD", {"count": 19, "size": 500})


def test_chords_that_cut_a_neighbouring_hole_are_refused_with_a_size_that_helps():
    outer = [Arc((0, 0), (2000, 0), 0.5), *straight([(2000, 0), (2000, 1000), (0, 1000), (0, 0)])[:3]]
    near_the_arc = circle(500, -300, 50)
    with pytest.raises(PlateError) as caught:
        contour(outer=outer, holes=[near_the_arc], size=5000)
    assert (caught.value.code, caught.value.place) == ("E_COARSE", "/plates/0/holes/0")
    assert contour(outer=outer, holes=[near_the_arc], size=caught.value.numbers["helping"])


def test_the_size_that_helps_is_about_the_largest():
    outer = [Arc((0, 0), (2000, 0), 0.5), *straight([(2000, 0), (2000, 1000), (0, 1000), (0, 0)])[:3]]
    described = {"outer": outer, "holes": [circle(500, -300, 50)]}
    with pytest.raises(PlateError) as caught:
        contour(**described, size=5000)
    helping = caught.value.numbers["helping"]
    assert f"{helping:.4g} mm helps" in caught.value.text
    contour(**described, size=helping)
    with pytest.raises(PlateError):
        contour(**described, size=1.15 * helping)


@given(st.floats(1.5, 90), st.floats(50, 1000), st.booleans())
@settings(max_examples=40, deadline=None)
def test_strips_too_narrow_for_any_element_are_told_with_a_size_that_helps(width, size, beside_hole):
    square = straight([(1000, 400), (1000, 600), (1200, 600), (1200, 400)])
    other = straight([(1200 + width, 300), (1200 + width, 700), (1500, 700), (1500, 300)])
    top = 1000 if beside_hole else 600 + width
    outer = straight([(0, 0), (2000, 0), (2000, top), (0, top)])
    described = plate(outer=outer, holes=[square, other] if beside_hole else [square])
    found = [notice for notice in size_concerns(described, size) if notice.code == "W_LIGAMENT"]
    assert [notice.case for notice in found] == (
        ["hole" if beside_hole else "contour"] if width < 0.2 * size * (1 - 1e-9) else []
    )
    for notice in found:
        assert notice.numbers["width"] == pytest.approx(width)
        helping = notice.numbers["helping"]
        assert f"choose {helping:.4g} mm or less" in notice.text
        assert not [n for n in size_concerns(described, float(f"{helping:.4g}")) if n.code == "W_LIGAMENT"]


@given(st.floats(1.5, 300), st.sampled_from([0.2, 1.0]))
@settings(max_examples=40, deadline=None)
def test_a_size_that_is_told_to_help_does(length, part):
    """Of short edges and small holes; the length is a part of the size from which they are none."""
    small = straight([(1000, 400), (1000, 400 + length), (1000 + length, 400 + length), (1000 + length, 400)])
    described = plate(holes=[small])
    code = {0.2: "W_SHORT_EDGE", 1.0: "W_SMALL_HOLE"}[part]
    (notice,) = [notice for notice in size_concerns(described, 2 * length / part) if notice.code == code]
    helping = notice.numbers["helping"]
    assert f"choose {helping:.4g} mm or less" in notice.text
    assert helping > 0.98 * length / part
    assert not [n for n in size_concerns(described, float(f"{helping:.4g}")) if n.code == code]


def notched(width):
    """A plate 2000 wide, cut from above so that only a neck is left."""
    corners = [(0, 0), (2000, 0), (2000, 1000), (1100, 1000), (1100, width), (900, width), (900, 1000), (0, 1000)]
    return plate(outer=straight(corners))


@given(st.floats(1.5, 90), st.floats(50, 1000))
@settings(max_examples=40, deadline=None)
def test_a_neck_of_the_contour_itself_is_told_like_a_strip_beside_a_hole(width, size):
    found = [notice for notice in size_concerns(notched(width), size) if notice.code == "W_LIGAMENT"]
    assert [notice.case for notice in found] == (["neck"] if width < 0.2 * size * (1 - 1e-9) else [])
    for notice in found:
        assert notice.place == "/plates/0/outer/0"
        assert notice.numbers["width"] == pytest.approx(width)
        helping = notice.numbers["helping"]
        assert f"choose {helping:.4g} mm or less" in notice.text
        assert not [n for n in size_concerns(notched(width), float(f"{helping:.4g}")) if n.code == "W_LIGAMENT"]


def test_a_tongue_between_two_ends_of_a_hole_is_a_neck():
    ring = [(500, 200), (900, 200), (900, 600), (710, 600), (710, 500), (800, 500), (800, 300), (600, 300)]
    described = plate(holes=[straight([*ring, (600, 500), (690, 500), (690, 600), (500, 600)])])
    (notice,) = [notice for notice in size_concerns(described, 200.0) if notice.code == "W_LIGAMENT"]
    assert (notice.case, notice.numbers["width"]) == ("neck", pytest.approx(20))


@pytest.mark.parametrize(
    "outer",
    [
        [(0, 0), (2000, 0), (2000, 2), (0, 2)],
        [(0, 0), (50, 0), (1000, 0), (1000, 1000)],
        [(0, 0), (1000, 0), (1000, 500), (15, 40), (0, 25)],
    ],
    ids=["strip", "corner", "nose"],
)
def test_what_only_runs_out_narrow_is_no_neck(outer):
    assert not [notice for notice in size_concerns(plate(outer=straight(outer)), 200.0) if notice.case == "neck"]


def test_a_size_larger_than_the_plate_is_told_with_the_plates_own():
    (notice,) = [n for n in size_concerns(plate(), 2500.0) if n.code == "W_SIZE"]
    assert "extent is 2000 mm" in notice.text
    assert [n.code for n in size_concerns(plate(), 50_000.0)] == ["W_SIZE"]  # its edges are short beside that only
    assert "W_SIZE" not in {n.code for n in size_concerns(plate(), 2000.0)}


def test_chords_that_leave_a_fixed_node_outside_are_refused():
    outer = [Arc((0, 0), (2000, 0), 0.5), *straight([(2000, 0), (2000, 1000), (0, 1000), (0, 0)])[:3]]
    with pytest.raises(PlateError) as caught:
        contour(outer=outer, fixed=[(480, -370)], size=5000)
    assert (caught.value.code, caught.value.place) == ("E_COARSE", "/plates/0/fixed/0")


def test_one_plate_does_not_stop_the_others():
    plates = (plate(size=0.1), plate(plate_id="Q"))
    outcomes = attempts(Document(name="d", materials={}, plates=plates))
    assert isinstance(outcomes["P"], PlateError)
    assert outcomes["Q"].edge_count == 60


@st.composite
def outlines(draw):
    count = draw(st.integers(3, 9))
    angles = 2 * np.pi * np.arange(count) / count
    radii = np.array(draw(st.lists(st.floats(600, 1000), min_size=count, max_size=count)))
    corners = np.stack([radii * np.cos(angles), radii * np.sin(angles)], axis=1)
    bulges = draw(st.lists(st.sampled_from([0, 0.05, 0.1]), min_size=count, max_size=count))
    pairs = zip(corners, np.roll(corners, -1, axis=0), bulges, strict=True)
    return [Arc(a, b, bulge) if bulge else Straight(a, b) for a, b, bulge in pairs]


@given(outlines(), st.floats(20, 3000))
@settings(max_examples=60, deadline=None)
def test_vertices_keep_their_bits_and_nodes_lie_on_the_curves(outer, size):
    nodes = contour(outer=outer, size=size).nodes
    assert {tuple(curve.start) for curve in outer} <= set(map(tuple, nodes))
    feet = [[curve.points(np.array([nearest(curve, node)]))[0] for curve in outer] for node in nodes[:20]]
    away = np.hypot(*np.moveaxis(np.array(feet) - nodes[:20, None], 2, 0)).min(axis=1)
    assert away.max() < 1e-6


@given(outlines(), st.floats(20, 3000))
@settings(max_examples=60, deadline=None)
def test_segments_are_near_the_size_where_the_edges_allow_it(outer, size):
    found = contour(outer=outer, size=size)
    assert row_lengths(found).max() < max(1.5 * size, 1)


@given(outlines(), st.floats(20, 3000), st.floats(0.1, 0.9))
@settings(max_examples=60, deadline=None)
def test_the_division_is_the_same_whichever_way_the_loop_runs(outer, size, part):
    end = outer[0].points(np.array([part * outer[0].length]))[0]
    backwards = [curve.reversed() for curve in reversed(outer)]
    one = contour(outer=outer, size=size, lines=[(end, (0, 0))])
    other = contour(outer=backwards, size=size, lines=[(end, (0, 0))])
    assert set(map(tuple, one.nodes)) == set(map(tuple, other.nodes))


def test_a_contour_never_changes():
    with pytest.raises(attrs.exceptions.FrozenInstanceError):
        contour().size = 3
    with pytest.raises(ValueError, match="read-only"):
        contour().nodes[0] = 0
