"""Why a run ended, and what to do about it."""

import attrs


@attrs.frozen
class Stop:
    """A reason to stop, with advice."""

    name: str
    reason: str
    advice: str


NO_FREE_NODES = Stop(
    "no_free_nodes",
    "every node is given by the plate",
    "A smaller element size gives nodes that can be moved.",
)
NO_QUADS = Stop(
    "no_quads",
    "the mesh has only triangles, and the objective sums quads",
    "Join the triangles to quads first.",
)
GRADIENT = Stop(
    "gradient",
    "the gradient is zero: the sum is at an optimum or a saddle",
    "Nothing is left to do for this metric.",
)
GAIN = Stop(
    "gain",
    "the best sum has hardly grown over the last iterations",
    "Converged: going on would gain next to nothing. A smaller element size or another metric changes more.",
)
TIME = Stop(
    "time",
    "the time that was given is used up",
    "Run again from here, or allow more time, while the mesh still gets better.",
)
NO_GAIN = Stop(
    "no_gain",
    "nothing that was tried is better than the mesh as it was",
    "The mesh is left as it is. Another metric or a smaller element size changes more.",
)
ITERATIONS = Stop(
    "iterations",
    "the number of iterations that was asked for is done",
    "Run again from here, or allow more iterations, while the sum still grows.",
)
