"""The same contours meshed by Gmsh: the nodes of the contour are fixed, and nothing is added between them."""

import time
from itertools import pairwise

import gmsh
import numpy as np

from hullquad.mesh import Mesh
from hullquad.topology import NodeState, topology

ROWS = {
    "Frontal-Delaunay for quads + Blossom": 8,
    "Frontal-Delaunay + Blossom": 6,
    "packing of parallelograms": 9,
}


def start():
    gmsh.initialize(interruptible=False)
    for name, value in {"General.Terminal": 0, "General.NumThreads": 1, "Mesh.RecombineAll": 1}.items():
        gmsh.option.setNumber(name, value)


def mesh_by_gmsh(contour, algorithm):
    """Mesh of a contour, and the seconds that it took."""
    gmsh.clear()
    gmsh.option.setNumber("Mesh.Algorithm", algorithm)
    gmsh.option.setNumber("Mesh.RecombinationAlgorithm", 1)
    gmsh.option.setNumber("Mesh.MeshSizeMax", contour.size)
    _describe(contour)
    began = time.perf_counter()
    gmsh.model.mesh.generate(2)
    return _mesh(contour), time.perf_counter() - began


def _describe(contour):
    lengths = np.hypot(*(contour.nodes[contour.segments[:, 1]] - contour.nodes[contour.segments[:, 0]]).T)
    sizes = np.full(len(contour.nodes), contour.size)
    sizes[: contour.edge_count] = np.bincount(contour.segments.ravel(), np.repeat(lengths, 2) / 2)
    plane = gmsh.model.geo
    for number, ((u, v), size) in enumerate(zip(contour.nodes, sizes, strict=True), 1):
        plane.addPoint(u, v, 0, size, number)
    for number, (start_node, end_node) in enumerate(contour.segments.tolist(), 1):
        plane.addLine(start_node + 1, end_node + 1, number)
        plane.mesh.setTransfiniteCurve(number, 2)
    starts = contour.loop_starts.tolist()
    loops = [plane.addCurveLoop(list(range(a + 1, b + 1))) for a, b in pairwise(starts)]
    surface = plane.addPlaneSurface(loops)
    plane.synchronize()
    inside = list(range(contour.edge_count + 1, len(contour.nodes) + 1))
    if inside:
        gmsh.model.mesh.embed(0, inside, 2, surface)


def _mesh(contour):
    given = len(contour.nodes)
    own = [int(gmsh.model.mesh.getNodes(0, number + 1)[0][0]) for number in range(given)]
    tags, places, _ = gmsh.model.mesh.getNodes()
    known = dict.fromkeys(own) | dict.fromkeys(tags.tolist())
    rows = {tag: row for row, tag in enumerate(known)}
    nodes = np.zeros((len(rows), 2))
    nodes[[rows[tag] for tag in tags.tolist()]] = places.reshape(-1, 3)[:, :2]
    nodes[:given] = contour.nodes
    elements = _elements(nodes, rows)
    states = np.full(len(nodes), NodeState.FREE, dtype=np.int8)
    states[:given] = NodeState.FIXED
    states[: contour.edge_count] = NodeState.CONTOUR
    surface = contour.plate.surface
    points = surface.points(nodes)
    points[:given] = contour.points
    return Mesh(
        points=points,
        topology=topology(elements, states),
        target_size=contour.size,
        surface=surface,
        parameters=nodes,
        input_hash="gmsh",
    )


def _elements(nodes, rows):
    """(E, 4) elements, counter-clockwise as a whole."""
    found = []
    for kind, _, listed in zip(*gmsh.model.mesh.getElements(2), strict=True):
        corners = 4 if kind == 3 else 3
        numbers = np.array([rows[tag] for tag in listed.tolist()], dtype=np.int32).reshape(-1, corners)
        x, y = np.moveaxis(nodes[numbers] - nodes[numbers[:, :1]], 2, 0)
        area = (x * np.roll(y, -1, axis=1) - y * np.roll(x, -1, axis=1)).sum()
        numbers = numbers if area > 0 else numbers[:, ::-1]
        found.append(np.pad(numbers, ((0, 0), (0, 4 - corners)), constant_values=-1))
    return np.concatenate(found)
