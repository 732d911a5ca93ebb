"""The tool bar: as many words as there is room for, icons alone in a narrow window."""

from collections.abc import Iterable

from PySide6.QtCore import QEvent, QSize, Qt
from PySide6.QtGui import QAction, QResizeEvent
from PySide6.QtWidgets import QToolBar, QWidget

_ICON = QSize(20, 20)
_SPACE = 4
"""Beside each tool and at the rims [px]."""


class Tools(QToolBar):
    """Groups of actions and boxes, parted by lines."""

    def __init__(self, title: str, groups: Iterable[Iterable[QAction | QWidget]]) -> None:
        super().__init__(title)
        self.setIconSize(_ICON)
        self._needed = 0
        for number, group in enumerate(groups):
            if number:
                self.addSeparator()
            for tool in group:
                self.addAction(tool) if isinstance(tool, QAction) else self.addWidget(tool)
        self.setToolButtonStyle(Qt.ToolButtonStyle.ToolButtonTextBesideIcon)

    def resizeEvent(self, change: QResizeEvent) -> None:
        """Leave the words out where they would push tools from the bar."""
        super().resizeEvent(change)
        self._fit()

    def changeEvent(self, change: QEvent) -> None:
        """Follow the font."""
        super().changeEvent(change)
        if change.type() == QEvent.Type.FontChange:
            self._needed = 0
            self._fit()

    def _fit(self) -> None:
        styles = Qt.ToolButtonStyle
        if not self._needed:
            self.setToolButtonStyle(styles.ToolButtonTextBesideIcon)
            self._needed = sum(self._width(action) + _SPACE for action in self.actions())
        fits = self._needed <= self.width()
        self.setToolButtonStyle(styles.ToolButtonTextBesideIcon if fits else styles.ToolButtonIconOnly)

    def _width(self, action: QAction) -> int:
        return self.widgetForAction(action).minimumSizeHint().width()
