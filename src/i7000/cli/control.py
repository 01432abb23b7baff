"""Commands to a running simulation: one a line, each answered by one line, ``ok`` or ``error``.

Laws: any line has an answer. Files are read in another thread, so that no command holds up the line. At most
`MOST_CONNECTIONS` programs are connected at a time, and of a line `LONGEST_LINE` bytes are kept.
"""

import asyncio
import os
import socket
import sys
from collections.abc import AsyncIterator, Awaitable, Callable, Iterator, Mapping
from contextlib import asynccontextmanager, suppress
from pathlib import Path
from threading import Thread
from typing import Any, Protocol

from attrs import frozen

from i7000.cli.faults import faults_words, read_faults
from i7000.cli.text import escaped, undecodable_as_bytes
from i7000.cli.words import UsageError
from i7000.errors import I7000Error
from i7000.link.worker import done_in
from i7000.simulator.faults import Faults

__all__ = ["LONGEST_LINE", "MOST_CONNECTIONS", "Command", "Control", "Lines", "follow_input", "listening"]

LONGEST_LINE = 1000
MOST_CONNECTIONS = 8
_AT_ONCE = 1024
_PATIENCE = 1.0
"""The seconds that the end waits until the last answers are sent."""
_LONG = f"error: a line has at most {LONGEST_LINE} bytes"


class Faulty(Protocol):
    """A line with faults."""

    faults: Faults

    def end(self) -> None:
        """End it."""


@frozen
class Command:
    """A command: its syntax, and what carries out its arguments and returns what to add to ``ok``."""

    syntax: str
    run: Callable[[str], Awaitable[str]]


class Control:
    """The commands to a line: those given, ``fault`` and ``quit``."""

    def __init__(self, line: Faulty, commands: Mapping[str, Command] | None = None) -> None:
        self.line = line
        self._commands = {
            **(commands or {}),
            "fault": Command("fault [off | NAME=PROBABILITY[@WHERE]...]", self._fault),
            "quit": Command("quit", self._quit),
        }
        self._turn = asyncio.Lock()

    async def answer(self, line: str) -> str:
        """Carry out a command, and return the line that answers it."""
        name, _, arguments = line.strip().partition(" ")
        command = self._commands.get(name)
        if command is None:
            known = "; ".join(it.syntax for it in self._commands.values())
            return escaped(undecodable_as_bytes(f"error: {name!r} is not a command; commands are {known}"))
        try:
            async with self._turn:
                said = await command.run(arguments.strip())
        except (UsageError, I7000Error, OSError) as error:
            return escaped(undecodable_as_bytes(f"error: {error}"))
        return escaped(f"ok {said}".rstrip())

    async def _fault(self, text: str) -> str:
        if text == "off":
            self.line.faults = Faults()
        else:
            self.line.faults = read_faults(text.split(), self.line.faults)
        return faults_words(self.line.faults)

    async def _quit(self, text: str) -> str:
        if text:
            raise UsageError("quit has no arguments")
        self.line.end()
        return ""


class Lines:
    """The lines in a stream of bytes; those that are too long are None."""

    def __init__(self) -> None:
        self._rest = b""
        self._long = False

    def feed(self, data: bytes) -> Iterator[str | None]:
        r"""Return the lines that are complete now.

        >>> lines = Lines()
        >>> list(lines.feed(b"fault off\nqu")), list(lines.feed(b"it\n" + b"x" * 2000)), list(lines.feed(b"x\n"))
        (['fault off'], ['quit'], [None])
        """
        *whole, rest = (self._rest + data).split(b"\n")
        found = []
        for line in whole:
            found.append(None if self._long or len(line) > LONGEST_LINE else line.decode("utf-8", "surrogateescape"))
            self._long = False
        self._long = self._long or len(rest) > LONGEST_LINE
        self._rest = b"" if self._long else rest
        return iter(found)

    def end(self) -> Iterator[str | None]:
        """Return the last line, which has no end."""
        return self.feed(b"\n") if self._rest or self._long else iter(())


async def _answers(control: Control, lines: Iterator[str | None]) -> AsyncIterator[str]:
    for line in lines:
        yield _LONG if line is None else await control.answer(line)


# --- a socket ---------------------------------------------------------------------------------------------------------


@asynccontextmanager
async def listening(control: Control, path: Path) -> AsyncIterator[None]:
    """Listen for programs at a Unix socket, which only the user can connect to; it is deleted at the end.

    Errors: `UsageError` if there is another file, or if this system has no such sockets; `OSError`.
    """
    start = getattr(asyncio, "start_unix_server", None)
    if start is None:
        raise UsageError("this system has no Unix sockets: give --control -")
    connections: set[asyncio.Task[None]] = set()

    async def serve(reader: asyncio.StreamReader, writer: asyncio.StreamWriter) -> None:
        task = asyncio.current_task()
        if task is None or len(connections) >= MOST_CONNECTIONS:
            writer.write(f"error: {MOST_CONNECTIONS} programs are connected\n".encode())
            writer.close()
            return
        connections.add(task)
        try:
            with suppress(asyncio.CancelledError):  # which asyncio would print
                await _serve(control, reader, writer)
        finally:
            connections.discard(task)
            writer.close()

    bound = _bound(path)
    try:
        server = await start(serve, sock=bound, limit=_AT_ONCE)
        try:
            yield
        finally:
            server.close()
            await asyncio.sleep(0)  # The answer to ``quit`` is written before its connection ends.
            for task in tuple(connections):
                task.cancel()
            if connections:
                await asyncio.wait(connections, timeout=_PATIENCE)
    finally:
        bound.close()
        _forget(path)


def _forget(path: Path) -> None:
    path.unlink(missing_ok=True)


async def _serve(control: Control, reader: asyncio.StreamReader, writer: asyncio.StreamWriter) -> None:
    """Answer one program until it disconnects; one that does not read its answers gets no more."""
    lines = Lines()
    with suppress(ConnectionError):
        while data := await reader.read(_AT_ONCE):
            async for answer in _answers(control, lines.feed(data)):
                writer.write(f"{answer}\n".encode("utf-8", "backslashreplace"))
                await writer.drain()
        async for answer in _answers(control, lines.end()):
            writer.write(f"{answer}\n".encode("utf-8", "backslashreplace"))


def _bound(path: Path) -> socket.socket:
    """Return a socket at a path, in place of one that nobody listens at any more."""
    if path.is_socket():
        with socket.socket(socket.AF_UNIX) as other:
            other.settimeout(_PATIENCE)
            try:
                other.connect(str(path))
            except ConnectionRefusedError:
                path.unlink()
            else:
                raise UsageError(f"{path}: another program listens there")
    elif path.exists():
        raise UsageError(f"{path} exists and is not a socket: give another path, or -")
    bound = socket.socket(socket.AF_UNIX)
    mask = os.umask(0o177)
    try:
        bound.bind(str(path))
    except OSError as error:
        bound.close()
        raise UsageError(f"{path}: {error.strerror or error}") from None
    finally:
        os.umask(mask)
    return bound


# --- standard input ---------------------------------------------------------------------------------------------------


def follow_input(control: Control, write: Callable[[str], None]) -> None:
    """Start to carry out the lines of standard input, in a thread; `write` is called in the loop with each answer.

    Special: the end of the input is ``quit``.
    """
    loop = asyncio.get_running_loop()
    read = _reader()

    async def carry_out(found: Iterator[str | None]) -> None:
        async for answer in _answers(control, found):
            write(answer)

    def follow() -> None:
        lines = Lines()
        while data := read():
            if not done_in(loop, carry_out(lines.feed(data))):
                return
        if done_in(loop, carry_out(lines.end())):
            with suppress(RuntimeError):  # The loop has ended.
                loop.call_soon_threadsafe(control.line.end)

    Thread(target=follow, name="i7000 control", daemon=True).start()


def _reader() -> Callable[[], bytes]:
    """Return a function that waits for bytes of standard input.

    Special: it reads the descriptor, since Python cannot end while a thread waits in a buffer of `sys.stdin`.
    """
    if sys.stdin is None:
        raise UsageError("there is no standard input: give --control a path")
    try:
        descriptor = sys.stdin.fileno()
    except (OSError, ValueError):
        buffer: Any = sys.stdin.buffer
        return lambda: buffer.read1(_AT_ONCE)

    def read() -> bytes:
        try:
            return os.read(descriptor, _AT_ONCE)
        except OSError:  # The terminal is gone.
            return b""

    return read
