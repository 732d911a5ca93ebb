"""Kniat's optimisation: interior nodes along the gradient of the sum of a metric over all quads.

``X_{n+1} = X_n + a G_n`` with a numerically calculated gradient G, until G is zero, the gain is small or the
iterations are used up. `a` has the unit of a length squared and is given as c times the target size squared.
"""

from collections.abc import Iterator

import numpy as np

from hullquad.arrays import Bools, Floats
from hullquad.errors import MeshError
from hullquad.mesh import Mesh
from hullquad.metrics import Metric
from hullquad.metrics.values import difference_gradient, valid_elements
from hullquad.optimization import stops
from hullquad.optimization.iterate import Iterate
from hullquad.optimization.objective import objective_sum
from hullquad.optimization.settings import PaperSettings
from hullquad.optimization.sliding import along_lines, on_lines
from hullquad.optimization.stops import Stop
from hullquad.quality import quality
from hullquad.surface import Plane

__all__ = ["PaperSettings", "objective_sum", "paper_iterates", "unmoved"]

_DIFFERENCE = 1e-5
"""Step of the central differences over the target size: rounding and truncation weigh about the same there."""


def paper_iterates(mesh: Mesh, metric: Metric, settings: PaperSettings | None = None) -> Iterator[Iterate]:
    """Iterates of the paper's method, the given mesh first.

    The objective is the sum of the metric's raw values over the quads; it is increased where higher is better
    and decreased where lower is. Best is the iterate with the best sum, and with the guard on none is best that
    has more invalid elements than another.

    Raises
    ------
    MeshError
        E_CURVED where the mesh lies on no known surface.
    """
    settings = settings or PaperSettings()
    surface, parameters = mesh.surface, mesh.parameters
    if surface is None or parameters is None:
        raise MeshError("E_CURVED", mesh.plate_id or "mesh", "optimize")
    sense = 1.0 if metric.higher_is_better else -1.0
    record = _Record(settings, quads=len(mesh.topology.quads), sense=sense)
    length, number, displacement = sense * settings.step * mesh.target_size**2, 0, 0.0
    while True:
        judged = quality(mesh, metric)
        objective = objective_sum(mesh, metric)
        is_best = record.take(objective, judged.inverted_count)
        gradient = _gradient(mesh, surface, metric)
        stop = _stop(mesh, gradient, number, record)
        yield Iterate(
            number=number,
            mesh=mesh,
            quality=judged,
            objective=objective,
            displacement=displacement,
            is_best=is_best,
            stop=stop,
        )
        if stop is not None:
            return
        mesh, displacement = _stepped(mesh, length * gradient, guard=settings.guard)
        number += 1


def unmoved(mesh: Mesh, metric: Metric) -> Iterate:
    """A mesh as the only iterate of a run that does nothing."""
    return Iterate(number=0, mesh=mesh, quality=quality(mesh, metric), objective=objective_sum(mesh, metric))


class _Record:
    """The best of a run so far, and how it got there."""

    def __init__(self, settings: PaperSettings, quads: int, sense: float) -> None:
        self._settings = settings
        self._least_gain = settings.tolerance * quads
        self._sense = sense
        self._best = (-np.inf, -np.inf)
        self._sums: list[float] = []

    def take(self, objective: float, inverted: int) -> bool:
        """Note an iterate; whether it is the best so far: with the guard on, first by inverted elements."""
        rank = (-inverted if self._settings.guard else 0, self._sense * objective)
        is_best = rank > self._best or not self._sums
        if rank[0] > self._best[0]:
            self._sums.clear()  # sums with more inverted elements are no measure of gain any more
        if is_best:
            self._best = rank
        self._sums.append(self._best[1])
        return is_best

    @property
    def gains_little(self) -> bool:
        """Whether the best sum has hardly grown over the last iterations."""
        window = self._settings.window
        return len(self._sums) > window and self._sums[-1] - self._sums[-1 - window] < self._least_gain

    def is_complete(self, number: int) -> bool:
        """Whether the iterations are used up."""
        return number >= self._settings.iterations


def _gradient(mesh: Mesh, surface: Plane, metric: Metric) -> Floats:
    """(N, 2) gradient of the objective by the parameters of the free nodes, along their line if they slide; else 0.

    A difference across a degenerate quad may be infinite or undefined; it tells no direction and counts as 0.
    """
    assert mesh.parameters is not None  # a mesh on a surface has them
    tangents = surface.tangents(mesh.parameters)
    step = _DIFFERENCE * mesh.target_size
    gradient = difference_gradient(
        metric, mesh.points, mesh.topology.quads, tangents, step, mesh.normals, mesh.reference_areas
    )
    usable = mesh.topology.is_free[:, None] & np.isfinite(gradient)
    return along_lines(mesh, np.where(usable, gradient, 0.0))


def _stop(mesh: Mesh, gradient: Floats, number: int, record: _Record) -> Stop | None:
    if not mesh.topology.is_free.any():
        return stops.NO_FREE_NODES
    if len(mesh.topology.quads) == 0:
        return stops.NO_QUADS
    if not gradient.any():
        return stops.GRADIENT
    if record.gains_little:
        return stops.GAIN
    return stops.ITERATIONS if record.is_complete(number) else None


def _stepped(mesh: Mesh, move: Floats, *, guard: bool) -> tuple[Mesh, float]:
    """The mesh with its nodes moved by `move` (N, 2) in the parameter plane, and the largest move [mm]."""
    parameters = mesh.parameters
    assert parameters is not None  # a mesh on a surface has them
    after = mesh.with_parameters(on_lines(mesh, parameters + move))
    held = _held(mesh, after) if guard else np.zeros(len(parameters), dtype=bool)
    if held.any():
        after = mesh.with_parameters(np.where(held[:, None], parameters, on_lines(mesh, parameters + move)))
    return after, float(np.sqrt(((after.points - mesh.points) ** 2).sum(axis=1).max()))


def _held(before: Mesh, after: Mesh) -> Bools:
    """(N,) nodes that must stay so that no element becomes invalid; all other moves are kept."""
    elements = before.topology.elements
    was_valid = valid_elements(before.points, elements, before.normals)
    held = np.zeros(len(before.points), dtype=bool)
    points = after.points
    while True:
        spoilt = was_valid & ~valid_elements(points, elements, before.normals)
        if not spoilt.any():
            return held
        nodes = elements[spoilt]
        held[nodes[nodes >= 0]] = True
        points = np.where(held[:, None], before.points, after.points)
