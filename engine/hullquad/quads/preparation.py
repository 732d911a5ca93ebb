"""Every compiled kernel of the best mesher met once, on a square of eight triangles."""

import numpy as np

from hullquad.quads.draft import draft
from hullquad.quads.log import Log
from hullquad.quads.making import Task, making
from hullquad.quads.matching import improved
from hullquad.quads.pairs import pairs
from hullquad.quads.repair import repaired
from hullquad.quads.shaking import Costs, shaken
from hullquad.quads.stages import padded
from hullquad.quads.trial import change, ground
from hullquad.triangulation.field import Field
from hullquad.triangulation.points import aligned_points

_RIM = np.array([[0, 0], [1, 0], [2, 0], [2, 1], [2, 2], [1, 2], [0, 2], [0, 1]], dtype=float)


def prepare_kernels() -> None:
    """Load the kernels, compiling those that are not on disk."""
    nodes = np.concatenate([_RIM, [[1.0, 1.1]]])
    following = np.roll(np.arange(8), -1)
    triangles = np.stack([np.arange(8), following, np.full(8, 8)], axis=1).astype(np.int32)
    task = Task(
        given=8,
        rim_ideal=np.array([1, 2] * 4),
        size=1.0,
        bound=np.empty((0, 2), dtype=np.int32),
        usual=4.0,
        unavoidable=0,
    )
    list(making(nodes, triangles, task, is_watched=False))
    possible = pairs(np.pad(nodes, ((0, 0), (0, 1))), triangles, np.array([[0.0, 0.0, 1.0]]))
    list(improved(possible, {0}, possible.scores, np.zeros(8)))
    made, other = (draft(nodes, padded(triangles), 8, task.rim_ideal) for _ in range(2))
    silence = Log(is_watched=False)
    list(repaired(made, change(), ground(made), 0, silence))
    list(shaken(other, change(), ground(other), Costs(lambda _: 0.0, lambda _: 0.0), silence, most=1))
    guide = Field(
        nodes=nodes,
        triangles=triangles,
        neighbours=np.stack([np.full(8, -1), following, np.roll(np.arange(8), 1)], axis=1),
        values=np.tile([1.0, 0.0, 1.0, 0.0, 0.0], (9, 1)),
        seeds=np.array([[0.5, 0.0, 0.2]]),
        grading=0.4,
    )
    aligned_points(_RIM, np.stack([np.arange(8), following], axis=1), guide, 1.0)
