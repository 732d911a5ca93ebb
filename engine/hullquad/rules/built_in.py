"""The rule sets that come with the program, and those of the user's own files."""

from functools import cache
from importlib.resources import files
from pathlib import Path

from hullquad.errors import RuleError
from hullquad.rules.document import content
from hullquad.rules.reading import parsed
from hullquad.rules.rule import RuleSet

KEYS = (
    "table_1",
    "csr_coarse",
    "csr_fine",
    "csr_very_fine",
    "csr_bc_2014_coarse",
    "csr_bc_2014_fine",
    "csr_ot_2014",
    "kr",
    "bv",
    "dnv",
    "msc_nastran",
    "autodesk_nastran",
    "optistruct",
    "ansys",
    "abaqus",
)
"""Keys of the built-in sets in the order in which they are listed: each is a file in ``rules/data``."""


def rule_sets() -> tuple[RuleSet, ...]:
    """Every rule set that comes with the program."""
    return tuple(map(_built_in, KEYS))


def rule_set(name: str | Path) -> RuleSet:
    """The built-in rule set of that key or title, else the one in the file of that name.

    Raises
    ------
    FileError, RuleError
        There is neither, or the file is of no use.
    """
    if name in KEYS:
        return _built_in(str(name))
    titled = [found for found in rule_sets() if found.title.casefold() == str(name).casefold()]
    if titled:
        return titled[0]
    if not Path(name).suffix and not Path(name).exists():
        raise RuleError("E_RULES", str(name), known=", ".join(KEYS))
    return read_rule_set(Path(name))


def read_rule_set(path: Path) -> RuleSet:
    """The rule set in a file of the user's.

    Raises
    ------
    FileError, RuleError
        The file cannot be read, or something in it is wrong.
    """
    return parsed(content(path), str(path))


@cache
def _built_in(key: str) -> RuleSet:
    place = f"{key}.json"
    return parsed(files("hullquad.rules").joinpath("data", place).read_bytes(), place)
