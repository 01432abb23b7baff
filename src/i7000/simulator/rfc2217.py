"""A simulated bus behind RFC 2217: hosts set their baud rate and parity, and the wrong ones get garbage (pyserial)."""

import asyncio
from types import SimpleNamespace
from typing import Any

from attrs import evolve
from serial.rfc2217 import PortManager

from i7000.device import Uart
from i7000.simulator.simulator import Host
from i7000.simulator.tcp import Connection

__all__ = ["Rfc2217Connection"]

_LONGEST_SUBOPTION = 256


class Port:
    """What `PortManager` takes for a serial port: settings of a host's end of the line.

    Errors: `EncodeError`, which is a `ValueError`, for a setting that no port has.
    """

    xonxoff = rtscts = dtr = rts = break_condition = ri = False
    cts = dsr = cd = True

    def __init__(self, host: Host) -> None:
        self.host = host
        host.uart = Uart()

    @property
    def baudrate(self) -> int:
        """Bits per second."""
        return self._uart.rate

    @baudrate.setter
    def baudrate(self, rate: int) -> None:
        self.host.uart = evolve(self._uart, rate=rate)

    @property
    def bytesize(self) -> int:
        """Data bits."""
        return self._uart.data_bits

    @bytesize.setter
    def bytesize(self, bits: int) -> None:
        self.host.uart = evolve(self._uart, data_bits=bits)

    @property
    def parity(self) -> str:
        """``N``, ``E``, ``O``, ``M`` or ``S``."""
        return self._uart.parity

    @parity.setter
    def parity(self, parity: str) -> None:
        self.host.uart = evolve(self._uart, parity=parity)

    @property
    def stopbits(self) -> float:
        """Stop bits."""
        return self._uart.stop_bits

    @stopbits.setter
    def stopbits(self, bits: float) -> None:
        self.host.uart = evolve(self._uart, stop_bits=bits)

    @property
    def _uart(self) -> Uart:
        return self.host.uart or Uart()

    def reset_input_buffer(self) -> None:
        """Forget what came in: nothing is kept."""

    def reset_output_buffer(self) -> None:
        """Forget what is to go out: nothing is kept."""


class Rfc2217Connection(Connection):
    """A host on the network, whose bytes are those of RFC 2217."""

    def connection_made(self, transport: asyncio.BaseTransport) -> None:
        """Connect the host to the bus, and begin to negotiate."""
        super().connection_made(transport)
        port: Any = Port(self.host)
        network: Any = SimpleNamespace(write=super().write)
        self.manager = PortManager(port, network)

    def receive(self, data: bytes) -> None:
        """Take what the host sends and sets."""
        try:
            sent = b"".join(self.manager.filter(data))
        except Exception:  # noqa: BLE001 - what `PortManager` raises for bytes that are not RFC 2217
            self.close()
            return
        if len(self.manager.suboption or b"") > _LONGEST_SUBOPTION:
            self.close()
        elif sent:
            super().receive(sent)

    def write(self, data: bytes) -> None:
        """Send to the host."""
        super().write(b"".join(self.manager.escape(data)))
