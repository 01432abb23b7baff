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


def _setting(name: str) -> property:
    """Make a setting of `Port` of what its host's `Uart` calls `name`."""

    def get(port: "Port") -> Any:  # noqa: ANN401 - of any setting
        return getattr(port.host.uart, name)

    def put(port: "Port", value: object) -> None:
        uart: Any = port.host.uart
        port.host.uart = evolve(uart, **{name: value})

    return property(get, put)


class Port:
    """What `PortManager` takes for a serial port: settings of a host's end of the line.

    Errors: `EncodeError`, which is a `ValueError`, for a setting that no port has.
    """

    xonxoff = rtscts = dtr = rts = break_condition = ri = False
    cts = dsr = cd = True
    baudrate = _setting("rate")
    bytesize = _setting("data_bits")
    parity = _setting("parity")
    stopbits = _setting("stop_bits")

    def __init__(self, host: Host) -> None:
        self.host = host
        host.uart = Uart()

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
