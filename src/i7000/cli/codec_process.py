"""A process that answers line by line: what it reads is JSON, and so is what it writes.

Laws: nothing that the process does holds up the kit, and nothing fills its memory: lines are read up to a limit, then
the process waits; of its standard error the end is kept. A process that is ended takes its children with it.
"""

import os
import signal
import subprocess
from collections import deque
from collections.abc import Sequence
from contextlib import suppress
from queue import SimpleQueue
from threading import Condition, Thread
from typing import IO, cast

from i7000.conformance.vector_verdicts import LONGEST_LINE, MessageError, Reason

__all__ = ["KEPT_ERRORS", "MOST_LINES", "CodecProcess"]

MOST_LINES = 256
"""The lines that are read ahead."""
KEPT_ERRORS = 4096
"""The bytes of standard error that are kept: the last ones."""
_PIECE = 1 << 16
_ENDING = 2.0
"""The longest time in seconds that a killed process and its threads take to end."""


class CodecProcess:
    """A running implementation.

    Errors: `OSError` and `ValueError` for a program that cannot be started.
    """

    def __init__(self, command: Sequence[str]) -> None:
        self._process = subprocess.Popen(  # noqa: S603 - what the user named
            command,
            stdin=subprocess.PIPE,
            stdout=subprocess.PIPE,
            stderr=subprocess.PIPE,
            bufsize=0,
            start_new_session=True,  # so that Ctrl-C does not end it, and its children end with it
        )
        self._changed = Condition()
        """Guards what follows."""
        self._lines: deque[bytes] = deque()
        self._fault: MessageError | None = None
        """What comes after the lines."""
        self._errors = b""
        self._ended = False
        self._sending: SimpleQueue[bytes] = SimpleQueue()
        self._threads = [
            Thread(target=it, name="i7000 vectors", daemon=True) for it in (self._hear, self._hear_errors, self._send)
        ]
        for thread in self._threads:
            thread.start()

    def send(self, line: bytes) -> None:
        """Pass a line to the process, without waiting."""
        self._sending.put(line)

    def receive(self, seconds: float) -> bytes:
        """Return the next line of the process.

        Errors: `MessageError` if none comes in time, the process has ended, or the line is too long.
        """
        with self._changed:
            if not self._changed.wait_for(lambda: self._lines or self._fault, seconds):
                raise MessageError(Reason.TIMEOUT, f"no answer in {seconds:g} s: is each line flushed?")
            self._changed.notify_all()
            if self._lines:
                return self._lines.popleft()
            assert self._fault is not None  # noqa: S101 - that was waited for
            raise self._fault

    def errors(self) -> str:
        """Return the end of the standard error of the process."""
        with self._changed:
            return self._errors.decode("utf-8", "backslashreplace").strip()

    def finish(self, seconds: float) -> str:
        """Wait until the process ends by itself; return what is wrong with how it does, or nothing."""
        self.send(b"")
        with self._changed:
            surplus = self._changed.wait_for(lambda: self._lines or self._fault, seconds) and self._lines
        if surplus:
            return "it writes more after the last answer"
        try:
            code = self._process.wait(seconds)
        except subprocess.TimeoutExpired:
            return f"it does not end within {seconds:g} s after stop"
        return f"it ends with exit code {code} after stop" if code else ""

    def kill(self) -> None:
        """Kill the process and its children."""
        if hasattr(os, "killpg"):
            with suppress(ProcessLookupError, PermissionError):
                os.killpg(self._process.pid, signal.SIGKILL)
        else:  # pragma: no cover - Windows
            self._process.kill()
        with self._changed:
            self._ended = True
            self._changed.notify_all()
        self.send(b"")
        with suppress(subprocess.TimeoutExpired):
            self._process.wait(_ENDING)
        for thread in self._threads:
            thread.join(_ENDING)

    # --- threads ------------------------------------------------------------------------------------------------------

    def _hear(self) -> None:
        with cast(IO[bytes], self._process.stdout) as output:
            fault = self._read_lines(output)
        with self._changed:
            self._fault = fault
            self._changed.notify_all()

    def _read_lines(self, output: IO[bytes]) -> MessageError:
        """Read lines until the end, or until one is too long; return what ended it."""
        heard = b""
        while data := output.read(_PIECE):
            *lines, heard = (heard + data).split(b"\n")
            for line in lines:
                if len(line) >= LONGEST_LINE or not self._take(line):
                    return _too_long()
            if len(heard) >= LONGEST_LINE:
                return _too_long()
        half = f", after half a line of {len(heard)} bytes" if heard else ""
        return MessageError(Reason.DIED, f"the process has closed its output{half}")

    def _take(self, line: bytes) -> bool:
        """Keep a line, once there is room; return False if the process was ended before."""
        with self._changed:
            self._changed.wait_for(lambda: self._ended or len(self._lines) < MOST_LINES)
            self._lines.append(line)
            self._changed.notify_all()
            return not self._ended

    def _hear_errors(self) -> None:
        with cast(IO[bytes], self._process.stderr) as output:
            while data := output.read(_PIECE):
                with self._changed:
                    self._errors = (self._errors + data)[-KEPT_ERRORS:]

    def _send(self) -> None:
        with suppress(OSError), cast(IO[bytes], self._process.stdin) as pipe:
            while data := self._sending.get():
                while data:
                    data = data[pipe.write(data) :]


def _too_long() -> MessageError:
    return MessageError(Reason.TOO_LONG, f"a line of more than {LONGEST_LINE} bytes")
