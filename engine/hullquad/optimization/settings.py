"""The parameters of the methods: apart from them, so that asking for them loads no compiled kernel."""

from math import inf

import attrs

from hullquad.arrays import Bools


@attrs.frozen(kw_only=True)
class PaperSettings:
    """The parameters of the method."""

    step: float = 0.003
    """c: the step is c times the square of the target size times the gradient."""
    iterations: int = 1000
    """Most iterations."""
    tolerance: float = 1e-6
    """Stop when the best sum has gained less than this per quad over the last `window` iterations."""
    window: int = 100
    """Iterations that the gain is taken over: more than the sum pauses for while it oscillates towards its optimum."""
    guard: bool = True
    """Whether the nodes of an element that a step would make invalid stay where they are in that step.

    Without it the run is the paper's to the letter, and may fold elements: most metrics cannot see that.
    """


@attrs.frozen
class Schedule:
    """How a smooth stand-in comes to its metric."""

    doublings: tuple[int, ...]
    """The exponents, as powers of 2."""
    most: int
    """Iterations at each, at the most."""
    gain: float
    """What an iteration must gain for each quad, on the average of the last five."""


QUICK = Schedule((2, 5, 8, 10), 60, 1e-5)
FINE = Schedule(tuple(range(11)), 200, 1e-7)


@attrs.frozen(kw_only=True, eq=False)
class SearchSettings:
    """The parameters of all other methods."""

    floor: float | None = 0.3
    """Scaled Jacobian that an element is not pushed below for the sake of others; None: the pure objective."""
    schedule: Schedule = QUICK
    iterations: int = 10_000
    """Most iterations."""
    seconds: float = inf
    """Most time."""
    stride: int = 1
    """Iterations from one iterate to the next: 1 to watch each, many to be quick. The way is the same."""
    is_for_quads: bool = False
    """Whether the worst quad is what counts, where triangles would; the floor holds these then."""
    chosen: Bools | None = None
    """(N,) nodes that may move, if not all free ones may."""
