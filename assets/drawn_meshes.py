"""Meshes as SVG for the documentation: panels side by side, each with a caption of two lines."""

from collections.abc import Sequence
from html import escape

import attrs
import numpy as np

from hullquad.mesh import Mesh
from hullquad.sight import plan
from hullquad.topology import NodeState, edges
from hullquad_app.colours import LIGHT

GAP, CAPTION = 24.0, 54.0
_BOLD, _DIM = f'font-weight="600" fill="{LIGHT.text}"', f'fill="{LIGHT.dim}"'


@attrs.frozen(eq=False)
class Panel:
    """A mesh, the colour ``#RRGGBB`` of each of its elements, and what is said of it."""

    mesh: Mesh
    fills: Sequence[str]
    title: str
    figures: str


def drawing(panels: Sequence[Panel], columns: int, width: float, footer: Sequence[str] = (), room: float = 0.0) -> str:
    """The panels in rows, so wide all together; `footer` is drawn into the room below them."""
    views = [_view(panel.mesh) for panel in panels]
    low, high = views[0].min(axis=0), views[0].max(axis=0)
    each = (width - GAP * (columns + 1)) / columns
    scale = each / (high - low)[0]
    height = scale * (high - low)[1] + CAPTION + GAP
    rows = -(-len(panels) // columns)
    size = f"{width:g} {rows * height + GAP + room:.0f}"
    parts = [f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {size}" font-family="sans-serif" font-size="13">']
    parts.append('<rect width="100%" height="100%" fill="#FFFFFF"/>')
    for number, (panel, view) in enumerate(zip(panels, views, strict=True)):
        left, top = GAP + number % columns * (each + GAP), GAP + number // columns * height
        places = (view - [low[0], high[1]]) * [scale, -scale] + [left, top]
        parts += [*_mesh(panel, places), *_caption(panel, left, top + height - CAPTION - GAP)]
    parts += [f'<g transform="translate(0 {rows * height + GAP:.0f})">', *footer, "</g>", "</svg>"]
    return "\n".join(parts) + "\n"


def text(x: float, y: float, words: str, style: str = _DIM, anchor: str = "start") -> str:
    """A line of text."""
    return f'<text x="{x:.1f}" y="{y:.1f}" text-anchor="{anchor}" {style}>{escape(words)}</text>'


def _view(mesh: Mesh) -> np.ndarray:
    """(N, 2) nodes as one looks at the plate [mm]."""
    right, up = plan(mesh)
    return mesh.points @ np.stack([right, up], axis=1)


def _mesh(panel: Panel, places: np.ndarray) -> list[str]:
    topology = panel.mesh.topology
    parts = [f'<g stroke="{LIGHT.edge}" stroke-width="0.7" stroke-linejoin="round">']
    for element, fill in zip(topology.elements.tolist(), panel.fills, strict=True):
        parts.append(f'<polygon fill="{fill}" points="{_points(places[[node for node in element if node >= 0]])}"/>')
    found, counts = edges(topology.elements)
    rim = " ".join(f"M{_points(places[edge], ' L')}" for edge in found[counts == 1].tolist())
    parts.append(
        f'<path d="{rim}" fill="none" stroke="{LIGHT.contour}" stroke-width="1.8" stroke-linecap="round"/></g>'
    )
    given = places[topology.node_states == NodeState.CONTOUR]
    parts += [f'<circle cx="{x:.1f}" cy="{y:.1f}" r="2" fill="{LIGHT.contour}"/>' for x, y in given.tolist()]
    return parts


def _caption(panel: Panel, left: float, top: float) -> list[str]:
    return [text(left, top + 24, panel.title, _BOLD), text(left, top + 43, panel.figures)]


def _points(places: np.ndarray, between: str = " ") -> str:
    return between.join(f"{x:.1f},{y:.1f}" for x, y in places.tolist())
