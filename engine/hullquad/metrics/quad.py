"""Edges of one quad, for compiled loops of others; metrics are worked out by programs, many elements at once."""

from hullquad.metrics.compiled import inlined
from hullquad.metrics.vectors import Vector, difference

Vectors4 = tuple[Vector, Vector, Vector, Vector]


@inlined
def edges(a: Vector, b: Vector, c: Vector, d: Vector) -> Vectors4:
    """The four edges, each from a node to the next."""
    return difference(b, a), difference(c, b), difference(d, c), difference(a, d)
