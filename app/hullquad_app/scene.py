"""What is open, how it is looked at, and what is on the screen then: values that never change."""

from collections.abc import Mapping
from functools import cached_property
from pathlib import Path
from typing import TYPE_CHECKING

import attrs

from hullquad.arrays import Bools
from hullquad.mesh import Mesh
from hullquad.metrics import Band, Metric, metric
from hullquad.optimization.iterate import Iterate
from hullquad.plate import Document as PlateDocument
from hullquad.plate import Plate
from hullquad.quality import Quality
from hullquad.quality import quality as measured
from hullquad_app.track import Track
from hullquad_app.verdict import Verdict, verdict

if TYPE_CHECKING:
    from hullquad.rules import Assessment, RuleSet
    from hullquad_app.inspection import Inspection


@attrs.frozen(eq=False, kw_only=True)
class State:
    """What is open and what has become of it: all that undo brings back."""

    title: str = ""
    path: Path | None = None
    """File it was opened from."""
    plates: PlateDocument | None = None
    """None where a mesh was opened, or nothing."""
    tracks: Mapping[str, Track] = attrs.field(factory=dict)
    """Meshed plates by id; a mesh that was opened by its plate's id or its file's name."""

    @property
    def keys(self) -> tuple[str, ...]:
        """Ids of all that can be shown, in order."""
        return tuple(self.tracks) if self.plates is None else tuple(plate.id for plate in self.plates.plates)

    def plate(self, key: str) -> Plate | None:
        """Plate of that id, where the document has plates."""
        if self.plates is None:
            return None
        return next((plate for plate in self.plates.plates if plate.id == key), None)

    def with_track(self, key: str, track: Track) -> "State":
        """The state with another track of a plate."""
        return attrs.evolve(self, tracks={**self.tracks, key: track})


@attrs.frozen(eq=False, kw_only=True)
class View:
    """How the document is looked at: changes nothing in it, and is not undone."""

    key: str | None = None
    """The plate that is shown."""
    position: int = -1
    """Which iterate of its track; -1 the last."""
    stage: int | None = None
    """Which stage of the mesh's making is shown instead of it; None shows the iterate."""
    metric: Metric = attrs.field(factory=lambda: metric("stretch"))
    bands: Mapping[str, Band] = attrs.field(factory=dict)
    """What the user accepts by metric key, where it differs from the metric's own band."""
    rules: "RuleSet | None" = None
    """By which elements are judged and coloured; None: by the metric."""
    selection: frozenset[int] = frozenset()
    """Rows of the selected elements."""


@attrs.frozen(eq=False, kw_only=True)
class Scene:
    """All that is on the screen at one moment, resolved: widgets read this and nothing else."""

    state: State = attrs.field(factory=State)
    view: View = attrs.field(factory=View)
    plate: Plate | None = None
    """The plate that is shown; None where a mesh without plate is, or nothing."""
    track: Track | None = None
    """Of the plate that is shown; while a run goes on, with its iterates so far."""
    position: int = 0
    """Of the shown iterate in the track."""
    stage: int | None = None
    """Of the shown stage of the mesh's making; None where the iterate is shown."""
    quality: Quality | None = None
    """Quality of the shown mesh by the chosen metric and limit: one value for view, histogram, table, status bar."""
    first_quality: Quality | None = None
    """The same of the mesh as it was made or loaded."""
    verdict: Verdict | None = None
    """What the contour gives and the rule set says; while a run goes on of a mesh that was shown a moment before."""
    running: bool = False

    @property
    def iterate(self) -> Iterate | None:
        """The shown iterate, or stage of the making."""
        if self.track is None:
            return None
        return self.track.iterates[self.position] if self.stage is None else self.track.making[self.stage]

    @property
    def mesh(self) -> Mesh | None:
        """The mesh that is shown and pictured; it is saved and continued from unless it is a stage of the making."""
        return None if self.iterate is None else self.iterate.mesh

    @property
    def band(self) -> Band:
        """Within which quads are acceptable."""
        return band(self.view)

    @property
    def given(self) -> Bools | None:
        """(E,) which elements fail by the metric because of the contour: no node that may move can mend them."""
        return None if self.verdict is None else self.verdict.given

    @cached_property
    def inspection(self) -> "Inspection | None":
        """The selected element; None where none is, or several are."""
        if self.mesh is None or len(self.view.selection) != 1:
            return None
        from hullquad_app.inspection import Inspection  # noqa: PLC0415  an empty window does not wait for it

        (row,) = self.view.selection
        return Inspection(mesh=self.mesh, row=row, metric=self.view.metric, bands=self.view.bands)

    @property
    def assessment(self) -> "Assessment | None":
        """What the chosen rule set says of the shown mesh; None where elements are judged by the metric."""
        return None if self.verdict is None else self.verdict.assessment


def band(view: View) -> Band:
    """The band of the chosen metric: the user's, or the metric's own."""
    return view.bands.get(view.metric.key, view.metric.band)


def resolved(
    before: Scene, state: State, view: View, running: Track | None = None, *, keeps_verdict: bool = False
) -> Scene:
    """The scene of a state, looked at in some way; what has not changed since `before` is not computed again.

    With `keeps_verdict` the last one stands for a mesh of which only the nodes have moved.
    """
    key = view.key if view.key in state.keys else next(iter(state.keys), None)
    track = running or (None if key is None else state.tracks.get(key))
    count = 0 if track is None else len(track.iterates)
    position = count - 1 if view.position < 0 else min(view.position, count - 1)
    has_stage = not running and track is not None and view.stage is not None and view.stage < len(track.making)
    stage = view.stage if has_stage else None
    shown = None if track is None else track.iterates[position] if stage is None else track.making[stage]
    selection = view.selection if shown is not None and _shares_elements(shown, before.iterate) else frozenset()
    quality = _judged(shown, view, before)
    return Scene(
        state=state,
        view=attrs.evolve(view, key=key, selection=selection),
        plate=None if key is None else state.plate(key),
        track=track,
        position=max(position, 0),
        stage=stage,
        quality=quality,
        first_quality=quality if track is None or shown is track.first else _judged(track.first, view, before),
        verdict=_verdict(shown, quality, view, before.verdict, keeps=keeps_verdict),
        running=running is not None,
    )


def _shares_elements(one: Iterate, other: Iterate | None) -> bool:
    return other is not None and one.mesh.topology is other.mesh.topology


def _verdict(
    shown: Iterate | None, quality: Quality | None, view: View, before: Verdict | None, *, keeps: bool
) -> Verdict | None:
    if shown is None or quality is None:
        return None
    if keeps and before is not None and before.may_stand_for(shown.mesh, quality, view.rules):
        return before
    return verdict(shown.mesh, quality, view.rules, before)


def _judged(iterate: Iterate | None, view: View, before: Scene) -> Quality | None:
    """Quality of an iterate as it is looked at; one that is there already is taken again."""
    if iterate is None:
        return None
    known = [(iterate.mesh, iterate.quality)]
    if before.track is not None:
        known += [(before.iterate.mesh, before.quality)] if before.iterate and before.quality else []
        known += [(before.track.first.mesh, before.first_quality)] if before.first_quality else []
    for mesh, judged in known:
        if mesh is iterate.mesh and judged.metric is view.metric and judged.band == band(view):
            return judged
    return measured(iterate.mesh, view.metric, band(view))
