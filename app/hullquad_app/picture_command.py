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
from hullquad.metrics import METRICS, Band, Metric, metric
from hullquad_app import libraries

if TYPE_CHECKING:
    from hullquad.rules import RuleSet
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
    from hullquad_app.judging import named_rules  # noqa: PLC0415

    rules = None if options.rules is None else named_rules(options.rules)
    scene = _scene(mesh, options.input, metric(options.metric), options.limit, rules)
    pictures.write(scene, output, scale=options.scale, transparent=options.transparent)


def _scene(
    mesh: Mesh, path: Path, chosen: Metric, limits: tuple[float, ...] | None, rules: "RuleSet | None"
) -> "Scene":
    """The mesh as a document of its own, looked at by a metric and its limits, or by rules."""
    from hullquad.optimization.paper import unmoved  # noqa: PLC0415  brings Numba
    from hullquad_app.objectives import optimised_by  # noqa: PLC0415
    from hullquad_app.scene import Scene, State, View, resolved  # noqa: PLC0415
    from hullquad_app.track import Track  # noqa: PLC0415

    key = mesh.plate_id or path.stem
    state = State(title=path.stem, path=path, tracks={key: Track((unmoved(mesh, optimised_by(chosen)),))})
    bands = {} if limits is None else {chosen.key: _band(chosen, limits)}
    return resolved(Scene(), state, View(key=key, metric=chosen, bands=bands, rules=rules))


def _band(by: Metric, limits: tuple[float, ...]) -> Band:
    """The metric's own band with another limit, the nearer one of two, or with both."""
    return by.opened((limits[0], limits[-1])) if len(limits) > 1 else by.moved(by.band, limits[0])


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
        "--limit",
        type=_numbers,
        metavar="X[,Y]",
        help="where quads begin to fail, at both ends of a metric with two (default: the metric's own)",
    )
    parser.add_argument(
        "--rules", metavar="NAME|FILE", help="colour by the worst violation of a rule set, or of a file"
    )
    parser.add_argument(
        "--scale", type=int, choices=_SCALES, default=1, help="size, as a multiple of 1600 x 1000 pixels (default: 1)"
    )
    parser.add_argument("--transparent", action="store_true", help="leave the ground out")
    parser.add_argument("--version", action="version", version=f"hullquad {__version__}")
    return parser


def _numbers(text: str) -> tuple[float, ...]:
    try:
        numbers = tuple(float(part) for part in text.split(","))
    except ValueError:
        numbers = ()
    if not 0 < len(numbers) < 3 or not all(map(isfinite, numbers)) or list(numbers) != sorted(numbers):
        raise ArgumentTypeError(f"'{text}' is no number, nor a lesser and a greater one")
    return numbers
