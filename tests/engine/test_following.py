"""Lines that elements follow: their pieces, their numbers of segments, the regions that they make."""

import numpy as np
import pytest
import shapely
from hypothesis import given, settings
from hypothesis import strategies as st

from hullquad.curves import Straight
from hullquad.plate import Document, Line, Plate, Sizes, closed_loop
from hullquad.surface import Plane
from hullquad.triangulation import parity
from hullquad.triangulation.concerns import division_concerns
from hullquad.triangulation.contour import contours

WALL = Plane([0, 0, 500], [0, 1, 0], [0, 0, 1])
BOX = [(0, 0), (2000, 0), (2000, 1000), (0, 1000)]
HOLE = [(900, 400), (1100, 400), (1100, 600), (900, 600)]


def loop(corners, place, *, is_hole=False):
    rows = [np.array(corner, dtype=float) for corner in corners]
    edges = [Straight(a, b) for a, b in zip(rows, [*rows[1:], rows[0]], strict=True)]
    return closed_loop(edges, place, is_hole=is_hole)


def plate(lines=(), outer=BOX, holes=(), size=100.0, surface=WALL, name="P", divisions=(), fixed=()):
    return Plate(
        id=name,
        thickness=10,
        material="A",
        surface=surface,
        outer=loop(outer, "/plates/0/outer"),
        holes=tuple(loop(hole, f"/plates/0/holes/{i}", is_hole=True) for i, hole in enumerate(holes)),
        stiffeners=tuple(Line(a, b, f"/plates/0/stiffeners/{i}") for i, (a, b) in enumerate(lines)),
        divisions=divisions,
        fixed=np.array(fixed, dtype=float).reshape(-1, 2),
        target_size=size,
        sizes=Sizes.of(size),
        place="/plates/0",
    )


def document(*plates):
    return Document(name="d", materials={}, plates=plates)


def followed(*lines, **described):
    return contours(document(plate(lines, **described)), follow_lines=True)["P"]


def pieces(contour):
    """Followed pieces by their ends in the plane, in no order."""
    ends = contour.plate.surface.parameters(contour.lines[: contour.followed.count].reshape(-1, 3)).round(6)
    return sorted(tuple(sorted(map(tuple, row))) for row in ends.reshape(-1, 2, 2).tolist())


def regions(contour):
    return int(contour.sides.regions.max()) + 1


def test_a_line_across_a_plate_makes_two_regions():
    found = followed(((1000, 0), (1000, 1000)))
    assert pieces(found) == [((1000, 0), (1000, 1000))]
    assert regions(found) == 2
    assert (found.node_lines >= 0).sum() == 9
    assert found.nodes[found.node_lines >= 0][:, 0] == pytest.approx(1000)


def test_without_following_the_contour_is_what_it_was():
    lines = (((1000, 0), (1000, 1000)), ((0, 500), (1500, 500)))
    plain, found = contours(document(plate(lines)))["P"], followed(*lines)
    assert plain.followed is None
    count = len(plain.nodes)
    assert found.points[:count].tobytes() == plain.points.tobytes()
    assert found.nodes[:count].tobytes() == plain.nodes.tobytes()
    assert (found.node_lines[:count] < 0).all()


def test_lines_are_cut_where_they_cross_and_where_they_meet():
    found = followed(((0, 500), (2000, 500)), ((1000, 0), (1000, 1000)), ((1500, 500), (1500, 1000)))
    assert len(pieces(found)) == 6
    assert ((1000, 0), (1000, 500)) in pieces(found)
    assert regions(found) == 5


def test_lines_upon_each_other_are_one():
    found = followed(((1000, 0), (1000, 600)), ((1000, 400), (1000, 1000)), ((1000, 0), (1000, 1000)))
    assert pieces(found) == [
        ((1000, 0), (1000, 400)),
        ((1000, 400), (1000, 600)),
        ((1000, 600), (1000, 1000)),
    ]


def test_a_line_on_the_contour_is_none():
    assert pieces(followed(((0, 0.3), (2000, 0.2)), ((300, 0), (900, 0)))) == []


def test_an_end_that_nearly_touches_is_on_the_contour():
    found = followed(((1000, 0.4), (1000, 999.6)))
    assert pieces(found) == [((1000, 0), (1000, 1000))]


def test_a_line_that_ends_inside_divides_nothing():
    found = followed(((1000, 0), (1000, 400)), ((300, 300), (600, 300)))
    assert regions(found) == 1
    assert found.triangles_unavoidable == 0
    angles = found.sides.angles[found.sides.contour :]
    assert np.isclose(angles, 2 * np.pi).sum() == 3


def test_holes_cut_lines_at_nodes_of_their_own():
    found = followed(((1000, 0), (1000, 1000)), holes=[HOLE])
    assert pieces(found) == [((1000, 0), (1000, 400)), ((1000, 600), (1000, 1000))]
    assert [1000, 400] in found.nodes[: found.edge_count].tolist()
    assert regions(found) == 2


def test_a_line_through_a_corner_of_a_hole_ends_there():
    found = followed(((900, 0), (900, 1000)), holes=[HOLE])
    assert pieces(found) == [((900, 0), (900, 400)), ((900, 600), (900, 1000))]


def test_a_line_from_a_hole_to_the_contour_divides_nothing():
    found = followed(((1000, 0), (1000, 400)), holes=[HOLE])
    assert regions(found) == 1


def test_a_fixed_point_on_a_line_is_a_node_of_it():
    found = followed(((1000, 0), (1000, 1000)), fixed=[(1000.2, 333)])
    assert ((1000, 0), (1000.2, 333)) in pieces(found)


def test_a_line_beside_the_contour_or_another_one_is_left_out():
    found = followed(((0, 1), (2000, 1)), ((500, 0), (500, 1000)), ((501, 0), (501.5, 1000)))
    assert ((500, 1), (500, 1000)) in pieces(found)
    assert not any(1 in (one[1], other[1]) and one[0] != other[0] for one, other in pieces(found))
    assert not any(501 in (one[0], other[0]) for one, other in pieces(found))
    assert len(found.lines) > found.followed.count


def test_lines_at_a_tiny_angle_are_not_both_followed():
    found = followed(((0, 500), (2000, 500)), ((0, 500), (2000, 502)))
    assert pieces(found) == [((0, 500), (2000, 500))]


def test_hundreds_of_lines_make_a_grid():
    lines = [((x, 0), (x, 1000)) for x in range(10, 2000, 10)] + [((0, y), (2000, y)) for y in (300, 700)]
    found = followed(*lines, size=20.0)
    assert regions(found) == len(found.sides.four_sided) == 600
    assert found.triangles_unavoidable == 0


@pytest.mark.parametrize("size", [100.0, 130.0, 170.0])
def test_opposite_sides_agree_where_they_may_be_chosen(size):
    lines = [((x, 0), (x, 1000 - 0.2 * x)) for x in range(400, 2000, 400)]
    found = followed(*lines, outer=[(0, 0), (2000, 0), (2000, 600), (0, 1000)], size=size)
    uneven = [region for region, (a, b, c, d) in found.sides.four_sided.items() if len(a) != len(c) or len(b) != len(d)]
    assert len(found.sides.four_sided) == 5
    assert len(uneven) <= 1  # the two short ends of the plate have numbers of their own


def test_an_odd_region_is_made_even_by_its_line():
    # 20 segments left of the line, 21 right of it: whatever the line has, one of the two regions is odd
    one = followed(((1000, 0), (1000, 1000)), divisions=((4, 3, 4, 3),), size=300.0)
    assert one.triangles_unavoidable == 0
    odd = followed(((1000, 0), (1000, 1000)), divisions=((4, 3, 5, 3),), size=300.0)
    assert odd.triangles_unavoidable == odd.edge_count % 2 == 1


def test_a_line_that_several_plates_have_is_divided_once():
    across = Plane([0, 1000, 500], [1, 0, 0], [0, 0, 1])
    wide = plate([((1000, 0), (1000, 1000))], size=130.0)
    other = plate(
        [((500, 0), (500, 1000))],
        outer=[(0, 0), (1000, 0), (1000, 1000), (0, 1000)],
        surface=Plane([-500, 1000, 500], across.u, across.v),
        size=90.0,
        name="Q",
    )
    found = contours(document(wide, other), follow_lines=True)
    one, two = ({point.tobytes() for point in contour.points[contour.node_lines >= 0]} for contour in found.values())
    assert one == two
    assert len(one) == 10


def test_nodes_of_a_plate_that_stands_on_a_line_are_nodes_of_it():
    shell = plate([((1000, 0), (1000, 1000))], size=150.0)
    floor = plate(
        outer=[(0, 0), (700, 0), (700, 1000), (0, 1000)],
        size=80.0,
        name="F",
        surface=Plane([0, 1000, 500], [1, 0, 0], [0, 0, 1]),
    )
    found = contours(document(shell, floor), follow_lines=True)["P"]
    (row,) = found.rows
    edges = {tuple(sorted(edge)) for edge in found.line_edges.tolist()}
    assert {tuple(sorted(edge)) for edge in zip(row[:-1].tolist(), row[1:].tolist(), strict=True)} <= edges
    assert regions(found) == 2


@settings(max_examples=40, deadline=None)
@given(st.integers(0, 10_000))
def test_random_lines_make_pieces_that_have_only_ends_in_common(seed):
    rng = np.random.default_rng(seed)
    lines = rng.uniform([0, 0], [2000, 1000], (rng.integers(1, 12), 2, 2)).round(int(rng.integers(-2, 3)))
    lines = [line for line in lines if np.hypot(*(line[1] - line[0])) > 1]
    found = followed(*lines, holes=[HOLE], size=float(rng.uniform(60, 400)))
    edges = shapely.linestrings(found.nodes[found.line_edges])
    rim = shapely.linestrings(found.nodes[found.segments])
    one, other = shapely.STRtree(np.concatenate([edges, rim])).query(edges, predicate="intersects")
    ends = np.concatenate([found.line_edges, found.segments])
    apart = ~(ends[one][:, :, None] == ends[other][:, None, :]).any(axis=(1, 2))
    assert not apart.any()
    assert shapely.contains(found.region.buffer(1e-6), edges).all()
    assert found.triangles_unavoidable <= 1


def weight(ways, chosen):
    return sum(ways[row][2] for row in chosen)


@settings(max_examples=30, deadline=None)
@given(st.integers(0, 10_000), st.booleans())
def test_changes_leave_as_few_odd_regions_as_can_be(seed, in_tree):
    rng = np.random.default_rng(seed)
    count = int(rng.integers(2, 9))
    ends = rng.integers(0, count, (10, 2)).tolist()
    ways = [(one, other, float(rng.random())) for one, other in ends if one != other]
    odd = [region for region in range(count) if rng.random() < 0.5]
    monkey = pytest.MonkeyPatch()
    with monkey.context() as patch:
        patch.setattr(parity, "EXACT", 0 if in_tree else 80)
        chosen = parity.changes(count, odd, ways, {})
    left = set(odd)
    for row in chosen:
        left ^= {ways[row][0]} ^ {ways[row][1]}
    best = min(
        (bin_left(odd, ways, mask), sum(w for i, (_, _, w) in enumerate(ways) if mask >> i & 1))
        for mask in range(1 << len(ways))
    )
    assert len(left) == best[0]
    if not in_tree:
        assert weight(ways, chosen) == pytest.approx(best[1], abs=1e-5)


def bin_left(odd, ways, mask):
    left = set(odd)
    for i, (a, b, _) in enumerate(ways):
        if mask >> i & 1:
            left ^= {a} ^ {b}
    return len(left)


def told(*lines, **described):
    return {notice.code: notice for notice in division_concerns(followed(*lines, **described))}


def test_what_is_not_followed_is_told_with_its_place():
    notice = told(((500, 0), (500, 1000)), ((501, 0), (501.5, 1000)))["W_LINE_BESIDE"]
    assert notice.place == "/plates/0/stiffeners/1"
    assert "beside" in notice.text


@pytest.mark.parametrize(
    ("lines", "code"),
    [
        ([((890, 0), (890, 1000))], "W_LINE_NEAR"),
        ([((500, 0), (500, 1000)), ((512, 0), (512, 1000))], "W_LINE_NEAR"),
        ([((500, 0), (500, 1000)), ((0, 500), (2000, 500)), ((0, 495), (1000, 505 + 10))], "W_LINE_SHORT"),
        ([((0, 500), (2000, 900)), ((0, 500), (2000, 500))], "W_LINE_ANGLE"),
    ],
)
def test_lines_that_force_poor_elements_are_told_of(lines, code):
    notice = told(*lines, holes=[HOLE])[code]
    assert notice.place.startswith("/plates/0/stiffeners/")
    assert notice.text


@given(st.floats(2.0, 19.9))
@settings(max_examples=20, deadline=None)
def test_a_size_that_is_told_to_help_beside_lines_does(width):
    lines = ((0, width), (2000, width))
    helping = told(lines, size=100.0)["W_LINE_NEAR"].numbers["helping"]
    assert "W_LINE_NEAR" not in told(lines, size=float(f"{helping:.4g}"))


def test_usual_lines_are_no_concern():
    lines = [((x, 0), (x, 1000)) for x in (300, 600, 1500)] + [((0, 500), (600, 500)), ((1500, 200), (1900, 200))]
    assert not [code for code in told(*lines, holes=[HOLE]) if "LINE" in code]


def test_a_part_between_other_plates_that_stays_odd_is_told_of():
    shell = plate(size=200.0, divisions=((10, 6, 10, 6),))
    floors = [
        plate(
            outer=[(0, 0), (700, 0), (700, 1000), (0, 1000)],
            size=200.0,
            name=f"F{x}",
            surface=Plane([0, x, 500], [1, 0, 0], [0, 0, 1]),
        )
        for x in (600, 1400)
    ]
    found = contours(document(shell, *floors), follow_lines=True)["P"]
    odd = [notice for notice in division_concerns(found) if notice.code == "W_ODD_PART"]
    assert len(odd) == found.triangles_unavoidable > found.edge_count % 2
    assert "odd number" in odd[0].text


def test_a_line_faces_the_nodes_of_a_hole_that_it_passes_closely():
    hole = [(900, 430), (1100, 430), (1100, 590), (900, 590)]
    found = followed(((888, 0), (888, 1000)), holes=[hole], size=150.0)
    on_line = sorted(v for u, v in found.nodes.tolist() if u == 888)
    assert {430.0, 590.0} <= set(on_line)
    assert not {430.0, 590.0} & {
        v for u, v in followed(((800, 0), (800, 1000)), holes=[hole]).nodes.tolist() if u == 800
    }


def test_small_regions_with_three_sides_have_two_segments_on_each():
    found = followed(((0, 0), (200, 300)), ((400, 0), (200, 300)), size=390.0, divisions=((10, 5, 10, 5),))
    assert min((sorted(map(len, sides)) for sides in found.sides.three_sided.values()), key=sum) == [2, 2, 2]


def test_no_piece_of_many_lines_is_shorter_than_the_tolerance():
    rng = np.random.default_rng(1)
    found = followed(*rng.uniform([0, 0], [2000, 1000], (50, 2, 2)), holes=[HOLE])
    ends = found.lines[: found.followed.count]
    assert np.linalg.norm(ends[:, 1] - ends[:, 0], axis=1).min() > 0.5
    assert found.triangles_unavoidable == found.edge_count % 2
