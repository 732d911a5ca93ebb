"""What meshes cost beside one another."""

import numpy as np

from hullquad.quads.cost import price
from hullquad.quads.energy import INVALID, MOST
from hullquad.quads.settings import Preference


def test_avoidable_triangles_cost_more_than_the_thinnest_quads_and_less_than_invalid_elements():
    thinnest = price(np.full(5, MOST), 0, 1.0, Preference.QUADS)
    triangles = price(np.zeros(5), 2, 1.0, Preference.QUADS)
    invalid = price(np.array([0.0, 0.0, 0.0, 0.0, INVALID]), 0, 1.0, Preference.QUADS)
    assert thinnest < triangles < invalid
