"""The pairing of triangles: exact on small plates, near exact on large ones."""

import numpy as np
import pytest
import rustworkx
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy.spatial import Delaunay

from hullquad.quads import matching as module
from hullquad.quads.matching import matching
from hullquad.quads.pairs import HOPE, Pairs, pairs

UP = np.array([[0.0, 0.0, 1.0]])


def possible(count: int, seed: int) -> Pairs:
    nodes = np.random.default_rng(seed).random((count, 2))
    triangles = Delaunay(nodes).simplices.astype(np.int32)
    corners = nodes[triangles]
    u, w = corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]
    clockwise = u[:, 0] * w[:, 1] < u[:, 1] * w[:, 0]
    triangles[clockwise] = triangles[clockwise][:, ::-1]
    return pairs(np.pad(nodes, ((0, 0), (0, 1))), triangles, UP)


def matched(found: Pairs, worth: np.ndarray | None = None) -> set[int]:
    """The pairing at the end of its search."""
    search = matching(found, found.scores, np.zeros(len(found.triangles)) if worth is None else worth)
    while True:
        try:
            next(search)
        except StopIteration as end:
            return end.value


def exact(found: Pairs) -> tuple[int, float]:
    """Number of pairs of the best pairing, and its weight."""
    graph = rustworkx.PyGraph()
    graph.add_nodes_from(range(len(found.triangles)))
    weights = (1e6 * found.scores).astype(int).tolist()
    graph.add_edges_from([(a, b, w) for (a, b), w in zip(found.members.tolist(), weights, strict=True)])
    chosen = rustworkx.max_weight_matching(graph, max_cardinality=True, weight_fn=lambda w: w + 1)
    weight = sum(graph.get_edge_data(*pair) for pair in chosen)
    return len(chosen), weight / 1e6


@settings(max_examples=30, deadline=None)
@given(count=st.integers(4, 120), seed=st.integers(0, 10**6))
def test_no_triangle_has_two_partners(count, seed):
    found = possible(count, seed)
    chosen = matched(found)
    members = found.members[sorted(chosen)].ravel()
    assert len(np.unique(members)) == len(members)


@settings(max_examples=30, deadline=None)
@given(count=st.integers(4, 120), seed=st.integers(0, 10**6))
def test_small_pairings_are_the_best_there_are(count, seed):
    found = possible(count, seed)
    chosen = matched(found)
    number, weight = exact(found)
    assert len(chosen) == number
    assert found.scores[sorted(chosen)].sum() == pytest.approx(weight, abs=1e-3)


@pytest.mark.parametrize("seed", range(5))
def test_large_pairings_have_as_many_pairs_and_nearly_the_best_weight(seed, monkeypatch):
    found = possible(300, seed)
    monkeypatch.setattr(module, "EXACT", 0)
    chosen = matched(found)
    number, weight = exact(found)
    assert len(chosen) == number
    assert found.scores[sorted(chosen)].sum() > 0.94 * weight


def test_the_triangle_left_over_is_the_one_that_is_worth_most():
    nodes = np.array([[0, 0], [1, 0], [2, 0], [0.5, 1], [1.5, 1]], dtype=float)
    triangles = np.array([[0, 1, 3], [1, 4, 3], [1, 2, 4]], dtype=np.int32)
    found = pairs(np.pad(nodes, ((0, 0), (0, 1))), triangles, UP)
    for left in (0, 2):
        worth = np.zeros(3)
        worth[left] = 1.0
        (row,) = matched(found, worth)
        assert left not in found.members[row]


def test_pairs_that_smoothing_may_mend_score_least_and_have_a_free_node():
    nodes = np.random.default_rng(4).random((40, 2))
    nodes = np.concatenate([nodes[Delaunay(nodes).convex_hull[:, 0]], nodes])
    _, first = np.unique(nodes, axis=0, return_index=True)
    nodes = nodes[np.sort(first)]
    held = len(Delaunay(nodes).convex_hull)
    triangles = Delaunay(nodes).simplices.astype(np.int32)
    u, w = nodes[triangles[:, 1]] - nodes[triangles[:, 0]], nodes[triangles[:, 2]] - nodes[triangles[:, 0]]
    clockwise = u[:, 0] * w[:, 1] < u[:, 1] * w[:, 0]
    triangles[clockwise] = triangles[clockwise][:, ::-1]
    points = np.pad(nodes, ((0, 0), (0, 1)))
    good, hopeful = pairs(points, triangles, UP), pairs(points, triangles, UP, held=held)
    more = {tuple(row): score for row, score in zip(hopeful.quads.tolist(), hopeful.scores.tolist(), strict=True)}
    for row in good.quads.tolist():
        del more[tuple(row)]
    assert more
    assert set(more.values()) == {HOPE}
    assert all(max(row) >= held for row in more)
