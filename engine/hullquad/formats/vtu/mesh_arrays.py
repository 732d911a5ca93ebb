"""What a mesh knows beyond points and elements, as arrays of a VTK file.

============  ===================  =========  ==========================================================
section       name                 columns    content
============  ===================  =========  ==========================================================
PointData     node label           1
PointData     node state           1          0 free, 1 contour, 2 fixed, 3 on a line, 4 pinned
PointData     node line            1          row in ``lines`` that the node slides on, else -1
PointData     parameters           2          place on the plane [mm]; only with ``plane``
CellData      element label        1
FieldData     hullquad version     text       the program that wrote the file
FieldData     plate id             text
FieldData     input hash           text       SHA-256 of the plate document
FieldData     target size          1          [mm]
FieldData     thickness            1          [mm]; not there when it is unknown
FieldData     reference areas      1          of quads and triangles, what sizes are relative to [mm²]; not there
                                              when it is the means of the elements
FieldData     unavoidable          1          triangles that the contour and followed lines ask for; only where lines
              triangles                       are followed
FieldData     plane                3          origin, u and v; not there when the mesh is not flat
FieldData     lines                6          both ends of each stiffener and seam line; not there without
============  ===================  =========  ==========================================================
"""

from typing import NamedTuple
from xml.etree.ElementTree import Element

import attrs
import numpy as np

from hullquad import placement
from hullquad.arrays import Bytes, Floats, Ints
from hullquad.formats import imported
from hullquad.formats.vtu.data_arrays import integers, reals, text
from hullquad.formats.vtu.document import Document, arrays, count
from hullquad.mesh import Mesh
from hullquad.plate import JOIN
from hullquad.surface import Plane
from hullquad.topology import NodeState, Topology

VERSION = "hullquad version"
_SIGNS = {VERSION, "node state", "node line"}
_MOST_LINES = 100_000
_AREAS = "reference areas"
_UNAVOIDABLE = "unavoidable triangles"
_SHARED = 4 * JOIN  # handed on from plate to plate; how far a shared node may be off the plane of one of them
_UNIT = 1e-9  # how far the axes of a plane may be from unit length and from square


class Sections(NamedTuple):
    """The arrays of a grid, by name."""

    nodes: dict[str, Element]
    elements: dict[str, Element]
    whole: dict[str, Element]


def sections(grid: Element, piece: Element) -> Sections:
    """The arrays of a grid and its piece."""
    return Sections(arrays(piece.find("PointData")), arrays(piece.find("CellData")), arrays(grid.find("FieldData")))


def are_ours(found: Sections) -> bool:
    """Whether the file was written by this program, even if something has been taken from it since."""
    return bool(_SIGNS & (found.nodes.keys() | found.elements.keys() | found.whole.keys()))


def mesh(points: Floats, elements: Ints, found: Sections, file: Document) -> Mesh:
    """The mesh as it was when it was written."""
    reader = _Reader(found, file)
    topology = reader.topology(elements, len(points))
    imported.judge(points, elements, topology.node_labels, topology.element_labels, file.place)
    lines = reader.lines()
    reader.check_lines(topology, len(lines))
    plane = reader.plane()
    reader.text(VERSION)
    return Mesh(
        points=points,
        topology=topology,
        target_size=reader.length("target size"),
        surface=plane,
        parameters=None if plane is None else reader.parameters(points, plane, topology.node_states),
        lines=lines,
        reference_areas=reader.areas(),
        unavoidable=reader.unavoidable(len(elements)),
        plate_id=reader.text("plate id"),
        thickness=reader.length("thickness") if "thickness" in found.whole else None,
        input_hash=reader.text("input hash"),
    )


@attrs.frozen
class _Reader:
    found: Sections
    file: Document

    def topology(self, elements: Ints, nodes: int) -> Topology:
        states = integers(self._array(self.found.nodes, "node state"), nodes, self.file)
        self._within("node state", states, min(NodeState), max(NodeState))
        lines = integers(self._array(self.found.nodes, "node line"), nodes, self.file)
        self._within("node line", lines, -1, _MOST_LINES)
        node_labels = integers(self._array(self.found.nodes, "node label"), nodes, self.file)
        element_labels = integers(self._array(self.found.elements, "element label"), len(elements), self.file)
        for name, labels in (("node label", node_labels), ("element label", element_labels)):
            values, counts = np.unique(labels, return_counts=True)
            if (counts > 1).any():
                raise self.file.refusal("label", name=name, found=values[counts > 1][0])
        return Topology(
            elements=elements,
            node_labels=node_labels,
            element_labels=element_labels,
            node_states=states,
            node_lines=lines,
        )

    def lines(self) -> Floats:
        if "lines" not in self.found.whole:
            return np.empty((0, 2, 3))
        array = self.found.whole["lines"]
        rows = count(array, "NumberOfTuples", self.file)
        lines = self._finite("lines", reals(array, rows, 6, self.file))
        return lines.reshape(rows, 2, 3)

    def check_lines(self, topology: Topology, lines: int) -> None:
        self._within("node line", topology.node_lines, -1, lines - 1)
        lost = np.flatnonzero((topology.node_states == NodeState.ON_LINE) & (topology.node_lines < 0))
        if len(lost):
            raise self.file.refusal("no_line", node=topology.node_labels[lost[0]])

    def plane(self) -> Plane | None:
        if "plane" not in self.found.whole:
            return None
        origin, u, v = self._finite("plane", reals(self.found.whole["plane"], 3, 3, self.file))
        if np.abs([u @ u - 1.0, v @ v - 1.0, u @ v]).max() > _UNIT:
            raise self.file.refusal("axes")
        return Plane(origin=origin, u=u, v=v)

    def parameters(self, points: Floats, plane: Plane, states: Bytes) -> Floats:
        """(N, 2) places on the plane, where the points must be: a file moved elsewhere would spring back.

        Nodes that are shared with other plates may be off it, for they are where those have them.
        """
        array = self._array(self.found.nodes, "parameters")
        parameters = self._finite("parameters", reals(array, len(points), 2, self.file))
        away = np.linalg.norm(plane.points(parameters) - points, axis=1)
        is_shared = np.isin(states, (NodeState.CONTOUR, NodeState.FIXED, NodeState.ON_LINE))
        least = 10.0 * placement.FLATNESS * placement.diameter(points)
        if (away > np.where(is_shared, max(least, _SHARED), least)).any():
            raise self.file.refusal("moved", away=away.max())
        return parameters

    def length(self, name: str) -> float:
        value = float(reals(self._array(self.found.whole, name), 1, 1, self.file)[0, 0])
        if not 0.0 < value <= imported.FARTHEST:
            raise self.file.refusal("length_value", name=name, found=value)
        return value

    def areas(self) -> Floats | None:
        if _AREAS not in self.found.whole:
            return None
        areas = self._finite(_AREAS, reals(self.found.whole[_AREAS], 2, 1, self.file)).ravel()
        if (areas < 0.0).any():
            raise self.file.refusal("length_value", name=_AREAS, found=areas.min())
        return areas

    def unavoidable(self, elements: int) -> int | None:
        if _UNAVOIDABLE not in self.found.whole:
            return None
        counts = integers(self.found.whole[_UNAVOIDABLE], 1, self.file)
        self._within(_UNAVOIDABLE, counts, 0, elements)
        return int(counts[0])

    def text(self, name: str) -> str:
        return text(self._array(self.found.whole, name), self.file)

    def _array(self, section: dict[str, Element], name: str) -> Element:
        if name not in section:
            raise self.file.refusal("no_own_array", name=name)
        return section[name]

    def _finite(self, name: str, values: Floats) -> Floats:
        if not (np.abs(values) <= imported.FARTHEST).all():
            raise self.file.refusal("not_finite", name=name)
        return values

    def _within(self, name: str, values: np.ndarray, least: int, most: int) -> None:
        wrong = values[(values < least) | (values > most)]
        if len(wrong):
            raise self.file.refusal("range", name=name, found=wrong[0], least=least, most=most)
