"""The states that a mesh goes through while it is made, each told by what it has other than the one before.

So the joins of a large plate, thousands of them, take no more room than one mesh; a state is put together when somebody
wants to see it.
"""

from collections.abc import Iterator
from enum import Enum

import attrs
import numpy as np
import numpy.typing as npt

from hullquad.arrays import Floats, Ints, Longs, floats, ints, longs


class Step(Enum):
    """What has just been done."""

    MAPPED = "mapped"
    TRIANGULATED = "triangulated"
    JOINED = "joined"
    REPAIRED = "repaired"
    CLEANED = "cleaned"
    SMOOTHED = "smoothed"
    SHAKEN = "shaken"


@attrs.frozen(eq=False, kw_only=True)
class States:
    """States of a mesh, one after another: each writes some rows of elements and some nodes.

    No row and no node is written by two of them.
    """

    step: Step
    before: "States | None" = None
    """Whose last state these go on from; None where they begin with a whole mesh."""
    rows: Ints = attrs.field(converter=ints)
    """(R,) rows of elements that are written, state after state."""
    elements: Ints = attrs.field(converter=ints)
    """(R, 4) what is written: a triangle ends with -1, a row that is not in use begins with -1."""
    row_ends: Longs = attrs.field(converter=longs)
    """(S,) where the rows of each state end."""
    nodes: Ints = attrs.field(converter=ints)
    """(M,) nodes that are put somewhere, state after state."""
    places: Floats = attrs.field(converter=floats)
    """(M, 2) where [mm]."""
    node_ends: Longs = attrs.field(converter=longs)
    """(S,) where the nodes of each state end."""
    cost: float | None = None
    """Of a finished mesh, see `quads.cost`."""

    def __len__(self) -> int:
        return len(self.row_ends)

    def at(self, index: int, given: int) -> tuple[Floats, Ints]:
        """(N, 2) nodes [mm] and (E, 4) elements of a state, quads first; the first `given` nodes are always there."""
        chain = [(self, int(self.row_ends[index]), int(self.node_ends[index]))]
        chain += [(states, len(states.rows), len(states.nodes)) for states in _all_before(self)]
        elements = np.full((1 + max(states.rows.max(initial=0) for states, _, _ in chain), 4), -1, dtype=np.int32)
        places = np.zeros((1 + max(states.nodes.max(initial=0) for states, _, _ in chain), 2))
        for states, rows, nodes in reversed(chain):
            elements[states.rows[:rows]] = states.elements[:rows]
            places[states.nodes[:nodes]] = states.places[:nodes]
        return compact(places, elements, given)


def _all_before(states: States) -> Iterator[States]:
    """What states go on from, the nearest first."""
    while states.before is not None:
        states = states.before
        yield states


def whole(step: Step, nodes: Floats, elements: Ints, cost: float | None = None) -> States:
    """A state that goes on from nothing."""
    made = written(step, None, np.arange(len(elements)), elements, np.arange(len(nodes)), nodes)
    return made if cost is None else attrs.evolve(made, cost=cost)


def written(
    step: Step,
    before: States | None,
    rows: npt.ArrayLike,
    elements: npt.ArrayLike,
    nodes: npt.ArrayLike,
    places: npt.ArrayLike,
) -> States:
    """One state that goes on from others."""
    return States(
        step=step,
        before=before,
        rows=rows,
        elements=elements,
        row_ends=[len(np.asarray(rows))],
        nodes=nodes,
        places=places,
        node_ends=[len(np.asarray(nodes))],
    )


def compact(nodes: Floats, elements: npt.NDArray[np.integer], given: int) -> tuple[Floats, Ints]:
    """Nodes and elements in use: quads in their order, then the triangles; the first `given` nodes all stay."""
    rows = elements[elements[:, 0] >= 0]
    rows = np.concatenate([rows[rows[:, 3] >= 0], rows[rows[:, 3] < 0]])
    used = np.zeros(len(nodes), dtype=bool)
    used[rows[rows >= 0]] = True
    used[:given] = True
    numbers = np.append(np.cumsum(used) - 1, -1)
    return nodes[used], ints(numbers[rows])


def padded(triangles: Ints) -> Ints:
    """(T, 4) triangles as elements, ending with -1."""
    return np.pad(triangles, ((0, 0), (0, 1)), constant_values=-1)
