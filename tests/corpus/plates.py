"""Two thousand random plates: stars, combs, plates with holes and slots, graded edges; each from its own number.

Beyond them are narrow ones: rings, bent strips, stars with holes side by side, slits, nowhere or everywhere as narrow
as is allowed.

Ligaments are at least a tenth of the element size and corners at least 20 degrees. Everything is in elements of
length one, then brought to millimetres, turned and moved. As many have lines that elements follow: across the plate,
from the contour inwards, or inside, crossing each other; what is true of ligaments and corners is true with lines, too.
"""

import numpy as np
import shapely

from hullquad.plate import Plate
from hullquad.triangulation.contour import Contour
from hullquad.triangulation.following import with_lines

LIGAMENT = 0.1
SHARPEST = np.radians(20)
SIZE = 100.0
COUNT = 2000
"""The whole corpus."""
_TRIES = 40
"""Lines that are tried for a plate."""


def plate_contour(number: int, template: Plate) -> Contour:
    """Contour of the plate of a number; `template` gives what a contour needs of a plate beside its nodes."""
    rng = np.random.default_rng(number)
    while True:
        rings = (_KINDS if number < COUNT else _NARROW_KINDS)[number % len(_KINDS)](rng)
        divided = [_divided(ring, rng) for ring in rings]
        if _is_sound(divided):
            return _placed(divided, template, rng)


def lined_contour(number: int, template: Plate) -> Contour:
    """The same plate with lines that elements follow."""
    contour = plate_contour(number, template)
    rng = np.random.default_rng([number, 1])
    lines, found = [], contour
    for _ in range(_TRIES):
        tried = [*lines, _line(contour, rng)]
        wished = with_lines(contour, np.array(tried))
        if _is_clear(wished):
            lines, found = tried, wished
        if len(lines) == 1 + number // len(_KINDS) % 6:
            break
    return found


def _line(contour, rng):
    """Ends of a line inside: nodes of the contour, or points anywhere."""
    rim, (low, high) = contour.nodes, (contour.nodes.min(axis=0), contour.nodes.max(axis=0))
    while True:
        ends = [rim[rng.integers(len(rim))] if rng.random() < 0.7 else rng.uniform(low, high) for _ in range(2)]
        line = shapely.LineString(ends)
        if line.length > SIZE and contour.region.buffer(1e-6).covers(line):
            return np.array(ends)


def _is_clear(contour):
    """Whether lines are followed as a whole, and neither nodes nor corners force worse elements than the contour."""
    around = contour.sides
    if contour.followed.count < len(contour.lines) or around.angles.min() < SHARPEST:
        return False
    ends = around.ends[: around.contour + around.lines]
    away = shapely.distance(shapely.points(contour.nodes)[:, None], shapely.linestrings(contour.nodes[ends])[None])
    away[ends.T, np.arange(len(ends))] = np.inf
    return bool(contour.followed.count) and away.min() >= LIGAMENT * SIZE


def _star(rng):
    count = rng.integers(3, 12)
    angles = np.sort(rng.uniform(0, 2 * np.pi, count))
    radii = rng.uniform(1.5, 8, count)
    return [np.stack([radii * np.cos(angles), radii * np.sin(angles)], axis=1)]


def _comb(rng):
    teeth, width, gap = rng.integers(2, 6), rng.uniform(0.8, 3), rng.uniform(0.4, 2)
    depth, back = rng.uniform(1, 5), rng.uniform(0.8, 4)
    ring = [(0.0, 0.0), ((width + gap) * teeth - gap, 0.0)]
    for tooth in reversed(range(teeth)):
        left = (width + gap) * tooth
        ring += [(left + width, back + depth), (left, back + depth)]
        if tooth:
            ring += [(left, back), (left - gap, back)]
    return [np.array(ring)]


def _box(rng):
    width, height = rng.uniform(3, 14, 2)
    return np.array([(0, 0), (width, 0), (width, height), (0, height)], dtype=float)


def _holes(rng):
    outer = _box(rng)
    rings = [outer]
    for _ in range(rng.integers(1, 5)):
        centre, radius, corners = rng.uniform(0, 1, 2) * outer[2], rng.uniform(0.3, 2), rng.integers(3, 10)
        turn = rng.uniform(0, np.pi) - np.arange(corners) * 2 * np.pi / corners
        rings.append(centre + radius * np.stack([np.cos(turn), np.sin(turn)], axis=1))
    return rings


def _slots(rng):
    outer = _box(rng)
    (width, height), rows = outer[2], [outer[0]]
    x = rng.uniform(0.5, 2)
    while x + 1.0 < width:
        gap, depth = rng.uniform(0.15, 0.6), rng.uniform(0.3, 0.6) * height
        rows += [(x, 0.0), (x, depth), (x + gap, depth), (x + gap, 0.0)]
        x += gap + rng.uniform(0.6, 3)
    return [np.array([*rows, *outer[1:]])]


def _graded(rng):
    return [_box(rng) + rng.uniform(-0.7, 0.7, (4, 2))]


def _ring(rng):
    """A narrow ring of two polygons, seldom with the same number of corners."""
    outer, inner = rng.integers(5, 24, 2) if rng.random() < 0.7 else np.full(2, rng.integers(5, 24))
    radius = rng.uniform(1.5, 4)
    within = radius * np.cos(np.pi / outer) - rng.uniform(0.1, 0.4)
    return [_polygon(radius, outer, 0.0), _polygon(within, inner, rng.uniform(0, 1))]


def _polygon(radius, corners, turn):
    angles = turn + np.arange(corners) * 2 * np.pi / corners
    return radius * np.stack([np.cos(angles), np.sin(angles)], axis=1)


def _strip(rng):
    """A bent strip."""
    bends = rng.integers(2, 6)
    x, y = np.cumsum(rng.uniform(1.5, 5, bends)), np.where(np.arange(bends) % 2, rng.uniform(0.5, 3, bends), 0)
    line = shapely.LineString(np.stack([x, y], axis=1))
    width = rng.uniform(0.1, 0.2) if rng.random() < 0.5 else rng.uniform(0.2, 1)
    return _rings(line.buffer(width / 2, cap_style="flat", join_style="mitre", mitre_limit=8))


def _bored(rng):
    """A star with holes beside one another."""
    rings = _star(rng)
    while not shapely.is_valid(shapely.Polygon(rings[0])):
        rings = _star(rng)
    star = shapely.Polygon(rings[0])
    for _ in range(20):
        hole = rng.uniform(-4, 4, 2) + _polygon(rng.uniform(0.2, 1.2), rng.integers(3, 12), rng.uniform(0, 1))
        near, at = shapely.get_coordinates(shapely.shortest_line(star.boundary, shapely.LinearRing(hole)))
        away = np.hypot(*(at - near))
        moved = shapely.Polygon(hole + (near - at) * (1 - 0.11 / away)) if away else star
        if shapely.contains_properly(star, moved) and star.boundary.distance(moved) > LIGAMENT:
            star = star.difference(moved)
    return _rings(star)


def _slits(rng):
    """Slots of a tenth, from the sides inwards and inside."""
    width, height = rng.uniform(2, 8, 2)
    plate = shapely.box(0, 0, width, height)
    for _ in range(rng.integers(2, 7)):
        x, y, length = rng.uniform(0, width), rng.uniform(-1, height), rng.uniform(0.4, 0.8) * height
        slit = shapely.box(x, y, x + 0.1 + rng.integers(2) * rng.uniform(0, 0.2), y + length)
        cut = plate.difference(slit)
        if cut.geom_type == "Polygon" and _is_sound(_rings(cut)):
            plate = cut
    return _rings(plate)


def _rings(polygon):
    return [shapely.get_coordinates(ring)[:-1] for ring in (polygon.exterior, *polygon.interiors)]


def _unlike(rng):
    """A bar whose long sides have very different numbers of segments."""
    length, width = rng.integers(2, 9), rng.uniform(0.1, 0.6)
    above = np.linspace(length, 0, rng.integers(2, 3 * length + 1))
    return [np.concatenate([[(0.0, 0.0), (length, 0.0)], np.stack([above, np.full(len(above), width)], axis=1)])]


_KINDS = (_star, _comb, _holes, _slots, _graded)
_NARROW_KINDS = (_ring, _strip, _bored, _slits, _unlike)


def _divided(ring, rng):
    """Edges in segments of about one, on one edge of three graded by up to one in six."""
    rows = []
    for start, end in zip(ring, np.roll(ring, -1, axis=0), strict=True):
        count = max(1, round(np.hypot(*(end - start)) * rng.uniform(0.8, 1.25)))
        stations = np.arange(count) / count
        if rng.random() < 1 / 3 and count > 2:
            stations = stations ** rng.uniform(1, 1.7)
        rows.append(start + stations[:, None] * (end - start))
    return np.concatenate(rows)


def _is_sound(rings):
    outer, *holes = rings
    polygon = shapely.Polygon(outer, holes)
    if (
        not polygon.is_valid
        or polygon.area < 2
        or not all(shapely.Polygon(outer).contains(shapely.Polygon(h)) for h in holes)
    ):
        return False
    lines = [shapely.LinearRing(ring) for ring in rings]
    apart = all(one.distance(other) >= LIGAMENT for i, one in enumerate(lines) for other in lines[:i])
    return apart and all(_is_open(ring) for ring in rings)


def _is_open(ring):
    """Whether a ring keeps away from itself and has no sharp corner."""
    back, ahead = np.roll(ring, 1, axis=0) - ring, np.roll(ring, -1, axis=0) - ring
    angles = np.arctan2(ahead[:, 0] * back[:, 1] - ahead[:, 1] * back[:, 0], (ahead * back).sum(axis=1)) % (2 * np.pi)
    if min(angles.min(), (2 * np.pi - angles).min()) < SHARPEST or np.hypot(*ahead.T).min() < LIGAMENT:
        return False
    ends = np.stack([ring, np.roll(ring, -1, axis=0)], axis=1)
    away = shapely.distance(shapely.points(ring)[:, None], shapely.linestrings(ends)[None])
    index = np.arange(len(ring))
    away[index, index] = away[index, index - 1] = np.inf
    return bool(away.min() >= LIGAMENT)


def _placed(rings, template, rng):
    turn = rng.uniform(0, 2 * np.pi)
    axes = np.array([[np.cos(turn), np.sin(turn)], [-np.sin(turn), np.cos(turn)]])
    shift = rng.uniform(-1e4, 1e4, 2)
    turned = [_run(ring, is_hole=i > 0) @ axes * SIZE + shift for i, ring in enumerate(rings)]
    starts = np.cumsum([0, *map(len, turned)])
    return Contour(plate=template, size=SIZE, nodes=np.concatenate(turned), loop_starts=starts)


def _run(ring, *, is_hole):
    """The ring counter-clockwise, or clockwise of a hole."""
    return ring if shapely.LinearRing(ring).is_ccw != is_hole else ring[::-1]
