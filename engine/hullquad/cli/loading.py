"""What every command loads before it works."""

from collections.abc import Callable

from hullquad.cli.clock import Clock
from hullquad.cli.interrupt import ending_at_once
from hullquad.cli.output import activity


def load(clock: Clock, *prepare: Callable[[], None]) -> None:
    """Have the compiled kernels of some work ready, so that their loading is not counted as work.

    Nothing is written meanwhile, and Ctrl+C ends it at once: the compiler's callbacks would swallow it.
    """
    with ending_at_once(), activity("preparing; the first time, what is computed has to be compiled"):
        with clock.running("import"):
            import numba  # noqa: F401, PLC0415
        with clock.running("prepare"):
            for part in prepare:
                part()
