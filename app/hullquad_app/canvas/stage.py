"""What stands in the view: the layers of a scene, of which only those are touched that differ."""

from typing import Any

import numpy as np

from hullquad.arrays import Bools, Floats, Ints, floats
from hullquad.mesh import Mesh
from hullquad.plate import Plate
from hullquad.sight import from_notch
from hullquad.topology import Topology, edges, half_edges
from hullquad.triangulation.contour import Contour
from hullquad_app.canvas.layer import Layer
from hullquad_app.canvas.painting import Painting, painting
from hullquad_app.canvas.strokes import dashes, hatching
from hullquad_app.colours import BROKEN, INVERTED, ColourMap, Palette, rgb
from hullquad_app.division import Division
from hullquad_app.scene import Scene

LAYERS = {
    "elements": (0, 1.0),
    "inverted": (1, 1.0),
    "edges": (2, 1.0),
    "hatching": (2, 1.4),
    "lines": (3, 1.5),
    "contour": (4, 2.5),
    "outline": (4, 2.5),
    "nodes": (5, 4.5),
    "failing": (6, 2.0),
    "worst": (7, 2.0),
    "halo": (8, 6.5),
    "selection": (9, 3.5),
    "place": (10, 4.5),
    "marks": (11, 11.0),
}
"""Rank and width of each [pixels]; contour and those above it hide what is below."""
_OF_NODES = ("inverted", "edges", "contour", "failing", "worst", "halo", "selection")
_LEAST_OUTLINED = 8.0
"""Length of the edges of elements that are outlined when they fail [px]."""
_LEAST_EDGE = 4.0
"""Length from which edges of elements are drawn [pixels]."""
_NO_LINES = floats(np.empty((0, 2, 3)))


class Stage:
    """Layers in a renderer of VTK; knows no Qt, so that pictures are made with it as well."""

    def __init__(self, renderer: Any, palette: Palette) -> None:
        self.renderer = renderer
        self.layers = {name: Layer(renderer, rank, width) for name, (rank, width) in LAYERS.items()}
        self.scene = Scene()
        self.chosen_map = BROKEN
        self.edges_wanted = True
        self.points: Floats = floats(np.empty((0, 3)))
        """(N, 3) all that the view is to hold."""
        self.loops: list[Floats] = []
        """Outline and holes of a plate that is not meshed, each (N, 3)."""
        self._pixel = 1.0
        self._painting: Painting | None = None
        self._lines = _NO_LINES
        self._filled: Ints = np.empty((0, 4), dtype=np.int32)
        self._division: Division | None = None
        self.set_palette(palette)

    @property
    def box(self) -> Floats:
        """(2, 3) least and greatest coordinates of what is shown."""
        return floats([self.points.min(axis=0), self.points.max(axis=0)] if len(self.points) else np.zeros((2, 3)))

    def show(self, scene: Scene) -> None:
        """Show a scene; what is the same as in the one before, by identity, is left alone."""
        before, self.scene = self.scene, scene
        if scene.mesh is not before.mesh:
            self._show_mesh(scene.mesh, before.mesh)
        if scene.mesh is None and (before.mesh is not None or scene.plate is not before.plate):
            self._show_plate(scene.plate)
        if scene.quality is not before.quality or scene.verdict is not before.verdict:
            self._paint()
        if scene.view.selection != before.view.selection or scene.mesh is not before.mesh:
            self._show_selection(scene.mesh, scene.view.selection)

    def show_division(self, division: Division | None) -> None:
        """Draw the nodes that a plate without a mesh has then."""
        self._division = division
        if self.scene.mesh is None and self.scene.plate is not None:
            self._show_nodes(self.scene.plate)

    def set_palette(self, palette: Palette) -> None:
        """Take the colours of a theme."""
        self.renderer.SetBackground(*(value / 255 for value in rgb(palette.view)))
        for name, colour in (
            ("inverted", INVERTED),
            ("edges", palette.edge),
            ("lines", palette.line),
            ("contour", palette.contour),
            ("outline", palette.contour),
            ("nodes", palette.accent),
            ("failing", palette.failing),
            ("worst", palette.worst),
            ("halo", palette.view),
            ("selection", palette.selection),
            ("place", palette.fail),
            ("marks", palette.fail),
        ):
            self.layers[name].paint(colour)

    def set_colour_map(self, chosen: ColourMap) -> None:
        """Colour elements by another map."""
        self.chosen_map = chosen
        self._paint()

    def look(self, towards: Floats, pixel: float, ratio: float) -> None:
        """Fit the layers to the camera: direction to the viewer, length of a pixel [mm], device pixels per pixel."""
        if pixel != self._pixel:
            self._pixel = pixel
            self._show_lines(self._lines)
            self.show_edges(self.edges_wanted)
            self._thin_outlines()
            self._hatch()
        for layer in self.layers.values():
            layer.lift(towards, pixel)
            layer.scale(ratio)

    def show_edges(self, wanted: bool) -> None:
        """Draw edges of elements, unless they are too small for it."""
        self.edges_wanted = wanted
        mesh = self.scene.mesh
        self.layers["edges"].show(wanted and mesh is not None and mesh.target_size >= _LEAST_EDGE * self._pixel)

    def show_place(self, points: Floats) -> None:
        """Draw a polyline (N, 3) that shows where something is wrong; a single point as a dot, none to take it away."""
        place, marks = self.layers["place"], self.layers["marks"]
        place.clear()
        marks.clear()
        if len(points) == 1:
            marks.set_dots(points)
        elif len(points):
            place.set_segments(np.stack([points[:-1], points[1:]], axis=1))

    def _thin_outlines(self) -> None:
        """Outlines of small elements must not bury them: they are thin, and then there are none."""
        mesh = self.scene.mesh
        edge = np.inf if mesh is None else mesh.target_size / self._pixel
        for name in ("failing", "worst"):
            self.layers[name].width = float(np.clip(edge / 12, 1.0, LAYERS[name][1]))
            self.layers[name].show(edge >= _LEAST_OUTLINED)

    def _show_lines(self, lines: Floats) -> None:
        """Stiffeners and seams, dashed at the scale of the picture."""
        self._lines = lines
        self.layers["lines"].set_segments(dashes(lines, self._pixel))

    def _show_mesh(self, mesh: Mesh | None, before: Mesh | None) -> None:
        if mesh is None:
            for name in ("elements", "hatching", *_OF_NODES):
                self.layers[name].clear()
            self._show_lines(_NO_LINES)
            return
        self.points, self.loops = mesh.points, []
        self.layers["elements"].move(mesh.points)
        if before is None or mesh.topology is not before.topology:
            self._show_topology(mesh.topology)
        if before is None or mesh.lines is not before.lines:
            self._show_lines(mesh.lines)
        self.layers["elements"].data.Modified()
        for name in ("outline", "nodes"):
            self.layers[name].clear()

    def _show_topology(self, topology: Topology) -> None:
        for name in _OF_NODES:
            self.layers[name].lie_on(self.layers["elements"])
        self._filled = topology.elements
        self.layers["elements"].set_faces(topology.elements)
        found, counts = edges(topology.elements)
        self.layers["edges"].set_lines(found)
        self.layers["contour"].set_lines(found[counts != 2])
        self.show_edges(self.edges_wanted)
        self._thin_outlines()

    def _paint(self) -> None:
        """Colour, outline and hatch the elements."""
        mesh, painted = self.scene.mesh, painting(self.scene, self.chosen_map)
        self._painting = painted
        if mesh is None or painted is None:
            return
        elements = mesh.topology.elements
        self.layers["elements"].paint_cells(painted.colours)
        self._show_inverted(mesh, painted.inverted)
        self.layers["failing"].set_lines(_sides(elements, painted.outlined & ~painted.dark))
        self.layers["worst"].set_lines(_sides(elements, painted.outlined & painted.dark))
        self._hatch()

    def _hatch(self) -> None:
        """Hatch what the contour gives, light on dark elements."""
        layer, mesh, painted = self.layers["hatching"], self.scene.mesh, self._painting
        rows = np.empty(0, dtype=np.int64) if mesh is None or painted is None else np.flatnonzero(painted.hatched)
        layer.clear()
        if mesh is None or painted is None or not len(rows):
            return
        lines, owners = hatching(mesh.points, mesh.topology.elements[rows], self._pixel)
        if len(lines):
            layer.set_segments(lines)
            layer.paint_cells(painted.hatch_colours(rows[owners]))

    def _show_inverted(self, mesh: Mesh, is_inverted: Bools) -> None:
        """On top, and without spilling out of concave ones, where VTK would fill the notch."""
        elements = mesh.topology.elements
        turned = from_notch(mesh.points, elements[is_inverted])
        self.layers["inverted"].set_faces(turned)
        filled = elements.copy()
        filled[is_inverted] = turned
        if not np.array_equal(filled, self._filled):
            self._filled = filled
            self.layers["elements"].set_faces(filled)

    def _show_selection(self, mesh: Mesh | None, rows: frozenset[int]) -> None:
        chosen = np.empty((0, 4), dtype=np.int32) if mesh is None else mesh.topology.elements[sorted(rows)]
        found, counts = edges(chosen)
        for name in ("halo", "selection"):
            self.layers[name].set_lines(found[counts == 1])

    def _show_plate(self, plate: Plate | None) -> None:
        """The outline of a plate that is not meshed, with the nodes that its contour gets."""
        self.points, self.loops = floats(np.empty((0, 3))), []
        for name in ("outline", "nodes"):
            self.layers[name].clear()
        self._show_lines(_NO_LINES)
        if plate is None:
            return
        self.loops = loops = list(plate.rims)
        self.points = floats(np.concatenate(loops))
        self.layers["outline"].set_segments(
            np.concatenate([np.stack([loop, np.roll(loop, -1, axis=0)], axis=1) for loop in loops])
        )
        self._show_nodes(plate)

    def _show_nodes(self, plate: Plate) -> None:
        """Contour nodes and lines, as far as the division is one of this plate."""
        contour = self._contour(plate)
        self.layers["nodes"].clear()
        if contour is not None:
            self.layers["nodes"].set_dots(contour.points)
        self._show_lines(_lines_of(plate) if contour is None else contour.lines)

    def _contour(self, plate: Plate) -> Contour | None:
        contour = None if self._division is None else self._division.contours.get(plate.id)
        return contour if isinstance(contour, Contour) and contour.plate.outer is plate.outer else None


def _lines_of(plate: Plate) -> Floats:
    """(L, 2, 3) ends of the stiffeners and seams of a plate, cut by its holes."""
    if not plate.is_plane:
        return _NO_LINES
    return floats(plate.surface.points(plate.clipped_lines.reshape(-1, 2)).reshape(-1, 2, 3))


def _sides(elements: Ints, chosen: Bools) -> Ints:
    """(H, 2) nodes of the edges of the chosen elements."""
    return half_edges(elements[chosen])[0]
