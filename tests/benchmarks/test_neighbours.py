"""Dividing a block of a thousand plates: finding what they have in common, and every further size."""

import numpy as np

from hullquad.curves import Straight
from hullquad.plate import Document, Line, Plate, Sizes, closed_loop
from hullquad.surface import Plane
from hullquad.triangulation.contour import attempts
from hullquad.triangulation.neighbours import neighbours

X, Y, Z = np.eye(3)


def rectangle(number, origin, axes, width, height):
    corners = [(0, 0), (width, 0), (width, height), (0, height)]
    edges = [Straight(*ends) for ends in zip(corners, [*corners[1:], corners[0]], strict=True)]
    levels = np.arange(800, height, 800)
    return Plate(
        id=f"P{number}",
        thickness=10,
        material="A",
        surface=Plane(origin, *axes),
        outer=closed_loop(edges, f"/plates/{number}/outer", is_hole=False),
        stiffeners=tuple(Line((0, v), (width, v), f"/plates/{number}/stiffeners/{i}") for i, v in enumerate(levels)),
        target_size=800,
        sizes=Sizes.of(800),
        place=f"/plates/{number}",
    )


def block(count):
    """Document of decks, bulkheads and frames between `count` cubed cells."""
    sheets = (((X, Y), 4800, 3000), ((X, Z), 4800, 2400), ((Y, Z), 3000, 2400))
    cells = np.stack(np.meshgrid(*[np.arange(count)] * 3), axis=-1).reshape(-1, 3)
    found = [(cell * (4800, 3000, 2400), *sheet) for cell in cells for sheet in sheets]
    plates = tuple(rectangle(number, *row) for number, row in enumerate(found))
    return Document(name="block", materials={}, plates=plates)


def test_a_thousand_plates_are_divided(benchmark):
    described = block(7)

    def divided():
        neighbours.cache_clear()
        return attempts(described, "coarse")

    assert len(benchmark.pedantic(divided, rounds=3, warmup_rounds=1)) == 1029


def test_a_thousand_plates_are_divided_by_a_further_size(benchmark):
    described = block(7)
    assert len(benchmark.pedantic(attempts, args=(described, "fine"), rounds=3, warmup_rounds=1)) == 1029
