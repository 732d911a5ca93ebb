"""The elements of a mesh as CSV: one row each, all metrics, made block by block."""

from collections.abc import Iterator

import attrs
import numpy as np
import numpy.typing as npt

from hullquad.arrays import Bools, Bytes, Longs
from hullquad.cli.decimals import LONGEST, Text, Words, powers_of_ten, put_number, put_whole
from hullquad.mesh import Mesh
from hullquad.metrics import METRICS
from hullquad.metrics.compiled import compiled
from hullquad.metrics.values import all_judged

BLOCK = 1 << 14
"""Elements that are judged and written at a time: some ten megabytes."""

_LEXICON = ("quad", "triangle", "false", "true", "ok", "warn", "error")
_QUAD, _FALSE, _OK = (_LEXICON.index(word) for word in ("quad", "false", "ok"))
_COMMA, _END = ord(","), ord("\n")
_WITHOUT_TRIANGLES = np.array([row.triangles is None for row in METRICS])
_WORDS = np.array([list(word.ljust(8).encode()) for word in _LEXICON], dtype=np.uint8)
_SIZES = np.array([len(word) for word in _LEXICON])
_Codes = npt.NDArray[np.int64]


@attrs.frozen(eq=False)
class ElementTable:
    """What stands in the rows beside the metrics."""

    mesh: Mesh
    given: Bools
    """(E,) fails, and cannot be mended by moving nodes."""
    verdict: Bytes | None
    """(E,) `Level` by a rule set; None without one."""

    def lines(self) -> Iterator[bytes]:
        """A heading, then the rows of each block; values are empty where a triangle has no such metric."""
        verdict = [] if self.verdict is None else ["verdict"]
        yield ",".join(["element", "type", "valid", *(row.key for row in METRICS), "given", *verdict]).encode() + b"\n"
        areas = self.mesh.areas
        for start in range(0, len(self.given), BLOCK):
            yield self._rows(slice(start, start + BLOCK), areas)

    def _rows(self, block: slice, areas: npt.NDArray[np.float64]) -> bytes:
        mesh, topology = self.mesh, self.mesh.topology
        normals = mesh.normals if len(mesh.normals) == 1 else mesh.normals[block]
        columns, valid = all_judged(mesh.points, topology.elements[block], normals, areas)
        values = np.ascontiguousarray(columns)  # an element's beside each other, as they are written
        is_triangle = topology.is_triangle[block]
        values[is_triangle[:, None] & _WITHOUT_TRIANGLES] = np.nan
        before = np.stack([_QUAD + is_triangle, _FALSE + valid], axis=1)
        after = [_FALSE + self.given[block]]
        if self.verdict is not None:
            after.append(_OK + self.verdict[block])
        return _csv(topology.element_labels[block], before, values.view(np.uint64), np.stack(after, axis=1))


def prepare() -> None:
    """Load what writes rows, compiling it first where it is not on disk."""
    nothing = np.zeros((1, 1), dtype=np.int64)
    _csv(np.zeros(1, dtype=np.int64), nothing, nothing.astype(np.uint64), nothing)


def _csv(labels: Longs, before: _Codes, bits: Words, after: _Codes) -> bytes:
    """Rows of labels, words, numbers and words."""
    columns = 1 + before.shape[1] + bits.shape[1] + after.shape[1]
    text = np.empty(len(labels) * columns * (LONGEST + 1), dtype=np.uint8)
    end = _put_rows(np.array(labels), before, bits, after, powers_of_ten(), text)
    return text[:end].tobytes()


@compiled
def _put_rows(labels: Longs, before: _Codes, bits: Words, after: _Codes, powers: Words, text: Text) -> int:
    at = 0
    for i in range(len(labels)):
        at = put_whole(labels[i], text, at)
        at = _put_words(before[i], text, at)
        for k in range(bits.shape[1]):
            text[at] = _COMMA
            at = put_number(bits[i, k], powers, text, at + 1)
        at = _put_words(after[i], text, at)
        text[at] = _END
        at += 1
    return at


@compiled
def _put_words(codes: _Codes, text: Text, at: int) -> int:
    """Write a comma and a word of the lexicon for each code; where the next byte goes."""
    for code in codes:
        size = _SIZES[code]
        text[at] = _COMMA
        text[at + 1 : at + 1 + size] = _WORDS[code, :size]
        at += 1 + size
    return at
