"""Points inside small regions whose corners are too narrow for elements of full size."""

from pathlib import Path

import numpy as np

from hullquad import pipeline
from hullquad.formats import read_plates
from hullquad.quads.insets import inset_points
from hullquad.triangulation.contour import Contour
from hullquad.triangulation.following import with_lines

PLATE = read_plates(Path(__file__).parents[2] / "assets/plates/hopper_partition.json").plates[0]


def box(lines):
    """A box of 8 by 5 elements of 100 mm with lines that are followed."""
    below = np.stack([np.arange(0.0, 800.0, 100.0), np.zeros(8)], axis=1)
    right = np.stack([np.full(5, 800.0), np.arange(0.0, 500.0, 100.0)], axis=1)
    rim = np.concatenate([below, right, [800, 500] - below, [800, 500] - right])
    contour = Contour(plate=PLATE, size=100.0, nodes=rim, loop_starts=[0, len(rim)])
    return with_lines(contour, np.array(lines, dtype=float))


TIP = box([((300, 0), (360, 70)), ((400, 0), (360, 70))])


def test_every_point_lies_in_its_region_and_others_keep_away():
    small = int(np.argmin(np.bincount(TIP.sides.regions)))
    others = np.array([[350.0, 30.0], [100.0, 100.0]])
    points = inset_points(TIP, [small], others, 0.35)
    assert [100.0, 100.0] in points.tolist()
    assert [350.0, 30.0] not in points.tolist()
    inside = points[(points != [100.0, 100.0]).any(axis=1)]
    assert len(inside) >= 3
    assert (inside[:, 1] > 0).all()
    assert (np.abs(inside - [350.0, 35.0]) < [50.0, 35.0]).all()


def test_a_small_region_with_three_sides_needs_no_triangle():
    mesh = pipeline.best_mesh(TIP)
    assert len(mesh.topology.triangles) == TIP.triangles_unavoidable
