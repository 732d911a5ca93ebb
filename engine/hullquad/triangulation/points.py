"""Interior points in line with the contour: from every node on to the next ones along the four arms of the cross.

The queue begins with the nodes of the contour, so that the points come in layers from all sides. A point is taken
where no other one is nearer than `SPACING` of the local size, measured along the two arms (the greater of the two
distances), and no segment nearer than `CLEARANCE` of it. Where opposite sides of the contour agree the result is a
grid; where layers meet that do not, there is a seam of irregular nodes between them.
"""

from math import atan2, cos, floor, hypot, inf, pi, sin

import numpy as np

from hullquad.arrays import Floats, Longs, floats, longs
from hullquad.metrics.compiled import called, uncounted, woven
from hullquad.triangulation.field import Field
from hullquad.triangulation.sizes import MOST_ELEMENTS

SPACING = 0.75
CLEARANCE = 0.45

_CELL = 0.5
"""Width of the cells of the search grid over the element size."""
_VAGUE = 0.05
"""Length of a cross below which it tells no direction."""

Local = tuple[float, float, float, float, float, float]
"""Angle of the cross and its length; m1, m2, m3 of the size; the most that fine seeds allow."""


def aligned_points(given: Floats, segments: Longs, guide: Field, size: float, spacing: float = SPACING) -> Floats:
    """(P, 2) points inside a plate, beside those that are given [mm].

    Parameters
    ----------
    given : (K, 2) float array
        Nodes of the contour and fixed ones inside [mm].
    segments : (E, 2) int array
        Nodes of the contour's segments.
    guide : Field
    size : float
        Element size [mm].
    spacing : float
        Distance that points keep, over the local size.
    """
    cell = _CELL * size
    low = given.min(axis=0) - 2 * cell
    across, up = (int(n) for n in np.ceil((given.max(axis=0) + 2 * cell - low) / cell))
    room = _most_points(guide, len(given))
    nodes = np.zeros((room, 2))
    nodes[: len(given)] = given
    ends = given[segments]
    heads, links = np.full(across * up, -1), np.full(room, -1)
    cells = _cells_of(ends, low, cell, across)
    count = _place(
        nodes,
        len(given),
        guide.nodes,
        guide.triangles,
        guide.neighbours,
        guide.values,
        floats(ends.reshape(-1, 4)),
        longs(cells),
        longs(np.searchsorted(cells[:, 0], np.arange(across * up + 1))),
        heads,
        links,
        np.full(room, -1),
        guide.seeds,
        floats([low[0], low[1], cell, across, up, spacing, CLEARANCE, guide.grading]),
    )
    return floats(nodes[len(given) : count])


def _most_points(guide: Field, given: int) -> int:
    """Room that is enough for any way to place the points, as far as memory is concerned: more are not placed."""
    corners = guide.nodes[guide.triangles]
    u, w = corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]
    areas = 0.5 * (u[:, 0] * w[:, 1] - u[:, 1] * w[:, 0])
    m1, m2, m3 = guide.values[guide.triangles, 2:].mean(axis=1).T
    least = np.maximum(m1**2 - m2**2 - m3**2, 0.01 * m1**2)
    return int(min(1024 + given * 64 + 4 * (areas / least).sum(), 2 * MOST_ELEMENTS))


def _cells_of(segments: Floats, low: Floats, cell: float, across: int) -> Longs:
    """(K, 2) cells that segments pass, in order, and the segment."""
    lengths = np.hypot(*(segments[:, 1] - segments[:, 0]).T)
    steps = np.ceil(2 * lengths / cell).astype(int) + 1
    rows = np.repeat(np.arange(len(segments)), steps)
    share = (np.arange(len(rows)) - np.repeat(np.cumsum(steps) - steps, steps)) / np.repeat(steps - 1, steps)
    at = segments[rows, 0] + share[:, None] * (segments[rows, 1] - segments[rows, 0])
    column, row = np.floor((at - low) / cell).astype(np.int64).T
    return np.unique(np.stack([row * across + column, rows], axis=1), axis=0)


@called
def _side(ax: float, ay: float, bx: float, by: float, x: float, y: float) -> float:
    return (bx - ax) * (y - ay) - (by - ay) * (x - ax)


@called
def _located(nodes: Floats, triangles: Longs, neighbours: Longs, start: int, x: float, y: float) -> int:
    """Triangle that a point lies in, going there from another one; -1 where the way leaves the plate."""
    here, before = start, -1
    for _ in range(len(triangles) + 3):
        ahead, barred = -1, False
        for i in range(3):
            a, b = triangles[here, i], triangles[here, (i + 1) % 3]
            if _side(nodes[a, 0], nodes[a, 1], nodes[b, 0], nodes[b, 1], x, y) < 0.0:
                if neighbours[here, i] < 0:
                    barred = True
                elif neighbours[here, i] != before:
                    ahead = neighbours[here, i]
        if ahead < 0:
            return -1 if barred else here
        here, before = ahead, here
    return -1


@called
def _local(
    nodes: Floats, triangles: Longs, values: Floats, seeds: Floats, grading: float, triangle: int, x: float, y: float
) -> Local:
    """The field at a point of a triangle, interpolated."""
    most = inf
    for i in range(len(seeds)):
        most = min(most, seeds[i, 2] + grading * hypot(seeds[i, 0] - x, seeds[i, 1] - y))
    a, b, c = triangles[triangle, 0], triangles[triangle, 1], triangles[triangle, 2]
    area = _side(nodes[a, 0], nodes[a, 1], nodes[b, 0], nodes[b, 1], nodes[c, 0], nodes[c, 1])
    at_a = _side(nodes[b, 0], nodes[b, 1], nodes[c, 0], nodes[c, 1], x, y) / area
    at_b = _side(nodes[c, 0], nodes[c, 1], nodes[a, 0], nodes[a, 1], x, y) / area
    at_c = 1.0 - at_a - at_b
    cosine = at_a * values[a, 0] + at_b * values[b, 0] + at_c * values[c, 0]
    sine = at_a * values[a, 1] + at_b * values[b, 1] + at_c * values[c, 1]
    m1 = at_a * values[a, 2] + at_b * values[b, 2] + at_c * values[c, 2]
    m2 = at_a * values[a, 3] + at_b * values[b, 3] + at_c * values[c, 3]
    m3 = at_a * values[a, 4] + at_b * values[b, 4] + at_c * values[c, 4]
    return atan2(sine, cosine) / 4.0, hypot(cosine, sine), m1, m2, m3, most


@called
def _length_along(local: Local, angle: float) -> float:
    """Size in a direction."""
    return min(local[5], local[2] + local[3] * cos(2.0 * angle) + local[4] * sin(2.0 * angle))


@woven
def _turned(angle: float, towards: float) -> float:
    """The arm of a cross nearest to a direction."""
    return angle + 0.5 * pi * floor((towards - angle) / (0.5 * pi) + 0.5)


@woven
def _is_free(nodes: Floats, heads: Longs, links: Longs, grid: Floats, x: float, y: float, local: Local) -> bool:
    """Whether no node is too near to a point."""
    angle, spacing = local[0], grid[5]
    ahead, beside = spacing * _length_along(local, angle), spacing * _length_along(local, angle + 0.5 * pi)
    c, s, reach = cos(angle), sin(angle), hypot(ahead, beside)
    across, up = int(grid[3]), int(grid[4])
    left, right = int((x - reach - grid[0]) / grid[2]), int((x + reach - grid[0]) / grid[2])
    bottom, top = int((y - reach - grid[1]) / grid[2]), int((y + reach - grid[1]) / grid[2])
    for row in range(max(0, bottom), min(up - 1, top) + 1):
        for column in range(max(0, left), min(across - 1, right) + 1):
            node = heads[row * across + column]
            while node >= 0:
                dx, dy = nodes[node, 0] - x, nodes[node, 1] - y
                if abs(c * dx + s * dy) < ahead and abs(c * dy - s * dx) < beside:
                    return False
                node = links[node]
    return True


@woven
def _is_clear(
    segments: Floats, segment_cells: Longs, first: Longs, grid: Floats, x: float, y: float, distance: float
) -> bool:
    """Whether no segment is nearer to a point than a distance."""
    across, up = int(grid[3]), int(grid[4])
    left, right = int((x - distance - grid[0]) / grid[2]), int((x + distance - grid[0]) / grid[2])
    bottom, top = int((y - distance - grid[1]) / grid[2]), int((y + distance - grid[1]) / grid[2])
    for row in range(max(0, bottom), min(up - 1, top) + 1):
        for column in range(max(0, left), min(across - 1, right) + 1):
            cell = row * across + column
            for place in range(first[cell], first[cell + 1]):
                segment = segments[segment_cells[place, 1]]
                ux, uy = segment[2] - segment[0], segment[3] - segment[1]
                share = ((x - segment[0]) * ux + (y - segment[1]) * uy) / (ux * ux + uy * uy)
                share = min(1.0, max(0.0, share))
                if hypot(segment[0] + share * ux - x, segment[1] + share * uy - y) < distance:
                    return False
    return True


@uncounted
def _place(
    nodes: Floats,
    given: int,
    ground: Floats,
    triangles: Longs,
    neighbours: Longs,
    values: Floats,
    segments: Floats,
    segment_cells: Longs,
    first: Longs,
    heads: Longs,
    links: Longs,
    homes: Longs,
    seeds: Floats,
    grid: Floats,
) -> int:
    """Write the points behind the given nodes; the number of all."""
    for triangle in range(len(triangles)):
        for corner in range(3):
            if triangles[triangle, corner] < given:
                homes[triangles[triangle, corner]] = triangle
    across = int(grid[3])
    for node in range(given):
        cell = int((nodes[node, 1] - grid[1]) / grid[2]) * across + int((nodes[node, 0] - grid[0]) / grid[2])
        links[node], heads[cell] = heads[cell], node
    count, node = given, 0
    while node < count:
        x, y, home = nodes[node, 0], nodes[node, 1], homes[node]
        here = _local(ground, triangles, values, seeds, grid[7], home, x, y)
        for arm in range(4):
            if here[1] < _VAGUE or count == len(nodes):
                break
            angle = here[0] + 0.5 * pi * arm
            length = _length_along(here, angle)
            target = _located(ground, triangles, neighbours, home, x + length * cos(angle), y + length * sin(angle))
            if target < 0:
                continue
            there = _local(
                ground, triangles, values, seeds, grid[7], target, x + length * cos(angle), y + length * sin(angle)
            )
            angle = 0.5 * (angle + _turned(there[0], angle))
            length = 0.5 * (length + _length_along(there, angle))
            to_x, to_y = x + length * cos(angle), y + length * sin(angle)
            target = _located(ground, triangles, neighbours, target, to_x, to_y)
            if target < 0:
                continue
            there = _local(ground, triangles, values, seeds, grid[7], target, to_x, to_y)
            near = grid[6] * min(_length_along(there, there[0]), _length_along(there, there[0] + 0.5 * pi))
            if not _is_clear(segments, segment_cells, first, grid, to_x, to_y, near):
                continue
            if not _is_free(nodes, heads, links, grid, to_x, to_y, there):
                continue
            nodes[count, 0], nodes[count, 1], homes[count] = to_x, to_y, target
            cell = int((to_y - grid[1]) / grid[2]) * across + int((to_x - grid[0]) / grid[2])
            links[count], heads[cell] = heads[cell], count
            count += 1
        node += 1
    return count
