"""Worst, mean and number of failing elements, in large figures."""

from PySide6.QtCore import QEvent
from PySide6.QtWidgets import QHBoxLayout, QLabel, QVBoxLayout, QWidget

from hullquad.arrays import Bools
from hullquad.quality import Quality
from hullquad_app.colours import INVERTED, LIGHT, Palette
from hullquad_app.panels.figures import CAPTION, KEY, counted, sized, valued
from hullquad_app.panels.ground import coloured

_NONE = "–"


class Figure(QWidget):
    """A caption over a large number, with small words behind it."""

    def __init__(self, caption: str) -> None:
        super().__init__()
        self.caption, self.number, self.rest = QLabel(caption), QLabel(_NONE), QLabel()
        self.number.setAccessibleName(caption)
        line = QHBoxLayout()
        line.setSpacing(0)
        line.addWidget(self.number)
        line.addWidget(self.rest)
        line.addStretch()
        column = QVBoxLayout(self)
        column.setContentsMargins(0, 0, 0, 0)
        column.setSpacing(0)
        column.addWidget(self.caption)
        column.addLayout(line)
        self._size_texts()

    def say(self, number: str, colour: str, rest: str = "") -> None:
        """Show a number and the words behind it in a colour."""
        self.number.setText(number)
        self.rest.setText(f" {rest}" if rest else "")
        for label in (self.number, self.rest):
            coloured(label, colour)

    def changeEvent(self, change: QEvent) -> None:
        """Follow the font."""
        super().changeEvent(change)
        if change.type() == QEvent.Type.FontChange and hasattr(self, "caption"):
            self._size_texts()

    def _size_texts(self) -> None:
        self.caption.setFont(sized(self.font(), CAPTION))
        self.number.setFont(sized(self.font(), KEY))
        self.rest.setFont(sized(self.font(), CAPTION))


class KeyFigures(QWidget):
    """The figures of one quality side by side."""

    def __init__(self) -> None:
        super().__init__()
        self.worst = Figure(self.tr("worst"))
        self.mean = Figure(self.tr("mean"))
        self.failing = Figure(self.tr("failing"))
        self.inverted = Figure(self.tr("inverted"))
        line = QHBoxLayout(self)
        line.setContentsMargins(0, 0, 0, 0)
        for figure in (self.worst, self.mean, self.failing, self.inverted):
            line.addWidget(figure, stretch=1)
        self.show_quality(None, LIGHT)

    def show_quality(self, quality: Quality | None, palette: Palette, given: Bools | None = None) -> None:
        """Show the figures of a quality, and how many elements fail because of the contour; dashes without quality."""
        for figure in (self.worst, self.mean, self.failing, self.inverted):
            coloured(figure.caption, palette.dim)
            figure.say(_NONE, palette.dim)
        self._say_given(0 if given is None else int(given.sum()))
        self.inverted.setVisible(quality is not None and quality.inverted_count > 0)
        if quality is None or not len(quality.values):
            return
        bad = palette.fail
        is_bad = bool(quality.failing[quality.worst_element])
        self.worst.say(valued(quality.worst, quality.metric), bad if is_bad else palette.text)
        self.mean.say(valued(quality.mean, quality.metric), palette.text)
        of_all = self.tr("of {count}").format(count=counted(len(quality.values)))
        self.failing.say(counted(quality.failing_count), bad if quality.failing_count else palette.text, of_all)
        self.inverted.say(counted(quality.inverted_count), INVERTED)

    def _say_given(self, count: int) -> None:
        caption, tip = self.tr("failing"), self.tr("Elements beyond their limit.")
        if count:
            caption = self.tr("failing, {count} given").format(count=counted(count))
            more = self.tr("{count} of them are given by the contour: moving nodes cannot mend them.")
            tip = f"{tip}\n{more.format(count=counted(count))}"
        self.failing.caption.setText(caption)
        self.failing.setToolTip(tip)
