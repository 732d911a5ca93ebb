"""What may stand on the command line, with its help."""

from argparse import ArgumentParser, ArgumentTypeError, Namespace, RawDescriptionHelpFormatter
from collections.abc import Callable, Sequence
from math import inf, nan
from pathlib import Path

from hullquad import __version__
from hullquad.cli.improving import mesh_plates, optimize_mesh
from hullquad.cli.judging import judge_mesh
from hullquad.cli.mesher_options import add_mesher
from hullquad.errors import HullquadError
from hullquad.metrics import OBJECTIVES
from hullquad.optimization.objective import Objective, objective
from hullquad.optimizers import OPTIMIZERS
from hullquad.rules.built_in import KEYS

SIZES = ("coarse", "fine", "very_fine")
_LARGEST = 1e9

_EXIT_CODES = "exit codes: 0 done, 1 refused input, 2 wrong usage, 3 violations found with --fail-on, 130 interrupted"


def parser() -> ArgumentParser:
    """Parser of all commands; the chosen one is in `command`."""
    root = ArgumentParser(
        prog="hullquad",
        description="Quadrilateral meshes of ship hull plates. Lengths are in mm, angles in degrees.",
        epilog=_EXIT_CODES,
    )
    root.add_argument("--version", action="version", version=f"hullquad {__version__}")
    commands = root.add_subparsers(title="commands", metavar="COMMAND", required=True)
    _add_mesh(_command(commands, "mesh", "mesh plates and improve the meshes"))
    _add_optimize(_command(commands, "optimize", "improve a mesh by moving its free nodes"))
    _add_quality(_command(commands, "quality", "judge a mesh by every metric"))
    return root


def options_of(arguments: Sequence[str] | None) -> Namespace:
    """What was asked for; wrong usage is told, and ends the program."""
    root = parser()
    options = root.parse_args(arguments)
    if hasattr(options, "guard"):
        options.optimizer = options.optimizer or ("default" if options.guard else "paper")
        if not options.guard and options.optimizer != "paper":
            root.error("--no-guard goes with --optimizer paper: no other ever folds an element")
    if getattr(options, "optimizer", None) == "rules" and options.rules is None:
        root.error("--optimizer rules needs --rules NAME|FILE")
    if getattr(options, "csv", None) == "-" and options.json:
        root.error("--csv - and --json both want standard output; give --csv the name of a file")
    return options


def _command(commands: object, name: str, title: str) -> ArgumentParser:
    add = commands.add_parser  # type: ignore[attr-defined]  # argparse keeps the type to itself
    made: ArgumentParser = add(
        name,
        help=title,
        description=title[0].upper() + title[1:] + ".",
        epilog=_EXIT_CODES,
        formatter_class=RawDescriptionHelpFormatter,
        allow_abbrev=False,
    )
    return made


def _add_mesh(command: ArgumentParser) -> None:
    command.set_defaults(command=mesh_plates)
    command.add_argument("input", type=Path, metavar="PLATES", help="plate document (.json)")
    command.add_argument(
        "-o",
        "--output",
        type=Path,
        required=True,
        metavar="OUT",
        help="mesh file (.vtu); a document of several plates writes OUT-ID.vtu for each",
    )
    command.add_argument(
        "--size",
        type=_size,
        metavar="N|" + "|".join(SIZES),
        help="element size in mm, or by the document's name of it (default: the plates' target size)",
    )
    command.add_argument("--plate", metavar="ID", help="only this plate, written to OUT")
    add_mesher(command)
    _add_run(command)


def _add_optimize(command: ArgumentParser) -> None:
    command.set_defaults(command=optimize_mesh)
    command.add_argument("input", type=Path, metavar="MESH", help="mesh file (.vtu)")
    command.add_argument("-o", "--output", type=Path, required=True, metavar="OUT", help="mesh file (.vtu)")
    _add_run(command)


def _add_quality(command: ArgumentParser) -> None:
    command.set_defaults(command=judge_mesh)
    command.add_argument("input", type=Path, metavar="MESH", help="mesh file (.vtu)")
    command.add_argument(
        "--csv",
        type=_file_name,
        metavar="FILE|-",
        help="one row per element with all metrics, to a file or to standard output; 'given' is true where moving "
        "nodes cannot mend the worst that is said of the element",
    )
    command.add_argument("--json", action="store_true", help="print one JSON object")
    command.add_argument(
        "--rules",
        type=_file_name,
        metavar="NAME|FILE",
        help="judge by a rule set too: " + ", ".join(KEYS) + ", or a file",
    )
    command.add_argument(
        "--fail-on",
        choices=["warn", "error"],
        help="end with 3 where elements are warned of, or in error, by --rules; without rules, what a metric of "
        "Table 1 does not accept is an error, and what another one does not accept a warning, but for lengths. "
        "Elements that the contour gives so count, too; how many they are is told",
    )


def _add_run(command: ArgumentParser) -> None:
    command.add_argument(
        "--optimizer",
        choices=[*(row.key for row in OPTIMIZERS), "none"],
        help="how nodes are moved (default: default, with --no-guard paper). "
        + " ".join(f"{row.key}: {row.words[0].lower()}{row.words[1:]}" for row in OPTIMIZERS),
    )
    command.add_argument(
        "--metric",
        type=_objective,
        default="stretch",
        metavar="KEY[=WEIGHT][,KEY…]",
        help="what is made better, the first also judges: "
        + ", ".join(row.key for row in OBJECTIVES)
        + " (default: stretch)",
    )
    command.add_argument(
        "--rules",
        type=_file_name,
        metavar="NAME|FILE",
        help="rule set for --optimizer rules: " + ", ".join(KEYS) + ", or a file",
    )
    command.add_argument(
        "--floor",
        type=_floor,
        default=0.3,
        metavar="X|off",
        help="scaled Jacobian that no element is pushed below for the sum of others; 0.6 makes all acceptable "
        "(default: 0.3)",
    )
    command.add_argument("--iterations", type=_count, metavar="N", help="at most so many (paper: 1000 if not given)")
    command.add_argument("--time", type=_seconds, default=inf, metavar="S", help="at most so many seconds")
    command.add_argument(
        "--no-guard",
        dest="guard",
        action="store_false",
        help="the paper's run to the letter, which may fold elements; their number is told",
    )
    command.add_argument("--json", action="store_true", help="print one JSON object, or a list for several plates")


def _objective(text: str) -> Objective:
    try:
        return objective(text)
    except HullquadError as error:
        raise ArgumentTypeError(f"{error.place or text!r}: {error.text}") from None


def _floor(text: str) -> float | None:
    if text == "off":
        return None
    return _number(text, "a scaled Jacobian above 0 and below 1, nor 'off'", lambda value: 0 < value < 1)


def _seconds(text: str) -> float:
    return _number(text, "a time of 0 seconds or more", lambda value: 0 <= value < inf)


def _number(text: str, meant: str, is_meant: Callable[[float], bool]) -> float:
    try:
        value = float(text)
    except ValueError:
        value = nan
    if not is_meant(value):
        raise ArgumentTypeError(f"'{text}' is not {meant}")
    return value


def _size(text: str) -> float | str:
    if text in SIZES:
        return text
    try:
        size = float(text)
    except ValueError:
        size = 0.0
    if not 0 < size <= _LARGEST:
        raise ArgumentTypeError(
            f"'{text}' is neither a length above 0 and up to {_LARGEST:g} mm nor one of {', '.join(SIZES)}"
        )
    return size


def _file_name(text: str) -> str:
    if not text:
        raise ArgumentTypeError("the name of the file is empty")
    return text


def _count(text: str) -> int:
    if not text.isascii() or not text.isdigit():
        raise ArgumentTypeError(f"'{text}' is no whole number from 0 on")
    return int(text)
