"""Files in and out: a table with one row per format, found by the ending of the file's name."""

from collections.abc import Callable, Mapping, Sequence
from pathlib import Path
from typing import Any

import attrs

from hullquad.arrays import Floats
from hullquad.errors import FileError
from hullquad.formats import atomic, hullplate, vtu
from hullquad.mesh import Mesh
from hullquad.plate import Document, Refusal


@attrs.frozen(kw_only=True)
class Format:
    """One row of the table; what a format cannot do is None."""

    suffix: str
    title: str
    read_plates: Callable[[Path], Document] | None = None
    survey_plates: Callable[[Path], tuple[Document, Sequence[Refusal]]] | None = None
    write_plates: Callable[[Document, Path], None] | None = None
    read_mesh: Callable[[Path], Mesh] | None = None
    write_mesh: Callable[[Mesh, Path, Mapping[str, Floats] | None], None] | None = None


FORMATS = (
    Format(
        suffix=".json",
        title="HullQuad plates",
        read_plates=hullplate.read,
        survey_plates=hullplate.survey,
        write_plates=hullplate.write,
    ),
    Format(suffix=".vtu", title="VTK unstructured grid", read_mesh=vtu.read, write_mesh=vtu.write),
)


def read_plates(path: Path) -> Document:
    """The plates in a file.

    Raises
    ------
    FileError, PlateError
        No plates are read from files with this ending, or the file is of no use.
    """
    document: Document = _function("read_plates", path)(path)
    return document


def survey_plates(path: Path) -> tuple[Document, Sequence[Refusal]]:
    """The sound plates in a file, without warnings about any element size, and the refused ones.

    Raises
    ------
    FileError, PlateError
        No plates are read from files with this ending, or something is wrong that concerns every plate.
    """
    found: tuple[Document, Sequence[Refusal]] = _function("survey_plates", path)(path)
    return found


def write_plates(document: Document, path: Path) -> None:
    """Put the plates of a document into a file, from which they are read as they are.

    Raises
    ------
    FileError
        No plates are written to files with this ending, or it cannot be written; an existing file is as it was.
    """
    _function("write_plates", path)(document, path)


def read_mesh(path: Path) -> Mesh:
    """The mesh in a file.

    Raises
    ------
    FileError, MeshError
        No mesh is read from files with this ending, or the file is of no use.
    """
    mesh: Mesh = _function("read_mesh", path)(path)
    return mesh


def write_mesh(mesh: Mesh, path: Path, cell_values: Mapping[str, Floats] | None = None) -> None:
    """Put the mesh into a file, with values of its elements for those who look at it elsewhere.

    Raises
    ------
    FileError
        No mesh is written to files with this ending, or it cannot be written; an existing file is as it was.
    """
    _function("write_mesh", path)(mesh, path, cell_values)


def check_output(path: Path) -> None:
    """Refuse, before any work, a file that no mesh can be written to.

    Raises
    ------
    FileError
        For its ending E_SUFFIX, for anything else E_FILE.
    """
    _function("write_mesh", path)
    atomic.check(path)


def _function(name: str, path: Path) -> Callable[..., Any]:
    """What the format of the file has in the column `name`."""
    able = {row.suffix: getattr(row, name) for row in FORMATS if getattr(row, name)}
    suffix = Path(path).suffix.lower()
    if suffix not in able:
        raise FileError("E_SUFFIX", str(path), name, suffix=suffix or "(none)", known=", ".join(able))
    function: Callable[..., Any] = able[suffix]
    return function
