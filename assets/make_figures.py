"""Draw the README's figures of the hopper partition from the program itself: ``python assets/make_figures.py``."""

from pathlib import Path

import numpy as np
from drawn_meshes import GAP, Panel, drawing, text

from hullquad import pipeline
from hullquad.formats import read_plates
from hullquad.mesh import Mesh
from hullquad.metrics import METRICS, metric
from hullquad.optimization.iterate import outcome
from hullquad.optimization.objective import objective
from hullquad.optimizers import iterates
from hullquad.quads.stages import Step
from hullquad.quality import quality
from hullquad.topology import half_edges, paired_sides
from hullquad.triangulation.contour import Contour, contours
from hullquad_app.colours import colour, element_colours

ASSETS = Path(__file__).parent
SAMPLE = ASSETS / "plates" / "hopper_partition.json"
SIZE = 600.0
"""Element size [mm]: a mesh whose elements can still be told apart in a sixth of a page's width."""
WIDTH = 1200
NARROW = 860
QUAD, TRIANGLE = "#DCE8F3", "#F9C784"
BY = "scaled_jacobian"
SWATCHES, SWATCH = 20, 16


def making(contour: Contour) -> str:
    """Stages of the best mesh, from the triangles to the nodes in their places."""
    stages = [stage for stage in pipeline.best_stages(contour) if stage is not None]
    best = [stage for stage in stages if stage.is_best][-1]
    stages = [stage for stage in stages if stage.candidate == best.candidate]
    joined = [stage for stage in stages if stage.step is Step.JOINED]
    cleaned = [stage for stage in stages if stage.step in (Step.REPAIRED, Step.CLEANED)]
    shown = {
        "a Triangulated": stages[0],
        "b Joined at the contour": joined[_rim_count(joined[-1].mesh()) - 1],
        "c Joined inwards": joined[-1],
        "d Repaired, cleaned up": cleaned[-1],
        "e Shaken, smoothed": best,
    }
    panels = [_panel_by_kind(stage.mesh(), title) for title, stage in shown.items()]
    run = outcome(iterates("default", best.mesh(), objective("shape")))
    panels.append(_panel_by_kind(run.best.mesh, "f Optimised by shape"))
    return drawing(panels, len(panels), WIDTH)


def _rim_count(mesh: Mesh) -> int:
    """Number of quads with an edge of the contour."""
    found, owners = half_edges(mesh.topology.elements)
    inner = np.concatenate(paired_sides(found))
    rim = np.unique(np.delete(owners, inner))
    return int((~mesh.topology.is_triangle[rim]).sum())


def before_and_after(contour: Contour) -> str:
    """The paper's mesher and optimiser beside the best mesher and the default optimiser."""
    paper = outcome(iterates("paper", pipeline.paper_mesh(contour), objective("stretch"))).best.mesh
    best = outcome(iterates("default", pipeline.best_mesh(contour), objective("shape"))).best.mesh
    titles = "The paper's mesher and optimiser, by stretch", "The best mesher and the default optimiser, by shape"
    panels = [_panel_by_metric(mesh, title) for mesh, title in zip((paper, best), titles, strict=True)]
    return drawing(panels, 2, NARROW, _scale(), room=44)


def _panel_by_kind(mesh: Mesh, title: str) -> Panel:
    fills = [TRIANGLE if is_triangle else QUAD for is_triangle in mesh.topology.is_triangle]
    return Panel(mesh, fills, title, _count(mesh))


def _panel_by_metric(mesh: Mesh, title: str) -> Panel:
    judged = quality(mesh, metric(BY))
    figures = f"{_count(mesh)}; scaled Jacobian: worst {judged.worst:.2f}, mean {judged.mean:.2f}"
    fills = [f"#{red:02X}{green:02X}{blue:02X}" for red, green, blue in element_colours(judged).tolist()]
    return Panel(mesh, fills, title, figures)


def _count(mesh: Mesh) -> str:
    triangles, quads = len(mesh.topology.triangles), len(mesh.topology.quads)
    parts = [f"{quads} quad{'s' * (quads != 1)}"] * bool(quads)
    return ", ".join([*parts, f"{triangles or 'no'} triangle{'s' * (triangles != 1)}"])


def _scale() -> list[str]:
    """Colours of the metric from the worst to the best, with the limit."""
    by = next(row for row in METRICS if row.key == BY)
    parts = [text(GAP, 16, by.title)]
    left = GAP + 130
    for number in range(SWATCHES):
        grade = -1 + 2 * (number + 0.5) / SWATCHES
        parts.append(f'<rect x="{left + number * SWATCH}" y="4" width="{SWATCH}" height="14" fill="{colour(grade)}"/>')
    length = SWATCHES * SWATCH
    parts.append(text(left, 34, "worst"))
    parts.append(text(left + length / 2, 34, f"limit {by.band[0]:g}", anchor="middle"))
    parts.append(text(left + length, 34, "ideal", anchor="end"))
    return parts


def main() -> None:
    """Draw both."""
    (contour,) = contours(read_plates(SAMPLE), SIZE).values()
    (ASSETS / "pictures" / "making.svg").write_text(making(contour), encoding="utf-8")
    (ASSETS / "pictures" / "before_after.svg").write_text(before_and_after(contour), encoding="utf-8")


if __name__ == "__main__":
    main()
