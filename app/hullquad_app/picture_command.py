"""The command picture: a mesh as a PNG for a report, without a window or a screen."""

import argparse
import sys
from argparse import ArgumentParser, ArgumentTypeError, Namespace
from collections.abc import Sequence
from math import isfinite
from pathlib import Path
from typing import TYPE_CHECKING

from hullquad import __version__
from hullquad.errors import FileError, HullquadError
from hullquad.formats import atomic, read_mesh
from hullquad.mesh import Mesh
from hullquad.metrics import METRICS, Metric, metric
from hullquad_app import libraries

if TYPE_CHECKING:
    from hullquad_app.scene import Scene

DONE, REFUSED, USAGE, INTERRUPTED = 0, 1, 2, 130
_SCALES = (1, 2, 3, 4)
_SUFFIX = ".png"


def main(arguments: Sequence[str] | None = None) -> int:
    """Run the command; the exit code: 0 done, 1 refused, 2 wrong usage, 130 interrupted."""
    options = _parser().parse_args(arguments)
    lacking = libraries.missing()
    if lacking:
        advice = libraries.advice([libraries.PACKAGES[name] for name in lacking], lacking)
        print(f"hullquad: {advice}", file=sys.stderr)  # noqa: T201  (a terminal is all there is)
        return REFUSED
    try:
        _run(options)
    except HullquadError as error:
        print(f"error {error}", file=sys.stderr)  # noqa: T201  (a terminal is all there is)
        return USAGE if error.code == "E_SUFFIX" and error.case == "picture" else REFUSED
    except KeyboardInterrupt:
        return INTERRUPTED
    return DONE


def _run(options: Namespace) -> None:
    output: Path = options.output
    if output.suffix.lower() != _SUFFIX:
        raise FileError("E_SUFFIX", str(output), "picture", suffix=output.suffix or "(none)", known=_SUFFIX)
    atomic.check(output)
    mesh = read_mesh(options.input)
    from hullquad_app import pictures  # noqa: PLC0415  brings VTK, which wrong usage must not wait for

    scene = _scene(mesh, options.input, metric(options.metric), options.limit)
    pictures.write(scene, output, scale=options.scale, transparent=options.transparent)


def _scene(mesh: Mesh, path: Path, chosen: Metric, limit: float | None) -> "Scene":
    """The mesh as a document of its own, looked at by a metric and a limit."""
    from hullquad.optimization.paper import unmoved  # noqa: PLC0415  brings Numba
    from hullquad_app.scene import Scene, State, View, resolved  # noqa: PLC0415
    from hullquad_app.track import Track  # noqa: PLC0415

    key = mesh.plate_id or path.stem
    state = State(title=path.stem, path=path, tracks={key: Track((unmoved(mesh, chosen),))})
    bands = {} if limit is None else {chosen.key: chosen.moved(chosen.band, limit)}
    return resolved(Scene(), state, View(key=key, metric=chosen, bands=bands))


def _parser() -> ArgumentParser:
    parser = ArgumentParser(
        prog="hullquad picture",
        description="A picture of a mesh for a report: its elements coloured by a metric, with limit, key figures, "
        "colour bar and scale bar.",
        epilog="exit codes: 0 done, 1 refused input, 2 wrong usage, 130 interrupted",
        formatter_class=argparse.RawDescriptionHelpFormatter,
        allow_abbrev=False,
    )
    keys = [row.key for row in METRICS]
    parser.add_argument("input", type=Path, metavar="MESH", help="mesh file (.vtu)")
    parser.add_argument("-o", "--output", type=Path, required=True, metavar="PNG", help="picture to write (.png)")
    parser.add_argument(
        "--metric",
        choices=keys,
        default="stretch",
        metavar="KEY",
        help="what elements are coloured by: " + ", ".join(keys) + " (default: stretch)",
    )
    parser.add_argument(
        "--limit", type=_number, metavar="X", help="where quads begin to fail (default: the metric's own limit)"
    )
    parser.add_argument(
        "--scale", type=int, choices=_SCALES, default=1, help="size, as a multiple of 1600 x 1000 pixels (default: 1)"
    )
    parser.add_argument("--transparent", action="store_true", help="leave the ground out")
    parser.add_argument("--version", action="version", version=f"hullquad {__version__}")
    return parser


def _number(text: str) -> float:
    try:
        number = float(text)
    except ValueError:
        number = float("nan")
    if not isfinite(number):
        raise ArgumentTypeError(f"'{text}' is no number")
    return number
