"""The table of meshers: all plane sample plates, coarse and fine, the same contour nodes for every mesher.

    python tests/benchmarks/meshing.py

Gmsh is in the dependency group `peers`. Each mesh is then optimised by the paper's guarded method with metric shape.
Columns of quality are means over the plates; elements, triangles and seconds are sums. Outside: share of the elements
with an aspect ratio above 3 or an angle beyond 45 to 135 degrees, but for those the contour gives (all nodes fixed, the
bad corner between two contour edges, both extreme edges on the contour), which have a column of their own.
"""

import time
from pathlib import Path

import gmsh_peer
import numpy as np

from hullquad import pipeline
from hullquad.formats import read_plates
from hullquad.metrics import metric
from hullquad.metrics.values import judged_values
from hullquad.optimization.iterate import outcome
from hullquad.optimization.paper import paper_iterates
from hullquad.topology import edges
from hullquad.triangulation.contour import contours

PLATES = Path(__file__).parents[2] / "assets" / "plates"
SUMS = ("elements", "triangles", "unavoidable", "inverted", "seconds")
TIMED = {"200": 300.0, "2000": 80.0, "20000": 25.5}
"""Sizes that give about so many quads on floor_manholes [mm]."""


def timed(make):
    began = time.perf_counter()
    made = make()
    return made, time.perf_counter() - began


def figures(mesh, contour):
    """What stands in the columns for one plate."""
    mesh = outcome(paper_iterates(mesh, metric("shape"))).best.mesh
    known = mesh.topology
    values = {
        key: judged_values(metric(key), mesh.points, known.quads, mesh.normals)[0]
        for key in ("scaled_jacobian", "stretch", "shape", "aspect_ratio")
    }
    outside, given = violations(mesh, values["aspect_ratio"])
    found, _ = edges(known.elements)
    valence = np.bincount(found.ravel(), minlength=len(mesh.points))[known.is_free]
    valid = judged_values(metric("shape"), mesh.points, known.elements, mesh.normals)[1]
    return {
        "elements": len(known.elements),
        "triangles": len(known.triangles),
        "unavoidable": contour.triangles_unavoidable,
        "SJ min": values["scaled_jacobian"].min(),
        "SJ mean": values["scaled_jacobian"].mean(),
        "stretch": values["stretch"].mean(),
        "shape": values["shape"].mean(),
        "outside": outside / len(known.elements),
        "given": given / len(known.elements),
        "valence 4": np.mean(valence == 4) if len(valence) else 1.0,
        "inverted": int((~valid).sum()),
    }


def violations(mesh, aspect):
    """Numbers of quads outside the limits that nodes could mend, and that the contour gives."""
    quads = mesh.topology.quads
    corners = mesh.parameters[quads]
    ahead, back = np.roll(corners, -1, axis=1) - corners, np.roll(corners, 1, axis=1) - corners
    angles = np.arctan2(ahead[..., 0] * back[..., 1] - ahead[..., 1] * back[..., 0], (ahead * back).sum(axis=2))
    degrees = np.degrees(angles) % 360
    is_bad = (degrees < 45) | (degrees > 135)
    on_rim = _on_rim(mesh, quads)
    between = on_rim & np.roll(on_rim, 1, axis=1)
    lengths = np.hypot(ahead[..., 0], ahead[..., 1])
    longest, shortest = np.where(on_rim, lengths, 0.0).max(axis=1), np.where(on_rim, lengths, np.inf).min(axis=1)
    is_slim = (aspect > 3) & (longest <= 3 * shortest)
    movable = mesh.topology.is_free[quads].any(axis=1)
    mendable = ((is_bad & ~between).any(axis=1) | is_slim) & movable
    return int(mendable.sum()), int(((is_bad.any(axis=1) | (aspect > 3)) & ~mendable).sum())


def _on_rim(mesh, quads):
    found, counts = edges(mesh.topology.elements)
    room = len(mesh.points)
    rim = found[counts == 1].astype(np.int64) @ [room, 1]
    sides = np.sort(np.stack([quads, np.roll(quads, -1, axis=1)], axis=2), axis=2).astype(np.int64) @ [room, 1]
    return np.isin(sides, rim)


def table(rows):
    columns = list(next(iter(next(iter(rows.values())).values())))
    print(f"{'':38}" + "".join(f"{column:>12}" for column in columns))
    for name, plates in rows.items():
        line = f"{name:38}"
        for column in columns:
            found = [row[column] for row in plates.values()]
            value = sum(found) if column in SUMS else np.mean(found)
            line += f"{value:12d}" if isinstance(value, int) else f"{value:12.4f}"
        print(line, flush=True)


def main():
    pipeline.prepare()
    gmsh_peer.start()
    plates = {
        f"{key} {size}": contour
        for file in sorted(PLATES.glob("*.json"))
        for size in ("coarse", "fine")
        for key, contour in contours(read_plates(file), size).items()
    }
    meshers = {
        f"Gmsh {name}": lambda contour, number=number: gmsh_peer.mesh_by_gmsh(contour, number)
        for name, number in gmsh_peer.ROWS.items()
    }
    meshers["paper"] = lambda contour: timed(lambda: pipeline.paper_mesh(contour))
    meshers["best"] = lambda contour: timed(lambda: pipeline.best_mesh(contour))
    for make in meshers.values():  # the first call of anything is slower
        make(next(iter(plates.values())))
    rows = {}
    for name, make in meshers.items():
        rows[name] = {}
        for key, contour in plates.items():
            mesh, seconds = make(contour)
            rows[name][key] = {**figures(mesh, contour), "seconds": seconds}
    table(rows)
    document = read_plates(PLATES / "floor_manholes.json")
    for quads, size in TIMED.items():
        (contour,) = contours(document, size).values()
        for name in ("Gmsh Frontal-Delaunay for quads + Blossom", "paper", "best"):
            mesh, seconds = min((meshers[name](contour) for _ in range(3)), key=lambda made: made[1])
            print(
                f"floor_manholes, about {quads}: {name:42} {len(mesh.topology.elements):6d} {seconds:8.3f} s",
                flush=True,
            )


if __name__ == "__main__":
    main()
