"""Why a run ended, and what to do about it."""

from collections.abc import Sequence

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
    "the last iterations have hardly gained anything",
    "Converged: going on would gain next to nothing. A smaller element size or another metric changes more.",
)
_MOST_NAMED = 12


def still_folded(labels: Sequence[int]) -> Stop:
    """The reason of a run that could not open all elements, with their labels."""
    named = ", ".join(map(str, labels[:_MOST_NAMED])) + (" …" if len(labels) > _MOST_NAMED else "")
    count = "1 element stays" if len(labels) == 1 else f"{len(labels)} elements stay"
    return Stop(
        "folded",
        f"{count} folded, which no move of the free nodes opens: {named}",
        "Their fixed or pinned nodes hold them: change the contour there, free a node, or mesh anew.",
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
