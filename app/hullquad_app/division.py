"""What the contours of a document are at one element size, and what is to be said about them before meshing."""

from collections.abc import Generator, Iterator, Mapping, Sequence
from functools import cached_property
from typing import TYPE_CHECKING, TypeAlias

import attrs

from hullquad.errors import PlateError
from hullquad.plate import Document, Notice

if TYPE_CHECKING:
    from hullquad.triangulation.contour import Contour
    from hullquad.triangulation.remedies import Remedy

Size: TypeAlias = float | str | None
"""Element size [mm], or the name of one of the plates' own; None for their target sizes."""
Attempt: TypeAlias = "Contour | PlateError"
"""A plate's contour, or why it has none."""


@attrs.frozen(eq=False)
class Division:
    """The contours of a document, divided for one size."""

    plates: Document
    size: Size
    follows_lines: bool
    """Whether elements are to follow stiffeners and seams as a whole."""
    contours: Mapping[str, Attempt]
    """Of the plane plates, by id."""
    notices: Mapping[str, Sequence[Notice]] = attrs.field(factory=dict)
    """What will not be good in the mesh of a plate, by id."""
    remedies: Mapping[str, "Remedy"] = attrs.field(factory=dict)
    """What makes the contours of odd plates even, by id."""

    @cached_property
    def odd(self) -> tuple[str, ...]:
        """Ids of the plates whose only unavoidable triangle comes from an odd number of contour edges."""
        return tuple(
            key
            for key, contour in self.contours.items()
            if not isinstance(contour, PlateError) and contour.is_odd and contour.triangles_unavoidable == 1
        )


def division(plates: Document, size: Size, *, follows_lines: bool = False) -> Division:
    """The contours of the plane plates, with all that is to be said about each plate."""
    steps = dividing(plates, size, follows_lines=follows_lines)
    while True:
        try:
            next(steps)
        except StopIteration as end:
            found: Division = end.value
            return found


def dividing(plates: Document, size: Size, *, follows_lines: bool = False) -> Generator[int, None, Division]:
    """The same, step by step: yields of how many plates all is known."""
    from hullquad.triangulation.contour import attempts  # noqa: PLC0415  all of these bring Shapely
    from hullquad.triangulation.remedies import remedy  # noqa: PLC0415

    yield 0
    contours = attempts(plates, size, follow_lines=follows_lines)
    notices = yield from _notices(plates, size, contours)
    found = Division(plates, size, follows_lines, contours, notices)
    remedies = {}
    for key in found.odd:
        yield len(plates.plates)
        if (change := remedy(plates, key, size)) is not None:
            remedies[key] = change
    return attrs.evolve(found, remedies=remedies)


def _notices(
    plates: Document, size: Size, contours: Mapping[str, Attempt]
) -> Generator[int, None, dict[str, list[Notice]]]:
    from hullquad.formats.hullplate import concerns  # noqa: PLC0415
    from hullquad.triangulation.concerns import gap_concerns  # noqa: PLC0415

    notices: dict[str, list[Notice]] = {}
    for plate in plates.plates:
        yield len(notices)
        notices[plate.id] = [*_at_size(plates, size, contours, plate.id), *concerns(plate)]
    for gap in gap_concerns(plates):
        owner = next(plate.id for plate in plates.plates if gap.place.startswith(f"{plate.place}/"))
        notices[owner].append(gap)
    return notices


def _at_size(plates: Document, size: Size, contours: Mapping[str, Attempt], key: str) -> Iterator[Notice]:
    """Those that depend on the element size; a plate that is refused has its refusal."""
    from hullquad.triangulation.concerns import concerns_of  # noqa: PLC0415

    contour = contours.get(key)
    if contour is not None and not isinstance(contour, PlateError):
        yield from concerns_of(plates, size, contour)
