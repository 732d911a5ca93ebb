"""The tool bar: as many words as there is room for, icons alone in a narrow window."""

from collections.abc import Callable, Iterable
from functools import partial

from PySide6.QtCore import QEvent, QSize, Qt
from PySide6.QtGui import QAction, QResizeEvent
from PySide6.QtWidgets import QToolBar, QWidget

_ICON = QSize(20, 20)
_SPACE = 4
"""Beside each tool and at the rims [px]."""
_STYLES = Qt.ToolButtonStyle


class Tools(QToolBar):
    """Groups of actions and boxes, parted by lines.

    Parameters
    ----------
    squeeze
        Makes the boxes as narrow as they can be, or as wide as they should be.
    """

    def __init__(
        self,
        title: str,
        groups: Iterable[Iterable[QAction | QWidget]],
        squeeze: Callable[[bool], None] = lambda _: None,
    ) -> None:
        super().__init__(title)
        self.setIconSize(_ICON)
        self._squeeze = squeeze
        self._needed: list[int] = []
        """Width of each way to show all tools, the widest first."""
        for number, group in enumerate(groups):
            if number:
                self.addSeparator()
            for tool in group:
                self.addAction(tool) if isinstance(tool, QAction) else self.addWidget(tool)
        self._ways = (
            partial(self._show_as, _STYLES.ToolButtonTextBesideIcon, False),
            partial(self._show_as, _STYLES.ToolButtonIconOnly, False),
            partial(self._show_as, _STYLES.ToolButtonIconOnly, True),
        )
        self._ways[0]()

    def resizeEvent(self, change: QResizeEvent) -> None:
        """Leave out what would push tools from the bar."""
        super().resizeEvent(change)
        self._fit()

    def changeEvent(self, change: QEvent) -> None:
        """Follow the font."""
        super().changeEvent(change)
        if change.type() == QEvent.Type.FontChange:
            self._needed = []
            self._fit()

    def _fit(self) -> None:
        if not self._needed:
            for way in self._ways:
                way()
                self._needed.append(sum(self._width(action) + _SPACE for action in self.actions()))
        fitting = (way for way, needed in zip(self._ways, self._needed, strict=True) if needed <= self.width())
        next(fitting, self._ways[-1])()

    def _show_as(self, style: Qt.ToolButtonStyle, is_squeezed: bool) -> None:
        self.setToolButtonStyle(style)
        self._squeeze(is_squeezed)

    def _width(self, action: QAction) -> int:
        return self.widgetForAction(action).minimumSizeHint().width()
