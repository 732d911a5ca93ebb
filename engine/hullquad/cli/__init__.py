"""The engine's commands: mesh, optimize, quality."""

from collections.abc import Sequence

from hullquad.cli.codes import DONE, REFUSED, USAGE
from hullquad.cli.interrupt import INTERRUPTED, ending_at_once
from hullquad.cli.streams import Stream, sturdy_streams
from hullquad.errors import FileError, HullquadError


def main(arguments: Sequence[str] | None = None) -> int:
    """Run a command; the exit code: 0 done, 1 refused, 2 wrong usage, 3 violations found, 130 interrupted."""
    try:
        with ending_at_once():
            import hullquad.cli.arguments  # noqa: F401, PLC0415  brings all others: half a second

        with sturdy_streams() as output:
            return max(_run(arguments), _lost(output))
    except KeyboardInterrupt:
        return INTERRUPTED


def _run(arguments: Sequence[str] | None) -> int:
    from hullquad.cli.arguments import options_of  # noqa: PLC0415
    from hullquad.cli.output import complain  # noqa: PLC0415

    try:
        options = options_of(arguments)
        return int(options.command(options))
    except HullquadError as error:
        complain(error)
        return USAGE if error.code == "E_SUFFIX" and error.case == "write_mesh" else REFUSED
    except SystemExit as end:  # argparse has said what is wrong, or what was asked for
        return int(end.code or DONE)


def _lost(output: Stream) -> int:
    """Exit code by what could not be printed."""
    from hullquad.cli.output import complain  # noqa: PLC0415

    output.flush()
    if output.loss is None:
        return DONE
    complain(FileError("E_FILE", "standard output", "output", reason=output.loss.strerror or str(output.loss)))
    return REFUSED
