"""The command `hullquad`: the engine's subcommands, or the window."""

import argparse
import gc
import os
import sys
from collections.abc import Sequence

from hullquad import __version__
from hullquad.cli.interrupt import INTERRUPTED, ending_at_once
from hullquad_app import ENGINE_COMMANDS, libraries

_COMMANDS = """
commands without a window (each has its own --help):
  hullquad mesh PLATES -o OUT       make quadrilateral meshes of plates
  hullquad optimize MESH -o OUT     improve a mesh
  hullquad quality MESH             judge a mesh
  hullquad picture MESH -o PNG      picture a mesh for a report
"""


def main(arguments: Sequence[str] | None = None) -> int:
    """Run the command line; gives the exit code.

    Whatever is heavy is imported where it is needed: `hullquad --help` must not wait for Qt, nor `hullquad mesh`
    need it.
    """
    try:
        return _run(list(sys.argv[1:] if arguments is None else arguments))
    except KeyboardInterrupt:
        return INTERRUPTED


def _run(words: Sequence[str]) -> int:
    if words[:1] and words[0] in ENGINE_COMMANDS:
        from hullquad.cli import main as run_engine  # noqa: PLC0415

        return run_engine(words)
    if words[:1] == ["picture"]:
        return _picture(words[1:])
    files = _parser().parse_args(words).files
    obstacle = _obstacle()
    if obstacle:
        print(f"hullquad: {obstacle}", file=sys.stderr)  # noqa: T201  (a terminal is all there is)
        return 1
    gc.disable()  # until the window is there, which collects itself
    with ending_at_once():
        import hullquad.optimizers  # noqa: F401, PLC0415  with NumPy; once Qt is there every import takes longer
        from hullquad_app.application import show  # noqa: PLC0415

    return show(files)


def _picture(words: Sequence[str]) -> int:
    """Run the command that needs the libraries of the window, but no screen."""
    with ending_at_once():
        from hullquad_app.picture_command import main as run_picture  # noqa: PLC0415

    return run_picture(words)


def _parser() -> argparse.ArgumentParser:
    parser = argparse.ArgumentParser(
        prog="hullquad",
        description="Quadrilateral meshes of ship hull plates: made, judged and improved.",
        epilog=_COMMANDS,
        formatter_class=argparse.RawDescriptionHelpFormatter,
    )
    parser.add_argument("files", nargs="*", metavar="FILE", help="plate document to open in the window")
    parser.add_argument("--version", action="version", version=f"%(prog)s {__version__}")
    return parser


def _obstacle() -> str:
    """Why no window can open, in words; empty when one can. Qt itself would abort the process."""
    screens = ("DISPLAY", "WAYLAND_DISPLAY", "QT_QPA_PLATFORM")
    if sys.platform.startswith("linux") and not any(os.environ.get(name) for name in screens):
        return (
            "no screen: none of DISPLAY, WAYLAND_DISPLAY and QT_QPA_PLATFORM is set. "
            "Start it on a desktop (or over ssh -X); the commands mesh, optimize and quality need no screen."
        )
    lacking = libraries.missing()
    return libraries.advice([libraries.PACKAGES[name] for name in lacking], lacking) if lacking else ""
