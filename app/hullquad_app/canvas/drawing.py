"""What VTK draws without a window on the screen."""

import os
import sys
from typing import Any

import numpy as np
import vtkmodules.vtkRenderingOpenGL2  # noqa: F401  makes what vtkRenderWindow() gives
from numpy.typing import NDArray
from vtkmodules.vtkCommonCore import vtkUnsignedCharArray
from vtkmodules.vtkRenderingCore import vtkRenderer, vtkRenderWindow


class Drawing:
    """A renderer and the pixels that come of it; on a transparent ground they have the opacity of what is drawn."""

    def __init__(self, samples: int = 0, *, transparent: bool = False) -> None:
        if sys.platform.startswith("linux") and not os.environ.get("DISPLAY"):
            os.environ.setdefault("VTK_DEFAULT_OPENGL_WINDOW", "vtkEGLRenderWindow")  # or VTK complains of the screen
        self.renderer: Any = vtkRenderer()
        self._window: Any = vtkRenderWindow()
        self._window.SetOffScreenRendering(True)
        self._window.SetShowWindow(False)
        self._window.SetMultiSamples(samples)
        if transparent:
            self._window.SetAlphaBitPlanes(1)
            self.renderer.SetBackgroundAlpha(0.0)
        self._window.AddRenderer(self.renderer)
        self._bytes: Any = vtkUnsignedCharArray()

    @property
    def samples(self) -> int:
        """Samples of each pixel; 0 leaves edges rough."""
        return int(self._window.GetMultiSamples())

    @samples.setter
    def samples(self, number: int) -> None:
        self._window.SetMultiSamples(number)

    def pixels(self, width: int, height: int) -> NDArray[np.uint8]:
        """(height, width, 4) red, green, blue and opacity as it looks now, from the top down."""
        self._window.SetSize(width, height)
        self._window.Render()
        self._window.GetRGBACharPixelData(0, 0, width - 1, height - 1, 0, self._bytes, 0)
        return np.ascontiguousarray(np.frombuffer(self._bytes, dtype=np.uint8).reshape(height, width, 4)[::-1])

    def finish(self) -> None:
        """Give everything back to OpenGL and the screen; nothing can be drawn afterwards."""
        if self._window is not None:
            self._window.Finalize()
        self._window = None
