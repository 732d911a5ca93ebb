"""All contours of a document made even, as far as possible."""

from collections import deque
from collections.abc import Generator
from itertools import pairwise

from hullquad.plate import Document, Plate
from hullquad.triangulation.edges import is_odd, sized
from hullquad.triangulation.neighbours import Neighbours
from hullquad.triangulation.remedies import Remedy, changes, remedied, remedy

_OUTSIDE = -1


def evened(document: Document, size: float | str | None = None) -> Document:
    """The document with contours made even by single segments more or fewer on some edges, as far as a way is found.

    An odd plate is made even by one edge with others that are odd too, or with the nearest odd one, or with an edge
    that it has alone; plates on the way there change on two edges each, and stay even.
    """
    steps = evening(document, size)
    while True:
        try:
            next(steps)
        except StopIteration as end:
            found: Document = end.value
            return found


def evening(document: Document, size: float | str | None = None) -> Generator[int, None, Document]:
    """The same, step by step: yields how many contours are odd that nothing was tried for yet."""
    shared, sizes = sized(document, size)
    tried: set[str] = set()
    while odd := [plate.id for plate in shared.frame.plates if plate.id not in tried and _odd(shared, sizes, plate)]:
        yield len(odd)
        tried.add(odd[0])
        changed, best = document, remedy(document, odd[0], size)
        if best is not None and best.odd < 0:
            document = remedied(document, best)
            shared, _ = sized(document, size)
            continue
        for one, other in pairwise(_way(shared, sizes, shared.numbers[odd[0]])):
            change = _change(*sized(changed, size), one, other)
            changed = changed if change is None else remedied(changed, change)
        after, _ = sized(changed, size)
        if _odd_count(after, sizes) < _odd_count(shared, sizes):
            document, shared = changed, after
    return document


def _odd(shared: Neighbours, sizes: list[float], plate: Plate) -> bool:
    return is_odd(shared, sizes, shared.numbers[plate.id])


def _odd_count(shared: Neighbours, sizes: list[float]) -> int:
    return sum(is_odd(shared, sizes, plate) for plate in range(len(shared.frame.plates)))


def _change(shared: Neighbours, sizes: list[float], one: int, other: int) -> Remedy | None:
    """The change that suits best of those that turn two plates, or one of them alone, between odd and even."""
    wanted = {one, other} - {_OUTSIDE}
    found = [(misfit, change) for flipped, misfit, change in changes(shared, sizes, one) if flipped == wanted]
    return min(found, key=lambda item: item[0])[1] if found else None


def _way(shared: Neighbours, sizes: list[float], start: int) -> list[int]:
    """Plates from an odd one over common edges to the next odd one, or to nowhere by an edge that one has alone."""
    before = {start: start}
    waiting = deque([start])
    while waiting:
        plate = waiting.popleft()
        if plate == _OUTSIDE or (plate != start and is_odd(shared, sizes, plate)):
            way = [plate]
            while way[-1] != start:
                way.append(before[way[-1]])
            return way[::-1]
        steps = [flipped for flipped, _, _ in changes(shared, sizes, plate) if len(flipped) < 3]
        for step in sorted({min(flipped - {plate}, default=_OUTSIDE) for flipped in steps}, reverse=True):
            if step not in before:
                before[step] = plate
                waiting.append(step)
    return [start]
