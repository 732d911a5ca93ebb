"""The files that come with the program: in a checkout beside the sources, installed inside the package."""

import json
from pathlib import Path

import attrs

_INSTALLED = Path(__file__).parent / "assets"
_CHECKOUT = Path(__file__).parents[2] / "assets"
FOLDER = _INSTALLED if _INSTALLED.is_dir() else _CHECKOUT
"""Where `plates` is."""


@attrs.frozen
class Sample:
    """A plate document that comes with the program."""

    path: Path
    name: str
    titles: tuple[str, ...]
    """Of its plates."""
    is_curved: bool
    """All of it: nothing of it can be meshed yet."""


def samples() -> list[Sample]:
    """Sample documents by file name, those that cannot be meshed yet at the end."""
    found = [_sample(path) for path in sorted((FOLDER / "plates").glob("*.json"))]
    return sorted(found, key=lambda sample: sample.is_curved)


def _sample(path: Path) -> Sample:
    document = json.loads(path.read_text(encoding="utf-8"))
    titles = (plate.get("title", plate["id"]) for plate in document["plates"])
    return Sample(path, document["name"], tuple(titles), all("surface" in plate for plate in document["plates"]))
