"""The commands mesh and optimize: plates or a mesh in, better meshes out."""

from argparse import Namespace
from pathlib import Path
from typing import Any

from hullquad import pipeline, worker
from hullquad.cli.clock import Clock
from hullquad.cli.output import complain, progress, say, say_json, warn
from hullquad.cli.report import run_figures, run_text
from hullquad.errors import HullquadError, MeshingError, PlateError
from hullquad.formats import check_output, read_mesh, read_plates, write_mesh
from hullquad.mesh import Mesh
from hullquad.metrics import metric
from hullquad.optimization.iterate import Outcome
from hullquad.placement import placed
from hullquad.plate import Document, Plate
from hullquad.triangulation.contour import Contour, attempts


def mesh_plates(options: Namespace) -> bool:
    """Mesh every plate of a document, or one, and improve the meshes; whether any plate was refused."""
    check_output(options.output)
    worker.start()
    document = read_plates(options.input)
    plates = _chosen(document, options.plate)
    for notice in document.warnings:
        if any(_is_within(notice.place, plate.place) for plate in plates):
            warn(notice)
    contours = attempts(document, options.size)
    results: list[dict[str, Any]] = []
    for plate in plates:
        output = options.output if len(document.plates) == 1 or options.plate else _beside(options.output, plate)
        try:
            results.append(_mesh_plate(plate, contours.get(plate.id), document.input_hash, output, options))
        except HullquadError as error:
            complain(error)
    if options.json:
        say_json(results[0] if results and len(plates) == 1 else results)
    return len(results) < len(plates)


def optimize_mesh(options: Namespace) -> bool:
    """Improve a mesh; never refuses a part of it."""
    check_output(options.output)
    clock = Clock("import", "prepare", "mesh", "optimize")
    mesh = placed(read_mesh(options.input))
    figures = _improve_and_write(mesh, options.output, options, clock)
    if options.json:
        say_json(figures)
    return False


def _mesh_plate(
    plate: Plate, contour: Contour | PlateError | None, input_hash: str, output: Path, options: Namespace
) -> dict[str, Any]:
    """Mesh one plate, improve and write the mesh; its figures."""
    if contour is None:
        raise MeshingError("E_CURVED", plate.id)
    if isinstance(contour, PlateError):
        raise contour
    check_output(output)
    if not options.json:
        say(f"{plate.id}: {contour.edge_count} contour edges, unavoidable triangles: {contour.triangles_unavoidable}")
    clock = Clock("import", "prepare", "mesh", "optimize")
    _load(clock)
    with clock.running("mesh"):
        mesh = pipeline.paper_mesh(contour, input_hash)
    return _improve_and_write(mesh, output, options, clock)


def _improve_and_write(mesh: Mesh, output: Path, options: Namespace, clock: Clock) -> dict[str, Any]:
    _load(clock)
    with clock.running("optimize"):
        run = _improved(mesh, options)
    write_mesh(run.best.mesh, output)
    if not options.json:
        say(run_text(run))
        say(f"  written to {output}")
    return {**run_figures(run), "seconds": clock.rounded()}


def _improved(mesh: Mesh, options: Namespace) -> Outcome:
    from hullquad.optimization.paper import PaperSettings, paper_iterates, unmoved  # noqa: PLC0415  brings Numba

    chosen = metric(options.metric)
    if options.optimizer == "none":
        start = unmoved(mesh, chosen)
        return Outcome(first=start, best=start, last=start)
    settings = PaperSettings(iterations=options.iterations, guard=options.guard)
    with progress(mesh.plate_id or "mesh", options.iterations) as bar:
        return pipeline.improved(paper_iterates(mesh, chosen, settings), bar.show)


def _load(clock: Clock) -> None:
    """Have the compiled kernels ready, so that their loading is not counted as work."""
    with clock.running("import"):
        import numba  # noqa: F401, PLC0415
    with clock.running("prepare"):
        pipeline.prepare()


def _chosen(document: Document, plate_id: str | None) -> list[Plate]:
    if plate_id is None:
        return list(document.plates)
    chosen = [plate for plate in document.plates if plate.id == plate_id]
    if not chosen:
        known = ", ".join(plate.id for plate in document.plates)
        raise PlateError("E_PLATE", "--plate", id=plate_id, known=known)
    return chosen


def _is_within(place: str, plate: str) -> bool:
    return place == plate or place.startswith(plate + "/") or not place.startswith("/plates/")


def _beside(output: Path, plate: Plate) -> Path:
    return output.with_name(f"{output.stem}-{plate.id}{output.suffix}")
