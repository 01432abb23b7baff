"""A driver under test: a program that is started, or one that somebody else runs; and the lines of its output.

Laws: no more than `MOST_LINES` lines and the end of the error output are kept. A program that is started is ended.
"""

import asyncio
import os
import signal
import stat
import sys
from collections.abc import AsyncIterator, Callable, Sequence
from contextlib import asynccontextmanager, suppress
from threading import Event, Thread

from i7000.cli.control import LONGEST_LINE, Lines
from i7000.cli.words import UsageError
from i7000.conformance.believed import Unreadable, read
from i7000.conformance.provoked import Ended, Line

__all__ = ["MOST_LINES", "Driver", "followed", "started"]

MOST_LINES = 100_000
_AT_ONCE = 1 << 16
_PATIENCE = 2.0
"""The seconds in which a program has to end after it was asked to."""
_PAUSE = 0.05
"""The seconds between two looks at a file that grows."""
_KEPT = 2000
_LONG = Unreadable(f"a line has at most {LONGEST_LINE} bytes")
_MANY = Unreadable(f"there are more than {MOST_LINES} lines")


class Driver:
    """The output of a driver so far, and its end."""

    def __init__(self, clock: Callable[[], float]) -> None:
        self._clock = clock
        self._text = Lines()
        self._count = 0
        self.lines: list[Line] = []
        self.ended: Ended | None = None
        self.complaints = b""
        """The end of its error output."""

    def feed(self, data: bytes) -> None:
        """Read what it has written."""
        for text in self._text.feed(data):
            self._count += 1
            said = _LONG if text is None else read(text)
            if said is not None and len(self.lines) <= MOST_LINES:
                said = said if len(self.lines) < MOST_LINES else _MANY
                self.lines.append(Line(self._clock(), self._count, said))

    def complain(self, data: bytes) -> None:
        """Keep the end of what it has written to its error output."""
        self.complaints = (self.complaints + data)[-_KEPT:]

    def end(self, words: str) -> None:
        """Note its end."""
        self.feed(b"\n")
        self.ended = self.ended or Ended(self._clock(), words)


# --- a program --------------------------------------------------------------------------------------------------------


@asynccontextmanager
async def started(command: Sequence[str], clock: Callable[[], float]) -> AsyncIterator[Driver]:
    """Start a program, and end it at the end.

    Special: in its environment, ``PYTHONUNBUFFERED`` is set: a line that is not written yet would look missing.
    Errors: `OSError` if it cannot be started.
    """
    driver = Driver(clock)
    process = await asyncio.create_subprocess_exec(
        *command,
        stdin=asyncio.subprocess.DEVNULL,
        stdout=asyncio.subprocess.PIPE,
        stderr=asyncio.subprocess.PIPE,
        env={**os.environ, "PYTHONUNBUFFERED": "1"},
        start_new_session=True,
    )
    reading = asyncio.gather(
        _read(process.stdout, driver.feed), _read(process.stderr, driver.complain), _wait(process, driver)
    )
    try:
        yield driver
    finally:
        await _end(process)
        reading.cancel()
        with suppress(asyncio.CancelledError):
            await reading


async def _read(stream: asyncio.StreamReader | None, take: Callable[[bytes], None]) -> None:
    while stream is not None and (data := await stream.read(_AT_ONCE)):
        take(data)


async def _wait(process: asyncio.subprocess.Process, driver: Driver) -> None:
    code = await process.wait()
    await asyncio.sleep(_PAUSE)  # What it wrote last is read meanwhile.
    driver.end(f"the driver ended with exit code {code}")


async def _end(process: asyncio.subprocess.Process) -> None:
    """End a program and what it has started, first kindly."""
    for number in (signal.SIGTERM, getattr(signal, "SIGKILL", signal.SIGTERM)):
        with suppress(ProcessLookupError, PermissionError):
            getattr(os, "killpg", os.kill)(process.pid, number)
        with suppress(TimeoutError):
            await asyncio.wait_for(process.wait(), _PATIENCE)
            return


# --- a file -----------------------------------------------------------------------------------------------------------


@asynccontextmanager
async def followed(output: str, clock: Callable[[], float]) -> AsyncIterator[Driver]:
    """Follow a file to which a driver writes, from now on; ``-`` is standard input.

    Errors: `UsageError` without a standard input; `OSError` if the file cannot be opened.
    """
    driver, loop, stopped = Driver(clock), asyncio.get_running_loop(), Event()
    if output == "-":
        if sys.stdin is None:
            raise UsageError("there is no standard input: give --driver-output a file")
        descriptor, grows = os.dup(sys.stdin.fileno()), False
    else:
        descriptor = os.open(output, os.O_RDONLY | getattr(os, "O_NONBLOCK", 0))
        grows = stat.S_ISREG(os.fstat(descriptor).st_mode)
        if grows:
            os.lseek(descriptor, 0, os.SEEK_END)
        os.set_blocking(descriptor, True)

    def follow() -> None:
        with suppress(RuntimeError, OSError), os.fdopen(descriptor, "rb", 0):  # The loop or the terminal is gone.
            began = False
            while True:
                data = os.read(descriptor, _AT_ONCE)
                if data:
                    began = True
                    loop.call_soon_threadsafe(driver.feed, data)
                elif began and not grows:
                    loop.call_soon_threadsafe(driver.end, "the driver's output ended")
                    return
                elif stopped.wait(_PAUSE):  # A named pipe may have no writer yet.
                    return
                elif grows and os.fstat(descriptor).st_size < os.lseek(descriptor, 0, os.SEEK_CUR):
                    os.lseek(descriptor, 0, os.SEEK_SET)  # It was emptied, as a shell does that writes to it.

    Thread(target=follow, name="i7000 driver", daemon=True).start()
    try:
        yield driver
    finally:
        stopped.set()
