"""How the user wants the nodes to be moved: an optimiser with its options, remembered from day to day."""

import attrs

FLOORS = (0.3, 0.6, None)
"""Scaled Jacobians that no element is to be pushed below for the sake of others; None: the sum alone counts."""
MOST_ITERATIONS = 1_000_000
MOST_SECONDS = 86_400
MOST_RINGS = 99


@attrs.frozen(kw_only=True)
class Search:
    """What is chosen in the search settings, but the metric and the parameters of the paper's method."""

    optimizer: str = "default"
    """Key of a row of `optimizers.OPTIMIZERS`."""
    floor: float | None = FLOORS[0]
    iterations: int = 10_000
    """Most iterations of a run."""
    seconds: int = 0
    """Most time of a run, pauses not counted; 0: as long as it takes [s]."""
    is_local: bool = False
    """Whether only the selected elements are optimised, and `rings` of elements around them."""
    rings: int = 2
