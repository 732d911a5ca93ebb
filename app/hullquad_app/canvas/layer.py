"""What VTK draws in one go: faces, lines or points of one look."""

from typing import Any

import numpy as np
from pyvista import CellArray, PolyData
from vtkmodules.vtkRenderingCore import vtkActor, vtkPolyDataMapper

from hullquad.arrays import Floats, Ints, Longs
from hullquad_app.colours import Colours, rgb

_COLOURS = "colours"


class Layer:
    """Data with its actor, which is made once and stays; empty ones are hidden.

    Layers of higher rank are drawn before those of lower rank: they stand a little nearer to the viewer, which
    parallel projection does not show.
    """

    def __init__(self, renderer: Any, rank: int, width: float = 1.0) -> None:
        self.data: Any = PolyData()  # its types forbid slices
        self.rank, self.width = rank, width
        self.shown = True
        mapper = vtkPolyDataMapper()
        mapper.SetInputData(self.data)
        mapper.SetScalarModeToUseCellFieldData()
        mapper.SelectColorArray(_COLOURS)
        mapper.SetColorModeToDirectScalars()
        mapper.ScalarVisibilityOff()
        self.actor = vtkActor()
        self.actor.SetMapper(mapper)
        self.actor.GetProperty().LightingOff()
        renderer.AddActor(self.actor)

    def move(self, points: Floats) -> None:
        """Move the points; arrays of another length take the place of the present ones."""
        if len(points) == self.data.n_points:
            self.data.points[:] = points
        else:
            self.data.points = points.copy()
        self.data.GetPoints().Modified()

    def lie_on(self, other: "Layer") -> None:
        """Use the points of another layer, wherever they move."""
        self.data.SetPoints(other.data.GetPoints())

    def set_faces(self, elements: Ints) -> None:
        """Fill elements (E, 4); triangles end with -1."""
        is_node = elements >= 0
        offsets = np.concatenate([[0], np.cumsum(is_node.sum(axis=1))])
        self.data.SetPolys(_cells(elements[is_node], offsets))
        self._changed()

    def set_lines(self, ends: Ints | Longs) -> None:
        """Draw lines between nodes (L, 2)."""
        self.data.SetLines(_cells(ends.ravel(), np.arange(0, 2 * len(ends) + 1, 2)))
        self._changed()

    def set_segments(self, ends: Floats) -> None:
        """Draw segments (L, 2, 3) on points of their own."""
        self.move(ends.reshape(-1, 3))
        self.set_lines(np.arange(2 * len(ends)).reshape(-1, 2))

    def set_dots(self, points: Floats) -> None:
        """Draw points (N, 3)."""
        self.move(points)
        self.data.SetVerts(_cells(np.arange(len(points)), np.arange(len(points) + 1)))
        self._changed()

    def clear(self) -> None:
        """Draw nothing."""
        for set_cells in (self.data.SetPolys, self.data.SetLines, self.data.SetVerts):
            set_cells(CellArray())
        self._changed()

    def paint_cells(self, colours: Colours) -> None:
        """Colour each cell (C, 3); in place where there are as many as before."""
        if _COLOURS in self.data.cell_data and len(self.data.cell_data[_COLOURS]) == len(colours):
            self.data.cell_data[_COLOURS][:] = colours
            self.data.GetCellData().GetArray(_COLOURS).Modified()
        else:
            self.data.cell_data[_COLOURS] = colours
        self.actor.GetMapper().ScalarVisibilityOn()
        self.data.Modified()

    def paint(self, colour: str) -> None:
        """Colour the whole layer."""
        self.actor.GetProperty().SetColor(*(value / 255 for value in rgb(colour)))

    def scale(self, ratio: float) -> None:
        """Lines and points so many times as wide: device pixels per pixel."""
        self.actor.GetProperty().SetLineWidth(self.width * ratio)
        self.actor.GetProperty().SetPointSize(self.width * ratio)

    def lift(self, towards: Floats, pixel: float) -> None:
        """Stand nearer to the viewer, by more than a steep plate rises under the width of a line."""
        self.actor.SetPosition(*(4 * self.rank * pixel * towards))

    def show(self, shown: bool) -> None:
        """Show the layer, if there is anything in it."""
        self.shown = shown
        self.actor.SetVisibility(shown and self.data.n_cells > 0)

    def _changed(self) -> None:
        self.data.Modified()
        self.show(self.shown)


def _cells(nodes: Any, offsets: Any) -> CellArray:
    """Cells whose nodes begin at `offsets`."""
    return CellArray.from_arrays(offsets, nodes.astype(np.int64), deep=True)
