"""Limited-memory BFGS with local rollback, compiled: a few iterations at a time, whatever the energy.

J. Nocedal, S. Wright, *Numerical Optimization* (2006), Algorithms 7.4 and 7.5, with a line search by the weak Wolfe
conditions (bisection). Where a step would spoil elements, only the steps of their nodes are shortened, so that one
bad element does not hold up the whole mesh; the decrease is asked of the step that is really made.
"""

from typing import NamedTuple

import numpy as np

from hullquad.arrays import Floats, Ints, Longs
from hullquad.metrics.compiled import compiled, inlined, woven
from hullquad.optimization.energy import Elements, Energy, rows_for, total_at
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
    slides: Ints
    """(S,) nodes that move along a line, which is their first tangent."""
    ends: Floats
    """(S, 2, 3) between which they stay."""
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
    """(E,) of the elements at the present iterate."""
    trial_openness: Floats
    """(E,)"""
    values: Floats
    """(LOOK_BACK + 1,) the last energies, the newest at `counts[1] % (LOOK_BACK + 1)`; not a number when it begins."""
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
        values=np.full(LOOK_BACK + 1, np.nan),
        counts=np.zeros(3, dtype=np.int64),
    )


def looking(run: Descent) -> Descent:
    """One that is only looked with, at the same points: it takes nothing of what the other remembers."""
    values, counts = np.full_like(run.values, np.nan), np.zeros_like(run.counts)
    openness = np.empty_like(run.openness)
    return run._replace(gradient=run.trial_gradient, openness=openness, values=values, counts=counts)


def begin(run: Descent) -> None:
    """Forget what was learnt: the next iterations begin anew where the nodes are, perhaps with another energy."""
    run.counts[:] = 0
    run.values[:] = np.nan


def look(run: Descent, ways: Ways, elements: Elements, energy: Energy) -> float:
    """An energy where the nodes are; sets `openness` and `node_gradient`."""
    begin(run)
    iterate(run, ways, elements, energy, 0, 0.0)
    return float(run.values[0])


@compiled
def iterate(run: Descent, ways: Ways, elements: Elements, energy: Energy, iterations: int, gain: float) -> int:
    """Up to so many iterations, until the energy has fallen by less than `gain` an iteration.

    Returns GOING_ON, CONVERGED (the gain is small) or STUCK (no step makes it smaller).
    """
    rows = rows_for(energy)
    if np.isnan(run.values[0]):
        value, _ = total_at(run.points, elements, energy, rows, run.openness, run.openness, run.node_gradient)
        run.values[0] = value
        _reduce(run.node_gradient, ways.tangents, run.gradient)
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
def _step(run: Descent, ways: Ways, elements: Elements, energy: Energy, rows: Floats) -> bool:
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
    direction, steps, changes, curvatures = run.direction, run.unknown_steps, run.changes, run.curvatures
    alphas, known, newest = np.empty(PAIRS), run.counts[0], run.counts[2] - 1
    scale = _FIRST * size * size
    _scale(run.gradient, 1.0, direction)
    for back in range(known):
        row = (newest - back) % PAIRS
        alphas[row] = curvatures[row] * _product(steps[row], direction)
        _add(direction, -alphas[row], changes[row])
    if known > 0:
        last = newest % PAIRS
        scale = 1.0 / (curvatures[last] * _product(changes[last], changes[last]))
    _scale(direction, -scale, direction)
    for back in range(known - 1, -1, -1):
        row = (newest - back) % PAIRS
        beta = -curvatures[row] * _product(changes[row], direction)
        _add(direction, beta - alphas[row], steps[row])
    longest = 0.0
    for i in range(len(direction)):
        longest = max(longest, abs(direction[i]))
    return _product(run.gradient, direction), longest


@woven
def _search(
    run: Descent, ways: Ways, elements: Elements, energy: Energy, rows: Floats, slope: float, longest: float
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
    run: Descent, ways: Ways, elements: Elements, energy: Energy, rows: Floats, length: float, slope: float
) -> tuple[float, bool, float]:
    """Energy a step away, whether all nodes made the whole step, and the slope times the step that was made."""
    _move(run.points, ways.tangents, run.direction, length, run.trial)
    is_free = _keep_between(ways.slides, ways.ends, ways.tangents, run.trial)
    value, is_whole = _settle(run, ways, elements, energy, rows)
    is_whole &= is_free
    _reduce(run.node_gradient, ways.tangents, run.trial_gradient)
    return (
        value,
        is_whole,
        slope * length if is_whole else _slope_made(run.trial, run.points, ways.tangents, run.gradient),
    )


@woven
def _settle(run: Descent, ways: Ways, elements: Elements, energy: Energy, rows: Floats) -> tuple[float, bool]:
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
            run.points, run.trial, elements.nodes, run.openness, run.trial_openness, energy.guard, energy.kept, share,
            run.shares,
        )  # fmt: skip
    return np.inf, False


@woven
def _remember(run: Descent, ways: Ways, elements: Elements, energy: Energy, rows: Floats) -> None:
    """Make the trial the present iterate and keep the step with its change of gradient."""
    row = run.counts[2] % PAIRS
    step, change = run.unknown_steps[row], run.changes[row]
    _project(run.trial, run.points, ways.tangents, step)
    _take(run.trial, run.points, run.trial_openness, run.openness)
    if len(ways.footing.at) > 0:
        turn(ways.footing, ways.tangents)
        face(elements.nodes, ways.footing.normals, elements.facing)
        value, _ = total_at(run.points, elements, energy, rows, run.openness, run.openness, run.node_gradient)
        run.values[(run.counts[1] + 1) % (LOOK_BACK + 1)] = value
        _reduce(run.node_gradient, ways.tangents, run.trial_gradient)
    _change(run.trial_gradient, run.gradient, change)
    curvature, spread = _product(step, change), _product(change, change)
    if curvature > 1e-16 * spread * energy.size * energy.size:
        run.curvatures[row] = 1.0 / curvature
        run.counts[2] += 1
        run.counts[0] = min(run.counts[0] + 1, PAIRS)


@inlined
def _slope_made(trial: Floats, points: Floats, tangents: Floats, gradient: Floats) -> float:
    """What the energy should change by in the step that is made, by its gradient."""
    total = 0.0
    for unknown in range(len(gradient)):
        total += _made(trial, points, tangents, unknown) * gradient[unknown]
    return total


@inlined
def _project(trial: Floats, points: Floats, tangents: Floats, step: Floats) -> None:
    """The step that is made, by the unknowns."""
    for unknown in range(len(step)):
        step[unknown] = _made(trial, points, tangents, unknown)


@inlined
def _made(trial: Floats, points: Floats, tangents: Floats, unknown: int) -> float:
    """What an unknown changes by in the step that is made."""
    node, way, made = unknown // 2, unknown % 2, 0.0
    for axis in range(3):
        made += (trial[node, axis] - points[node, axis]) * tangents[node, way, axis]
    return made


@inlined
def _take(trial: Floats, points: Floats, trial_openness: Floats, openness: Floats) -> None:
    """Make the trial the present iterate."""
    for node in range(len(points)):
        for axis in range(3):
            points[node, axis] = trial[node, axis]
    for i in range(len(openness)):
        openness[i] = trial_openness[i]


@inlined
def _change(trial_gradient: Floats, gradient: Floats, change: Floats) -> None:
    """Take the gradient of the trial, and keep what has changed."""
    for i in range(len(change)):
        change[i] = trial_gradient[i] - gradient[i]
        gradient[i] = trial_gradient[i]


@inlined
def _move(points: Floats, tangents: Floats, direction: Floats, length: float, moved: Floats) -> None:
    """Nodes a step along their tangents."""
    for node in range(len(tangents)):
        first, second = length * direction[2 * node], length * direction[2 * node + 1]
        for axis in range(3):
            moved[node, axis] = points[node, axis] + first * tangents[node, 0, axis] + second * tangents[node, 1, axis]


@inlined
def _keep_between(slides: Ints, ends: Floats, tangents: Floats, moved: Floats) -> bool:
    """Put nodes that have slid beyond an end of their line there; whether there were none."""
    is_free = True
    for k in range(len(slides)):
        node = slides[k]
        back, ahead = 0.0, 0.0
        for axis in range(3):
            back += (ends[k, 0, axis] - moved[node, axis]) * tangents[node, 0, axis]
            ahead += (ends[k, 1, axis] - moved[node, axis]) * tangents[node, 0, axis]
        beyond = max(back, 0.0) + min(ahead, 0.0)
        if beyond != 0.0:
            is_free = False
            for axis in range(3):
                moved[node, axis] += beyond * tangents[node, 0, axis]
    return is_free


@inlined
def _reduce(node_gradient: Floats, tangents: Floats, gradient: Floats) -> None:
    """Gradient by the unknowns from that by the points."""
    for node in range(len(tangents)):
        for way in range(2):
            total = 0.0
            for axis in range(3):
                total += node_gradient[node, axis] * tangents[node, way, axis]
            gradient[2 * node + way] = total


@inlined
def _product(one: Floats, other: Floats) -> float:
    total = 0.0
    for i in range(len(one)):
        total += one[i] * other[i]
    return total


@inlined
def _add(to: Floats, factor: float, what: Floats) -> None:
    for i in range(len(to)):
        to[i] += factor * what[i]


@inlined
def _scale(what: Floats, factor: float, to: Floats) -> None:
    for i in range(len(to)):
        to[i] = factor * what[i]
