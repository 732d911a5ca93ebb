"""Sparse systems of equations, those of large plates in the worker: nothing can interrupt a factorisation but its end.

The answer is the same to the last bit wherever it is found.
"""

from scipy import sparse
from scipy.sparse.linalg import splu

from hullquad import worker
from hullquad.arrays import Floats, Ints, floats

_LARGE = 6000
"""Unknowns from which on it takes so long that somebody may lose interest: a twentieth of a second."""
_SECONDS = 600.0
_MEMORY = 512 * 1024**2
_MEMORY_PER_UNKNOWN = 20_000
"""Bytes; measured: 2000 with a hundred thousand of them."""


def solved(matrix: sparse.csc_array, right: Floats, place: str) -> Floats:
    """What times the matrix (N, N) gives the right side (N,) or (N, K).

    Raises
    ------
    WorkerError
        E_CANCELLED, or what should never happen.
    """
    count = matrix.shape[0]
    if count < _LARGE:
        return floats(splu(matrix).solve(right))
    parts = matrix.data, matrix.indices, matrix.indptr, right
    memory = _MEMORY + _MEMORY_PER_UNKNOWN * count
    return floats(worker.call(_solution, *parts, seconds=_SECONDS, memory=memory, place=place))


def _solution(data: Floats, rows: Ints, starts: Ints, right: Floats) -> Floats:
    count = len(starts) - 1
    return floats(splu(sparse.csc_array((data, rows, starts), shape=(count, count))).solve(right))
