"""The port of ``exec:``: a process that plays a module, with the bytes of the line on its standard input and output.

Laws: nothing that the process does holds up the host: what it does not read, and what the host does not read, is lost
beyond `BUFFER` bytes, as on a real line. The process ends with the port.
"""

import os
import signal
import subprocess
from collections.abc import Sequence
from contextlib import suppress
from queue import Empty, Full, Queue
from threading import Condition, Thread
from typing import IO, cast

import serial

from i7000.arguments import as_bytes
from i7000.link.errors import LinkError

__all__ = ["BUFFER", "INIT_SWITCH", "ProcessPort"]

BUFFER = 1 << 16
"""The bytes that wait for the host, and for the process."""
INIT_SWITCH = "I7000_INIT"
"""The environment variable that is 1 if the power is switched on with the INIT switch set, or else 0."""
_PIECE = 4096
_MOST_PIECES = BUFFER // 64
_ENDING = 2.0
"""The longest time in seconds that a killed process and its threads take to end."""


class _Running:
    """A process with power: its pipes are read and written by threads of their own."""

    def __init__(self, command: Sequence[str], *, init_switch: bool) -> None:
        environment = os.environ | {INIT_SWITCH: str(int(init_switch))}
        self.process = subprocess.Popen(  # noqa: S603 - what the user named
            command,
            stdin=subprocess.PIPE,
            stdout=subprocess.PIPE,
            env=environment,
            bufsize=0,
            start_new_session=True,  # so that Ctrl-C does not end it, and its children end with it
        )
        self.heard = bytearray()
        self.changed = Condition()
        """Guards `heard` and `silent`."""
        self.silent = False
        """Whether the process has closed its output."""
        self._sending: Queue[bytes] = Queue(_MOST_PIECES)
        self.threads = [Thread(target=it, name="i7000 exec", daemon=True) for it in (self._hear, self._send)]
        for thread in self.threads:
            thread.start()

    def _hear(self) -> None:
        with cast(IO[bytes], self.process.stdout) as output:
            while data := output.read(_PIECE):
                with self.changed:
                    self.heard += data[: BUFFER - len(self.heard)]
                    self.changed.notify_all()
        with self.changed:
            self.silent = True
            self.changed.notify_all()

    def _send(self) -> None:
        with suppress(OSError), cast(IO[bytes], self.process.stdin) as pipe:
            while data := self._sending.get():
                while data:
                    data = data[pipe.write(data) :]

    def send(self, data: bytes) -> None:
        """Pass bytes to the process; they are lost if it does not read."""
        with suppress(Full):
            self._sending.put_nowait(data)

    def end(self) -> None:
        """Kill the process."""
        _kill(self.process)
        with suppress(Empty):
            while True:
                self._sending.get_nowait()
        self.send(b"")
        with suppress(subprocess.TimeoutExpired):
            self.process.wait(_ENDING)
        for thread in self.threads:
            thread.join(_ENDING)


def _kill(process: "subprocess.Popen[bytes]") -> None:
    """Kill a process and its children."""
    if hasattr(os, "killpg"):
        with suppress(ProcessLookupError, PermissionError):
            os.killpg(process.pid, signal.SIGKILL)
    else:  # pragma: no cover - Windows
        process.kill()


class ProcessPort(serial.SerialBase):
    """A serial port with a process at its other end, in real time; baud rate and parity have no effect.

    Shape: `command` is the program and its arguments; no shell reads them. Its standard error is that of this program.
    Special: `init_switch` counts at the next `power_cycle`, which starts the process again.
    Errors: `LinkError` for a program that cannot be started, and for a process that has ended.
    """

    def __init__(self, command: Sequence[str], *, init_switch: bool = False, timeout: float | None = None) -> None:
        super().__init__(None, timeout=timeout)
        self.name = f"exec:{command[0]}"
        self.command = tuple(command)
        self.init_switch = init_switch
        self._start()

    def power_cycle(self, *, init_switch: bool | None = None) -> None:
        """Kill the process, and start it again; what is on the line is lost.

        Shape: `init_switch` is the switch from now on; None leaves it as it is.
        """
        if init_switch is not None:
            self.init_switch = init_switch
        self._checked().end()
        self.is_open = False
        self._start()

    def _start(self) -> None:
        try:
            self._running = _Running(self.command, init_switch=self.init_switch)
        except (OSError, ValueError) as error:
            raise LinkError(f"{self.name}: {getattr(error, 'strerror', None) or error}") from None
        self.is_open = True

    def close(self) -> None:
        """Kill the process."""
        if self.is_open:
            self.is_open = False
            self._running.end()

    def read(self, size: int = 1) -> bytes:
        """Return `size` bytes of the output of the process, or fewer after `timeout`.

        Errors: `LinkError` if the process has closed its output and all of it is read.
        """
        running = self._checked()
        with running.changed:
            running.changed.wait_for(lambda: len(running.heard) >= size or running.silent, self.timeout)
            if size and running.silent and not running.heard:
                raise LinkError(f"{self.name}: the process has ended")
            data = bytes(running.heard[:size])
            del running.heard[:size]
        return data

    def write(self, data: object) -> int:
        """Pass bytes to the process; those that it does not read are lost."""
        wire = as_bytes("data", data)
        self._checked().send(wire)
        return len(wire)

    @property
    def in_waiting(self) -> int:
        """The number of bytes that can be read."""
        return len(self._checked().heard)

    def reset_input_buffer(self) -> None:
        """Drop the output so far."""
        running = self._checked()
        with running.changed:
            running.heard.clear()

    def flush(self) -> None:
        """Do nothing: the process reads when it likes."""

    reset_output_buffer = flush

    def _checked(self) -> _Running:
        if not self.is_open:
            raise serial.PortNotOpenError
        return self._running

    def _reconfigure_port(self) -> None:
        """Do nothing: pipes have no settings."""

    _update_rts_state = _update_dtr_state = _update_break_state = _reconfigure_port
