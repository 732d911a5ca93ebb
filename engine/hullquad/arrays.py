"""Array types, and arrays that cannot be written to."""

from typing import TypeVar

import numpy as np
import numpy.typing as npt

Scalar = TypeVar("Scalar", bound=np.generic)

Floats = npt.NDArray[np.float64]
Ints = npt.NDArray[np.int32]
Longs = npt.NDArray[np.int64]
Bools = npt.NDArray[np.bool_]
Bytes = npt.NDArray[np.int8]


def floats(values: npt.ArrayLike) -> Floats:
    """Read-only float64 array of the values; an array that is one already is not copied."""
    return _frozen(np.ascontiguousarray(values, dtype=np.float64))


def ints(values: npt.ArrayLike) -> Ints:
    """Read-only int32 array of the values; an array that is one already is not copied."""
    return _frozen(np.ascontiguousarray(values, dtype=np.int32))


def longs(values: npt.ArrayLike) -> Longs:
    """Read-only int64 array of the values; an array that is one already is not copied."""
    return _frozen(np.ascontiguousarray(values, dtype=np.int64))


def small_ints(values: npt.ArrayLike) -> Bytes:
    """Read-only int8 array of the values; an array that is one already is not copied."""
    return _frozen(np.ascontiguousarray(values, dtype=np.int8))


def bools(values: npt.ArrayLike) -> Bools:
    """Read-only bool array of the values; an array that is one already is not copied."""
    return _frozen(np.ascontiguousarray(values, dtype=np.bool_))


def _frozen(array: npt.NDArray[Scalar]) -> npt.NDArray[Scalar]:
    if array.flags.writeable:
        array = array.copy()
        array.flags.writeable = False
    return array
