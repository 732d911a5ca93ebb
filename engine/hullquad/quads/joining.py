"""A pairing of triangles as states of a mesh, join after join."""

from collections.abc import Iterator, Sequence

import numpy as np

from hullquad.arrays import Floats
from hullquad.quads.front import Join
from hullquad.quads.pairs import Pairs
from hullquad.quads.stages import States, Step, padded, whole, written


def joined_states(before: States, pairs: Pairs, order: Sequence[int]) -> States:
    """One state for every pair that is joined: its quad in the row of one triangle, and none in that of the other."""
    quads = pairs.quads[order]
    ends = np.arange(1, len(order) + 1)
    return States(
        step=Step.JOINED,
        before=before,
        rows=pairs.members[order].ravel(),
        elements=np.stack([quads, np.full_like(quads, -1)], axis=1).reshape(-1, 4),
        row_ends=2 * ends,
        nodes=[],
        places=np.empty((0, 2)),
        node_ends=0 * ends,
    )


def paper_states(nodes: Floats, pairs: Pairs, steps: Sequence[Join]) -> Iterator[States]:
    """The triangles, then the states after each step of the paper's pairing but the last one."""
    before = whole(Step.TRIANGULATED, nodes, padded(pairs.triangles))
    yield before
    front = [step.joined[0] for step in steps[:-1] if step.level >= 0]
    if front:
        before = joined_states(before, pairs, front)
        yield before
    for step in steps[len(front) : -1]:
        before = _rejoined(before, pairs, step)
        yield before


def _rejoined(before: States, pairs: Pairs, step: Join) -> States:
    """The state after some pairs were taken apart and others joined."""
    rows: dict[int, list[int]] = {}
    for pair in step.parted:
        for triangle in pairs.members[pair].tolist():
            rows[triangle] = [*pairs.triangles[triangle].tolist(), -1]
    for pair in step.joined:
        one, other = pairs.members[pair].tolist()
        rows[one], rows[other] = pairs.quads[pair].tolist(), [-1] * 4
    return written(Step.JOINED, before, list(rows), list(rows.values()), [], np.empty((0, 2)))
