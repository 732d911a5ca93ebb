"""How kernels are compiled: to machine code kept on disk, running without the interpreter's lock."""

from collections.abc import Callable
from typing import ParamSpec, TypeVar, cast

import numba

_Parameters = ParamSpec("_Parameters")
_Result = TypeVar("_Result")


def compiled(function: Callable[_Parameters, _Result]) -> Callable[_Parameters, _Result]:
    """The function as machine code; division by zero gives inf or nan as in IEEE 754, not an exception."""
    return cast("Callable[_Parameters, _Result]", _jit(function))


def _jit(function: Callable[_Parameters, _Result]) -> object:
    try:
        return numba.njit(cache=True, nogil=True, error_model="numpy")(function)
    except RuntimeError:  # no folder that the machine code could be kept in
        return numba.njit(nogil=True, error_model="numpy")(function)
