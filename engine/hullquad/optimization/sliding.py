"""Nodes on followed lines of a plane plate: they move along their line, and nowhere else."""

import numpy as np

from hullquad.arrays import Floats, Longs
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
    places, ways = mesh.parameters[rows], line_directions(mesh)[known.node_lines[rows]]
    back, ahead = ends_of(mesh, rows).swapaxes(0, 1)
    moved = np.clip(*(_along(to - places, ways) for to in (parameters[rows], back, ahead)))
    slid = np.array(parameters)
    slid[rows] = places + moved[:, None] * ways
    return slid


def ends_of(mesh: Mesh, rows: Longs) -> Floats:
    """(S, 2, 2) parameters of the ends between which sliding nodes stay: their line's, beside it as they are.

    A node that is beyond an end, by a rounding error, is its own end.
    """
    assert mesh.parameters is not None  # nodes slide on planes only
    lines, places = mesh.topology.node_lines[rows], mesh.parameters[rows]
    (starts, ends), ways = (part[lines] for part in _ends(mesh)), line_directions(mesh)[lines]
    reach = np.minimum(_along(starts - places, ways), 0.0), np.maximum(_along(ends - places, ways), 0.0)
    return np.stack([places + part[:, None] * ways for part in reach], axis=1)


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
