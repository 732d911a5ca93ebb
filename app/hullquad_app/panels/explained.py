"""What a control is, for those who see it and for those who do not."""

from PySide6.QtWidgets import QWidget


def explain(widget: QWidget, name: str, tip: str = "") -> None:
    """Give a control its name, and what it is for as tip."""
    widget.setAccessibleName(name)
    widget.setAccessibleDescription(tip)
    widget.setToolTip(tip)
