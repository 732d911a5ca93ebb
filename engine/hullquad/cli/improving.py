"""The commands mesh and optimize: plates or a mesh in, better meshes out."""

from argparse import Namespace
from collections.abc import Sequence
from pathlib import Path
from typing import Any

import attrs

from hullquad import pipeline, worker
from hullquad.cli.clock import Clock
from hullquad.cli.loading import load
from hullquad.cli.output import activity, complain, progress, say, say_json, warn
from hullquad.cli.report import run_figures, run_text
from hullquad.errors import FileError, HullquadError, MeshError, PlateError
from hullquad.formats import check_output, read_mesh, survey_plates, write_mesh
from hullquad.mesh import Mesh
from hullquad.optimization.iterate import Iterate, Outcome
from hullquad.optimization.settings import PaperSettings, SearchSettings
from hullquad.optimizers import iterates
from hullquad.placement import placed, unplaced
from hullquad.plate import Document, Plate, Refusal
from hullquad.quads.remaining import Cause, cause_of, remaining_triangles
from hullquad.quads.settings import MeshSettings, Preference
from hullquad.quality import quality
from hullquad.rules import rule_set
from hullquad.triangulation.concerns import concerns_of
from hullquad.triangulation.contour import Contour, attempts
from hullquad.triangulation.curved import curved_refusal

_WATCHED, _UNWATCHED = 5, 1_000_000
"""Iterations from one look at a run to the next."""
_Outcomes = dict[str, Contour | PlateError]


def mesh_plates(options: Namespace) -> bool:
    """Mesh every plate of a document, or one, and improve the meshes; whether any plate was refused."""
    check_output(options.output)
    worker.start()
    with activity(f"reading {options.input.name}"):
        document, refusals = survey_plates(options.input)
    plates, refused = _chosen(document, refusals, options.plate)
    for refusal in refused:
        complain(refusal.error.concerning(refusal.plate_id))
    with activity("dividing contours"):
        contours = attempts(document, options.size, follow_lines=options.follow_stiffeners)
    for plate in plates:
        _warn(document, options.size, plate, contours.get(plate.id))
    is_alone = options.plate is not None or len(document.plates) + len(refusals) == 1
    results = _results(document, plates, contours, options, is_alone=is_alone)
    if options.json and not is_alone:
        say_json(results)
    elif options.json and results:
        say_json(results[0])
    return len(results) < len(plates) + len(refused)


def optimize_mesh(options: Namespace) -> bool:
    """Improve a mesh; never refuses a part of it."""
    check_output(options.output)
    given = read_mesh(options.input)
    try:
        mesh = placed(given)
    except MeshError as error:
        if options.optimizer == "paper":
            raise error.at(str(options.input)) from error
        mesh = given  # its own facets are its surface
    clock = _clock()
    load(clock, pipeline.prepare_judging, pipeline.prepare_optimizing)
    with clock.running("optimize"):
        run = _improved(mesh, options)
    figures = _written(run if given.surface is mesh.surface else _bare(run), options.output, options, clock)
    if options.json:
        say_json(figures)
    return False


def _results(
    document: Document, plates: Sequence[Plate], contours: _Outcomes, options: Namespace, *, is_alone: bool
) -> list[dict[str, Any]]:
    """Figures of the plates that could be meshed; of the others it is told why not."""
    clock = _clock()
    if any(isinstance(contours.get(plate.id), Contour) for plate in plates):
        load(clock, pipeline.prepare)
    results: list[dict[str, Any]] = []
    for plate in plates:
        output = options.output if is_alone else _beside(options.output, plate)
        try:
            if plate.id not in contours:
                raise curved_refusal(document, plate)
            contour = _usable(plate, contours[plate.id], options.size)
            check_output(output)
            results.append(_mesh_plate(contour, document.input_hash, output, options, clock))
        except FileError as error:
            complain(error)
        except HullquadError as error:
            complain(error.concerning(plate.id))
    return results


def _usable(plate: Plate, contour: Contour | PlateError, size: float | str | None) -> Contour:
    """The contour to be meshed; raises why there is none."""
    if isinstance(contour, PlateError):
        is_of_size = size is not None and contour.place == plate.place
        raise contour.at("--size") if is_of_size else contour
    return contour


def _mesh_plate(contour: Contour, input_hash: str, output: Path, options: Namespace, clock: Clock) -> dict[str, Any]:
    """Mesh one plate, improve and write the mesh; its figures."""
    if not options.json:
        edges, unavoidable = contour.edge_count, contour.triangles_unavoidable
        say(f"{contour.plate.id}: {edges} contour edges, unavoidable triangles: {unavoidable}")
    with clock.running("mesh"):
        mesh = _meshed(contour, input_hash, options)
    cause = Cause.PAPER if options.mesher == "paper" else cause_of(Preference(options.prefer))
    if (left := remaining_triangles(mesh, contour.plate.place, cause)) is not None:
        warn(left)
    with clock.running("optimize"):
        run = _improved(mesh, options)
    return _written(run, output, options, clock)


def _meshed(contour: Contour, input_hash: str, options: Namespace) -> Mesh:
    with activity(f"{contour.plate.id}: meshing") as goes_on:
        if options.mesher == "paper":
            return pipeline.paper_mesh(contour, input_hash)
        settings = MeshSettings(prefer=Preference(options.prefer), grading=options.grading)
        return pipeline.best_mesh(contour, input_hash, settings, goes_on)


def _improved(mesh: Mesh, options: Namespace) -> Outcome:
    from hullquad.optimization.paper import unmoved  # noqa: PLC0415  brings Numba

    if options.optimizer == "none":
        start = unmoved(mesh, options.metric.metric)
        return Outcome(first=start, best=start, last=start)
    rules = None if options.rules is None else rule_set(options.rules)
    with progress(mesh.plate_id or "mesh", options.iterations) as bar:
        search, paper = _settings(options, is_watched=bar.is_watched)
        return pipeline.improved(iterates(options.optimizer, mesh, options.metric, search, paper, rules), bar.show)


def _settings(options: Namespace, *, is_watched: bool) -> tuple[SearchSettings, PaperSettings]:
    """Settings of the modes and of the paper's method; nobody need see what nobody watches."""
    search = SearchSettings(floor=options.floor, seconds=options.time, stride=_WATCHED if is_watched else _UNWATCHED)
    paper = PaperSettings(guard=options.guard)
    if options.iterations is not None:
        search = attrs.evolve(search, iterations=options.iterations)
        paper = attrs.evolve(paper, iterations=options.iterations)
    return search, paper


def _bare(run: Outcome) -> Outcome:
    """The run as one sees it without the plane that was fitted to the mesh, which is in neither of its files."""
    return Outcome(first=_rejudged(run.first), best=_rejudged(run.best), last=_rejudged(run.last))


def _rejudged(iterate: Iterate) -> Iterate:
    mesh = unplaced(iterate.mesh)
    return attrs.evolve(iterate, mesh=mesh, quality=quality(mesh, iterate.quality.metric))


def _written(run: Outcome, output: Path, options: Namespace, clock: Clock) -> dict[str, Any]:
    """Write the best mesh of a run; its figures."""
    write_mesh(run.best.mesh, output)
    if not options.json:
        say(run_text(run))
        say(f"  written to {output}")
    return {**run_figures(run), "seconds": clock.taken()}


def _clock() -> Clock:
    return Clock("import", "prepare", "mesh", "optimize")


def _chosen(
    document: Document, refusals: Sequence[Refusal], plate_id: str | None
) -> tuple[Sequence[Plate], Sequence[Refusal]]:
    """Sound and refused plates that were asked for."""
    if plate_id is None:
        return document.plates, refusals
    plates = [plate for plate in document.plates if plate.id == plate_id]
    refused = [refusal for refusal in refusals if refusal.plate_id == plate_id]
    if not plates and not refused:
        known = [*(plate.id for plate in document.plates), *(refusal.plate_id for refusal in refusals)]
        raise PlateError("E_PLATE", "--plate", id=plate_id, known=", ".join(filter(None, known)))
    return plates, refused


def _warn(document: Document, size: float | str | None, plate: Plate, contour: Contour | PlateError | None) -> None:
    """Tell of what the document says of a plate, and of what its contour is like."""
    for notice in document.warnings:
        if notice.place == plate.place or notice.place.startswith(plate.place + "/"):
            warn(notice)
    for notice in concerns_of(document, size, contour) if isinstance(contour, Contour) else ():
        warn(notice)


def _beside(output: Path, plate: Plate) -> Path:
    return output.with_name(f"{output.stem}-{plate.id}{output.suffix}")
