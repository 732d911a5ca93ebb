"""What every command loads before it works."""

from hullquad import pipeline
from hullquad.cli.clock import Clock


def load(clock: Clock) -> None:
    """Have the compiled kernels ready, so that their loading is not counted as work."""
    with clock.running("import"):
        import numba  # noqa: F401, PLC0415
    with clock.running("prepare"):
        pipeline.prepare()
