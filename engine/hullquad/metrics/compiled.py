"""How kernels are compiled: to machine code kept on disk, running without the interpreter's lock."""

from collections.abc import Callable
from typing import Any, ParamSpec, TypeVar, cast

import numba
import numpy

from hullquad.metrics import code_folder

code_folder.choose()

_Parameters = ParamSpec("_Parameters")
_Result = TypeVar("_Result")

_OF_A_PART: dict[str, Any] = {
    "nogil": True,
    "error_model": "numpy",
    "no_cpython_wrapper": True,
    "no_cfunc_wrapper": True,
}

_UNCOUNTED: dict[str, Any] = {"_nrt": False}
"""Without Numba's run time, which alone can make arrays, and drops them when nobody holds them any more."""


def compiled(function: Callable[_Parameters, _Result]) -> Callable[_Parameters, _Result]:
    """The function as machine code, kept on disk; division by zero gives inf or nan as in IEEE 754, no exception."""
    return cast("Callable[_Parameters, _Result]", _jit(function))


def uncounted(function: Callable[_Parameters, _Result]) -> Callable[_Parameters, _Result]:
    """As `compiled`, for a kernel that makes no array: nothing counts who holds those that it gets.

    Counting a structure of many arrays with every call costs as much as short parts do, and compiles slowly.
    """
    return cast("Callable[_Parameters, _Result]", _jit(function, **_UNCOUNTED))


def inlined(function: Callable[_Parameters, _Result]) -> Callable[_Parameters, _Result]:
    """A part of kernels: it becomes one with the loop that calls it, and is not kept by itself."""
    return cast("Callable[_Parameters, _Result]", numba.njit(forceinline=True, **_OF_A_PART)(function))


def called(function: Callable[_Parameters, _Result]) -> Callable[_Parameters, _Result]:
    """A part of kernels that several lines of them call: compiled once, and not kept by itself.

    It makes no array, see `uncounted`.
    """
    return cast("Callable[_Parameters, _Result]", numba.njit(**_OF_A_PART, **_UNCOUNTED)(function))


def woven(function: Callable[_Parameters, _Result]) -> Callable[_Parameters, _Result]:
    """A part of a kernel whose lines are put into it before anything is compiled.

    Of a chain of large parts each is compiled once then, not once more with every link.
    """
    return cast(
        "Callable[_Parameters, _Result]", numba.njit(inline="always", nogil=True, error_model="numpy")(function)
    )


def plain(number: int) -> int:
    """A constant that is of one type with all other whole numbers: no part is compiled for it alone."""
    return cast("int", numpy.int64(number))


def _jit(function: Callable[_Parameters, _Result], **options: Any) -> object:
    try:
        return numba.njit(cache=True, nogil=True, error_model="numpy", **options)(function)
    except RuntimeError:  # no folder that the machine code could be kept in
        return numba.njit(nogil=True, error_model="numpy", **options)(function)
