"""Sparse systems of equations whose matrix is symmetric and positive definite.

Those of large plates are solved in the worker: nothing can interrupt a factorisation but its end.

The answer is the same to the last bit wherever it is found.
"""

from scipy import sparse
from scipy.sparse.linalg import SuperLU, splu

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
        return floats(_factors(matrix).solve(right))
    parts = matrix.data, matrix.indices, matrix.indptr, right
    memory = _MEMORY + _MEMORY_PER_UNKNOWN * count
    return floats(worker.call(_solution, *parts, seconds=_SECONDS, memory=memory, place=place))


def _solution(data: Floats, rows: Ints, starts: Ints, right: Floats) -> Floats:
    count = len(starts) - 1
    return floats(_factors(sparse.csc_array((data, rows, starts), shape=(count, count))).solve(right))


def _factors(matrix: sparse.csc_array) -> SuperLU:
    """Of a symmetric, positive definite matrix.

    No rows need be exchanged in it, so that they can be ordered for the least filling in. Column by column is faster
    than by larger panels, and takes less room: there are few columns alike where triangles meet.
    """
    symmetric = {"SymmetricMode": True}
    return splu(matrix, "MMD_AT_PLUS_A", diag_pivot_thresh=0.0, relax=1, panel_size=1, options=symmetric)
