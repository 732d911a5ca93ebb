"""What goes through the pipes between the program and its child: byte strings, each after its length."""

import struct
from enum import StrEnum
from typing import IO

LENGTH = struct.Struct("<Q")


class Outcome(StrEnum):
    """How a call ended in the child; the first half of every reply."""

    DONE = "done"
    """With a result."""
    REFUSED = "refused"
    """With an error of ours, that says itself what is wrong."""
    FAILED = "failed"
    """With any other exception: its description and its traceback."""
    NO_MEMORY = "no memory"


def send(pipe: IO[bytes], message: bytes) -> None:
    """Write one message to an unbuffered pipe."""
    for part in (LENGTH.pack(len(message)), message):
        rest = memoryview(part)
        while rest:
            rest = rest[pipe.write(rest) :]


def receive(pipe: IO[bytes]) -> bytearray:
    """Next message of an unbuffered pipe.

    Raises
    ------
    EOFError
        The other side has closed the pipe, or has died.
    """
    (length,) = LENGTH.unpack(_exactly(pipe, LENGTH.size))
    return _exactly(pipe, length)


def _exactly(pipe: IO[bytes], length: int) -> bytearray:
    message = bytearray(length)
    rest = memoryview(message)
    while rest:
        count = pipe.readinto(rest)  # type: ignore[attr-defined]  # typeshed's IO lacks it, raw files have it
        if not count:
            raise EOFError
        rest = rest[count:]
    return message
