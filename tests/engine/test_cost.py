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


def test_an_element_that_cannot_be_mended_does_not_outweigh_all_others():
    one_hopeless, all_poor = np.zeros(100), np.full(100, 2.0)
    one_hopeless[0] = all_poor[0] = 1e5
    assert price(one_hopeless, 0, 100.0, Preference.QUADS) < price(all_poor, 0, 100.0, Preference.QUADS) - 1.0
    worse = np.where(one_hopeless > 0, 2e5, 0.0)
    assert price(worse, 0, 100.0, Preference.QUADS) == price(one_hopeless, 0, 100.0, Preference.QUADS)
