"""VTK XML elements with numbers and texts in them: inline base64, compressed, so that the file stays plain XML."""

import base64
import zlib
from collections.abc import Iterable, Iterator
from xml.sax.saxutils import quoteattr

import numpy as np
import numpy.typing as npt

_BLOCK = 1 << 20
_LEVEL = 3  # level 6 is three times as slow for files a tenth smaller
_TYPES = {"i1": "Int8", "u1": "UInt8", "i4": "Int32", "i8": "Int64", "f8": "Float64"}

Chunks = Iterable[bytes]


def element(tag: str, *content: Chunks, **attributes: object) -> Iterator[bytes]:
    """An element around its content."""
    written = "".join(f" {name}={quoteattr(str(value))}" for name, value in attributes.items())
    yield f"<{tag}{written}>\n".encode()
    for chunks in content:
        yield from chunks
    yield f"</{tag}>\n".encode()


def file(kind: str, *content: Chunks) -> Iterator[bytes]:
    """A whole file around a data set."""
    yield b'<?xml version="1.0"?>\n'
    layout = {"version": "1.0", "byte_order": "LittleEndian", "header_type": "UInt64"}
    yield from element("VTKFile", *content, type=kind, **layout, compressor="vtkZLibDataCompressor")


def numbers(name: str, values: npt.NDArray[np.generic], *, is_field: bool = False) -> Iterator[bytes]:
    """(N,) or (N, K) numbers as an array of K columns; field data tell their own number of rows."""
    kind = values.dtype.newbyteorder("<")
    layout: dict[str, object] = {"type": _TYPES[kind.str[1:]], "Name": name}
    layout["NumberOfComponents"] = values.shape[1] if values.ndim > 1 else 1
    if is_field:
        layout["NumberOfTuples"] = len(values)
    content = np.ascontiguousarray(values, dtype=kind).tobytes()
    yield from element("DataArray", _packed(content), **layout, format="binary")


def text(name: str, value: str) -> Iterator[bytes]:
    """A text as field data."""
    content = value.encode() + b"\0"
    yield from element("Array", _packed(content), type="String", Name=name, NumberOfTuples=1, format="binary")


def _packed(content: bytes) -> Iterator[bytes]:
    blocks = [zlib.compress(content[i : i + _BLOCK], _LEVEL) for i in range(0, len(content), _BLOCK)]
    header = [len(blocks), _BLOCK, len(content) % _BLOCK, *(len(block) for block in blocks)]
    yield base64.b64encode(np.array(header, dtype="<u8").tobytes())
    yield base64.b64encode(b"".join(blocks))
    yield b"\n"
