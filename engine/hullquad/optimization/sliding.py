"""Nodes on followed lines of a plane plate: they move along their line, and nowhere else."""

import numpy as np

from hullquad.arrays import Floats
from hullquad.mesh import Mesh


def line_directions(mesh: Mesh) -> Floats:
    """(L, 2) unit vectors along the lines of a mesh on a plane, in its parameters; zero for a line without length."""
    starts, ends = _ends(mesh)
    lengths = np.linalg.norm(ends - starts, axis=1, keepdims=True)
    return np.asarray((ends - starts) / np.where(lengths > 0, lengths, 1.0))


def on_lines(mesh: Mesh, parameters: Floats) -> Floats:
    """Parameters (N, 2) of nodes, those that slide moved along their line only and not beyond its ends.

    They stay as far beside the line as they are in `mesh`: a rounding error.
    """
    known = mesh.topology
    if mesh.parameters is None or not known.slides.any():
        return parameters
    rows = np.flatnonzero(known.slides)
    lines, places = known.node_lines[rows], mesh.parameters[rows]
    (starts, ends), ways = (part[lines] for part in _ends(mesh)), line_directions(mesh)[lines]
    back, ahead, moved = (_along(to - places, ways) for to in (starts, ends, parameters[rows]))
    slid = np.array(parameters)
    slid[rows] = places + np.clip(moved, np.minimum(back, 0.0), np.maximum(ahead, 0.0))[:, None] * ways
    return slid


def along_lines(mesh: Mesh, vectors: Floats) -> Floats:
    """Vectors (N, 2) at the nodes, those of nodes that slide without the part across their line."""
    known = mesh.topology
    if not known.slides.any():
        return vectors
    rows, kept = np.flatnonzero(known.slides), np.array(vectors)
    ways = line_directions(mesh)[known.node_lines[rows]]
    kept[rows] = _along(kept[rows], ways)[:, None] * ways
    return kept


def _along(vectors: Floats, ways: Floats) -> Floats:
    return np.asarray((vectors * ways).sum(axis=1))


def _ends(mesh: Mesh) -> tuple[Floats, Floats]:
    """(L, 2) parameters of both ends of each line."""
    assert mesh.surface is not None  # nodes slide on planes only
    return mesh.surface.parameters(mesh.lines[:, 0]), mesh.surface.parameters(mesh.lines[:, 1])
