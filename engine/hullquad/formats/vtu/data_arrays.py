"""The numbers and texts in the data arrays of a VTK XML file.

An array stands in its element as text (``ascii``) or base64 (``binary``), or in the appended data, raw or base64::

    plain:       bytes | data                                                    one stretch of base64
    compressed:  blocks, size, last size, packed size of each | packed blocks    two stretches of base64

How much an array holds is known before it is decoded, so a file cannot make us unpack more than its counts announce.
"""

import binascii
import zlib
from itertools import pairwise
from xml.etree.ElementTree import Element

import attrs
import numpy as np
import numpy.typing as npt

from hullquad.arrays import Floats, Longs
from hullquad.formats.vtu.document import Document, count

_MOST_TEXT = 1 << 16
_TYPES = {f"{kind}{bits}": f"{kind[0].lower()}{bits // 8}" for kind in ("Int", "UInt") for bits in (8, 16, 32, 64)}
_TYPES |= {"Float32": "f4", "Float64": "f8"}


def integers(array: Element, rows: int, file: Document) -> Longs:
    """(rows,) whole numbers."""
    if _type(array, file).kind == "f":
        raise file.refusal("not_whole", name=_name(array), found=array.get("type"))
    return np.asarray(_numbers(array, rows, 1, file), dtype=np.int64)


def reals(array: Element, rows: int, columns: int, file: Document) -> Floats:
    """(rows, columns) numbers."""
    return np.asarray(_numbers(array, rows, columns, file), dtype=np.float64).reshape(rows, columns)


def text(array: Element, file: Document) -> str:
    """The text in an array of one string."""
    if array.get("type") != "String":
        raise file.refusal("unknown", attribute="type", found=array.get("type", "")[:40], known="String")
    if _is_ascii(array):
        codes = _written(array, np.dtype(np.int64), file)
        content = codes.astype(np.uint8).tobytes()  # VTK writes bytes beyond 127 as negative numbers
    else:
        content = _content(array, range(_MOST_TEXT + 1), 1, file)
    try:
        return content.removesuffix(b"\0").decode()
    except UnicodeDecodeError as error:
        raise file.refusal("damaged", name=_name(array)) from error


def _numbers(array: Element, rows: int, columns: int, file: Document) -> npt.NDArray[np.generic]:
    kind = _type(array, file)
    if count(array, "NumberOfComponents", file, default="1") != columns:
        found = array.get("NumberOfComponents", "1")
        raise file.refusal("columns", name=_name(array), expected=columns, found=found[:40])
    if not _is_ascii(array):
        size = rows * columns * kind.itemsize
        return np.frombuffer(_content(array, range(size, size + 1), kind.itemsize, file), dtype=kind)
    values = _written(array, kind if kind.kind == "f" else np.dtype(np.int64), file)
    if len(values) != rows * columns:
        raise file.refusal("length", name=_name(array), expected=rows * columns, found=len(values))
    return values


def _type(array: Element, file: Document) -> np.dtype[np.generic]:
    found = array.get("type", "")
    if found not in _TYPES:
        raise file.refusal("unknown", attribute="type", found=found[:40], known=", ".join(_TYPES))
    return np.dtype(_TYPES[found]).newbyteorder(file.word.byteorder)


def _name(array: Element) -> str:
    return array.get("Name", "")[:40]


def _is_ascii(array: Element) -> bool:
    """Whether the numbers stand there in digits: as VTK reads it, so does an array that does not say."""
    return array.get("offset") is None and array.get("format", "ascii") not in {"binary", "appended"}


def _written(array: Element, kind: np.dtype[np.generic], file: Document) -> npt.NDArray[np.generic]:
    """Numbers written in digits."""
    words = (array.text or "").split()
    try:
        with np.errstate(over="ignore"):  # too large for Float32 is infinite, and refused as that
            return np.array(words, dtype=kind)
    except (ValueError, OverflowError) as error:
        raise file.refusal("damaged", name=_name(array)) from error


@attrs.define
class _Stream:
    """Bytes taken one stretch after the other from data that may be base64."""

    data: bytes = attrs.field(repr=False)
    position: int
    is_raw: bool
    array: Element
    file: Document

    def peek(self, size: int) -> bytes:
        """The next bytes, without taking them."""
        length = size if self.is_raw else -(-size // 3) * 4
        chunk = self.data[self.position : self.position + length]
        if len(chunk) < length:
            raise self.file.refusal("short", name=_name(self.array))
        if self.is_raw:
            return chunk
        try:
            content = binascii.a2b_base64(chunk, strict_mode=True)
        except ValueError as error:
            raise self.file.refusal("damaged", name=_name(self.array)) from error
        if len(content) < size:
            raise self.file.refusal("short", name=_name(self.array))
        return content[:size]

    def take(self, size: int) -> bytes:
        """The next bytes, and with base64 the rest of their stretch."""
        content = self.peek(size)
        self.position += size if self.is_raw else -(-size // 3) * 4
        return content

    def words(self, content: bytes) -> list[int]:
        """The numbers of a header."""
        return [int(word) for word in np.frombuffer(content, dtype=self.file.word)]


def _content(array: Element, sizes: range, item: int, file: Document) -> bytes:
    """Bytes of an array in binary form, which must be of one of the sizes."""
    stream = _stream(array, file)
    stated, parts = (_packed_sizes if file.is_compressed else _plain_size)(stream)
    if stated not in sizes:
        raise file.refusal("length", name=_name(array), expected=sizes[-1] // item, found=stated // item)
    if not file.is_compressed:
        return stream.take(file.word.itemsize + stated)[file.word.itemsize :]
    return _unpacked(stream, parts)


def _stream(array: Element, file: Document) -> _Stream:
    if array.get("format") != "appended" and array.get("offset") is None:
        return _Stream("".join((array.text or "").split()).encode(), 0, False, array, file)
    offset = array.get("offset", "")
    if not (offset.isascii() and offset.isdigit() and len(offset) < 19 and int(offset) <= len(file.appended)):
        raise file.refusal("offset", name=_name(array), found=offset[:40])
    return _Stream(file.appended, int(offset), file.appended_is_raw, array, file)


def _plain_size(stream: _Stream) -> tuple[int, list[tuple[int, int]]]:
    (stated,) = stream.words(stream.peek(stream.file.word.itemsize))
    return stated, []


def _packed_sizes(stream: _Stream) -> tuple[int, list[tuple[int, int]]]:
    """Size of the whole when unpacked; the sizes of its blocks, packed and unpacked."""
    word = stream.file.word.itemsize
    (blocks,) = stream.words(stream.peek(word))
    if blocks == 0:
        return 0, []
    _, size, last, *packed = stream.words(stream.take((3 + blocks) * word))
    unpacked = [size] * (blocks - 1) + [last or size]
    return sum(unpacked), list(zip(packed, unpacked, strict=True))


def _unpacked(stream: _Stream, parts: list[tuple[int, int]]) -> bytes:
    packed = stream.take(sum(size for size, _ in parts))
    ends = np.cumsum([0, *(size for size, _ in parts)]).tolist()
    blocks = []
    for (begin, end), (_, size) in zip(pairwise(ends), parts, strict=True):
        unpacker = zlib.decompressobj()
        try:
            block = unpacker.decompress(packed[begin:end], size + 1)  # one more than right tells a bomb
        except zlib.error as error:
            raise stream.file.refusal("damaged", name=_name(stream.array)) from error
        if len(block) != size or not unpacker.eof:
            raise stream.file.refusal("damaged", name=_name(stream.array))
        blocks.append(block)
    return b"".join(blocks)
