"""The best elements so far of every region of a plate: each is judged by itself, and only poor ones are tried again.

A plate without followed lines is one region.
"""

from collections.abc import Iterable

import attrs
import numpy as np

from hullquad.arrays import Floats, Ints, floats, ints
from hullquad.quads.cleanup import POOR
from hullquad.quads.cost import judged, price
from hullquad.quads.making import Task
from hullquad.quads.settings import Preference
from hullquad.quads.stages import compact
from hullquad.triangulation.delaunay import Triangulation
from hullquad.triangulation.divided import Contour

_NOTHING_LEFT = 0.02
"""Cost above the least possible below which a region is not tried again."""

Cutting = tuple[Floats, Ints]
"""Nodes (N, 2) and elements (E, 3 or 4) of a cut plate, or of some of its regions; nodes that are given come first."""


@attrs.frozen(eq=False, kw_only=True)
class _Part:
    """Elements of a region."""

    nodes: Floats = attrs.field(converter=floats)
    """(F, 2) free ones [mm]."""
    elements: Ints = attrs.field(converter=ints)
    """(E, 4) nodes of the cut plate that are given, and then the free ones."""
    energies: Floats = attrs.field(converter=floats)
    """(E,)"""
    is_final: bool
    """Whether it is a grid without a poor element, beside which nothing else is tried."""


class Patchwork:
    """Parts that come together to a mesh."""

    def __init__(self, contour: Contour, task: Task) -> None:
        self._cut, self._task, self._parts = contour.cut, task, dict[int, _Part]()
        around = contour.sides
        start, end = (around.nodes[around.ends] - around.nodes[0]).transpose(1, 0, 2)
        doubled = start[:, 0] * end[:, 1] - start[:, 1] * end[:, 0]
        self._usual = 0.5 * np.bincount(around.regions, doubled) / task.size**2
        self._odd = np.isin(np.arange(len(self._usual)), around.odd)

    @property
    def given(self) -> int:
        """Number of nodes of the cut plate that are given."""
        return self._task.given

    @property
    def cost(self) -> float:
        """Cost of the worst part."""
        return max(self._cost(region) for region in self._parts)

    @property
    def is_whole(self) -> bool:
        """Whether every region has elements."""
        return len(self._parts) == len(self._odd)

    @property
    def open(self) -> list[int]:
        """Regions that have no elements yet, or such as may be bettered."""
        good = self._task.least_cost + _NOTHING_LEFT
        parts = ((region, self._parts.get(region)) for region in range(len(self._odd)))
        return [region for region, part in parts if part is None or not (part.is_final or self._cost(region) < good)]

    @property
    def avoidable(self) -> list[int]:
        """Regions with triangles that could be avoided, where that matters most."""
        if self._task.prefer is not Preference.QUADS:
            return []
        return [region for region, part in sorted(self._parts.items()) if self._avoidable(part.elements, region)]

    def task(self, regions: list[int]) -> Task:
        """What is to be done with some regions."""
        usual, odd = float(self._usual[regions].sum()), int(self._odd[regions].sum())
        return attrs.evolve(self._task, usual=usual, unavoidable=odd)

    def expect(self, found: Triangulation) -> None:
        """Take half of the triangles of each region for the number of elements that is usual there."""
        _, triangles = self._cut.cut(found.nodes, found.triangles)
        self._usual = 0.5 * np.bincount(self._cut.regions(triangles), minlength=len(self._odd))

    def offer(self, nodes: Floats, elements: Ints, *, are_grids: bool = False) -> bool:
        """Keep what is better of a mesh, or of a part of one; whether anything was."""
        regions = self._cut.regions(elements)
        values, any_better = judged(nodes, elements, self.given, settles=self._task.settles), False
        for region in np.unique(regions).tolist():
            own = regions == region
            price_here = self._price(values[own], elements[own], region)
            if region not in self._parts or price_here < self._cost(region):
                is_final = are_grids and bool(values[own].max() < POOR)
                self._parts[region] = self._part(nodes, elements[own], values[own], is_final=is_final)
                any_better = True
        return any_better

    def together(self, regions: Iterable[int] | None = None) -> Cutting:
        """Nodes and elements of all parts, or of those of some regions: quads first."""
        given = self._task.given
        nodes, elements, count = [self._cut.nodes], [np.empty((0, 4), dtype=np.int32)], given
        for region in sorted(self._parts if regions is None else regions):
            part = self._parts[region]
            elements.append(np.where(part.elements >= given, part.elements + (count - given), part.elements))
            nodes.append(part.nodes)
            count += len(part.nodes)
        return compact(np.concatenate(nodes), np.concatenate(elements), given)

    def apart_from(self, regions: list[int]) -> Cutting:
        """Nodes and elements of all regions but some."""
        return self.together(set(self._parts) - set(regions))

    def within(self, regions: list[int], found: Triangulation) -> Cutting:
        """Nodes of the cut plate, and triangles in some regions."""
        nodes, triangles = self._cut.cut(found.nodes, found.triangles)
        chosen = np.isin(self._cut.regions(triangles), regions)
        return nodes, triangles if chosen.all() else ints(triangles[chosen])

    def _cost(self, region: int) -> float:
        return self._price(self._parts[region].energies, self._parts[region].elements, region)

    def _price(self, values: Floats, elements: Ints, region: int) -> float:
        return price(values, self._avoidable(elements, region), float(self._usual[region]), self._task.prefer)

    def _avoidable(self, elements: Ints, region: int) -> int:
        return max(0, int((elements[:, 3] < 0).sum()) - int(self._odd[region]))

    def _part(self, nodes: Floats, elements: Ints, energies: Floats, *, is_final: bool) -> _Part:
        given = self._task.given
        used = np.unique(elements[elements >= given])
        numbers = np.arange(len(nodes) + 1)
        numbers[-1] = -1
        numbers[used] = given + np.arange(len(used))
        return _Part(nodes=nodes[used], elements=numbers[elements], energies=energies, is_final=is_final)
