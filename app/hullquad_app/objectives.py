"""By which metric is optimised: the one that was chosen for it, else the one that is shown."""

from hullquad.metrics import OBJECTIVES, Metric, metric

INSTEAD = metric("shape")
"""Where the shown metric has no sum that could be made better: it grows with every kind of distortion."""


def optimised_by(shown: Metric, chosen: str | None = None) -> Metric:
    """The objective of the next run."""
    if chosen is not None:
        return metric(chosen)
    return shown if shown in OBJECTIVES else INSTEAD
