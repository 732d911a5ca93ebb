"""How a panel is dressed: its ground and texts in the colours of the theme."""

from PySide6.QtGui import QColor, QPalette
from PySide6.QtWidgets import QAbstractSpinBox, QCheckBox, QComboBox, QPushButton, QSlider, QWidget

from hullquad_app.colours import Palette

_ROLES = {
    QPalette.ColorRole.Window: "panel",
    QPalette.ColorRole.Base: "panel",
    QPalette.ColorRole.AlternateBase: "background",
    QPalette.ColorRole.Button: "panel",
    QPalette.ColorRole.WindowText: "text",
    QPalette.ColorRole.Text: "text",
    QPalette.ColorRole.ButtonText: "text",
    QPalette.ColorRole.PlaceholderText: "dim",
    QPalette.ColorRole.Highlight: "accent",
    QPalette.ColorRole.HighlightedText: "panel",
}


_FRAMED = (QAbstractSpinBox, QCheckBox, QComboBox, QPushButton, QSlider)


def frame(widget: QWidget, palette: Palette) -> None:
    """Give all boxes on a widget frames that are seen: Qt's style would draw them a little darker than the ground."""
    for kind in _FRAMED:
        for box in widget.findChildren(kind):
            colours = box.palette()
            colours.setColor(QPalette.ColorRole.Window, QColor(palette.frame))
            box.setPalette(colours)


def dress(widget: QWidget, palette: Palette) -> None:
    """Give a panel its ground and all that is on it the theme's colours."""
    colours = widget.palette()
    for role, name in _ROLES.items():
        for group in (QPalette.ColorGroup.Active, QPalette.ColorGroup.Inactive):
            colours.setColor(group, role, QColor(getattr(palette, name)))
    widget.setPalette(colours)
    widget.setAutoFillBackground(True)
    frame(widget, palette)


def coloured(widget: QWidget, colour: str) -> None:
    """Give the text of one label a colour."""
    colours = widget.palette()
    colours.setColor(QPalette.ColorRole.WindowText, QColor(colour))
    widget.setPalette(colours)
