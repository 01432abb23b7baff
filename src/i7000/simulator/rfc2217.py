"""A simulated bus over RFC 2217: hosts set their baud rate and parity, and wrong settings give garbage.

Sections: RFC 2217, 3 (the commands of the COM port option).
Laws: bytes sent before a setting are processed before the setting applies. The reply to a setting is the value in
effect: an unsupported value changes nothing, and the connection stays open.
"""

import asyncio
from contextlib import suppress
from typing import Any

from attrs import evolve, frozen

from i7000.device import Uart
from i7000.errors import InvalidValueError
from i7000.simulator.served import End
from i7000.simulator.tcp import Connection
from i7000.simulator.telnet import DO, WILL, Negotiation, Options, Telnet, escaped, subnegotiation

__all__ = ["Rfc2217Connection"]

_BINARY, _ECHO, _SUPPRESS_GO_AHEAD, _COM_PORT = 0, 1, 3, 44
_OURS = {_BINARY, _ECHO, _SUPPRESS_GO_AHEAD, _COM_PORT}
_THEIRS = {_BINARY, _SUPPRESS_GO_AHEAD, _COM_PORT}
_OFFERS = (WILL, _ECHO), (WILL, _SUPPRESS_GO_AHEAD), (DO, _BINARY), (WILL, _COM_PORT)

_SERVER = 100
"""The difference between the number of a reply and that of its command."""
_CONTROL, _LINE_STATE, _MODEM_STATE = 5, 6, 7
_NO_ERRORS = b"\0"
_READY = b"\xb0"
"""CTS, DSR and DCD are set."""


@frozen
class _Setting:
    """A setting of a port: the name of its `Uart` field, its length, and the values of its codes if they differ."""

    name: str
    size: int
    values: dict[int, Any] | None = None


_SETTINGS = {
    1: _Setting("rate", 4),
    2: _Setting("data_bits", 1),
    3: _Setting("parity", 1, {1: "N", 2: "O", 3: "E", 4: "M", 5: "S"}),
    4: _Setting("stop_bits", 1, {1: 1, 2: 2, 3: 1.5}),
}
_CONTROLS = {
    0: (1, 2, 3, 17, 19),
    4: (5, 6),
    7: (8, 9),
    10: (11, 12),
    13: (14, 15, 16, 18),
}
"""Requests for outbound flow control, break, DTR, RTS and inbound flow control, and the states of each."""
_AT_FIRST = {0: 1, 4: 6, 7: 8, 10: 11, 13: 14}
"""The initial states: no flow control, no break; DTR and RTS are set."""
_CONFIRMED = {10: range(0x100), 11: range(0x100), 12: range(1, 4)}
"""Commands that are only confirmed: the masks of line and modem state, and purging the buffers (always empty)."""


class Port:
    """The settings that a host makes for its end of the line."""

    def __init__(self, host: End) -> None:
        self._host = host
        self._controls = dict(_AT_FIRST)

    def answer(self, content: bytes) -> bytes:
        """Carry out a subnegotiation, and return the content of the reply; empty if there is none."""
        if len(content) <= 1 or content[0] != _COM_PORT:
            return b""
        command, value = content[1], content[2:]
        if command in _SETTINGS:
            said = self._set(_SETTINGS[command], value)
        elif command == _CONTROL and len(value) == 1:
            said = self._control(value[0])
        elif command in _CONFIRMED and len(value) == 1 and value[0] in _CONFIRMED[command]:
            said = value
        else:
            said = {_LINE_STATE: _NO_ERRORS, _MODEM_STATE: _READY}.get(command, b"")
        return bytes((_COM_PORT, _SERVER + command)) + said if said else b""

    def _set(self, setting: _Setting, value: bytes) -> bytes:
        """Change a setting, and return the value in effect; 0 only reads it."""
        uart: Any = self._host.uart
        if len(value) == setting.size:
            number = int.from_bytes(value)
            with suppress(InvalidValueError):
                wanted = number if setting.values is None else setting.values.get(number)
                self._host.uart = uart = evolve(uart, **{setting.name: wanted})
        now = getattr(uart, setting.name)
        if setting.values is not None:
            now = next(code for code, known in setting.values.items() if known == now)
        return int.to_bytes(now, setting.size)

    def _control(self, value: int) -> bytes:
        for request, states in _CONTROLS.items():
            if value in states:
                self._controls[request] = value
            if value == request or value in states:
                return bytes((self._controls[request],))
        return b""


class Rfc2217Connection(Connection):
    """A network connection of a host that uses RFC 2217."""

    def connection_made(self, transport: asyncio.BaseTransport) -> None:
        """Connect the host to the bus, and begin to negotiate."""
        super().connection_made(transport)
        self.host.uart = self.host.uart or Uart()
        self._port = Port(self.host)
        self._telnet = Telnet()
        self._options = Options(_OURS, _THEIRS)
        super().write(b"".join(self._options.offer(*offer) for offer in _OFFERS))

    def receive(self, data: bytes) -> None:
        """Process the data and settings that the host sends, in order."""
        for part in self._telnet.receive(data):
            if isinstance(part, bytes):
                super().receive(part)
            elif isinstance(part, Negotiation):
                self._negotiate(part)
            elif answer := self._port.answer(part.content):
                super().write(subnegotiation(answer))

    def _negotiate(self, negotiation: Negotiation) -> None:
        was_on = self._options.is_on(_COM_PORT)
        super().write(self._options.answer(negotiation))
        if self._options.is_on(_COM_PORT) and not was_on:
            super().write(subnegotiation(bytes((_COM_PORT, _SERVER + _MODEM_STATE)) + _READY))

    def write(self, data: bytes) -> None:
        """Send bytes to the host."""
        super().write(escaped(data))
