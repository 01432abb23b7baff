"""The entry point of the program ``i7000``: Ctrl-C and a closed pipe end it at any moment without a traceback.

It is outside the package because importing the package takes a large part of the time of a short command, and code
inside the package could not handle Ctrl-C during the import. For the same reason it imports very little.
"""

import os
import sys

INTERRUPTED = 130
"""The exit code after Ctrl-C: 128 and the number of the signal, as in a shell."""
FAILED = 2
"""The exit code if the output cannot be written, for example on a full disk, and for wrong usage."""
CLOSED = 141
"""The exit code if the reader closes the output early, as in ``| head -1``: that of a broken pipe."""

_ROOM = 1 << 16
"""The output is written in pieces of this many bytes: each write takes as long as many lines."""

try:
    import signal
    from contextlib import suppress
except KeyboardInterrupt:  # pragma: no cover
    os._exit(INTERRUPTED)

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Callable
    from typing import TextIO

__all__ = ["CLOSED", "INTERRUPTED", "end_at_ctrl_c", "main", "program", "roomy"]


def main() -> int:
    """Run the command line, and return the exit code of the process."""

    def run() -> int:
        from i7000.cli import main as command_line  # noqa: PLC0415 - when Ctrl-C is taken care of

        return command_line()

    sys.stdout = roomy(sys.stdout)
    return program(run)


def roomy(output: "TextIO | None") -> "TextIO | None":
    """Return a stream with a larger buffer; that of a terminal, which shows each line, is returned unchanged."""
    try:
        if output is None or output.isatty():
            return output
        descriptor = output.fileno()
    except OSError:  # It is not a file of the system.
        return output
    return open(descriptor, "w", _ROOM, output.encoding, output.errors, closefd=False)


def program(run: "Callable[[], int]") -> int:
    """Run a program, and return the exit code of the process.

    Special: Ctrl-C ends the process immediately, unless `run` installs another handler. After `run` it has no effect.
    """
    end_at_ctrl_c()
    code = run()
    signal.signal(signal.SIGINT, signal.SIG_IGN)
    failure = _flushed(sys.stdout)
    if isinstance(failure, BrokenPipeError):
        code = CLOSED
    elif failure is not None:
        if code != FAILED and sys.stderr is not None:  # else it was reported when it happened
            with suppress(OSError):
                sys.stderr.write(f"the output cannot be written: {failure.strerror}\n")
        code = FAILED
    _flushed(sys.stderr)
    return code


def _flushed(file: "TextIO | None") -> "OSError | None":
    """Write what is left for a file; return why that fails, and discard it then, before Python tries when it ends."""
    if file is None:
        return None
    try:
        file.flush()
    except OSError as error:
        nowhere = os.open(os.devnull, os.O_WRONLY)
        os.dup2(nowhere, file.fileno())
        return error
    return None


def end_at_ctrl_c() -> None:
    """Make Ctrl-C end the process immediately, unless it is ignored, as in a background job."""
    if signal.getsignal(signal.SIGINT) is signal.default_int_handler:
        signal.signal(signal.SIGINT, _end)


def _end(*_: object) -> None:
    """End the process; an exception could be raised where Python only prints it and continues."""
    try:
        sys.stdout.flush()
    finally:  # whether or not there is an output that can be written now
        os._exit(INTERRUPTED)


if __name__ == "__main__":
    sys.exit(main())
