"""Colours of what rules say of an element: kept, warned of, broken; told apart by every kind of eye."""

import numpy as np

from hullquad.arrays import Bools, Bytes
from hullquad_app.colours import INVERTED, Colours, rgb

LEVELS = ("#ADCDE1", "#FFD166", "#B2182B")
"""By `hullquad.rules.Level`: OK, WARN, ERROR. Any two differ by a dE of 40 at least, also for protan, deutan and
tritan eyes."""

_TABLE = np.array([*map(rgb, LEVELS), rgb(INVERTED)], dtype=np.uint8)


def level_colours(levels: Bytes, valid: Bools) -> Colours:
    """(E, 3) colour of each element by its worst level."""
    return _TABLE[np.where(valid, levels, len(LEVELS))]
