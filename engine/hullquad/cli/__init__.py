"""The engine's commands: mesh, optimize, quality."""

import os
import sys
from collections.abc import Sequence

from hullquad.cli.arguments import parser
from hullquad.cli.output import complain
from hullquad.errors import HullquadError

DONE, REFUSED, USAGE, INTERRUPTED = 0, 1, 2, 130


def main(arguments: Sequence[str] | None = None) -> int:
    """Run a command; the exit code: 0 done, 1 refused, 2 wrong usage, 130 interrupted."""
    try:
        options = parser().parse_args(arguments)
        refused: bool = options.command(options)
        sys.stdout.flush()
    except HullquadError as error:
        complain(error)
        return USAGE if error.code == "E_SUFFIX" and error.case == "write_mesh" else REFUSED
    except KeyboardInterrupt:
        return INTERRUPTED
    except BrokenPipeError:  # whoever read the output has had enough of it
        os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())
        return DONE
    return REFUSED if refused else DONE
