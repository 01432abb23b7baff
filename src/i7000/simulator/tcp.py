"""TCP, with the bytes as they are on the line.

Laws: a host that does not read loses what it is sent, as on a line; nothing waits for it. However much a host sends,
the others get their turn; however many hosts come, `MOST_CONNECTIONS` are served at a time.
"""

import asyncio
import errno
import os
import socket
from collections.abc import AsyncIterator
from contextlib import ExitStack, asynccontextmanager
from functools import partial
from ipaddress import ip_address
from typing import Any, cast

from i7000.simulator.simulator import UNREAD, Host, Simulator

__all__ = ["LOOPBACK", "MOST_CONNECTIONS", "Connection", "listen"]

LOOPBACK = "127.0.0.1"
MOST_CONNECTIONS = 64
"""Hosts that one listener serves at a time; the connections of further ones are closed at once."""
_MOST_UNREAD = 1 << 16
_AT_ONCE = 1024
"""Bytes of a host that are heard before it is another's turn."""
_PAUSE = 1.0
"""Seconds after which connections are accepted again, once one could not be."""
_ATTEMPTS = 10
"""Ports that are tried until one is free at all addresses."""
_UNAVAILABLE = errno.EAFNOSUPPORT, errno.EADDRNOTAVAIL
"""Errors of an address that a name has, and this machine does not, as where IPv6 is turned off."""


class Connection(asyncio.BufferedProtocol):
    """A host on the network, whose bytes are those of the line."""

    def __init__(self, simulator: Simulator, name: str, connections: "set[Connection]") -> None:
        """Make one that is in `connections` for as long as the host, whose address is `name`, is there."""
        self.simulator = simulator
        self.name = name
        self.connections = connections
        self.ended = False
        """Whether the host sends nothing more."""
        self._received = bytearray(_AT_ONCE)

    def connection_made(self, transport: asyncio.BaseTransport) -> None:
        """Connect the host to the bus."""
        self.transport = cast(asyncio.Transport, transport)
        self.host = Host(self.simulator, self.name, self.write)
        self.connections.add(self)

    def get_buffer(self, sizehint: int) -> bytearray:  # noqa: ARG002 - it is always the same
        """Tell where to put what the host sends."""
        return self._received

    def buffer_updated(self, nbytes: int) -> None:
        """Take what was put there."""
        self.receive(bytes(self._received[:nbytes]))

    def receive(self, data: bytes) -> None:
        """Take what the host sends."""
        self.host.receive(data)

    def eof_received(self) -> bool:
        """Close the connection once a host that sends nothing more has all its answers."""
        self.ended = True
        self.host.finish(self.transport.close)
        return True

    def connection_lost(self, exc: Exception | None) -> None:  # noqa: ARG002 - however it was lost
        """Forget the host."""
        self.host.close()
        self.connections.discard(self)

    def close(self) -> None:
        """Hang up."""
        self.connections.discard(self)
        self.transport.abort()

    def write(self, data: bytes) -> None:
        """Send to the host, unless it has not read for long, or is gone."""
        if self.transport.is_closing():
            return
        if self.transport.get_write_buffer_size() < _MOST_UNREAD:
            self.transport.write(data)
        else:
            self.simulator.notice(UNREAD)


@asynccontextmanager
async def listen(
    simulator: Simulator,
    host: str = LOOPBACK,
    port: int = 0,
    *,
    connection: type[Connection] = Connection,
) -> AsyncIterator[str]:
    """Wait for hosts on the network; the value is where: ``127.0.0.1:5020``.

    Shape: `host` is an address, or a name; empty or ``*`` is every address of this machine. Port 0 is any that is free.
        If the host has several addresses, all of them have the same port, and the value is the first, IPv4 before IPv6.
    Errors: `OSError` where it cannot.
    """
    with ExitStack() as opened:
        sockets = [opened.enter_context(one) for one in _bound(await _addresses(host, port))]
        places = [_place(one.getsockname()) for one in sockets]
        if not all(ip_address(one.getsockname()[0]).is_loopback for one in sockets):
            simulator.notice(f"{places[0]} can be reached from other machines")
        connections: set[Connection] = set()
        accepting = [asyncio.create_task(_accept(simulator, one, connections, connection)) for one in sockets]
        try:
            yield places[0]
        finally:
            for task in accepting:
                task.cancel()
            await asyncio.wait(accepting)
            for made in tuple(connections):
                made.close()


async def _accept(
    simulator: Simulator, listening: socket.socket, connections: set[Connection], connection: type[Connection]
) -> None:
    """Accept connections, as many as there is room for.

    Special: one that cannot be accepted, as there are no file descriptors, is left waiting for a while.
    """
    loop = asyncio.get_running_loop()
    while True:
        try:
            accepted, address = await loop.sock_accept(listening)
        except OSError as error:
            simulator.notice(f"connections are not accepted for {_PAUSE:g} s: {error.strerror}")
            await asyncio.sleep(_PAUSE)
            continue
        ended = next((one for one in connections if one.ended), None)
        if ended and len(connections) == MOST_CONNECTIONS:
            ended.close()  # Its host may be gone altogether, with late answers on their way.
        if len(connections) < MOST_CONNECTIONS:
            make = partial(connection, simulator, _place(address), connections)
            await loop.connect_accepted_socket(make, accepted)
        else:
            simulator.notice(f"a connection was refused: {MOST_CONNECTIONS} are open")
            accepted.close()
            await asyncio.sleep(0)  # It is the others' turn.


# --- places -----------------------------------------------------------------------------------------------------------

_Address = tuple[socket.AddressFamily, tuple[Any, ...]]


async def _addresses(host: str, port: int) -> list[_Address]:
    """Find the addresses of a host, IPv4 first."""
    name = None if host in ("", "*") else host
    try:
        found = await asyncio.get_running_loop().getaddrinfo(
            name, port, type=socket.SOCK_STREAM, flags=socket.AI_PASSIVE
        )
    except socket.gaierror as error:
        raise OSError(f"{host!r} is no host: {error.strerror}") from None
    except ValueError:
        raise OSError(f"{host!r} cannot be the name of a host") from None
    addresses = dict.fromkeys((family, address) for family, *_, address in found)
    return sorted(addresses, key=lambda it: it[0] is not socket.AF_INET)


def _bound(addresses: list[_Address], attempts: int = _ATTEMPTS) -> list[socket.socket]:
    """Listen at all addresses that this machine has, at one port.

    Errors: `OSError`.
    """
    with ExitStack() as opened:
        sockets: list[socket.socket] = []
        port = 0
        for family, (host, wanted, *others) in addresses:
            address = (host, wanted or port, *others)
            try:
                sockets.append(opened.enter_context(socket.create_server(address, family=family)))
            except OSError as error:
                if sockets and error.errno in _UNAVAILABLE:
                    continue
                if sockets and not wanted and attempts > 1:
                    return _bound(addresses, attempts - 1)
                reason = os.strerror(error.errno or 0)
                raise OSError(f"cannot listen at {_place(address)}: {reason}") from None
            sockets[-1].setblocking(False)
            port = sockets[-1].getsockname()[1]
        opened.pop_all()
    return sockets


def _place(address: tuple[Any, ...]) -> str:
    host, port, *_ = address
    return f"[{host}]:{port}" if ":" in host else f"{host}:{port}"
