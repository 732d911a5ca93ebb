"""What is done outside the GUI thread, as generators of progress that return what was made; no Qt but its texts.

The engine's rooms are loaded by the work that needs them, in its thread: an empty window waits for none of them.
"""

import logging
import threading
from collections.abc import Generator, Mapping, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any

import attrs
from PySide6.QtCore import QCoreApplication

from hullquad import worker
from hullquad.errors import HullquadError, PlateError
from hullquad.mesh import Mesh
from hullquad.metrics import Metric
from hullquad.plate import Document, Notice
from hullquad.quads.remaining import Cause, cause_of, remaining_triangles
from hullquad.quality import quality
from hullquad_app.dividing import Redivided, redividing
from hullquad_app.division import Attempt, Division, Size, dividing
from hullquad_app.making import Making
from hullquad_app.mesh_words import stage_progress
from hullquad_app.mesher import PAPER, Mesher
from hullquad_app.scene import State
from hullquad_app.track import Track

if TYPE_CHECKING:
    from hullquad.pipeline import MeshStage
    from hullquad.triangulation.contour import Contour
    from hullquad.triangulation.remedies import Remedy

PREPARE_SECONDS = 600.0
"""Compiling every kernel, on a slow machine."""


@attrs.frozen
class Progress:
    """What is being done, and how much of it is done."""

    text: str
    done: int = 0
    total: int = 0
    """0 where nobody can tell."""


Work = Generator[Progress, None, Any]


@attrs.frozen(eq=False)
class Meshed:
    """Plates of a document that were meshed, and those that could not be."""

    plates: Document
    mesher: Mesher
    tracks: Mapping[str, Track]
    refused: Mapping[str, HullquadError]
    left: Sequence[Notice]
    """Of triangles that could have been avoided."""


def prepared(is_prepared: threading.Event) -> Work:
    """Load the compiled kernels; `is_prepared` is set in the end, however it comes.

    The first to need them is a child process: where none is on disk it compiles, which would hold up the window.
    """
    try:
        yield Progress(_translated("Preparing"))
        from hullquad import pipeline  # noqa: PLC0415

        try:
            worker.call(pipeline.prepare, seconds=PREPARE_SECONDS, place="kernels")
        except HullquadError as error:
            logging.warning("kernels are not prepared by the worker: %s", error)
        yield Progress(_translated("Preparing"))
        pipeline.prepare()
    finally:
        is_prepared.set()


def opened(path: Path, metric: Metric) -> Work:
    """State with the plates, or the mesh, of a file."""
    yield Progress(_translated("Opening {file}").format(file=path.name))
    from hullquad.formats import FORMATS, read_mesh, read_plates  # noqa: PLC0415

    if path.suffix.lower() not in {row.suffix for row in FORMATS if row.read_mesh}:
        plates = read_plates(path)
        return State(title=plates.name, path=path, plates=plates)
    mesh = read_mesh(path)
    return State(title=path.stem, path=path, tracks={mesh.plate_id or path.stem: _track(mesh, metric)})


def divided(plates: Document, size: Size, *, follows_lines: bool = False) -> Work:
    """The `Division` of a document."""
    steps, text = dividing(plates, size, follows_lines=follows_lines), _translated("Dividing contours")
    while True:
        try:
            known = next(steps)
        except StopIteration as end:
            found: Division = end.value
            return found
        yield Progress(text, known, len(plates.plates) if known else 0)


def edited(plates: Document, change: "Remedy | None", size: Size) -> Work:
    """`Redivided` plates: by one change, or by as many as make all contours even."""
    steps, text, most = redividing(plates, change, size), _translated("Dividing edges"), 0
    yield Progress(text)
    while True:
        try:
            odd = next(steps)
        except StopIteration as end:
            found: Redivided = end.value
            return found
        most = max(most, odd)
        yield Progress(text, most - odd, most)


def meshed(
    state: State,
    keys: Sequence[str],
    size: Size,
    mesher: Mesher,
    metric: Metric,
    contours: Mapping[str, Attempt] | None,
    is_prepared: threading.Event,
) -> Work:
    """Tracks of plates by id; one that cannot be meshed does not stop the others."""
    assert state.plates is not None  # the keys are those of plates
    while not is_prepared.wait(0.05):
        yield Progress(_translated("Preparing"))
    yield Progress(_translated("Dividing contours"))
    from hullquad.triangulation.contour import attempts  # noqa: PLC0415

    contours = contours or attempts(state.plates, size, follow_lines=mesher.follows_lines)
    tracks: dict[str, Track] = {}
    refused: dict[str, HullquadError] = {}
    left: list[Notice] = []
    cause = Cause.PAPER if mesher.name == PAPER else cause_of(mesher.settings.prefer)
    for i, key in enumerate(keys):
        so_far = (i, len(keys)) if len(keys) > 1 else (0, 0)
        try:
            contour = _contour(state.plates, contours, key)
            mesh, making = yield from _made(contour, state.plates.input_hash, mesher, so_far)
            tracks[key] = attrs.evolve(_track(mesh, metric), making=Making.of(making, metric))
            left += filter(None, [remaining_triangles(mesh, contour.plate.place, cause)])
        except HullquadError as error:
            refused[key] = error
    return Meshed(state.plates, mesher, tracks, refused, left)


def saved(files: Mapping[Path, Mesh], metric: Metric) -> Work:
    """Write meshes with their values by a metric; the files."""
    from hullquad.formats import check_output, write_mesh  # noqa: PLC0415

    for path in files:
        check_output(path)
    for i, (path, mesh) in enumerate(files.items()):
        yield Progress(_translated("Saving {file}").format(file=path.name), i, len(files))
        write_mesh(mesh, path, {metric.key: quality(mesh, metric).values})
    return list(files)


def _made(
    contour: "Contour", input_hash: str, mesher: Mesher, so_far: tuple[int, int]
) -> Generator[Progress, None, tuple[Mesh, Sequence["MeshStage"]]]:
    """The mesh of a plate, and the stages of its making; they are made when asked for, so that not asking cancels."""
    from hullquad import pipeline  # noqa: PLC0415

    if mesher.name == PAPER:
        making = pipeline.paper_stages(contour, input_hash)
    else:
        making = pipeline.best_stages(contour, input_hash, mesher.settings)
    stages: list[MeshStage] = []
    told, text = None, _translated("Meshing {plate}").format(plate=contour.plate.id)
    yield Progress(text, *so_far)
    for stage in making:
        if stage is not None:
            stages.append(stage)
            if (stage.step, stage.candidate) == told:
                continue
            told, text = (stage.step, stage.candidate), stage_progress(contour.plate.id, stage)
        yield Progress(text, *so_far)
    best = [stage for stage in stages if stage.is_best][-1]
    return best.mesh(), [stage for stage in stages if stage.candidate == best.candidate and stage is not best]


def plates_saved(plates: Document, path: Path) -> Work:
    """Write a document of plates; its file in a list."""
    yield Progress(_translated("Saving {file}").format(file=path.name))
    from hullquad.formats import write_plates  # noqa: PLC0415

    write_plates(plates, path)
    return [path]


def _contour(plates: Document, contours: Mapping[str, Attempt], key: str) -> "Contour":
    from hullquad.triangulation.curved import curved_refusal  # noqa: PLC0415

    if key not in contours:
        raise curved_refusal(plates, plates.plate(key)).concerning(key)
    if isinstance(contour := contours[key], PlateError):
        raise contour
    return contour


def _track(mesh: Mesh, metric: Metric) -> Track:
    from hullquad.optimization.paper import unmoved  # noqa: PLC0415  brings Numba: half a second

    return Track((unmoved(mesh, metric),))


def _translated(text: str) -> str:
    return QCoreApplication.translate("Work", text)
