"""Options of the mesher on the command line."""

from argparse import ArgumentParser, ArgumentTypeError

from hullquad.quads.settings import GRADING, LARGEST_GRADING, LEAST_GRADING, Preference


def add_mesher(command: ArgumentParser) -> None:
    """Let a command take ``--mesher``, ``--prefer``, ``--grading`` and ``--follow-stiffeners``."""
    command.add_argument(
        "--mesher",
        choices=["best", "paper"],
        default="best",
        help="how quads are made: best leaves no triangle that can be avoided (default: best)",
    )
    command.add_argument(
        "--prefer",
        choices=[choice.value for choice in Preference],
        default=Preference.QUADS.value,
        help="what the best mesher puts first: the fewest triangles, or the best worst element (default: quads)",
    )
    command.add_argument(
        "--grading",
        type=_grading,
        default=GRADING,
        metavar="G",
        help="by how much the best mesher lets elements grow per length away from short edges, "
        f"{LEAST_GRADING:g} to {LARGEST_GRADING:g} (default: {GRADING:g})",
    )
    command.add_argument(
        "--follow-stiffeners",
        action="store_true",
        help="let elements of either mesher have edges along whole stiffeners and seams, not only nodes at their ends",
    )


def _grading(text: str) -> float:
    try:
        grading = float(text)
    except ValueError:
        grading = 0.0
    if not LEAST_GRADING <= grading <= LARGEST_GRADING:
        raise ArgumentTypeError(f"'{text}' is no number from {LEAST_GRADING:g} to {LARGEST_GRADING:g}")
    return grading
