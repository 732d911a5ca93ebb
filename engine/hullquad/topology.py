"""What does not change when nodes move: the elements, their neighbours, labels and the state of each node."""

from enum import IntEnum
from functools import cached_property

import attrs
import numpy as np

from hullquad.arrays import Bools, Bytes, Ints, Longs, ints, longs, small_ints
from hullquad.errors import MeshError


class NodeState(IntEnum):
    """What an algorithm may do with a node."""

    FREE = 0
    CONTOUR = 1
    """On the outline or a hole: shared with neighbours, never moved."""
    FIXED = 2
    """Inside, but given by the plate: a stiffener's end, a fixed point."""
    ON_LINE = 3
    """On a followed line: may slide along it."""
    PINNED = 4
    """Held by the user."""


@attrs.frozen(eq=False, kw_only=True, repr=False)
class Topology:
    """Elements, labels and node states of a mesh; every array is read-only."""

    elements: Ints = attrs.field(converter=ints)
    """(E, 4) nodes of each element in order; a triangle ends with -1."""
    node_labels: Longs = attrs.field(converter=longs)
    """(N,) as in the file, else from 1."""
    element_labels: Longs = attrs.field(converter=longs)
    """(E,) as in the file, else from 1."""
    node_states: Bytes = attrs.field(converter=small_ints)
    """(N,) values of `NodeState`."""
    node_lines: Ints = attrs.field(converter=ints)
    """(N,) the mesh's line that a node slides on, else -1."""

    def __attrs_post_init__(self) -> None:
        refuse_unknown_nodes(self.elements, len(self.node_states), self.element_labels, "mesh")

    @cached_property
    def is_triangle(self) -> Bools:
        """(E,) which elements are triangles."""
        return np.less(self.elements[:, 3], 0)

    @cached_property
    def quads(self) -> Ints:
        """(Q, 4) nodes of the quads, in the order of the elements."""
        return ints(self.elements[~self.is_triangle])

    @cached_property
    def triangles(self) -> Ints:
        """(T, 3) nodes of the triangles, in the order of the elements."""
        return ints(self.elements[self.is_triangle, :3])

    @cached_property
    def is_free(self) -> Bools:
        """(N,) which nodes an optimiser may move: anywhere, or along their line."""
        return np.equal(self.node_states, NodeState.FREE) | self.slides

    @cached_property
    def slides(self) -> Bools:
        """(N,) which nodes move along a line only."""
        return np.equal(self.node_states, NodeState.ON_LINE) & np.greater_equal(self.node_lines, 0)

    @cached_property
    def is_reversed(self) -> Bools:
        """(E,) which elements run against their neighbours, see `reversed_elements`."""
        return reversed_elements(self.elements)


def topology(elements: Ints, node_states: Bytes, node_lines: Ints | None = None) -> Topology:
    """Topology of (E, 4) elements with nodes and elements labelled from 1."""
    nodes = len(node_states)
    return Topology(
        elements=elements,
        node_labels=np.arange(1, nodes + 1),
        element_labels=np.arange(1, len(elements) + 1),
        node_states=node_states,
        node_lines=np.full(nodes, -1) if node_lines is None else node_lines,
    )


def refuse_unknown_nodes(elements: Ints, nodes: int, element_labels: Longs, place: str) -> None:
    """Refuse elements of other nodes than there are: compiled loops read whatever stands there.

    Raises
    ------
    MeshError
        It names the first such element by its label.
    """
    if not len(elements) or (elements.max() < nodes and elements[:, :3].min() >= 0 and elements[:, 3].min() >= -1):
        return
    is_none = (elements >= nodes) | (elements < [0, 0, 0, -1])
    row, corner = (int(found[0]) for found in np.nonzero(is_none))
    found = int(elements[row, corner])
    raise MeshError("E_MESH", place, "no_node", element=int(element_labels[row]), found=found, nodes=nodes)


def half_edges(elements: Ints) -> tuple[Ints, Longs]:
    """Every element's edges in its own direction: (H, 2) nodes and (H,) element."""
    closing = np.where(elements[:, 3:] < 0, elements[:, :1], elements[:, 3:])
    ends = np.concatenate([elements[:, 1:3], closing, elements[:, :1]], axis=1)
    sides = np.stack([elements, ends], axis=2).reshape(-1, 2)
    owners = np.repeat(np.arange(len(elements)), 4)
    real = sides[:, 0] >= 0
    return ints(sides[real]), longs(owners[real])


def edges(elements: Ints) -> tuple[Ints, Longs]:
    """Every edge once: (K, 2) nodes, the lesser first, and (K,) how many elements have it."""
    sides, _ = half_edges(elements)
    order, starts = _by_edge(sides)
    return ints(np.sort(sides[order[starts[:-1]]], axis=1)), longs(np.diff(starts))


def paired_sides(sides: Ints) -> tuple[Longs, Longs]:
    """Rows of (H, 2) sides that have an edge in common, two by two; edges with one side or with three are left out."""
    order, starts = _by_edge(sides)
    first = starts[:-1][np.diff(starts) == 2]
    return longs(order[first]), longs(order[first + 1])


def _by_edge(sides: Ints) -> tuple[Longs, Longs]:
    """(H,) rows of the sides, those of an edge following one another, and (K + 1,) where each edge's begin."""
    nodes = int(sides.max(initial=0)) + 1
    keys = sides.min(axis=1) * np.int64(nodes) + sides.max(axis=1)  # numbers sort ten times faster than rows
    order = np.argsort(keys, kind="stable")
    starts = np.flatnonzero(np.diff(keys[order], prepend=-1))
    return order, np.append(starts, len(keys))


def rim_edge_count(elements: Ints) -> int:
    """Number of edges with one element only: those of the contour."""
    return int((edges(elements)[1] == 1).sum())


def rim_states(elements: Ints, nodes: int) -> Bytes:
    """(N,) node states of a mesh that tells none: contour where an edge has not two elements, else free.

    Nodes without elements are fixed: nothing is gained by moving them.
    """
    found, counts = edges(elements)
    states = np.full(nodes, NodeState.FIXED, dtype=np.int8)
    states[elements[elements >= 0]] = NodeState.FREE
    states[found[counts != 2].ravel()] = NodeState.CONTOUR
    return small_ints(states)


def reversed_elements(elements: Ints) -> Bools:
    """(E,) which elements run against the majority of those they are connected with.

    Neighbours agree when they run through their common edge in opposite directions. Edges with more than
    two elements (T-joints) connect nothing; a one-sided (Moebius) part has no reversed elements.
    """
    sides, owners = half_edges(elements)
    count = len(elements)
    side, other_side = paired_sides(sides)
    one, other = owners[side], owners[other_side]
    against = sides[side, 0] == sides[other_side, 0]
    if not against.any():
        return np.zeros(count, dtype=bool)
    from scipy import sparse  # noqa: PLC0415  a quarter of a second, and few need it
    from scipy.sparse.csgraph import connected_components  # noqa: PLC0415

    # each element stands twice in this graph, as it is and turned over; an edge joins what agrees
    rows = np.concatenate([one, one + count])
    columns = np.concatenate([np.where(against, other + count, other), np.where(against, other, other + count)])
    graph = sparse.coo_array((np.ones(len(rows), dtype=bool), (rows, columns)), shape=(2 * count, 2 * count))
    _, part = connected_components(graph, directed=False)
    as_is, turned = part[:count], part[count:]
    sizes = np.bincount(as_is, minlength=2 * count)
    lesser = (sizes[as_is] < sizes[turned]) | ((sizes[as_is] == sizes[turned]) & (as_is > turned))
    return np.asarray(lesser & (as_is != turned))
