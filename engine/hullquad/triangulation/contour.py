"""The contour of a plate divided into segments: what a mesh has on its rim, settled before there is a mesh."""

from collections.abc import Mapping, Sequence

import numpy as np
import shapely

from hullquad.arrays import Floats, floats
from hullquad.errors import PlateError
from hullquad.plate import Document
from hullquad.triangulation.clearance import crossing, near_segments
from hullquad.triangulation.common_lines import common_numbers
from hullquad.triangulation.divided import Contour
from hullquad.triangulation.following import Plan, followed, plan
from hullquad.triangulation.given_nodes import given_nodes
from hullquad.triangulation.neighbours import Neighbours, neighbours
from hullquad.triangulation.sizes import MOST_ELEMENTS, element_size, elements_needed, refuse_size, rounded_down

__all__ = ["MOST_ELEMENTS", "Contour", "attempts", "contours", "element_size", "elements_needed", "refuse_size"]

_CLEARANCE = 0.01
"""Distance that nodes keep from the segments of others, so that the triangulation can tell them apart [mm]."""
_TRIES = 8
_HALVINGS = 4
"""Steps by which a size that helps is approached from below: to a sixteenth."""


def contours(document: Document, size: float | str | None = None, *, follow_lines: bool = False) -> dict[str, Contour]:
    """Divide the contours of a document's plane plates, by plate id.

    What plates have in common is divided once, with the finest of their sizes; they all get the same nodes.

    Parameters
    ----------
    document : Document
        Curved plates are left out.
    size : float, str or None
        Length of the segments [mm]; ``"coarse"``, ``"fine"`` or ``"very_fine"`` for the plates' own sizes;
        None for their target sizes.
    follow_lines : bool
        Whether elements follow stiffeners and seams as a whole, or only have nodes at their ends.

    Raises
    ------
    PlateError
        A plate cannot be divided so: the first of them in the document.
    """
    found = attempts(document, size, follow_lines=follow_lines)
    for outcome in found.values():
        if isinstance(outcome, PlateError):
            raise outcome
    return {key: outcome for key, outcome in found.items() if isinstance(outcome, Contour)}


def attempts(
    document: Document, size: float | str | None = None, *, follow_lines: bool = False
) -> dict[str, Contour | PlateError]:
    """Contour of each plane plate as of `contours`, or why there is none: one plate does not stop the others."""
    plates = tuple(plate for plate in document.plates if plate.is_plane)
    shared = neighbours(plates)
    refused = dict(shared.wishes.conflicts)
    below = "/target_size" if size is None else ""
    for plate in plates:
        try:
            refuse_size(plate, element_size(plate, size), plate.place + below)
        except PlateError as error:
            refused.setdefault(plate.id, error)
    sizes = [np.inf if plate.id in refused else element_size(plate, size) for plate in plates]
    found = {plate.id: refused.get(plate.id) or _attempt(shared, number, sizes) for number, plate in enumerate(plates)}
    return _following(found) if follow_lines else found


def _following(found: Mapping[str, Contour | PlateError]) -> dict[str, Contour | PlateError]:
    """The contours with the stiffeners and seams of their plates; what several plates have of them is divided once."""
    plans = {key: _plan(contour) for key, contour in found.items() if isinstance(contour, Contour)}
    numbers = common_numbers(list(plans.values()))
    made = {key: followed(chosen, given) for (key, chosen), given in zip(plans.items(), numbers, strict=True)}
    return {**found, **made}


def _plan(contour: Contour) -> Plan:
    lines = contour.plate.lines
    ends = floats(np.array([[line.a, line.b] for line in lines]).reshape(-1, 2, 2))
    return plan(contour, ends, [line.place for line in lines])


def _attempt(shared: Neighbours, plate: int, sizes: Sequence[float]) -> Contour | PlateError:
    contour = _divided(shared, plate, sizes)
    flaw = _flaw(contour)
    return contour if flaw is None else _too_coarse(shared, plate, sizes, flaw)


def _divided(shared: Neighbours, plate: int, sizes: Sequence[float]) -> Contour:
    given = given_nodes(shared, plate, sizes)
    return Contour(
        plate=shared.frame.plates[plate],
        size=sizes[plate],
        nodes=given.nodes,
        points=given.points,
        loop_starts=given.loop_starts,
        inside_places=given.inside_places,
        rows=given.rows,
        snaps=(*shared.fixed[plate].snaps, *shared.snaps(plate)),
    )


def _flaw(contour: Contour) -> tuple[str, Floats] | None:
    """Place and point where the straight segments, unlike the edges they stand for, cross or touch something."""
    rim = contour.nodes[: contour.edge_count]
    starts: Sequence[int] = contour.loop_starts.tolist()
    if not contour.region.is_valid:
        at = crossing(contour.region)
        away = [shapely.distance(shapely.linearrings(ring), shapely.Point(at)) for ring in contour.rings]
        nearest_last = len(away) - 1 - int(np.argmin(np.round(away[::-1], 6)))
        return contour.plate.loops[nearest_last].place, at
    touching = near_segments(rim, rim, starts, _CLEARANCE)
    if len(touching):
        node = touching[0, 0]
        return contour.plate.loops[int(np.searchsorted(starts, node, side="right")) - 1].place, rim[node]
    outside = ~shapely.contains_xy(contour.region, contour.inside)
    outside[near_segments(contour.inside, rim, starts, _CLEARANCE)[:, 0]] = True
    return next(((contour.inside_places[i], contour.inside[i]) for i in np.flatnonzero(outside)), None)


def _too_coarse(shared: Neighbours, plate: int, sizes: Sequence[float], flaw: tuple[str, Floats]) -> PlateError:
    """Error that says about the largest size that would do."""
    place, (u, v) = flaw
    size, owner = sizes[plate], shared.frame.plates[plate]

    def helps(finer: float) -> bool:
        is_small = elements_needed(owner, finer) <= MOST_ELEMENTS
        return is_small and _flaw(_divided(shared, plate, [*sizes[:plate], finer, *sizes[plate + 1 :]])) is None

    helping = next(filter(helps, (size / 2**i for i in range(1, _TRIES))), None)
    if helping is None:
        return PlateError("E_COARSE", place, "always", u=u, v=v, size=size)
    refused = min(2 * helping, size)
    for _ in range(_HALVINGS):
        middle = rounded_down((helping + refused) / 2)
        helping, refused = (middle, refused) if middle > helping and helps(middle) else (helping, middle)
    return PlateError("E_COARSE", place, u=u, v=v, size=size, helping=helping)
