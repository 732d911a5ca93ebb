"""Triangles: exactly those of the region, and Triangle's traps are closed."""

from collections.abc import Callable
from itertools import pairwise
from typing import Any

import numpy as np
import pytest
import shapely
from hypothesis import given, settings
from hypothesis import strategies as st

from hullquad import worker
from hullquad.errors import MeshingError
from hullquad.triangulation.delaunay import Triangulation, triangulate
from hullquad.worker import WorkerError

SQUARE = np.array([[0, 0], [1000, 0], [1000, 1000], [0, 1000]], dtype=float)
HOLE = np.array([[400, 400], [400, 600], [600, 600], [600, 400]], dtype=float)


def loops_of(*loops: Any) -> tuple[Any, list[int]]:
    return np.vstack(loops).astype(float), np.cumsum([0, *map(len, loops)]).tolist()


def triangles_of(nodes: Any, starts: Any, area: float | None = 5000.0, **options: Any) -> Triangulation:
    return triangulate(nodes, starts, area=area, place="plate H1", **options)


def refusal(nodes: Any, starts: Any = None, **options: Any) -> str:
    """Key of the error; the process lives on and the next call works."""
    with pytest.raises(MeshingError) as caught:
        triangles_of(nodes, [0, len(nodes)] if starts is None else starts, **options)
    assert "plate H1" in str(caught.value), "the sentence can be said"
    assert len(triangles_of(SQUARE, [0, 4]).triangles) > 0, "the next call works"
    return caught.value.key


def divided(corners: Any, spacing: float) -> Any:
    """A loop with nodes about `spacing` apart."""
    sides = []
    for one, other in zip(corners, np.roll(corners, -1, axis=0), strict=True):
        count = max(1, round(float(np.hypot(*(other - one))) / spacing))
        sides.append(one + (other - one) * np.arange(count)[:, None] / count)
    return np.vstack(sides)


def corner_angles(found: Triangulation) -> Any:
    corners = found.nodes[found.triangles]
    forth, back = np.roll(corners, -1, axis=1) - corners, np.roll(corners, 1, axis=1) - corners
    cosine = (forth * back).sum(axis=2) / np.hypot(*np.moveaxis(forth, 2, 0)) / np.hypot(*np.moveaxis(back, 2, 0))
    return np.degrees(np.arccos(np.clip(cosine, -1, 1)))


def areas(found: Triangulation) -> Any:
    (a, b), (c, d) = (np.diff(found.nodes[found.triangles], axis=1)[:, i].T for i in (0, 1))
    return (a * d - b * c) / 2


def agrees(found: Triangulation, nodes: Any, starts: Any) -> None:
    """What every triangulation has to be, told apart from the engine's own checks."""
    assert np.array_equal(found.nodes[: len(nodes)], nodes)
    loops = [nodes[one:other] for one, other in pairwise(starts)]
    assert (areas(found) > 0).all()
    assert areas(found).sum() == pytest.approx(shapely.Polygon(loops[0], loops[1:]).area, rel=1e-9)
    assert set(found.triangles.ravel()) == set(range(len(found.nodes)))
    inner = len(found.nodes) - starts[-1]
    assert len(found.triangles) == 2 * inner + starts[-1] - 2 + 2 * (len(loops) - 1)


@st.composite
def regions(draw: st.DrawFn) -> tuple[Any, list[int]]:
    """A star with star-shaped holes and points inside, anywhere and of any size."""
    random = np.random.default_rng(draw(st.integers(0, 2**32)))
    centre, size = random.uniform(-1, 1, 2) * 10.0 ** random.integers(0, 7), 10.0 ** random.uniform(-3, 6)

    def star(middle: Any, low: float, high: float, most: int) -> Any:
        angles = np.linspace(0, 2 * np.pi, int(random.integers(4, most)), endpoint=False)
        reach = random.uniform(low, high, len(angles)) * size
        return middle + np.stack([np.cos(angles), np.sin(angles)], axis=1) * reach[:, None]

    places = [centre + size * np.array(at) for at in ((0.2, 0.2), (-0.2, 0.2), (-0.2, -0.2))]
    holes = [star(place, 0.02, 0.12, 12)[::-1] for place in places[: int(random.integers(0, 4))]]
    outer = star(centre, 0.6, 1.0, 60)
    nodes, starts = loops_of(outer, *holes)
    points = centre + size * np.array([[0.2, -0.2], [0.25, -0.15]])[: int(random.integers(0, 3))]
    return np.vstack([nodes, points]), starts


@given(regions(), st.floats(0.001, 0.1))
@settings(max_examples=150, deadline=None)
def test_the_triangles_are_exactly_those_of_the_region(region: tuple[Any, list[int]], fraction: float) -> None:
    nodes, starts = region
    area = fraction * shapely.Polygon(nodes[: starts[1]]).area
    agrees(triangles_of(nodes, starts, area), nodes, starts)


@given(regions())
@settings(max_examples=40, deadline=None)
def test_without_an_area_no_node_is_added(region: tuple[Any, list[int]]) -> None:
    nodes, starts = region
    found = triangles_of(nodes, starts, None)
    assert np.array_equal(found.nodes, nodes)
    agrees(found, nodes, starts)


def test_triangles_keep_area_and_angle_when_the_contour_is_divided_to_match() -> None:
    nodes = divided(SQUARE, 50)
    found = triangles_of(nodes, [0, len(nodes)], 1250.0)
    assert areas(found).max() <= 1250.0
    assert corner_angles(found).min() >= 30.0


@pytest.mark.parametrize("area", [None, 5000.0])
def test_lines_are_edges_of_triangles(area: float | None) -> None:
    across = np.array([[500, 0], [1000, 500], [500, 1000], [0, 500], [500, 500], [300, 700], [500, 250]])
    nodes = np.vstack([[SQUARE[i], across[i]] for i in range(4)] + [across[4:]])
    lines = [[1, 10], [10, 8], [8, 9]]
    found = triangles_of(nodes, [0, 8], area, lines=lines)
    edges = {frozenset(pair) for row in found.triangles.tolist() for pair in zip(row, row[1:] + row[:1], strict=True)}
    assert {frozenset(line) for line in lines} <= edges
    agrees(found, nodes, [0, 8])


@pytest.mark.parametrize("lines", [[[0, 2], [1, 3]], [[0, 9]], [[-1, 2]], [[0, 4], [0, 2]]])
def test_lines_that_cannot_be_edges_are_refused(lines: list[list[int]]) -> None:
    assert refusal(np.vstack([SQUARE, [[500, 500]]]), [0, 4], area=None, lines=lines) == "E_TRIANGLE:lines"


def test_a_hole_stays_empty() -> None:
    nodes, starts = loops_of(SQUARE, HOLE)
    found = triangles_of(nodes, starts)
    middles = found.nodes[found.triangles].mean(axis=1)
    assert not shapely.contains_xy(shapely.Polygon(HOLE), middles).any()


@pytest.mark.parametrize("turn", [0.0, 0.1, 0.7, 1.234])
@pytest.mark.parametrize("width", [1e-3, 1e-5])
def test_the_thinnest_slit_stays_empty(turn: float, width: float) -> None:
    slit = np.array([[-300, 0], [-300, width], [0, 2 * width], [300, width], [300, 0], [0, width]])
    cosine, sine = np.cos(turn), np.sin(turn)
    nodes, starts = loops_of(SQUARE, slit @ np.array([[cosine, sine], [-sine, cosine]]) + [500.3, 500.7])
    agrees(triangles_of(nodes, starts, None), nodes, starts)


def test_a_bent_slit_stays_empty() -> None:
    bent = np.array([[300, 300], [300.01, 700], [700, 700.01], [700, 700], [300.02, 699.99], [300.02, 300]])
    nodes, starts = loops_of(SQUARE, bent)
    agrees(triangles_of(nodes, starts, None), nodes, starts)


def test_far_from_the_origin_the_nodes_keep_their_bits() -> None:
    nodes = divided(SQUARE, 100) / 3 + [1e9, -3e9]
    agrees(triangles_of(nodes, [0, len(nodes)], 500.0), nodes, [0, len(nodes)])


def test_an_oblique_divided_edge_is_no_obstacle() -> None:
    nodes = divided(SQUARE @ np.array([[0.8, 0.6], [-0.6, 0.8]]), 7.77)
    agrees(triangles_of(nodes, [0, len(nodes)], 30.0), nodes, [0, len(nodes)])


@pytest.mark.parametrize("size", [1e-7, 1e9])
def test_the_unit_of_length_changes_nothing(size: float) -> None:
    nodes = divided(SQUARE, 50)
    here, there = (triangles_of(nodes * k, [0, len(nodes)], 1250.0 * k**2) for k in (1.0, size))
    assert abs(len(here.triangles) - len(there.triangles)) < 0.05 * len(here.triangles)


def test_an_area_larger_than_the_region_is_no_limit() -> None:
    assert len(triangles_of(SQUARE, [0, 4], 1e300).triangles) == 2


@pytest.mark.parametrize("area", [1e6, 1e-5])
def test_an_area_that_prints_with_an_exponent_is_understood(area: float) -> None:
    nodes = divided(SQUARE * np.sqrt(area) / 500, np.sqrt(area) / 5)
    found = triangles_of(nodes, [0, len(nodes)], area / 50)
    assert areas(found).max() <= area / 50


def test_lists_of_whole_numbers_are_numbers() -> None:
    assert len(triangles_of([[0, 0], [10, 0], [0, 10]], [0, 3], None).triangles) == 1


TRAPS: dict[str, tuple[str, Callable[[], Any]]] = {
    "nan": ("E_CONTOUR:far", lambda: np.where(SQUARE == 1000, np.nan, SQUARE)),
    "infinity": ("E_CONTOUR:far", lambda: np.where(SQUARE == 1000, np.inf, SQUARE)),
    "1e307": ("E_CONTOUR:far", lambda: SQUARE * 1e304),
    "None": ("E_CONTOUR:numbers", lambda: [[0, 0], [1, None], [1, 1]]),
    "text": ("E_CONTOUR:numbers", lambda: [["0", "0"], ["1", "0"], ["1", "1"]]),
    "complex numbers": ("E_CONTOUR:numbers", lambda: SQUARE * 1j),
    "points in space": ("E_CONTOUR:numbers", lambda: np.zeros((4, 3))),
    "first node repeated at the end": ("E_CONTOUR:closing", lambda: np.vstack([SQUARE, SQUARE[:1]])),
    "node repeated in a row": ("E_CONTOUR:coincident", lambda: SQUARE[[0, 1, 1, 2, 3]]),
    "node met twice": ("E_CONTOUR:coincident", lambda: np.insert(SQUARE, 3, [[500, 500], [700, 0], [0, 0]], axis=0)),
    "edge of one ulp": ("E_CONTOUR:coincident", lambda: np.insert(SQUARE, 2, [1000, np.nextafter(1000, 0)], axis=0)),
    "short edge far away": ("E_CONTOUR:coincident", lambda: np.insert(SQUARE, 2, [1000, 999.99999], axis=0) + 1e10),
    "sliver of nodes in line": ("E_CONTOUR:touching", lambda: np.array([[0, 0], [500, 1e-10], [1000, 0], [600, 0]])),
    "no area": ("E_CONTOUR:touching", lambda: np.array([[0, 0], [500, 0], [1000, 0]])),
    "node on a foreign edge": ("E_CONTOUR:touching", lambda: np.insert(SQUARE, 3, [500, 0], axis=0)),
    "bow tie": ("E_CONTOUR:crossing", lambda: SQUARE[[0, 2, 1, 3]]),
    "wrong way round": ("E_CONTOUR:turned", lambda: SQUARE[::-1]),
}


@pytest.mark.parametrize("trap", TRAPS)
def test_triangle_never_gets(trap: str) -> None:
    key, nodes = TRAPS[trap]
    assert refusal(nodes()) == key


def test_a_hole_across_the_contour_is_refused() -> None:
    assert refusal(*loops_of(SQUARE, HOLE + np.array([500, 0]))) == "E_CONTOUR:crossing"


def test_a_hole_outside_is_refused() -> None:
    assert refusal(*loops_of(SQUARE, HOLE + np.array([5000, 0]))) == "E_CONTOUR:crossing"


def test_a_hole_in_a_hole_is_refused() -> None:
    assert refusal(*loops_of(SQUARE, HOLE, HOLE / 2 + 250)) == "E_CONTOUR:crossing"


def test_holes_that_share_a_node_are_refused() -> None:
    assert refusal(*loops_of(SQUARE, HOLE, HOLE + 200)) == "E_CONTOUR:coincident"


def test_a_hole_the_wrong_way_round_is_refused() -> None:
    assert refusal(*loops_of(SQUARE, HOLE[::-1])) == "E_CONTOUR:turned"


@pytest.mark.parametrize("point", [[2000, 500], [500, 500]])
def test_a_point_outside_or_in_a_hole_is_refused(point: list[float]) -> None:
    nodes, starts = loops_of(SQUARE, HOLE)
    assert refusal(np.vstack([nodes, [point]]), starts) == "E_CONTOUR:outside"


def test_a_point_on_the_contour_is_refused() -> None:
    assert refusal(np.vstack([SQUARE, [[500, 1e-10]]]), [0, 4]) == "E_CONTOUR:touching"


def test_a_point_on_a_node_is_refused() -> None:
    assert refusal(np.vstack([SQUARE, SQUARE[:1]]), [0, 4]) == "E_CONTOUR:coincident"


@pytest.mark.parametrize(
    "starts", [[0], [], [0, 5], [1, 4], [0, 2], [0, 4, 4], [0, 3, 0], [0.0, 4.0], [[0, 4]], [0, -1]]
)
def test_loops_out_of_range_are_refused(starts: Any) -> None:
    assert refusal(SQUARE, starts) == "E_CONTOUR:loops"


def test_an_empty_contour_is_refused() -> None:
    assert refusal(np.empty((0, 2)), [0, 0]) == "E_CONTOUR:loops"


@pytest.mark.parametrize("area", [0.0, -1.0, np.nan, np.inf])
def test_an_area_that_is_no_limit_is_refused(area: float) -> None:
    assert refusal(SQUARE, area=area) == "E_TRIANGLE:area"


@pytest.mark.parametrize("angle", [-1.0, 34.0, np.nan])
def test_an_angle_that_triangle_cannot_reach_is_refused(angle: float) -> None:
    assert refusal(SQUARE, min_angle=angle) == "E_TRIANGLE:angle"


def test_more_triangles_than_the_limit_are_refused_before_the_call() -> None:
    assert refusal(SQUARE, area=0.01) == "E_TRIANGLE:many"


def test_more_triangles_than_expected_are_refused_after_the_call() -> None:
    nodes = divided(SQUARE, 5)
    assert refusal(nodes, element_limit=2 * len(nodes) + 10, area=1e6) == "E_TRIANGLE:many"


def test_a_fine_row_of_nodes_along_an_undivided_edge_ends_within_its_limits() -> None:
    """10 000 nodes in line: with no node allowed on the far edge, Triangle would need time and memory without end."""
    row = np.stack([np.linspace(0, 10_000, 10_001), np.zeros(10_001)], axis=1)
    nodes = np.vstack([row, [[10_000, 100], [0, 100]]])
    with pytest.raises((MeshingError, WorkerError)) as caught:
        triangles_of(nodes, [0, len(nodes)], seconds=3.0)
    assert caught.value.key in ("E_TRIANGLE:given_up", "E_TIME")
    assert len(triangles_of(SQUARE, [0, 4]).triangles) > 0


def test_a_fine_row_of_nodes_is_no_obstacle_when_the_contour_is_divided_evenly() -> None:
    nodes = divided(np.array([[0, 0], [10_000, 0], [10_000, 10], [0, 10]], dtype=float), 1.0)
    agrees(triangles_of(nodes, [0, len(nodes)], 1.0), nodes, [0, len(nodes)])


def shifted(nodes: Any, triangles: Any) -> Any:
    return nodes + 1e-15, triangles


def one_short(nodes: Any, triangles: Any) -> Any:
    return nodes, triangles[np.all(triangles != 0, axis=1)]


def one_hole_more(nodes: Any, triangles: Any) -> Any:
    inner = np.flatnonzero((triangles >= 40).all(axis=1))[0]
    return nodes, np.delete(triangles, inner, axis=0)


def turned_over(nodes: Any, triangles: Any) -> Any:
    return nodes, triangles[:, ::-1]


def doubled(nodes: Any, triangles: Any) -> Any:
    return nodes, np.vstack([triangles, triangles])


def folded(nodes: Any, triangles: Any) -> Any:
    return np.vstack([nodes[:-1], [[5, 5]]]), triangles


ANSWERS = {
    shifted: "E_TRIANGLE:moved",
    one_short: "E_TRIANGLE:unused",
    one_hole_more: "E_TRIANGLE:contour",
    turned_over: "E_TRIANGLE:contour",
    doubled: "E_TRIANGLE:contour",
    folded: "E_TRIANGLE:areas",
}


@pytest.mark.parametrize("change", ANSWERS)
def test_an_answer_that_is_not_the_region_is_refused(
    change: Callable[[Any, Any], Any], monkeypatch: pytest.MonkeyPatch
) -> None:
    call = worker.call
    monkeypatch.setattr(worker, "call", lambda *arguments, **options: change(*call(*arguments, **options)))
    nodes = divided(SQUARE, 100)
    with pytest.raises(MeshingError) as caught:
        triangles_of(nodes, [0, len(nodes)])
    assert caught.value.key == ANSWERS[change]


def test_added_nodes_without_a_triangle_are_left_out(monkeypatch: pytest.MonkeyPatch) -> None:
    call = worker.call

    def littered(*arguments: Any, **options: Any) -> Any:
        nodes, triangles = call(*arguments, **options)
        return np.insert(nodes, 40, [0.01, 0.01], axis=0), triangles + (triangles >= 40)

    nodes = divided(SQUARE, 100)
    clean = triangles_of(nodes, [0, len(nodes)])
    monkeypatch.setattr(worker, "call", littered)
    found = triangles_of(nodes, [0, len(nodes)])
    assert np.array_equal(found.nodes, clean.nodes)
    assert np.array_equal(found.triangles, clean.triangles)
