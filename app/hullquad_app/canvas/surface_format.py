"""What Qt must know of OpenGL before the first window is made."""

from PySide6.QtGui import QSurfaceFormat
from PySide6.QtOpenGLWidgets import QOpenGLWidget
from PySide6.QtWidgets import QWidget


def set_surface_format() -> None:
    """Ask for what VTK needs in every window: on Wayland a format of the view alone leaves it black."""
    wanted = QSurfaceFormat()
    wanted.setRenderableType(QSurfaceFormat.RenderableType.OpenGL)
    wanted.setProfile(QSurfaceFormat.OpenGLContextProfile.CoreProfile)
    wanted.setVersion(3, 2)
    wanted.setAlphaBufferSize(8)
    wanted.setDepthBufferSize(8)
    wanted.setStencilBufferSize(0)
    wanted.setSamples(0)
    QSurfaceFormat.setDefaultFormat(wanted)


def hold_place(parent: QWidget) -> QOpenGLWidget:
    """Something hidden that needs OpenGL: without it Qt would make the window anew, visibly, when the view comes."""
    holder = QOpenGLWidget(parent)
    holder.hide()
    return holder
