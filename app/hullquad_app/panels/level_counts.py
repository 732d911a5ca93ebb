"""How many elements keep all rules, are warned of or fail: figures that are the legend of the view."""

from PySide6.QtCore import QRectF, QSize, Qt
from PySide6.QtGui import QColor, QFontMetricsF, QPainter, QPaintEvent
from PySide6.QtWidgets import QSizePolicy, QWidget

from hullquad_app.colours import LIGHT, Palette
from hullquad_app.level_legend import Entry, draw_swatch, entries
from hullquad_app.panels.figures import CAPTION, sized
from hullquad_app.scene import Scene

_GAP = 1.2
"""Between two entries, in lines."""


class LevelCounts(QWidget):
    """The entries in lines, as many in each as there is room for."""

    def __init__(self) -> None:
        super().__init__()
        self._palette, self.entries = LIGHT, list[Entry]()
        policy = QSizePolicy(QSizePolicy.Policy.Preferred, QSizePolicy.Policy.Fixed)
        policy.setHeightForWidth(True)
        self.setSizePolicy(policy)
        self.setAccessibleName(self.tr("Elements by their worst rule"))

    def show_scene(self, scene: Scene) -> None:
        """Show the numbers of a scene."""
        inverted = 0 if scene.quality is None else scene.quality.inverted_count
        self.entries = [] if scene.assessment is None else entries(scene.assessment, inverted)
        self.setAccessibleDescription(", ".join(entry.text for entry in self.entries))
        self.updateGeometry()
        self.update()

    def set_palette(self, palette: Palette) -> None:
        """Draw in the colours of a theme."""
        self._palette = palette
        self.update()

    def sizeHint(self) -> QSize:
        """Room for all entries in one line."""
        return QSize(self.minimumSizeHint().width(), self.heightForWidth(max(self.width(), 1)))

    def minimumSizeHint(self) -> QSize:
        """One line."""
        return QSize(8 * self.fontMetrics().averageCharWidth(), round(1.4 * self.fontMetrics().height()))

    def heightForWidth(self, width: int) -> int:
        """Height of as many lines as are needed."""
        places = self._places(width)
        line = 1.4 * self.fontMetrics().height()
        return round(line if not places else places[-1].bottom() + 0.2 * line)

    def paintEvent(self, _: QPaintEvent) -> None:
        """Draw all entries."""
        painter = QPainter(self)
        painter.setRenderHint(QPainter.RenderHint.Antialiasing)
        painter.setFont(sized(self.font(), CAPTION))
        side = 0.7 * painter.fontMetrics().height()
        for entry, place in zip(self.entries, self._places(self.width()), strict=True):
            square = QRectF(round(place.left()) + 0.5, round(place.center().y() - side / 2) + 0.5, side, side)
            draw_swatch(painter, square, entry.colour, self._palette)
            painter.setPen(QColor(self._palette.text))
            painter.drawText(place.adjusted(1.5 * side, 0, 0, 0), Qt.AlignmentFlag.AlignVCenter, entry.text)

    def _places(self, width: int) -> list[QRectF]:
        """Where each entry is."""
        letters = QFontMetricsF(sized(self.font(), CAPTION))
        line, left, top, places = letters.height(), 0.0, 0.2 * letters.height(), list[QRectF]()
        for entry in self.entries:
            wide = 1.05 * line + letters.horizontalAdvance(entry.text) + 1
            if places and left + wide > width:
                left, top = 0.0, top + 1.3 * line
            places.append(QRectF(left, top, wide, line))
            left += wide + _GAP * line
        return places
