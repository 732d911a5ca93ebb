"""Which pieces of lines are divided once more or once less, so that as few regions as possible have an odd contour.

A change of a piece between two regions makes an odd one even and an even one odd. So the pieces to change are a
T-join of the graph whose nodes are the regions and whose edges are the pieces: paths that connect the odd regions two
by two, of the least weight in sum (J. Edmonds, E. L. Johnson, "Matching, Euler tours and the Chinese postman",
Math. Programming 5:88, 1973). In every connected part with an odd number of odd regions one of them stays odd.
"""

from collections.abc import Iterator, Mapping, Sequence
from itertools import pairwise
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    import rustworkx

EXACT = 80
"""Odd regions of a connected part up to which the T-join is the one of least weight; of more it is one in a tree."""
_DIGITS = 1_000_000
"""Weights are rounded to whole numbers, so that rounding decides nothing."""

Ways = Sequence[tuple[int, int, float]]
"""Two regions that a change makes odd or even, and its weight."""


def changes(regions: int, odd: Sequence[int], ways: Ways, reluctance: Mapping[int, float]) -> set[int]:
    """Rows of the ways that are to be changed.

    Parameters
    ----------
    regions : int
        Their number.
    odd : sequence of int
        Regions with an odd contour.
    ways : sequence
    reluctance : mapping
        Weight of leaving a region odd where one must be; 0 for regions that are not in it.
    """
    import rustworkx  # noqa: PLC0415  only this needs it, and not without odd regions

    if not odd:
        return set()
    graph = rustworkx.PyGraph()
    graph.add_nodes_from(range(regions))
    graph.add_edges_from([(one, other, row) for row, (one, other, _) in enumerate(ways)])
    found: set[int] = set()
    for part in rustworkx.connected_components(graph):
        wanted = sorted(part & set(odd))
        if not wanted:
            continue
        join = _least if len(wanted) <= EXACT else _in_tree
        found ^= join(graph, wanted, sorted(part), [weight for _, _, weight in ways], reluctance)
    return found


def _least(
    graph: "rustworkx.PyGraph[int, int]",
    odd: Sequence[int],
    part: Sequence[int],
    weights: Sequence[float],
    reluctance: Mapping[int, float],
) -> set[int]:
    """The T-join of least weight: paths between odd regions that are matched so that their sum is least."""
    import rustworkx  # noqa: PLC0415

    paths = {region: _shortest(graph, region, weights) for region in odd}
    lengths = [(i, j, paths[one][other][0]) for i, one in enumerate(odd) for j, other in enumerate(odd) if i < j]
    ends = {}
    if len(odd) % 2:  # one more that stands for the region that stays odd
        for i, one in enumerate(odd):
            length, ends[i] = min((paths[one][region][0] + reluctance.get(region, 0.0), region) for region in part)
            lengths.append((i, len(odd), length))
    longest = max((length for _, _, length in lengths), default=0.0)
    complete = rustworkx.PyGraph()
    complete.add_nodes_from(range(len(odd) + len(odd) % 2))
    complete.add_edges_from([(i, j, 1 + round(_DIGITS * (longest - length))) for i, j, length in lengths])
    found: set[int] = set()
    for pair in rustworkx.max_weight_matching(complete, max_cardinality=True, weight_fn=int):
        i, j = min(pair), max(pair)
        found ^= set(paths[odd[i]][ends[i] if j == len(odd) else odd[j]][1])
    return found


def _shortest(
    graph: "rustworkx.PyGraph[int, int]", start: int, weights: Sequence[float]
) -> dict[int, tuple[float, list[int]]]:
    """Length and rows of the shortest path to every region."""
    import rustworkx  # noqa: PLC0415

    paths = rustworkx.dijkstra_shortest_paths(graph, start, weight_fn=lambda row: weights[row])
    found: dict[int, tuple[float, list[int]]] = {start: (0.0, [])}
    for end in paths:
        nodes = list(paths[end])
        rows = [
            min(graph.get_all_edge_data(one, other), key=lambda row: (weights[row], row))
            for one, other in pairwise(nodes)
        ]
        found[end] = sum(weights[row] for row in rows), rows
    return found


def _in_tree(
    graph: "rustworkx.PyGraph[int, int]",
    odd: Sequence[int],
    part: Sequence[int],
    weights: Sequence[float],
    reluctance: Mapping[int, float],
) -> set[int]:
    """The only T-join in the spanning tree of least weight."""
    import rustworkx  # noqa: PLC0415

    tree = rustworkx.minimum_spanning_tree(graph.subgraph(list(part)), weight_fn=lambda row: weights[row])
    wanted = set(odd)
    if len(odd) % 2:
        wanted ^= {min(part, key=lambda region: (reluctance.get(region, 0.0), region not in wanted, region))}
    return set(_tree_rows(tree, wanted))


def _tree_rows(tree: "rustworkx.PyGraph[int, int]", wanted: set[int]) -> Iterator[int]:
    """Edges of a tree that have an odd number of wanted regions beyond them."""
    root = next(iter(tree.node_indices()))
    above, order = {root: root}, [root]
    for node in order:
        beyond = [near for near in sorted(tree.neighbors(node)) if near != above[node]]
        above |= dict.fromkeys(beyond, node)
        order += beyond
    count = {node: int(tree[node] in wanted) for node in order}
    for node in reversed(order[1:]):
        if count[node] % 2:
            yield tree.get_edge_data(above[node], node)
        count[above[node]] += count[node]
