"""What the optimisation has brought so far: objective, worst and inverted elements, before and now; why it ended."""

from PySide6.QtCore import Qt
from PySide6.QtWidgets import QGridLayout, QLabel, QSizePolicy, QVBoxLayout, QWidget

from hullquad.metrics import Metric
from hullquad.optimization.iterate import Iterate
from hullquad_app.colours import INVERTED, LIGHT, Palette
from hullquad_app.metric_words import name_of
from hullquad_app.panels.figures import counted, sized, summed, valued
from hullquad_app.panels.ground import coloured
from hullquad_app.scene import Scene

_RIGHT = Qt.AlignmentFlag.AlignRight | Qt.AlignmentFlag.AlignVCenter
_NONE = "–"


class Outcome(QWidget):
    """A small table, a warning, and the reason to stop with its advice."""

    def __init__(self) -> None:
        super().__init__()
        self._scene, self._palette = Scene(), LIGHT
        self.captions = [QLabel(text) for text in (self.tr("Sum"), self.tr("Worst"), self.tr("Inverted"))]
        self.heads = [QLabel(self.tr("at the start")), QLabel(self.tr("now"))]
        self.before = [self._number(self.tr("{name} at the start"), caption) for caption in self.captions]
        self.now = [self._number(self.tr("{name} now"), caption) for caption in self.captions]
        self.warning, self.stop = self._sentence(self.tr("Warning")), self._sentence(self.tr("Why the run ended"))
        self._arrange()

    def show_scene(self, scene: Scene) -> None:
        """Show what has become of the mesh that is shown."""
        before, self._scene = self._scene, scene
        if (scene.iterate, scene.track, scene.running) != (before.iterate, before.track, before.running):
            self._refresh()

    def set_palette(self, palette: Palette) -> None:
        """Draw in the colours of a theme."""
        self._palette = palette
        self._refresh()

    def _refresh(self) -> None:
        now, start = self._scene.iterate, _start(self._scene)
        self._fill(self.before, start)
        self._fill(self.now, now)
        self.captions[0].setText(self.tr("Sum") if now is None else self._sum_of(now.quality.metric))
        for label in (*self.captions, *self.heads, *self.before):
            coloured(label, self._palette.dim)
        self.warning.setVisible(now is not None and start is not None and _sacrifices(start, now))
        coloured(self.warning, self._palette.fail)
        self.stop.setText(self._reason())
        self.stop.setVisible(bool(self.stop.text()))
        coloured(self.stop, self._palette.text)

    def _sum_of(self, by: Metric) -> str:
        return self.tr("Sum of {metric}").format(metric=name_of(by))

    def _fill(self, labels: list[QLabel], iterate: Iterate | None) -> None:
        if iterate is None:
            texts, inverted = [_NONE] * 3, 0
        else:
            quality, inverted = iterate.quality, iterate.quality.inverted_count
            worst = valued(quality.worst, quality.metric)
            texts = [summed(iterate.objective, quality.metric), worst, counted(inverted)]
        for label, text in zip(labels, texts, strict=True):
            label.setText(text)
            coloured(label, self._palette.text)
        coloured(labels[2], INVERTED if inverted else self._palette.text)

    def _reason(self) -> str:
        track = self._scene.track
        if self._scene.running:
            return self.tr("Running …")
        if track is None or track.last.stop is None:
            return ""
        text = self.tr("Ended at iteration {number}: {reason}. {advice}")
        return text.format(number=track.last.number, reason=track.last.stop.reason, advice=track.last.stop.advice)

    def _number(self, name: str, caption: QLabel) -> QLabel:
        label = QLabel(_NONE)
        label.setAlignment(_RIGHT)
        label.setFont(sized(self.font()))
        label.setAccessibleName(name.format(name=caption.text()))
        return label

    def _sentence(self, name: str) -> QLabel:
        label = QLabel()
        label.setWordWrap(True)
        label.setAccessibleName(name)
        label.setSizePolicy(QSizePolicy.Policy.Ignored, QSizePolicy.Policy.Preferred)
        label.hide()
        return label

    def _arrange(self) -> None:
        self.warning.setText(self.tr("⚠ The sum is better, but the worst element is worse than at the start."))
        grid = QGridLayout()
        grid.setColumnStretch(0, 1)
        grid.setHorizontalSpacing(2 * self.fontMetrics().averageCharWidth())
        for column, head in enumerate(self.heads, 1):
            head.setAlignment(_RIGHT)
            grid.addWidget(head, 0, column)
        for row, labels in enumerate(zip(self.captions, self.before, self.now, strict=True), 1):
            for column, label in enumerate(labels):
                grid.addWidget(label, row, column)
        column_of_all = QVBoxLayout(self)
        column_of_all.setContentsMargins(0, 0, 0, 0)
        column_of_all.addLayout(grid)
        column_of_all.addWidget(self.warning)
        column_of_all.addWidget(self.stop)


def _start(scene: Scene) -> Iterate | None:
    """The first iterate of the track that was judged by the objective of the shown one."""
    if scene.track is None or scene.iterate is None:
        return None
    metric = scene.iterate.quality.metric
    return next(iterate for iterate in scene.track.iterates if iterate.quality.metric is metric)


def _sacrifices(start: Iterate, now: Iterate) -> bool:
    """Whether the sum has become better and the worst element worse."""
    by = now.quality.metric
    return by.is_worse(start.objective, now.objective) and by.is_worse(now.quality.worst, start.quality.worst)
