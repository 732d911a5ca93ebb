"""Lines that are drawn at the scale of the picture: dashes along stiffeners, hatching over elements."""

import numpy as np

from hullquad.arrays import Floats, Ints, Longs, floats

_DASH, _GAP = 9.0, 5.0
"""Of stiffeners and seams [pixels]."""
_SPACING = 7.0
"""Between the lines of a hatching [pixels]."""
_MOST = 20_000
"""Lines that a picture has room for."""


def dashes(lines: Floats, pixel: float) -> Floats:
    """(D, 2, 3) dashes of lines (L, 2, 3), from end to end; the lines themselves where there would be too many."""
    lengths = np.linalg.norm(lines[:, 1] - lines[:, 0], axis=1) / pixel
    counts = np.maximum(1, np.rint((lengths + _GAP) / (_DASH + _GAP))).astype(int)
    if counts.sum() > _MOST:
        return lines
    first = np.arange(counts.sum()) - np.repeat(np.cumsum(counts) - counts, counts)
    line, period = np.repeat(np.arange(len(lines)), counts), np.repeat((lengths + _GAP) / counts, counts)
    along = np.stack([first * period, (first + 1) * period - _GAP], axis=1) / lengths[line, None]
    starts, ends = lines[line, :1], lines[line, 1:]
    return floats(starts + along[:, :, None] * (ends - starts))


def hatching(points: Floats, elements: Ints, pixel: float) -> tuple[Floats, Longs]:
    """(H, 2, 3) lines over elements (V, 4) along one of their diagonals, and (H,) the row of the element of each.

    None where there would be too many.
    """
    tips, lefts, rights, owners = _halves(points, elements)
    heights = np.linalg.norm((lefts + rights) / 2 - tips, axis=1)
    counts = np.rint(heights / (_SPACING * pixel)).astype(int)
    if counts.sum() > _MOST:
        counts = np.zeros_like(counts)
    half = np.repeat(np.arange(len(counts)), counts)
    along = np.arange(counts.sum()) - np.repeat(np.cumsum(counts) - counts, counts)
    share = ((along + 0.5) / np.maximum(counts[half], 1))[:, None]
    starts, ends = (tips[half] + share * (side[half] - tips[half]) for side in (lefts, rights))
    return floats(np.stack([starts, ends], axis=1)), owners[half]


def _halves(points: Floats, elements: Ints) -> tuple[Floats, Floats, Floats, Longs]:
    """Quads as two triangles each, triangles as one: (T, 3) tips, both ends of the sides opposite, (T,) rows."""
    is_quad = elements[:, 3] >= 0
    rows = np.arange(len(elements))
    second = np.where(is_quad, elements[:, 3], elements[:, 2])
    nodes = np.concatenate(
        [np.stack([elements[:, 0], elements[:, 1], second], axis=1), elements[is_quad][:, [2, 1, 3]]]
    )
    tips, lefts, rights = (points[nodes[:, column]] for column in range(3))
    return tips, lefts, rights, np.concatenate([rows, rows[is_quad]])
