"""Several ways to place the points of a plate, of which the best finished mesh is kept.

Small plates are worth many tries, large ones have one: the number depends on the number of elements only, never on
the clock, so that the same plate always gives the same mesh. It ends early when a mesh costs next to nothing.
"""

from collections.abc import Iterator

import attrs
import numpy as np

from hullquad.arrays import Floats, Ints, Longs, floats, ints
from hullquad.quads.insets import inset_points
from hullquad.quads.making import Task, making, mending, shaking
from hullquad.quads.mapped import grids
from hullquad.quads.patchwork import Cutting, Patchwork
from hullquad.quads.settings import MeshSettings, Preference
from hullquad.quads.stages import States, Step, padded, whole
from hullquad.topology import edges
from hullquad.triangulation.contour import MOST_ELEMENTS, Contour
from hullquad.triangulation.delaunay import Triangulation, triangulate
from hullquad.triangulation.field import Field, field
from hullquad.triangulation.points import aligned_points

MOST_TRIANGLES = 4 * MOST_ELEMENTS
"""Two for each element, and as many again, so that a size that was allowed is never refused afterwards."""

_EFFORT = 1200
"""Elements that all candidates together may have, about; the first one may have any number."""
_OWN_AREA = 0.8
_OWN_ANGLE = 30.0


@attrs.frozen
class Candidate:
    """A way to place the points."""

    spacing: float
    """Distance that points keep, over the local size; 0 for the points that Triangle places itself."""
    grading: float = 1.0
    """Factor of the grading that is asked for."""
    halves_chords: bool = False
    """Whether there are points, too, in the middle of edges across the plate, from contour to contour."""
    inset: float = 0.0
    """How far inside there are points, too, beside every node of a contour, over the length of its segments."""


CANDIDATES = (
    Candidate(0.75),
    Candidate(0.62, 0.7),
    Candidate(0.88, 0.7),
    Candidate(0.78, 0.5),
    Candidate(0.0),
    Candidate(0.56),
    Candidate(0.68),
    Candidate(0.82),
)
LAST_RESORTS = (Candidate(0.75, halves_chords=True), Candidate(0.75, inset=0.35), Candidate(0.75, inset=0.2))
"""Where triangles are left that could be avoided: in narrow parts there is no node then that could be moved."""


@attrs.frozen(eq=False)
class _Stuck:
    """Where the candidates have left triangles that could be avoided."""

    regions: list[int]
    states: States
    """Of these regions."""


@attrs.frozen(eq=False, kw_only=True)
class Trial:
    """States of one of the candidates, on the plate cut along followed lines."""

    number: int
    """Of the candidate, from 0."""
    count: int
    """Candidates that are tried at most."""
    states: States
    settled: Cutting | None = None
    """What regions have that are not worked on any more."""
    is_best: bool = False
    """Whether it is a finished mesh, and the best so far."""


def trials(contour: Contour, settings: MeshSettings, *, is_watched: bool) -> Iterator[Trial | None]:
    """States of all candidates, one after the other; the mesh to take is the last one that is the best so far.

    Beside them it yields None from time to time: it may be dropped then.

    Parameters
    ----------
    contour : Contour
    settings : MeshSettings
    is_watched
        Whether there are states on the way, beside the finished ones.

    Raises
    ------
    MeshingError, WorkerError
        The plate could not be triangulated.
    """
    work = Patchwork(contour, _task(contour, settings))
    work.offer(*grids(contour, work.task([])), are_grids=True)
    yield _best(work, Step.MAPPED, 0, 1) if work.is_whole else None
    if not work.open:
        return
    guide, count, best = field(contour, settings.grading), 1, 0
    stuck = None
    for number, candidate in enumerate((*CANDIDATES, *LAST_RESORTS)):
        regions = work.avoidable if candidate in LAST_RESORTS else work.open if number < count else []
        if not regions:
            continue
        if candidate is LAST_RESORTS[0]:
            stuck = _Stuck(regions, whole(Step.SMOOTHED, *work.together(regions)))
        yield None
        placed, settled = _triangulated(contour, candidate, guide, regions), work.apart_from(regions)
        if number == 0:
            work.expect(placed)
        for states in making(*work.within(regions, placed), work.task(regions), is_watched=is_watched):
            trial = _trial(work, states, settled, number, max(count, number + 1))
            if trial is not None and trial.is_best:
                best = number
            yield trial
            if number == 0 and states is not None and states.cost is not None:
                count = max(1, min(len(CANDIDATES), _EFFORT // len(states.rows)))
    yield from _mended(work, stuck, (best, max(count, best + 1)), is_watched=is_watched)
    yield from _shaken(work, (best, max(count, best + 1)), is_watched=is_watched)
    if settings.prefer is Preference.QUALITY:
        for trial in trials(contour, attrs.evolve(settings, prefer=Preference.QUADS), is_watched=False):
            yield None
            if trial is not None and trial.is_best and work.offer(*trial.states.at(0, work.given)):
                yield _best(work, trial.states.step, best, max(count, best + 1))


def _shaken(work: Patchwork, numbers: tuple[int, int], *, is_watched: bool) -> Iterator[Trial | None]:
    """States of the best elements of regions that may still be bettered, shaken."""
    regions = work.open
    if regions and not (task := work.task(regions)).is_large:
        start, settled = whole(Step.SMOOTHED, *work.together(regions)), work.apart_from(regions)
        for states in shaking(start, task, is_watched=is_watched):
            if states is not None and states.cost is not None:
                work.offer(*states.at(0, work.given))
                yield _best(work, states.step, *numbers)
            else:
                yield _trial(work, states, settled, *numbers)


def _mended(
    work: Patchwork, stuck: _Stuck | None, numbers: tuple[int, int], *, is_watched: bool
) -> Iterator[Trial | None]:
    """States of what the candidates have left, without its avoidable triangles; the last resorts may be better."""
    if stuck is not None:
        settled = work.apart_from(stuck.regions)
        for states in mending(stuck.states, work.task(stuck.regions), is_watched=is_watched):
            yield _trial(work, states, settled, *numbers)


def _trial(work: Patchwork, states: States | None, settled: Cutting, number: int, count: int) -> Trial | None:
    """States as those of a candidate; the best of all parts where they are finished and something is better."""
    if states is None:
        return None
    if states.cost is not None and work.offer(*states.at(0, work.given)):
        return _best(work, states.step, number, count)
    return Trial(number=number, count=count, states=states, settled=settled)


def _best(work: Patchwork, step: Step, number: int, count: int) -> Trial:
    """The best parts of all regions."""
    return Trial(number=number, count=count, states=whole(step, *work.together(), work.cost), is_best=True)


def _task(contour: Contour, settings: MeshSettings) -> Task:
    return Task(
        given=len(contour.cut.originals),
        rim_ideal=contour.sides.fitting,
        bound=_both_ways(contour.cut.segments),
        size=contour.size,
        usual=contour.area / contour.size**2,
        unavoidable=contour.triangles_unavoidable,
        prefer=settings.prefer,
    )


def _both_ways(segments: Longs) -> Ints:
    """(K, 2) edges that are segments of the cut plate either way."""
    weights = [int(segments.max()) + 1, 1]
    is_twice = np.isin(segments @ weights, segments[:, ::-1] @ weights)
    return ints(segments[is_twice & (segments[:, 0] < segments[:, 1])])


def _triangulated(contour: Contour, candidate: Candidate, guide: Field, regions: list[int]) -> Triangulation:
    """Triangles of the contour and of a candidate's points, good for some regions."""
    if candidate.spacing == 0:
        return _delaunay(contour, np.empty((0, 2)), _OWN_AREA * contour.size**2)
    eased, cut = attrs.evolve(guide, grading=candidate.grading * guide.grading), contour.cut
    points = aligned_points(cut.nodes, cut.segments, eased, contour.size, candidate.spacing)
    if candidate.inset:
        points = inset_points(contour, regions, points, candidate.inset)
    found = _delaunay(contour, points)
    if candidate.halves_chords:
        found = _delaunay(contour, np.concatenate([points, _chord_middles(contour, found)]))
    return found


def _delaunay(contour: Contour, points: Floats, area: float | None = None) -> Triangulation:
    """Triangles of the contour and of points inside."""
    return triangulate(
        np.concatenate([contour.nodes, points]),
        contour.loop_starts,
        area=area,
        min_angle=_OWN_ANGLE,
        place=contour.plate.place,
        lines=contour.line_edges,
        element_limit=MOST_TRIANGLES,
    )


def _chord_middles(contour: Contour, found: Triangulation) -> Floats:
    """(C, 2) middles of the edges that go across a region from one given node to another, but for those of lines."""
    nodes, triangles = contour.cut.cut(found.nodes, found.triangles)
    sides, counts = edges(padded(triangles))
    weights = [len(nodes), 1]
    is_line = np.isin(sides.astype(np.int64) @ weights, np.sort(contour.cut.segments, axis=1) @ weights)
    chords = sides[(counts == 2) & (sides < len(contour.cut.originals)).all(axis=1) & ~is_line]
    return floats(nodes[chords].mean(axis=1))
