"""The status bar: how large the mesh is, what goes on, and the objective."""

import numpy as np
from PySide6.QtCore import QEvent, QSize, Qt
from PySide6.QtGui import QHelpEvent, QPainter, QPaintEvent
from PySide6.QtWidgets import QLabel, QSizePolicy, QStatusBar, QToolTip

from hullquad.mesh import Mesh
from hullquad.metrics import Metric
from hullquad.optimization.iterate import Iterate
from hullquad.optimization.objective import Objective, objective_sum
from hullquad_app.colours import COLOUR_MAPS, LIGHT, ColourMap, Palette
from hullquad_app.count_words import number_of
from hullquad_app.metric_words import name_of
from hullquad_app.objectives import objective_name, optimised_by
from hullquad_app.panels.figures import counted, sized, summed, valued
from hullquad_app.panels.ground import coloured
from hullquad_app.scene import Scene
from hullquad_app.stage_words import stage_words


class Sentence(QLabel):
    """A text that is cut with three points where there is no room for it; its tip is the whole then."""

    def minimumSizeHint(self) -> QSize:
        """No width at all."""
        return QSize(0, super().minimumSizeHint().height())

    def paintEvent(self, _: QPaintEvent) -> None:
        """Draw what there is room for."""
        painter = QPainter(self)
        text = painter.fontMetrics().elidedText(self.text(), Qt.TextElideMode.ElideRight, self.contentsRect().width())
        painter.setPen(self.palette().color(self.foregroundRole()))
        painter.drawText(self.contentsRect(), Qt.AlignmentFlag.AlignLeft | Qt.AlignmentFlag.AlignVCenter, text)

    def event(self, happening: QEvent) -> bool:
        """Show the whole text where it has no other tip."""
        is_cut = self.fontMetrics().horizontalAdvance(self.text()) > self.contentsRect().width()
        if happening.type() == QEvent.Type.ToolTip and isinstance(happening, QHelpEvent) and is_cut:
            QToolTip.showText(happening.globalPos(), self.toolTip() or self.text(), self)
            return True
        return super().event(happening)


class StatusBar(QStatusBar):
    """Counts and state at the left, a warning, and the objective at the right."""

    def __init__(self) -> None:
        super().__init__()
        self._palette, self._scene, self._activity = LIGHT, Scene(), ""
        self._sums: dict[Mesh, tuple[Metric, float]] = {}
        self.counts, self.warning, self.course, self.objective = Sentence(), Sentence(), Sentence(), Sentence()
        names = (self.tr("Size of the mesh"), self.tr("Warning"), self.tr("What goes on"), self.tr("Objective"))
        labels = (self.counts, self.warning, self.course, self.objective)
        for label, name in zip(labels, names, strict=True):
            label.setAccessibleName(name)
            label.setFont(sized(self.font()))
        gap = self.fontMetrics().averageCharWidth()
        for label in labels[:-1]:
            label.setContentsMargins(0, 0, 2 * gap, 0)
            self.addWidget(label, stretch=int(label is self.course))
        self.course.setSizePolicy(QSizePolicy.Policy.Ignored, QSizePolicy.Policy.Preferred)  # the others come first
        self.addPermanentWidget(self.objective)
        self.setSizeGripEnabled(False)
        self.setContentsMargins(gap, 0, gap, 0)
        self.set_palette(LIGHT)

    def show_scene(self, scene: Scene) -> None:
        """Tell about a scene."""
        before, self._scene = self._scene, scene
        if any(new is not old for new, old in zip(_told(scene), _told(before), strict=True)):
            self._show()

    def say_activity(self, words: str) -> None:
        """Tell what goes on that no scene knows of, like "preparing…"; nothing when it is over."""
        self._activity = words
        self.course.setText(self._course_words())

    def set_palette(self, palette: Palette, _: ColourMap = COLOUR_MAPS[0]) -> None:
        """Take the colours of a theme."""
        self._palette = palette
        for label in (self.counts, self.course, self.objective):
            coloured(label, palette.dim)
        coloured(self.warning, palette.fail)

    def _show(self) -> None:
        scene = self._scene
        self.counts.setText("" if scene.mesh is None else self._count_words(scene.mesh))
        self.course.setText(self._course_words())
        stop = None if scene.track is None else scene.track.last.stop
        self.course.setToolTip("" if stop is None else f"{stop.reason}. {stop.advice}")
        self._sums = {} if scene.track is None else self._summed(scene.track.first, scene.iterate)
        self.objective.setText(self._objective_words())
        self.warning.setText(self._warning_words())
        self.warning.setVisible(bool(self.warning.text()))

    def _count_words(self, mesh: Mesh) -> str:
        grid = mesh.topology
        nouns = (("quad", len(grid.quads)), ("triangle", len(grid.triangles)), ("node", len(mesh.points)))
        things = " · ".join(number_of(noun, count) for noun, count in nouns)
        return self.tr("{things} ({free} free)").format(things=things, free=counted(int(grid.is_free.sum())))

    def _course_words(self) -> str:
        scene = self._scene
        if self._activity:
            return self._activity
        if scene.running:
            return " · ".join(filter(None, (self.tr("running"), _stage(scene))))
        if scene.track is None or scene.iterate is None:
            return ""
        if scene.stage is not None:
            making = self.tr("making of the mesh, {number} of {last}: {step}")
            last = len(scene.track.making)
            return making.format(number=scene.stage + 1, last=last, step=_stage(scene))
        stop, last = scene.track.last.stop, scene.track.last.number
        ended = "" if stop is None else self.tr("stopped at {last}: {why}").format(last=last, why=stop.reason)
        if scene.iterate is scene.track.last:
            return ended
        where = self.tr("iterate {number} of {last} shown").format(number=scene.iterate.number, last=last)
        return " · ".join(filter(None, (where, _stage(scene), ended)))

    def _objective_words(self) -> str:
        """Sum of the metric that is shown, and the objective where another metric was optimised."""
        scene = self._scene
        if scene.mesh is None or scene.iterate is None:
            return ""
        by, run = optimised_by(scene.view.metric), scene.iterate.quality.metric
        text = f"Σ {name_of(by)} {summed(self._sums[scene.mesh][1], by)}"
        weighted = self._weighted(scene.iterate)
        if (run is not by or weighted) and scene.iterate.number > 0:
            other, name = (
                self.tr("optimised by {metric}: {sum}"),
                objective_name(weighted) if weighted else name_of(run),
            )
            text += " · " + other.format(metric=name, sum=summed(scene.iterate.objective, None if weighted else run))
        return text + self.tr(" · lengths in mm")

    def _warning_words(self) -> str:
        """What the sum does not tell: that it became better while the worst element became worse."""
        scene = self._scene
        first, now = scene.first_quality, scene.quality
        if scene.track is None or scene.mesh is None or first is None or now is None or not len(now.values):
            return ""
        by = now.metric
        sums = (self._sums[scene.track.first.mesh][1], self._sums[scene.mesh][1])
        gain = 0 if by.is_two_sided else float(np.subtract(*by.badness(np.array(sums))))
        before, after = valued(first.worst, by), valued(now.worst, by)
        if gain <= 0 or not by.is_worse(now.worst, first.worst) or before == after:
            return ""
        higher = self.tr("worst fell {before} → {after} while the sum rose")
        lower = self.tr("worst rose {before} → {after} while the sum fell")
        return (higher if by.higher_is_better else lower).format(before=before, after=after)

    def _summed(self, *iterates: Iterate | None) -> dict[Mesh, tuple[Metric, float]]:
        """Sums of the chosen metric by mesh; one that is known is not computed again."""
        by = optimised_by(self._scene.view.metric)
        sums: dict[Mesh, tuple[Metric, float]] = {}
        for iterate in filter(None, iterates):
            known = self._sums.get(iterate.mesh)
            sums[iterate.mesh] = known if known is not None and known[0] is by else (by, self._sum(iterate, by))
        return sums

    def _sum(self, iterate: Iterate, by: Metric) -> float:
        if iterate.quality.metric is by and not self._weighted(iterate):
            return iterate.objective
        return objective_sum(iterate.mesh, by)

    def _weighted(self, iterate: Iterate) -> Objective | None:
        """Metrics and weights of an iterate's objective, where it is not the sum of one metric."""
        return None if self._scene.track is None else self._scene.track.weighted_at(iterate.number)


def _told(scene: Scene) -> tuple[object, ...]:
    """All of a scene that is told."""
    return scene.iterate, scene.track, scene.quality, scene.running


def _stage(scene: Scene) -> str:
    """What the run was about when it came to the shown iterate."""
    return "" if scene.iterate is None else stage_words(scene.iterate.stage)
