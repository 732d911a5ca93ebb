"""Joining triangles to quads: the front's order, what may be joined, and what augmentation adds."""

from functools import cache
from itertools import combinations

import numpy as np
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy.spatial import Delaunay

from hullquad.metrics.values import valid_elements
from hullquad.quads.augment import augment
from hullquad.quads.front import front
from hullquad.quads.join import elements, joins
from hullquad.quads.pairs import Pairs, pairs

UP = np.array([[0.0, 0.0, 1.0]])


def triangulation(count: int, seed: int) -> tuple[np.ndarray, np.ndarray]:
    """Delaunay triangulation of random points: (N, 3) points and counter-clockwise triangles."""
    nodes = np.random.default_rng(seed).random((count, 2))
    triangles = Delaunay(nodes).simplices
    a, b, c = np.moveaxis(nodes[triangles], 1, 0)
    clockwise = _area(a, b, c) < 0
    triangles[clockwise] = triangles[clockwise][:, ::-1]
    return np.pad(nodes, ((0, 0), (0, 1))), triangles.astype(np.int32)


def _area(a, b, c):
    return (b - a)[:, 0] * (c - a)[:, 1] - (b - a)[:, 1] * (c - a)[:, 0]


def possible(count: int, seed: int) -> tuple[np.ndarray, Pairs]:
    points, triangles = triangulation(count, seed)
    return points, pairs(points, triangles, UP)


def most_pairs(members: list[tuple[int, int]]) -> int:
    """Size of the largest pairing, by trying everything."""

    @cache
    def best(rows: tuple[tuple[int, int], ...]) -> int:
        if not rows:
            return 0
        (one, other), rest = rows[0], rows[1:]
        apart = tuple(row for row in rest if not {one, other} & set(row))
        return max(1 + best(apart), best(rest))

    return best(tuple(sorted(members)))


@settings(max_examples=40, deadline=None)
@given(count=st.integers(4, 60), seed=st.integers(0, 10**6))
def test_every_triangle_is_in_one_element_and_every_element_is_valid(count, seed):
    points, possibilities = possible(count, seed)
    made = elements(possibilities, joins(possibilities))
    is_quad = made[:, 3] >= 0
    assert 2 * is_quad.sum() + (~is_quad).sum() == len(possibilities.triangles)
    assert valid_elements(points, made[is_quad], UP).all()
    area = _areas(points, possibilities.triangles).sum()
    np.testing.assert_allclose(_areas(points, made).sum(), area, rtol=1e-12)


def _areas(points, rows):
    closed = np.where(rows < 0, rows[:, :1], rows)
    x, y = points[closed, 0], points[closed, 1]
    return 0.5 * (x * np.roll(y, -1, axis=1) - y * np.roll(x, -1, axis=1)).sum(axis=1)


@settings(max_examples=25, deadline=None)
@given(count=st.integers(4, 13), seed=st.integers(0, 10**6))
def test_augmentation_leaves_as_few_triangles_as_any_pairing(count, seed):
    _, possibilities = possible(count, seed)
    made = elements(possibilities, joins(possibilities))
    assert (made[:, 3] >= 0).sum() == most_pairs([tuple(row) for row in possibilities.members.tolist()])


def test_augmentation_finds_its_way_through_odd_circles():
    # a triangle of triangles 1 2 3 with a tail at each: only a search that contracts the circle pairs 0 with 1
    members = [(0, 1), (1, 2), (2, 3), (1, 3), (3, 4), (2, 5)]
    fake = _graph(6, members)
    changes = list(augment(fake, {members.index((1, 2))}))
    joined = set(changes[-1].joined).union(*(set(change.joined) for change in changes))
    parted = set().union(*(set(change.parted) for change in changes))
    paired = [members[row] for row in (joined | {1}) - parted]
    assert sorted(vertex for pair in paired for vertex in pair) == [0, 1, 2, 3, 4, 5]


def _graph(count: int, members: list[tuple[int, int]]) -> Pairs:
    """Pairs of triangles that exist only as a graph."""
    neighbours, across = np.full((2, count, 3), -1, dtype=np.int32)
    for row, (one, other) in enumerate(members):
        for here, there in ((one, other), (other, one)):
            side = (across[here] < 0).argmax()
            neighbours[here, side], across[here, side] = there, row
    return Pairs(
        triangles=np.arange(3 * count).reshape(count, 3),
        neighbours=neighbours,
        pair_across=across,
        members=members,
        quads=np.zeros((len(members), 4)),
        scores=np.ones(len(members)),
    )


@settings(max_examples=30, deadline=None)
@given(seed=st.integers(0, 10**6), vertices=st.integers(4, 12), density=st.floats(0.2, 1))
def test_augmentation_is_complete_on_any_graph_of_triangles(seed, vertices, density):
    rng = np.random.default_rng(seed)
    members, degree = [], np.zeros(vertices, dtype=int)
    for one, other in rng.permutation(list(combinations(range(vertices), 2))):
        if degree[one] < 3 and degree[other] < 3 and rng.random() < density:
            members.append((int(one), int(other)))
            degree[[one, other]] += 1
    joined: set[int] = set()
    for change in augment(_graph(vertices, members), set()):
        assert joined >= set(change.parted)
        joined = (joined - set(change.parted)) | set(change.joined)
    used = [vertex for row in joined for vertex in members[row]]
    assert len(used) == len(set(used))
    assert len(joined) == most_pairs(members)


def test_the_front_moves_inwards():
    _, possibilities = possible(400, 3)
    levels = [join.level for join in front(possibilities)]
    assert levels == sorted(levels)
    assert set(levels) == set(range(max(levels) + 1))
    assert max(levels) > 2


def test_the_front_begins_where_there_is_least_choice():
    _, possibilities = possible(30, 7)
    first = possibilities.members[next(front(possibilities)).joined[0]]
    choices = (possibilities.pair_across >= 0).sum(axis=1)
    at_rim = possibilities.at_rim & (choices > 0)
    assert choices[first].min() == choices[at_rim].min()


def test_an_edge_that_must_stay_is_not_taken_out():
    points, triangles = triangulation(30, 1)
    free = pairs(points, triangles, UP)
    kept = free.quads[0][[1, 3]][None]
    held = pairs(points, triangles, UP, constraints=kept)
    assert len(held.members) < len(free.members)
    assert not any(set(free.quads[0]) == set(quad) for quad in held.quads.tolist())


def test_a_single_triangle_stays_one():
    points = np.array([[0, 0, 0], [1, 0, 0], [0, 1, 0]], dtype=float)
    alone = pairs(points, np.array([[0, 1, 2]], dtype=np.int32), UP)
    assert elements(alone, joins(alone)).tolist() == [[0, 1, 2, -1]]


def test_two_triangles_become_the_square_they_halve():
    points = np.array([[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0]], dtype=float)
    halves = pairs(points, np.array([[0, 1, 2], [0, 2, 3]], dtype=np.int32), UP)
    (quad,) = elements(halves, joins(halves)).tolist()
    assert quad in ([0, 1, 2, 3], [1, 2, 3, 0], [2, 3, 0, 1], [3, 0, 1, 2])


def test_a_pair_with_a_corner_of_180_degrees_is_not_joined():
    points = np.array([[0, 0, 0], [1, 0, 0], [2, 0, 0], [1, 1, 0]], dtype=float)
    flat = pairs(points, np.array([[0, 1, 3], [1, 2, 3]], dtype=np.int32), UP)
    assert len(flat.members) == 0
