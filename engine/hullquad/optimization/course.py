"""A minimisation on a mesh, stage by stage: what every mode but the paper's is made of."""

from collections.abc import Iterator
from time import monotonic

import numpy as np

from hullquad.arrays import Floats, floats
from hullquad.mesh import Mesh
from hullquad.optimization import descent
from hullquad.optimization.energy import Elements, Energy
from hullquad.optimization.footing import footing
from hullquad.optimization.problem import Problem

_CHECK = 25
"""Iterations after which it is looked whether the mesh is the best so far, however often somebody looks at it."""


class Course:
    """Where the nodes are, how many iterations were made, and when there is no time for more.

    Parameters
    ----------
    iterations
        Most iterations of all stages together.
    seconds
        Most time.
    stride
        Iterations from one look at the mesh to the next: 1 to watch, many to be quick.
    """

    def __init__(self, given: Problem, iterations: int, seconds: float, stride: int) -> None:
        self.problem = given
        self.number = 0
        self.is_at_check = False
        """Whether it is time to see if the mesh is the best so far: the same iterations whatever the stride."""
        self._ways, self.elements = _ways(given)
        self._run = descent.descent(given.points, given.movable, len(self.elements.nodes))
        self._looking = descent.looking(self._run)
        self._iterations, self.stride = iterations, stride
        self._deadline = monotonic() + seconds

    def weigh(self, weights: Floats) -> None:
        """Have every element of the mesh (E,) count so much in the energies that ask for it."""
        self.elements = self.elements._replace(weights=floats(weights[self.problem.rows]))

    @property
    def points(self) -> Floats:
        """(K, 3) nodes of the problem; changes with every iteration."""
        return self._run.points

    @property
    def is_out_of_time(self) -> bool:
        """Whether the time is used up."""
        return monotonic() >= self._deadline

    @property
    def is_complete(self) -> bool:
        """Whether no iteration is left, or no time."""
        return self.number >= self._iterations or self.is_out_of_time

    def mesh(self) -> Mesh:
        """The mesh as it is now."""
        return self.problem.mesh_at(self.points)

    def value(self, energy: Energy) -> float:
        """An energy where the nodes are now."""
        return self.look(energy)[0]

    def look(self, energy: Energy) -> tuple[float, Floats]:
        """An energy where the nodes are now, and the openness (Q + T,) of the elements."""
        value = descent.look(self._looking, self._ways, self.elements, energy)
        return value, self._looking.openness

    def stage(self, energy: Energy, most: int, gain: float) -> Iterator[int]:
        """Make an energy smaller; yields the number of the iteration after each stride.

        Ends after `most` iterations, when one gains less than `gain`, or when the course is complete.
        """
        left, made, unchecked = most, 0, 0
        descent.begin(self._run)
        status = descent.GOING_ON
        while left > 0 and status == descent.GOING_ON and not self.is_complete:
            count = min(self.stride, left, self._iterations - self.number, _CHECK - (most - left) % _CHECK)
            status = descent.iterate(self._run, self._ways, self.elements, energy, count, gain)
            done = int(self._run.counts[1]) - made
            made, left, self.number = made + done, left - done, self.number + done
            is_over = left == 0 or status != descent.GOING_ON or self.is_complete
            self.is_at_check, unchecked = is_over or (most - left) % _CHECK == 0, unchecked + done
            if done or (is_over and unchecked):
                yield self.number
            if self.is_at_check:
                unchecked = 0


def _ways(given: Problem) -> tuple[descent.Ways, Elements]:
    """What nodes may move along, and the elements with what they must face."""
    tangents, facing = given.directions()
    slides, ends = given.slides()
    standing = footing(given.surface, given.nodes, given.movable)
    weights = floats(np.ones(len(given.elements)))
    return descent.Ways(tangents, slides, ends, given.surface, standing), Elements(
        given.elements, given.quads, facing, weights
    )
