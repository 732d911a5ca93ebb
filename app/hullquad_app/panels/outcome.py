"""What a run has brought: figures before and now, how far and how long it went, and why it ended."""

from PySide6.QtCore import Qt
from PySide6.QtWidgets import QGridLayout, QLabel, QSizePolicy, QVBoxLayout, QWidget

from hullquad_app.balance import Balance, Side, balance
from hullquad_app.colours import COLOUR_MAPS, INVERTED, LIGHT, ColourMap, Palette
from hullquad_app.count_words import number_of
from hullquad_app.metric_words import name_of
from hullquad_app.objectives import objective_name
from hullquad_app.panels.figures import CAPTION, counted, sized, summed, valued
from hullquad_app.panels.ground import coloured, dress
from hullquad_app.plan import UNTANGLE
from hullquad_app.scene import Scene

_RIGHT = Qt.AlignmentFlag.AlignRight | Qt.AlignmentFlag.AlignVCenter
_NONE = "–"
_INVERTED = 4
"""Row of the inverted elements."""


class OutcomePanel(QWidget):
    """A small table, a warning, and the reason to stop with its advice."""

    def __init__(self) -> None:
        super().__init__()
        self._scene, self._palette = Scene(), LIGHT
        self._balance: Balance | None = None
        self.captions = [QLabel(text) for text in self._captions()]
        self.heads = [QLabel(self.tr("before")), QLabel(self.tr("now"))]
        self.before = [self._number(self.tr("{name} before"), caption) for caption in self.captions]
        self.now = [self._number(self.tr("{name} now"), caption) for caption in self.captions]
        self.effort = self._sentence(self.tr("Effort"))
        self.effort.setFont(sized(self.font(), CAPTION))
        self.warning, self.stop = self._sentence(self.tr("Warning")), self._sentence(self.tr("Why the run ended"))
        self._arrange()
        self.set_palette(LIGHT)

    def show_scene(self, scene: Scene) -> None:
        """Show what has become of the mesh that is shown."""
        before, self._scene = self._scene, scene
        if scene.running and self.visibleRegion().isEmpty():
            return  # nobody looks, and there is more to do
        if _told(scene) != _told(before):
            self._refresh()

    def set_palette(self, palette: Palette, _: ColourMap = COLOUR_MAPS[0]) -> None:
        """Draw in the colours of a theme."""
        self._palette = palette
        dress(self, palette)
        self._refresh()

    def _captions(self) -> tuple[str, ...]:
        return (
            self.tr("Sum"),
            self.tr("Mean"),
            self.tr("Worst"),
            self.tr("Failing"),
            self.tr("Inverted"),
            self.tr("Given"),
        )

    def _refresh(self) -> None:
        self._balance = found = balance(self._scene, self._balance)
        self._fill(self.before, None if found is None else found.before, found)
        self._fill(self.now, None if found is None else found.now, found)
        self.captions[0].setText(self.tr("Sum") if found is None else self._sum_of(found))
        for label in (*self.captions, *self.heads, *self.before, self.effort):
            coloured(label, self._palette.dim)
        self._say(self.effort, "" if found is None else self._effort_words(found), self._palette.dim)
        self._say(self.warning, "" if found is None else self._warning_words(found), self._palette.fail)
        self._say(self.stop, self._reason(), self._palette.text)

    def _sum_of(self, found: Balance) -> str:
        return self.tr("Weighted") if found.is_weighted else f"Σ {name_of(found.metric)}"

    def _fill(self, labels: list[QLabel], side: Side | None, found: Balance | None) -> None:
        texts = [_NONE] * len(labels) if side is None or found is None else _texts(side, found)
        for label, text in zip(labels, texts, strict=True):
            label.setText(text)
            coloured(label, self._palette.text)
        is_inverted = side is not None and side.quality.inverted_count > 0
        coloured(labels[_INVERTED], INVERTED if is_inverted else self._palette.text)

    def _effort_words(self, found: Balance) -> str:
        if not found.iterations:
            return ""
        texts = [number_of("iteration", found.iterations)]
        if found.seconds is not None:
            texts.append(f"{found.seconds:.2f} s")
        texts.append(self.tr("moved by up to {length}").format(length=f"{found.displacement:.3g}\N{NO-BREAK SPACE}mm"))
        return self._run_words(found) + " · ".join(texts)

    def _run_words(self, found: Balance) -> str:
        if found.optimizer is None:
            return ""
        if found.optimizer.key == UNTANGLE:  # by no metric
            return f"{found.optimizer.title} · "
        text = self.tr("{optimizer}, by {objective} · ")
        return text.format(optimizer=found.optimizer.title, objective=objective_name(found.objective))

    def _warning_words(self, found: Balance) -> str:
        if not found.is_sacrifice:
            return ""
        by = found.metric
        text = self.tr("⚠ The sum is better, but the worst element is worse than before: {before} → {now}.")
        return text.format(before=valued(found.before.quality.worst, by), now=valued(found.now.quality.worst, by))

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
        label.setFont(sized(self.font()))
        label.setAccessibleName(name)
        label.setSizePolicy(QSizePolicy.Policy.Ignored, QSizePolicy.Policy.Preferred)
        label.hide()
        return label

    def _say(self, label: QLabel, text: str, colour: str) -> None:
        label.setText(text)
        label.setVisible(bool(text))
        coloured(label, colour)

    def _arrange(self) -> None:
        grid = QGridLayout()
        grid.setVerticalSpacing(self.fontMetrics().height() // 8)
        for row, head in enumerate(self.heads, 1):
            grid.addWidget(head, row, 0)
        self.captions[-1].setToolTip(
            self.tr("Failing elements that the contour itself makes fail: no node can mend them")
        )
        for column, labels in enumerate(zip(self.captions, self.before, self.now, strict=True), 1):
            labels[0].setAlignment(_RIGHT)
            labels[0].setFont(sized(self.font(), CAPTION))
            grid.setColumnStretch(column, 1)
            for row, label in enumerate(labels):
                grid.addWidget(label, row, column)
        column_of_all = QVBoxLayout(self)
        column_of_all.addLayout(grid)
        column_of_all.setSpacing(self.fontMetrics().height() // 3)
        for sentence in (self.warning, self.effort, self.stop):
            column_of_all.addWidget(sentence)
        column_of_all.addStretch()


def _texts(side: Side, found: Balance) -> list[str]:
    by, quality = found.metric, side.quality
    return [
        summed(side.objective, None if found.is_weighted else by),
        valued(quality.mean, by),
        valued(quality.worst, by),
        counted(quality.failing_count),
        counted(quality.inverted_count),
        counted(side.given_count),
    ]


def _told(scene: Scene) -> tuple[object, ...]:
    """All of a scene that is told."""
    return scene.iterate, scene.track, scene.running, scene.view.bands
