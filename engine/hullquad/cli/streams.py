"""Standard output and standard error that never stop the work: closed, full, in any encoding, or left by the reader."""

import io
import os
import sys
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from typing import TextIO


class Stream(io.TextIOBase):
    """A stream that is silent from the moment on when nothing can be written to it any more."""

    def __init__(self, stream: TextIO | None) -> None:
        self._stream = stream
        self.loss: OSError | None = None
        """Why something could not be written, unless whoever read the stream had enough of it."""
        if stream is None:  # its number must not be given to a file that is opened next
            os.open(os.devnull, os.O_WRONLY)
        elif isinstance(stream, io.TextIOWrapper):
            stream.reconfigure(errors="backslashreplace")

    def write(self, text: str) -> int:
        """Write as much as can be written."""
        with self._yielding() as stream:
            if stream is not None:
                stream.write(text)
        return len(text)

    def flush(self) -> None:
        """Hand on what was written."""
        with self._yielding() as stream:
            if stream is not None:
                stream.flush()

    def isatty(self) -> bool:
        """Whether somebody watches."""
        return self._stream is not None and self._stream.isatty()

    @contextmanager
    def _yielding(self) -> Iterator[TextIO | None]:
        try:
            yield self._stream
        except BrokenPipeError:
            self._fall_silent()
        except OSError as error:
            self.loss = error
            self._fall_silent()

    def _fall_silent(self) -> None:
        """Write nothing more; what is waiting to be written goes nowhere when the program ends."""
        stream, self._stream = self._stream, None
        with suppress(OSError):
            nowhere = os.open(os.devnull, os.O_WRONLY)
            os.dup2(nowhere, stream.fileno() if stream else nowhere)
            os.close(nowhere)


@contextmanager
def sturdy_streams() -> Iterator[Stream]:
    """Print to sturdy streams for as long as this lasts; gives standard output."""
    usual = sys.stdout, sys.stderr
    sys.stdout, sys.stderr = output, _ = Stream(sys.stdout), Stream(sys.stderr)
    try:
        yield output
        output.flush()
    finally:
        sys.stdout, sys.stderr = usual
