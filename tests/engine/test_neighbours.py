"""Plates that meet in space have the same nodes there, to the last bit."""

from itertools import pairwise, permutations
from pathlib import Path

import attrs
import numpy as np
import pytest
import shapely
from hypothesis import given, settings
from hypothesis import strategies as st

from hullquad import pipeline
from hullquad.curves import Arc, EllipseArc, Straight
from hullquad.errors import PlateError
from hullquad.formats import read_mesh, read_plates, write_mesh
from hullquad.plate import Document, Line, Plate, Sizes, closed_loop
from hullquad.surface import Plane
from hullquad.triangulation.concerns import division_concerns, gap_concerns
from hullquad.triangulation.contour import Contour, attempts, contours
from hullquad.triangulation.curved import curved_refusal
from hullquad.triangulation.edges import edge_counts, redivided
from hullquad.triangulation.evening import evened
from hullquad.triangulation.neighbours import neighbours
from hullquad.triangulation.remedies import remedied, remedy

PLATES = Path(__file__).parents[2] / "assets" / "plates"
SAMPLES = [read_plates(path) for path in sorted(PLATES.glob("*.json"))]
BLOCK = next(sample for sample in SAMPLES if sample.name == "hopper_block")
X, Y, Z = np.eye(3)
FAR = np.array([1e5, -2e5, 5e4])


def straight(corners):
    return [Straight(a, b) for a, b in zip(corners, [*corners[1:], corners[0]], strict=True)]


def plate(name, outer, frame, *, size=500.0, lines=(), holes=(), fixed=(), divisions=()):
    outer = straight(outer) if isinstance(outer[0], tuple) else outer
    return Plate(
        id=name,
        thickness=10,
        material="A",
        surface=Plane(*frame),
        outer=closed_loop(outer, f"/{name}/outer", is_hole=False),
        holes=tuple(closed_loop(hole, f"/{name}/holes/{i}", is_hole=True) for i, hole in enumerate(holes)),
        stiffeners=tuple(Line(a, b, f"/{name}/stiffeners/{i}") for i, (a, b) in enumerate(lines)),
        fixed=np.array(fixed, dtype=float).reshape(-1, 2),
        divisions=divisions,
        target_size=size,
        sizes=Sizes(size, size / 4, size / 16),
        place=f"/{name}",
    )


def rectangle(width, height, u=0.0, v=0.0):
    return [(u, v), (u + width, v), (u + width, v + height), (u, v + height)]


def document(*plates):
    return Document(name="d", materials={}, plates=plates)


def turned(plates, rotation, shift=FAR):
    """The plates elsewhere in space."""
    for one in plates:
        origin, u, v = (rotation @ axis for axis in (one.surface.origin, one.surface.u, one.surface.v))
        yield attrs.evolve(one, surface=Plane(origin + shift, u, v))


@st.composite
def rotations(draw):
    numbers = draw(st.lists(st.floats(-1, 1), min_size=4, max_size=4).filter(lambda q: np.linalg.norm(q) > 0.1))
    w, x, y, z = np.array(numbers) / np.linalg.norm(numbers)
    cross = np.array([[0, -z, y], [z, 0, -x], [-y, x, 0]])
    return np.eye(3) + 2 * w * cross + 2 * cross @ cross


def without_partner(one: Contour, other: Contour, *, faces: bool = True) -> int:
    """Number of contour nodes that lie on another plate, which has not the same node."""
    points = one.points[: one.edge_count]
    plane = other.plate.surface
    feet = plane.parameters(points)
    region = other.plate.region if faces else other.plate.region.boundary
    away = np.hypot(np.linalg.norm(plane.points(feet) - points, axis=1), shapely.distance(region, shapely.points(feet)))
    known = set(map(tuple, other.points))
    return sum(tuple(point) not in known for point in points[away < 0.9])


def assert_conforming(found):
    lost = {
        (one.plate.id, other.plate.id): without_partner(one, other) for one, other in permutations(found.values(), 2)
    }
    assert {pair: count for pair, count in lost.items() if count} == {}


def joined(plates):
    """Joints on each edge of the plates."""
    return neighbours(tuple(plates)).joints.breaks


def edge_nodes(contour: Contour, along):
    """Places of the contour's nodes on a line in space through the origin of the plate, in order."""
    points = contour.points[: contour.edge_count] - contour.plate.surface.origin
    is_on = np.linalg.norm(points - (points @ along)[:, None] * along, axis=1) < 1e-3
    return np.sort(points[is_on] @ along)


@pytest.mark.parametrize("size", [None, "coarse", "fine", "very_fine", 333.0])
def test_the_plates_of_a_block_have_no_node_without_its_partner(size):
    assert_conforming(contours(BLOCK, size))


def test_nodes_in_space_are_where_the_plates_have_them():
    for contour in contours(BLOCK, "fine").values():
        assert np.abs(contour.plate.surface.points(contour.nodes) - contour.points).max() < 1e-3


def test_edges_that_stand_on_a_plate_are_rows_of_nodes_from_end_to_end():
    found = contours(BLOCK, "coarse")
    (row,) = found["B1"].rows
    assert found["B1"].points[row] == pytest.approx(np.array([[2400, y, 0] for y in np.linspace(7200, 11400, 6)]))
    assert (row[[0, -1]] < found["B1"].edge_count).all()
    assert (row[1:-1] >= found["B1"].edge_count).all()


def test_a_mesh_of_a_block_has_the_common_nodes():
    found = contours(BLOCK, "coarse")
    shell, floor = (pipeline.paper_mesh(found[key]) for key in ("B1", "F1"))
    assert len(set(map(tuple, shell.points)) & set(map(tuple, floor.points))) == 6


@st.composite
def boxes(draw):
    """Plates of a box that is divided by decks and bulkheads, each cut where it is not cut in the others."""
    xs, ys, zs = (
        np.cumsum([0, *draw(st.lists(st.integers(200, 900), min_size=1, max_size=3))]).astype(float) for _ in range(3)
    )
    sizes = st.sampled_from([90.0, 150.0, 333.0, 1000.0])
    sheets = [((X, Y), xs, ys, zs, Z), ((X, Z), xs, zs, ys, Y), ((Y, Z), ys, zs, xs, X)]
    plates = []
    for (u, v), along, across, levels, normal in sheets:
        for level in levels:
            cuts = [0, *sorted(draw(st.sets(st.sampled_from(along[1:-1].tolist() or [along[-1]])))), along[-1]]
            for start, end in pairwise(cuts):
                if end > start:
                    outer = rectangle(end - start, across[-1], start)
                    frame = level * normal, u, v
                    plates.append(plate(f"P{len(plates)}", outer, frame, size=draw(sizes)))
    return draw(st.permutations(plates))


@given(boxes(), rotations(), st.integers(0, 2**32), st.sampled_from([0.0, 0.001, 0.05, 0.25]))
@settings(max_examples=70, deadline=None)
def test_boxes_of_plates_that_may_not_quite_meet_have_no_node_without_its_partner(plates, rotation, seed, gap):
    ways = np.random.default_rng(seed).uniform(-gap, gap, (len(plates), 3))
    shaken = [
        attrs.evolve(one, surface=attrs.evolve(one.surface, origin=one.surface.origin + way))
        for one, way in zip(plates, ways, strict=True)
    ]
    found = contours(document(*turned(shaken, rotation)))
    assert_conforming(found)
    distances = [snap.distance for contour in found.values() for snap in contour.snaps]
    assert bool(distances) == (gap > 0)
    assert all(distance < 2 * np.sqrt(3) * gap for distance in distances)


@given(boxes(), rotations())
@settings(max_examples=20, deadline=None)
def test_the_order_of_the_plates_does_not_change_the_numbers_of_nodes(plates, rotation):
    plates = list(turned(plates, rotation))
    one, other = contours(document(*plates)), contours(document(*plates[::-1]))
    assert {key: len(contour.nodes) for key, contour in one.items()} == {
        key: len(contour.nodes) for key, contour in other.items()
    }


@given(st.floats(0.3, 1.5), st.floats(0.2, 0.8), st.floats(0.1, 0.5), rotations(), st.booleans())
@settings(max_examples=40, deadline=None)
def test_a_part_of_a_round_edge_is_divided_once(bulge, first, part, rotation, as_ellipse):
    ends = (-1000.0, 0.0), (1000.0, 0.0)
    whole = EllipseArc(*ends, (0, 0), 1000, 700) if as_ellipse else Arc(*ends, bulge)
    second = first + part * (1 - first)
    a, b = whole.points(whole.length * np.array([first, second]))
    quarter = np.tan(whole.sweep * (second - first) / 4)
    piece = EllipseArc(a, b, (0, 0), 1000, 700) if as_ellipse else Arc(a, b, quarter)
    beyond = [Straight(b, 2 * b), Straight(2 * b, 2 * a), Straight(2 * a, a)]
    plates = (
        plate("A", [whole, Straight(*ends[::-1])], (0 * X, X, Y), size=90.0),
        plate("B", [piece, *beyond], (0 * X, X, Y), size=60.0),
    )
    found = contours(document(*turned(plates, rotation)))
    assert_conforming(found)
    assert [len(breaks) for breaks in joined(plates)[:3]] == [4, 2, 2]


def test_the_finest_size_divides_what_is_common():
    floor = plate("F", rectangle(1000, 400), (0 * X, X, Z), size=100.0)
    shell = plate("S", rectangle(1000, 2000), (0 * X, X, Y), size=500.0)
    found = contours(document(shell, floor))
    assert len(edge_nodes(found["S"], X)) == 11
    assert len(edge_nodes(found["S"], Y)) == 5


def test_a_vertex_and_a_line_of_one_plate_cut_the_edge_of_the_other():
    long = plate("L", rectangle(3000, 500), (0 * X, X, Z), size=1000.0)
    short = plate("S", rectangle(700, 500), (400 * X, X, Y), size=1000.0, lines=[((300, 0), (300, 500))])
    nodes = edge_nodes(contours(document(long, short))["L"], X)
    assert nodes == pytest.approx([0, 400, 700, 1100, 2050, 3000])


def test_a_stiffener_cuts_the_edge_that_stands_across_it():
    shell = plate("S", rectangle(2000, 2000), (0 * X, X, Y), size=500.0, lines=[((0, 700), (2000, 700))])
    floor = plate("F", rectangle(2000, 500), (1000 * X, Y, Z), size=500.0)
    assert 700.0 in edge_nodes(contours(document(shell, floor))["F"], Y).round(9)


def test_an_edge_is_no_node_where_it_stands_over_a_hole():
    hole = straight(rectangle(400, 400, 800, 800))
    shell = plate("S", rectangle(2000, 2000), (0 * X, X, Y), size=100.0, holes=[hole])
    floor = plate("F", rectangle(2000, 500), (1000 * X, Y, Z), size=100.0)
    found = contours(document(shell, floor))
    assert_conforming(found)
    assert [len(row) for row in found["S"].rows] == [9, 9]
    assert [1000, 800, 0] in found["S"].points[: found["S"].edge_count].tolist()


def test_edges_that_cross_on_a_plate_share_the_node():
    shell = plate("S", rectangle(2000, 2000), (0 * X, X, Y))
    floor = plate("F", rectangle(2000, 500), (900 * X, Y, Z))
    girder = plate("G", rectangle(2000, 500), (700 * Y, X, Z))
    found = contours(document(shell, floor, girder))
    assert all([900, 700, 0] in found[key].points.tolist() for key in "SFG")
    along, across = found["S"].rows
    assert len(set(along) & set(across)) == 1


def test_a_bracket_that_only_touches_a_plate_shares_its_toe():
    shell = plate("S", rectangle(2000, 2000), (0 * X, X, Y))
    bracket = plate("B", [(0, 0), (300, 400), (-300, 400)], (np.array([700, 900, 0]), X, Z))
    assert [700, 900, 0] in contours(document(shell, bracket))["S"].points.tolist()


def two(gap, *, size=500.0):
    """Two plates in one plane, a gap between them [mm]."""
    return document(
        plate("A", rectangle(3000, 1000), (0 * X, X, Y), size=size),
        plate("B", rectangle(3000, 1000, 0, 1000 + gap), (0 * X, X, Y), size=size),
    )


@pytest.mark.parametrize("gap", [1e-9, 0.1, 0.5, 0.99])
def test_small_gaps_are_closed_and_told(gap):
    found = contours(two(gap))
    common = set(map(tuple, found["A"].points)) & set(map(tuple, found["B"].points))
    assert len(common) == 7
    told = [notice for notice in division_concerns(found["B"]) if notice.code == "W_SNAP"]
    assert [notice.numbers["distance"] for notice in told] == ([] if gap < 1e-3 else [pytest.approx(gap)] * 2)
    assert all("plate A has it" in notice.text for notice in told)
    assert not list(gap_concerns(two(gap)))


@pytest.mark.parametrize("gap", [1.01, 3.0, 4.9])
def test_wider_gaps_are_told_and_left(gap):
    found = contours(two(gap))
    assert not any(contour.snaps for contour in found.values())
    (notice,) = gap_concerns(two(gap))
    assert (notice.place, notice.numbers["neighbour"]) == ("/A/outer/2", "B")
    assert notice.numbers["distance"] == pytest.approx(gap)


@pytest.mark.parametrize("gap", [5.1, 50.0])
def test_what_is_meant_to_be_apart_is_not_told(gap):
    assert not list(gap_concerns(two(gap)))


def test_an_edge_above_a_face_is_told():
    shell = plate("S", rectangle(2000, 2000), (0 * X, X, Y))
    floor = plate("F", rectangle(2000, 500), (np.array([900, 0, 2.5]), Y, Z))
    told = {notice.place: notice.numbers for notice in gap_concerns(document(shell, floor))}
    assert told["/F/outer/0"]["neighbour"] == "S"
    assert told["/F/outer/0"]["distance"] == pytest.approx(2.5)


def test_nothing_is_told_of_a_sound_block():
    assert not list(gap_concerns(BLOCK))
    codes = {notice.code for contour in contours(BLOCK, "coarse").values() for notice in division_concerns(contour)}
    assert "W_SNAP" not in codes


def test_nodes_off_the_plane_of_a_plate_survive_its_file(tmp_path):
    shell = plate("S", rectangle(300, 300), (0 * X, X, Y), size=100.0)
    floor = plate("F", rectangle(300, 300), (np.array([0, -0.9, 0]), X, Z), size=100.0)
    mesh = pipeline.paper_mesh(contours(document(shell, floor))["F"], "0" * 64)
    assert np.abs(mesh.surface.points(mesh.parameters) - mesh.points).max() == pytest.approx(0.9)
    write_mesh(mesh, tmp_path / "floor.vtu")
    assert read_mesh(tmp_path / "floor.vtu").points.tobytes() == mesh.points.tobytes()


def test_a_number_of_divisions_holds_for_all_plates_of_the_edge():
    floor = plate("F", rectangle(1000, 400), (0 * X, X, Z), divisions=((7, 1, 7, 1),))
    shell = plate("S", rectangle(1000, 2000), (0 * X, X, Y))
    assert len(edge_nodes(contours(document(shell, floor))["S"], X)) == 8


def test_a_number_for_a_part_of_an_edge_leaves_the_rest_to_the_whole():
    short = plate("S", rectangle(400, 400), (0 * X, X, Z), divisions=((4, 1, 1, 1),))
    long = plate("L", rectangle(1000, 400), (0 * X, X, Y), divisions=((10, 1, 1, 1),))
    assert edge_nodes(contours(document(long, short))["L"], X) == pytest.approx(np.arange(0, 1001, 100))


def test_two_numbers_for_one_edge_are_refused_at_the_later_plate():
    one = plate("A", rectangle(1000, 400), (0 * X, X, Z), divisions=((7, 1, 7, 1),))
    other = plate("B", rectangle(1000, 2000), (0 * X, X, Y), divisions=((6, 1, 6, 1),))
    found = attempts(document(one, other))
    assert isinstance(found["A"], Contour)
    assert isinstance(found["B"], PlateError)
    assert (found["B"].key, found["B"].place) == ("E_DIVISIONS:neighbour", "/B/divisions/outer/0")
    assert "6 segments" in found["B"].text


def test_a_plate_that_is_refused_for_its_size_does_not_bind_its_neighbours():
    fine = plate("A", rectangle(3000, 1000), (0 * X, X, Y), size=0.1)
    other = plate("B", rectangle(3000, 1000, 0, 1000), (0 * X, X, Y))
    assert contours(document(other))["B"].edge_count == attempts(document(fine, other))["B"].edge_count


def test_short_edges_of_neighbours_are_not_melted_together():
    corners = [(0, 0), (1000, 0), (1000, 500), (1.0, 500), (0, 499)]
    one, other = plate("A", corners, (0 * X, X, Y)), plate("B", corners, (0 * X, X, Y))
    found = contours(document(one, other))
    assert found["A"].points.tobytes() == found["B"].points.tobytes()
    assert_conforming(found)


def odd(described, size=None):
    return {key for key, contour in contours(described, size).items() if contour.triangles_unavoidable}


@pytest.mark.parametrize("size", ["coarse", "fine", 171.0])
@pytest.mark.parametrize("described", SAMPLES, ids=lambda described: described.name)
def test_a_remedy_makes_a_contour_even_and_keeps_what_it_promises(described, size):
    before = odd(described, size)
    for key in before:
        change = remedy(described, key, size)
        after = odd(remedied(described, change), size)
        assert key not in after
        assert len(after) - len(before) == change.odd
        assert before ^ after <= {key, *change.neighbours}


@given(boxes())
@settings(max_examples=25, deadline=None)
def test_a_remedy_in_a_box_divides_the_neighbours_too(plates):
    described = document(*plates)
    before = odd(described)
    for key in sorted(before)[:2]:
        change = remedy(described, key)
        mended = remedied(described, change)
        found = contours(mended)
        assert key not in odd(mended)
        assert len(odd(mended)) - len(before) == change.odd
        assert edge_counts(mended, key)[change.loop][change.edge] == change.number == change.before + 1 or (
            change.number == change.before - 1
        )
        assert_conforming(found)


def test_an_even_contour_needs_no_remedy():
    assert remedy(document(plate("A", rectangle(1000, 500), (0 * X, X, Y))), "A") is None


def test_of_two_odd_neighbours_the_common_edge_is_changed():
    one = plate("A", rectangle(1000, 500), (0 * X, X, Z), divisions=((0, 1, 3, 1),))
    other = plate("B", rectangle(1000, 500), (0 * X, X, Y), divisions=((0, 1, 3, 1),))
    change = remedy(document(one, other), "A")
    assert (change.edge, change.neighbours, change.odd) == (0, ("B",), -2)
    assert not odd(remedied(document(one, other), change))


def test_the_edge_whose_segments_stay_nearest_to_the_size_is_chosen():
    alone = plate("A", rectangle(2000, 700), (0 * X, X, Y), size=100.0, divisions=((20, 7, 21, 7),))
    change = remedy(document(alone), "A")
    assert (change.loop, change.edge, change.number) == (0, 2, 20)


def test_an_edge_of_the_document_keeps_its_number_whichever_way_the_loop_runs():
    for corners in (rectangle(2000, 700), rectangle(2000, 700)[::-1]):
        described = redivided(document(plate("A", corners, (0 * X, X, Y), size=100.0)), "A", 0, 0, 5)
        assert edge_counts(described, "A")[0][0] == 5
        assert sum(edge_counts(described, "A")[0]) == contours(described)["A"].edge_count
        assert sorted(described.plates[0].divisions[0]) == [0, 0, 0, 5]


def test_numbers_of_the_neighbours_follow_an_edit():
    one = plate("A", rectangle(1000, 500), (0 * X, X, Z), divisions=((3, 1, 3, 1),))
    other = plate("B", rectangle(2000, 500), (0 * X, X, Y), divisions=((6, 1, 6, 1),))
    described = redivided(document(one, other), "A", 0, 0, 5)
    assert [plate.divisions[0][0] for plate in described.plates] == [5, 8]
    assert_conforming(contours(described))


def test_an_edit_of_a_hole_leaves_the_other_holes_to_the_size():
    holes = [rectangle(100, 100, 200, 200), rectangle(100, 100, 500, 200)]
    described = document(plate("A", rectangle(1000, 500), (0 * X, X, Y), holes=[straight(hole) for hole in holes]))
    edited = redivided(described, "A", 2, 1, 3)
    assert edited.plates[0].divisions == ((), (0, 0, 0, 0), (0, 3, 0, 0))
    assert edge_counts(edited, "A") == ((2, 1, 2, 1), (1, 1, 1, 1), (1, 3, 1, 1))
    assert redivided(edited, "A", 2, 1, 0).plates[0].divisions == ((), (), ())
    assert described.plates[0].divisions == ()


def test_a_block_can_be_made_even_plate_by_plate():
    described = redivided(BLOCK, "F0", 0, 1, 4)
    while remaining := sorted(odd(described, "coarse")):
        change = remedy(described, remaining[0], "coarse")
        assert change.odd <= 0
        described = remedied(described, change)
        if change.odd == 0:
            break
    assert np.all([count > 0 for row in edge_counts(described, "F0", "coarse") for count in row])


@pytest.mark.parametrize("size", ["coarse", "fine", 171.0, 333.0])
def test_all_contours_of_a_block_are_made_even_at_once(size):
    mended = evened(BLOCK, size)
    assert not odd(mended, size)
    assert_conforming(contours(mended, size))


@given(boxes())
@settings(max_examples=25, deadline=None)
def test_making_contours_even_leaves_fewer_odd(plates):
    described = document(*plates)
    mended = evened(described)
    assert len(odd(mended)) < max(1, len(odd(described)))
    assert_conforming(contours(mended))


def test_an_edit_of_divisions_finds_what_the_plates_have_in_common_again():
    edited = redivided(BLOCK, "F0", 0, 1, 4)
    one, other = (neighbours(tuple(p for p in d.plates if p.is_plane)) for d in (BLOCK, edited))
    assert other.joints is one.joints
    assert other.frame.plates[7] is edited.plate("F0")


def test_a_curved_plate_is_refused_with_the_plane_ones_beside_it():
    refusal = curved_refusal(BLOCK, BLOCK.plate("BL"))
    assert refusal.place == BLOCK.plate("BL").place
    assert "in common with B2, SS, H0, H2 are divided by these alone" in refusal.text
    alone = read_plates(PLATES / "bilge_shell.json")
    assert curved_refusal(alone, alone.plates[0]).text.endswith("mesh the plane plates of the document")
