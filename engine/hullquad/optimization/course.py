"""A minimisation on a mesh, stage by stage: what every mode but the paper's is made of."""

from collections.abc import Iterator
from time import monotonic

import numpy as np

from hullquad.arrays import Floats, floats
from hullquad.mesh import Mesh
from hullquad.optimization import descent
from hullquad.optimization.energy import Elements, Energy, energy_at
from hullquad.optimization.problem import Problem
from hullquad.optimization.rollback import held_back
from hullquad.optimization.winslow import folding


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
        self.status = descent.GOING_ON
        """How the last stage ended: GOING_ON when iterations or time were used up before."""
        self._tangents, normals = given.directions(given.points)
        self.elements = Elements(given.quads, given.triangles, normals)
        self._run = descent.descent(given.points, given.movable)
        self._on_surface = given.points
        """Where the nodes were when they were brought back last."""
        self._iterations, self._stride = iterations, stride
        self._deadline = monotonic() + seconds

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

    @property
    def folded(self) -> tuple[int, float]:
        """Number of elements that are not open, and the least Jacobian [element size squared]."""
        return folding(self.points, *self.elements, self.problem.size)

    def mesh(self) -> Mesh:
        """The mesh as it is now."""
        return self.problem.mesh_at(self.points)

    def place(self, points: Floats) -> None:
        """Put the nodes elsewhere."""
        self._run.points[:] = points

    def value(self, energy: Energy) -> float:
        """An energy where the nodes are now."""
        return energy_at(self.points, self.elements, energy, np.empty_like(self.points))

    def stage(self, energy: Energy, most: int, gain: float) -> Iterator[int]:
        """Make an energy smaller; yields the number of the iteration after each stride.

        Ends after `most` iterations, when one gains less than `gain`, or when the course is complete.
        """
        left, made = most, 0
        before = descent.begin(self._run, self._tangents, self.elements, energy)
        self.status = descent.GOING_ON
        while left > 0 and self.status == descent.GOING_ON and not self.is_complete:
            count = min(self._stride, left, self._iterations - self.number)
            self.status = descent.iterate(self._run, self._tangents, self.elements, energy, count, gain)
            done = int(self._run.counts[1]) - made
            made, left, self.number = made + done, left - done, self.number + done
            if done and self.problem.surface is not None:
                value, made = self._settled(energy), 0
                self.status = descent.CONVERGED if before - value < gain * done else self.status
                before = value
            if done:
                yield self.number

    def _settled(self, energy: Energy) -> float:
        """Bring the nodes back onto the surface and begin anew from there; the energy then.

        Nodes of elements that would be folded by it go back to where they were brought last.
        """
        surface, movable = self.problem.surface, self.problem.movable
        assert surface is not None  # nodes cannot leave a plane
        self.points[:movable] = surface.feet(self.points[:movable])[0]
        held_back(self._on_surface, self.points, self.elements, 0.0, 0, np.ones(movable))
        self._on_surface = floats(self.points.copy())
        self._tangents, normals = self.problem.directions(self.points)
        self.elements = self.elements._replace(normals=normals)
        return descent.begin(self._run, self._tangents, self.elements, energy)
