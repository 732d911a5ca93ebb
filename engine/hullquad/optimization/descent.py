"""Limited-memory BFGS with local rollback, compiled: a few iterations at a time, whatever the energy.

J. Nocedal, S. Wright, *Numerical Optimization* (2006), Algorithms 7.4 and 7.5, with a line search by the weak Wolfe
conditions (bisection). Where a step would spoil elements, only the steps of their nodes are shortened, so that one
bad element does not hold up the whole mesh; the decrease is asked of the step that is really made.
"""

from typing import NamedTuple

import numpy as np

from hullquad.arrays import Floats, Longs
from hullquad.metrics.compiled import compiled, woven
from hullquad.optimization.energy import Elements, Energy, Rows, rows_of, total_at
from hullquad.optimization.facets import Facets
from hullquad.optimization.footing import Footing, bring_back, face, turn
from hullquad.optimization.rollback import HALVINGS, ROUNDS, hold_back

PAIRS = 7
"""Steps that are remembered."""
LOOK_BACK = 5
"""Iterations over which the gain is taken."""
_SEARCHES = 20
_DECREASE, _CURVATURE = 1e-4, 0.9
_FARTHEST = 0.5
"""Longest move of a node in one step, in element sizes."""
_FIRST = 0.05
"""Scale of the first step: nothing is known of the energy yet."""

GOING_ON, CONVERGED, STUCK = 0, 1, 2


class Ways(NamedTuple):
    """What nodes may move along, and the surface that they stay on."""

    tangents: Floats
    """(M, 2, 3) unit vectors, or zero; turned with the surface."""
    surface: Facets
    footing: Footing


class Descent(NamedTuple):
    """All that a minimisation remembers; its arrays are written to."""

    points: Floats
    """(K, 3) the present iterate."""
    trial: Floats
    """(K, 3)"""
    node_gradient: Floats
    """(K, 3)"""
    gradient: Floats
    """(2 M,) by the unknowns of the movable nodes."""
    trial_gradient: Floats
    direction: Floats
    unknown_steps: Floats
    """(PAIRS, 2 M)"""
    changes: Floats
    """(PAIRS, 2 M)"""
    curvatures: Floats
    """(PAIRS,)"""
    shares: Floats
    """(M,) part of its step that a node keeps."""
    openness: Floats
    """(Q + T,) of the elements at the present iterate."""
    trial_openness: Floats
    """(Q + T,)"""
    values: Floats
    """(LOOK_BACK + 1,) the last energies, the newest at `counts[1] % (LOOK_BACK + 1)`."""
    counts: Longs
    """(3,) pairs in use, iterations since the start, pairs ever kept."""


def descent(points: Floats, movable: int, elements: int) -> Descent:
    """A minimisation that has not begun, of so many nodes and elements."""
    unknowns = 2 * movable
    return Descent(
        points=points.copy(),
        trial=points.copy(),
        node_gradient=np.zeros_like(points),
        gradient=np.zeros(unknowns),
        trial_gradient=np.zeros(unknowns),
        direction=np.zeros(unknowns),
        unknown_steps=np.zeros((PAIRS, unknowns)),
        changes=np.zeros((PAIRS, unknowns)),
        curvatures=np.zeros(PAIRS),
        shares=np.ones(movable),
        openness=np.ones(elements),
        trial_openness=np.ones(elements),
        values=np.full(LOOK_BACK + 1, np.inf),
        counts=np.zeros(3, dtype=np.int64),
    )


def begin(run: Descent) -> None:
    """Forget what was learnt: the next iterations begin anew where the nodes are, perhaps with another energy."""
    run.counts[:] = 0
    run.values[:] = np.inf
    run.values[0] = np.nan


@compiled
def iterate(run: Descent, ways: Ways, elements: Elements, energy: Energy, iterations: int, gain: float) -> int:
    """Up to so many iterations, until the energy has fallen by less than `gain` an iteration.

    Returns GOING_ON, CONVERGED (the gain is small) or STUCK (no step makes it smaller).
    """
    rows = rows_of(energy)
    if np.isnan(run.values[0]):
        run.trial[:] = run.points
        run.values[0] = _look(run, ways, elements, energy, rows, run.gradient)
    for _ in range(iterations):
        if not _step(run, ways, elements, energy, rows):
            return STUCK
        run.counts[1] += 1
        if run.counts[1] >= LOOK_BACK:
            newest = run.values[run.counts[1] % (LOOK_BACK + 1)]
            oldest = run.values[(run.counts[1] + 1) % (LOOK_BACK + 1)]
            if oldest - newest < LOOK_BACK * gain:
                return CONVERGED
    return GOING_ON


@woven
def _step(run: Descent, ways: Ways, elements: Elements, energy: Energy, rows: Rows) -> bool:
    """One iteration; from the steepest descent again where the remembered steps lead nowhere."""
    while True:
        slope, longest = _aim(run, energy.size)
        if slope < 0.0 and _search(run, ways, elements, energy, rows, slope, longest):
            _remember(run, ways, elements, energy, rows)
            return True
        if run.counts[0] == 0:
            return False
        run.counts[0] = 0


@woven
def _aim(run: Descent, size: float) -> tuple[float, float]:
    """Set the direction (Algorithm 7.4); gives the slope along it and its longest unknown."""
    direction, alphas = run.direction, np.empty(PAIRS)
    direction[:] = run.gradient
    scale = _FIRST * size * size
    for back in range(run.counts[0]):
        row = (run.counts[2] - 1 - back) % PAIRS
        alphas[row] = run.curvatures[row] * _product(run.unknown_steps[row], direction)
        _add(direction, -alphas[row], run.changes[row])
    if run.counts[0] > 0:
        last = (run.counts[2] - 1) % PAIRS
        scale = 1.0 / (run.curvatures[last] * _product(run.changes[last], run.changes[last]))
    for i in range(len(direction)):
        direction[i] *= -scale
    for back in range(run.counts[0] - 1, -1, -1):
        row = (run.counts[2] - 1 - back) % PAIRS
        beta = -run.curvatures[row] * _product(run.changes[row], direction)
        _add(direction, beta - alphas[row], run.unknown_steps[row])
    longest = 0.0
    for i in range(len(direction)):
        longest = max(longest, abs(direction[i]))
    return _product(run.gradient, direction), longest


@woven
def _search(
    run: Descent, ways: Ways, elements: Elements, energy: Energy, rows: Rows, slope: float, longest: float
) -> bool:
    """Whether a step along the direction makes the energy smaller; leaves it in `trial` and `trial_gradient`."""
    before = run.values[run.counts[1] % (LOOK_BACK + 1)]
    most = _FARTHEST * energy.size / max(longest, 1e-300)
    low, high, length, is_last = 0.0, np.inf, min(1.0, most), False
    for search in range(_SEARCHES):
        value, is_whole, along = _try(run, ways, elements, energy, rows, length, slope)
        is_lower = along < 0.0 and value <= before + _DECREASE * along
        is_steep = is_whole and _product(run.trial_gradient, run.direction) < _CURVATURE * slope
        if is_last or (is_lower and not (is_steep and length < 0.99 * most)):
            run.values[(run.counts[1] + 1) % (LOOK_BACK + 1)] = value
            return True
        if is_lower:
            low = length
            length = 0.5 * (low + high) if high < np.inf else min(2.0 * low, most)
        else:
            high = length
            length = 0.5 * (low + high) if low > 0.0 else 0.4 * length
        if search == _SEARCHES - 2 and low > 0.0:
            length, is_last = low, True  # the longest that was found to be lower
    return False


@woven
def _try(
    run: Descent, ways: Ways, elements: Elements, energy: Energy, rows: Rows, length: float, slope: float
) -> tuple[float, bool, float]:
    """Energy a step away, whether all nodes made the whole step, and the slope times the step that was made."""
    _move(run.points, ways.tangents, run.direction, length, run.trial)
    value, is_whole = _settle(run, ways, elements, energy, rows)
    _reduce(run.node_gradient, ways.tangents, run.trial_gradient)
    return value, is_whole, slope * length if is_whole else _slope_made(run, ways.tangents)


@woven
def _settle(run: Descent, ways: Ways, elements: Elements, energy: Energy, rows: Rows) -> tuple[float, bool]:
    """Energy of the trial, once no element is spoilt by it, and whether nothing had to be held back for that."""
    for round_ in range(ROUNDS):
        bring_back(ways.surface, ways.footing, run.trial)
        value, spoils = total_at(
            run.trial, elements, energy, rows, run.openness, run.trial_openness, run.node_gradient
        )  # fmt: skip
        if not spoils:
            return value, round_ == 0
        share = 0.5 if round_ < HALVINGS else 0.0
        hold_back(
            run.points, run.trial, elements, run.openness, run.trial_openness, energy, share, run.shares
        )  # fmt: skip
    return np.inf, False


@woven
def _remember(run: Descent, ways: Ways, elements: Elements, energy: Energy, rows: Rows) -> None:
    """Make the trial the present iterate and keep the step with its change of gradient."""
    row = run.counts[2] % PAIRS
    step, change = run.unknown_steps[row], run.changes[row]
    for node in range(len(ways.tangents)):
        for way in range(2):
            made = 0.0
            for axis in range(3):
                made += (run.trial[node, axis] - run.points[node, axis]) * ways.tangents[node, way, axis]
            step[2 * node + way] = made
        for axis in range(3):
            run.points[node, axis] = run.trial[node, axis]
    run.openness[:] = run.trial_openness
    if len(ways.footing.at) > 0:
        turn(ways.footing, ways.tangents)
        face(elements.quads, ways.footing.normals, elements.quad_normals)
        face(elements.triangles, ways.footing.normals, elements.triangle_normals)
        value = _look(run, ways, elements, energy, rows, run.trial_gradient)
        run.values[(run.counts[1] + 1) % (LOOK_BACK + 1)] = value
    for i in range(len(change)):
        change[i] = run.trial_gradient[i] - run.gradient[i]
        run.gradient[i] = run.trial_gradient[i]
    curvature, spread = _product(step, change), _product(change, change)
    if curvature > 1e-16 * spread * energy.size * energy.size:
        run.curvatures[row] = 1.0 / curvature
        run.counts[2] += 1
        run.counts[0] = min(run.counts[0] + 1, PAIRS)


@woven
def _look(run: Descent, ways: Ways, elements: Elements, energy: Energy, rows: Rows, gradient: Floats) -> float:
    """The energy where the nodes are, and its gradient."""
    value, _ = total_at(run.points, elements, energy, rows, run.openness, run.openness, run.node_gradient)
    _reduce(run.node_gradient, ways.tangents, gradient)
    return value


@compiled
def _slope_made(run: Descent, tangents: Floats) -> float:
    """What the energy should change by in the step that is made, by its gradient."""
    total = 0.0
    for node in range(len(tangents)):
        for way in range(2):
            made = 0.0
            for axis in range(3):
                made += (run.trial[node, axis] - run.points[node, axis]) * tangents[node, way, axis]
            total += made * run.gradient[2 * node + way]
    return total


@compiled
def _move(points: Floats, tangents: Floats, direction: Floats, length: float, moved: Floats) -> None:
    """Nodes a step along their tangents."""
    for node in range(len(tangents)):
        first, second = length * direction[2 * node], length * direction[2 * node + 1]
        for axis in range(3):
            moved[node, axis] = points[node, axis] + first * tangents[node, 0, axis] + second * tangents[node, 1, axis]


@compiled
def _reduce(node_gradient: Floats, tangents: Floats, gradient: Floats) -> None:
    """Gradient by the unknowns from that by the points."""
    for node in range(len(tangents)):
        for way in range(2):
            total = 0.0
            for axis in range(3):
                total += node_gradient[node, axis] * tangents[node, way, axis]
            gradient[2 * node + way] = total


@compiled
def _product(one: Floats, other: Floats) -> float:
    total = 0.0
    for i in range(len(one)):
        total += one[i] * other[i]
    return total


@compiled
def _add(to: Floats, factor: float, what: Floats) -> None:
    for i in range(len(to)):
        to[i] += factor * what[i]
