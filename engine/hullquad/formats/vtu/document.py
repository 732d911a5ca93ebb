"""A VTK XML file in its parts: the elements, and the block of appended data that need not be XML."""

import re
from collections.abc import Iterator
from xml.etree.ElementTree import Element, TreeBuilder
from xml.parsers import expat

import attrs
import numpy as np

from hullquad.errors import FileError

MOST_ITEMS = 10_000_000
"""Most points, cells or rows of a table that a file may announce."""
_MOST_DEPTH = 30
_APPENDED = re.compile(rb"<AppendedData\b([^>]{0,200})>\s{0,200}_")
_APPENDED_END = b"</AppendedData>"


@attrs.frozen(eq=False)
class Document:
    """What a VTK XML file says, not yet decoded."""

    place: str
    root: Element
    appended: bytes = attrs.field(repr=False)
    """What follows the underscore of ``<AppendedData>``."""
    appended_is_raw: bool
    word: np.dtype[np.unsignedinteger]
    """Type of the numbers that head each block of data."""
    is_compressed: bool

    def refusal(self, case: str, **numbers: object) -> FileError:
        """The error that says in what way the file is no good."""
        return FileError("E_VTU", self.place, case, **numbers)


def document(content: bytes, kind: str, place: str) -> Document:
    """The parts of a file whose data set is a `kind`: ``UnstructuredGrid``."""
    _refuse_what_is_not_xml(content, place)
    xml, appended, encoding = _divided(content, place)
    root = _root(xml, place)
    if root.tag != "VTKFile":
        raise FileError("E_VTU", place, "not_vtk", found=root.tag[:40])
    if root.get("type") != kind:
        raise FileError("E_VTU", place, "kind", found=root.get("type", "")[:40])
    order = _choice(root, "byte_order", {"LittleEndian": "<", "BigEndian": ">"}, "LittleEndian", place)
    word = _choice(root, "header_type", {"UInt32": "u4", "UInt64": "u8"}, "UInt32", place)
    compressed = _choice(root, "compressor", {"": "", "vtkZLibDataCompressor": "zlib"}, "", place)
    return Document(place, root, appended, encoding == b"raw", np.dtype(order + word), bool(compressed))


def child(parent: Element, tag: str, file: Document) -> Element:
    """The only child of that name."""
    found = parent.findall(tag)
    if not found:
        raise file.refusal("no_part", part=tag)
    if len(found) > 1:
        raise file.refusal("parts", part=tag, count=len(found))
    return found[0]


def arrays(section: Element | None) -> dict[str, Element]:
    """The data arrays of a section (none when there is no such section) by name; of several the first."""
    named: dict[str, Element] = {}
    for array in _data_arrays(section):
        named.setdefault(array.get("Name", ""), array)
    return named


def count(element: Element, attribute: str, file: Document, default: str = "") -> int:
    """A number of things, from an attribute."""
    text = element.get(attribute, default).strip()
    if not re.fullmatch(r"[0-9]{1,18}", text) or int(text) > MOST_ITEMS:
        raise file.refusal("count", attribute=attribute, found=text[:40], most=MOST_ITEMS)
    return int(text)


def _data_arrays(section: Element | None) -> Iterator[Element]:
    if section is not None:
        yield from (child for child in section if child.tag in {"DataArray", "Array"})


def _refuse_what_is_not_xml(content: bytes, place: str) -> None:
    if not content.strip():
        raise FileError("E_VTU", place, "empty")
    if content.startswith(b"\x1f\x8b"):
        raise FileError("E_VTU", place, "gzip")
    if content.startswith(b"# vtk DataFile"):
        raise FileError("E_VTU", place, "legacy")


def _divided(content: bytes, place: str) -> tuple[bytes, bytes, bytes]:
    """Well-formed XML, the appended data, and their encoding (base64 unless said otherwise)."""
    begin = _APPENDED.search(content)
    if begin is None:
        return content, b"", b""
    end = content.rfind(_APPENDED_END, begin.end())
    if end < 0:
        raise FileError("E_VTU", place, "truncated")
    encoding = re.search(rb"""encoding\s*=\s*["'](\w*)["']""", begin[1])
    return content[: begin.end()] + content[end:], content[begin.end() : end], encoding[1] if encoding else b""


def _root(xml: bytes, place: str) -> Element:
    """Root of the XML; a document type is refused, for with it a small file can define a huge one."""
    builder = TreeBuilder()
    depth = 0

    def start(tag: str, attributes: dict[str, str]) -> None:
        nonlocal depth
        depth += 1
        if depth > _MOST_DEPTH:
            raise FileError("E_VTU", place, "deep", most=_MOST_DEPTH)
        builder.start(tag, attributes)

    def end(tag: str) -> None:
        nonlocal depth
        depth -= 1
        builder.end(tag)

    def refuse(*_: object) -> None:
        raise FileError("E_VTU", place, "doctype")

    parser = expat.ParserCreate("utf-8")
    parser.buffer_text = True
    parser.StartDoctypeDeclHandler = refuse
    parser.StartElementHandler = start
    parser.EndElementHandler = end
    parser.CharacterDataHandler = builder.data
    try:
        parser.Parse(xml, True)
    except expat.ExpatError as error:
        reason = expat.ErrorString(error.code)
        raise FileError("E_VTU", place, "xml", line=error.lineno, column=error.offset + 1, reason=reason) from error
    return builder.close()


def _choice(root: Element, attribute: str, known: dict[str, str], default: str, place: str) -> str:
    found = root.get(attribute, default)
    if found not in known:
        names = ", ".join(filter(None, known))
        raise FileError("E_VTU", place, "unknown", attribute=attribute, found=found[:40], known=names)
    return known[found]
