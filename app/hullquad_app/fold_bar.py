"""The bar above the view that offers to open elements that are folded or inside out."""

import numpy as np
from PySide6.QtCore import Qt
from PySide6.QtGui import QAction
from PySide6.QtWidgets import QFrame, QHBoxLayout, QLabel, QSizePolicy, QToolButton

from hullquad_app.colours import INVERTED, LIGHT, Palette
from hullquad_app.panels.figures import counted
from hullquad_app.scene import Scene


class FoldBar(QFrame):
    """Shown while the mesh that is shown has such elements, and no run goes on."""

    def __init__(self, opens: QAction) -> None:
        super().__init__()
        self.sentence, self.button = QLabel(), QToolButton()
        self.sentence.setWordWrap(True)
        self.button.setDefaultAction(opens)
        self.button.setToolButtonStyle(Qt.ToolButtonStyle.ToolButtonTextOnly)
        self.button.setFocusPolicy(Qt.FocusPolicy.TabFocus)
        self.button.setSizePolicy(QSizePolicy.Policy.Fixed, QSizePolicy.Policy.Fixed)
        row = QHBoxLayout(self)
        row.addWidget(self.sentence, stretch=1)
        row.addWidget(self.button)
        self.setObjectName("folds")
        self.set_palette(LIGHT)
        self.hide()

    def show_scene(self, scene: Scene) -> None:
        """Tell how many there are, and whether moving nodes can open any of them."""
        quality, given = scene.quality, scene.given
        count = 0 if quality is None else quality.inverted_count
        if quality is not None and count:
            held = 0 if given is None else int(np.count_nonzero(given & ~quality.valid))
            self.sentence.setText(self._words(count, held))
            self.button.setVisible(held < count)
        self.setVisible(count > 0 and not scene.running)

    def set_palette(self, palette: Palette) -> None:
        """Take the colours of a theme."""
        self.setStyleSheet(
            f"#folds {{ background: {palette.panel}; border: 0; border-left: 4px solid {INVERTED}; "
            f"border-bottom: 1px solid {palette.rule}; }}"
        )

    def _words(self, count: int, held: int) -> str:
        folded = (
            self.tr("1 element is folded or inside out.")
            if count == 1
            else self.tr("{count} elements are folded or inside out.").format(count=counted(count))
        )
        if not held:
            return folded
        if held == count:
            return folded + self.tr(" The contour makes it so: no move of the nodes can open it.")
        return folded + self.tr(" The contour makes {held} of them so.").format(held=counted(held))
