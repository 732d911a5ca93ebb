"""How the elements of a scene look: by the chosen metric, or by the worst rule that they break."""

import attrs
import numpy as np

from hullquad.arrays import Bools, Bytes, Longs
from hullquad.quality import Quality
from hullquad_app.colours import ColourMap, Colours, element_colours
from hullquad_app.hatching import pens_on
from hullquad_app.level_colours import LEVELS, level_colours
from hullquad_app.scene import Scene
from hullquad_app.verdict import Verdict

_DARKEST = -0.7
"""Grade below which an element is as dark as the outline of failing ones."""


@attrs.frozen(eq=False, kw_only=True)
class Painting:
    """Colours and marks of every element."""

    colours: Colours
    """(E, 3)"""
    inverted: Bools
    """(E,) drawn over the others."""
    outlined: Bools
    """(E,) fails; inverted ones have a colour of their own."""
    dark: Bools
    """(E,) as dark as the outline of failing ones."""
    hatched: Bools
    """(E,) fails, and is given by the contour."""

    def hatch_colours(self, rows: Longs) -> Colours:
        """(H, 3) colour of lines that are seen on the elements of these rows."""
        return pens_on(self.colours[rows])


def painting(scene: Scene, chosen: ColourMap) -> Painting | None:
    """How the elements of a scene look; None where there are none."""
    if scene.quality is None or scene.verdict is None:
        return None
    if scene.assessment is None:
        return _by_metric(scene.quality, scene.verdict, chosen)
    return _by_rules(scene.quality, scene.assessment.levels, scene.assessment.given)


def _by_metric(quality: Quality, verdict: Verdict, chosen: ColourMap) -> Painting:
    outlined = quality.failing & quality.valid
    return Painting(
        colours=element_colours(quality, chosen),
        inverted=~quality.valid,
        outlined=outlined,
        dark=quality.grades < _DARKEST,
        hatched=verdict.given,
    )


def _by_rules(quality: Quality, levels: Bytes, given: Bools) -> Painting:
    return Painting(
        colours=level_colours(levels, quality.valid),
        inverted=~quality.valid,
        outlined=(levels == len(LEVELS) - 1) & quality.valid,
        dark=np.zeros_like(given),
        hatched=given,
    )
