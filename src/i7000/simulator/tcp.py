"""Raw TCP connections to a simulated bus, or to another line that hosts are served with.

Laws: a host that does not read loses bytes, as on a real line; the simulator never waits for it. Hosts take turns,
however much one sends. At most `MOST_CONNECTIONS` hosts are served at a time.
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

from i7000.simulator.served import Served
from i7000.simulator.simulator import UNREAD

__all__ = ["LOOPBACK", "MOST_CONNECTIONS", "Connection", "listen"]

LOOPBACK = "127.0.0.1"
MOST_CONNECTIONS = 64
"""The number of hosts that one listener serves at a time; further connections are closed at once."""
_MOST_UNREAD = 1 << 16
_AT_ONCE = 1024
"""The number of bytes of a host that are processed before the next host."""
_PAUSE = 1.0
"""The seconds before connections are accepted again after an error."""
_ATTEMPTS = 10
"""The number of ports to try until one is free at all addresses."""
_UNAVAILABLE = errno.EAFNOSUPPORT, errno.EADDRNOTAVAIL
"""Errors of an address that a name has but this machine does not, for example without IPv6."""


class Connection(asyncio.BufferedProtocol):
    """A network connection of a host that sends and receives raw bytes."""

    def __init__(self, simulator: Served, name: str, connections: "set[Connection]") -> None:
        """Create a connection that is in `connections` while the host, whose address is `name`, is connected."""
        self.simulator = simulator
        self.name = name
        self.connections = connections
        self.ended = False
        """Whether the host has closed its sending side."""
        self._received = bytearray(_AT_ONCE)

    def connection_made(self, transport: asyncio.BaseTransport) -> None:
        """Connect the host to the bus."""
        self.transport = cast(asyncio.Transport, transport)
        self.host = self.simulator.host(self.name, self.write)
        self.connections.add(self)

    def get_buffer(self, sizehint: int) -> bytearray:  # noqa: ARG002 - it is always the same
        """Return the buffer for the next bytes of the host."""
        return self._received

    def buffer_updated(self, nbytes: int) -> None:
        """Process the bytes in the buffer."""
        self.receive(bytes(self._received[:nbytes]))

    def receive(self, data: bytes) -> None:
        """Process the bytes that the host sends."""
        self.host.receive(data)

    def eof_received(self) -> bool:
        """Close the connection once a host that sends nothing more has all its responses."""
        self.ended = True
        self.host.finish(self.transport.close)
        return True

    def connection_lost(self, exc: Exception | None) -> None:  # noqa: ARG002 - however it was lost
        """Remove the host."""
        self.host.close()
        self.connections.discard(self)

    def close(self) -> None:
        """Close the connection."""
        self.connections.discard(self)
        self.transport.abort()

    def write(self, data: bytes) -> None:
        """Send bytes to the host, unless it reads too slowly or is disconnected."""
        if self.transport.is_closing():
            return
        if self.transport.get_write_buffer_size() < _MOST_UNREAD:
            self.transport.write(data)
        else:
            self.simulator.notice(UNREAD)


@asynccontextmanager
async def listen(
    simulator: Served,
    host: str = LOOPBACK,
    port: int = 0,
    *,
    connection: type[Connection] = Connection,
) -> AsyncIterator[str]:
    """Listen for hosts on the network; the value is the place: ``127.0.0.1:5020``.

    Shape: `host` is an address, or a name; empty or ``*`` is every address of this machine. Port 0 selects a free port.
        If the host has several addresses, all of them use the same port, and the value is the first, IPv4 before IPv6.
    Errors: `OSError` if listening fails.
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
    simulator: Served, listening: socket.socket, connections: set[Connection], connection: type[Connection]
) -> None:
    """Accept connections, up to the limit.

    Special: a connection that cannot be accepted, for example without free file descriptors, waits for a while.
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
    """Return the addresses of a host, IPv4 first."""
    name = None if host in ("", "*") else host
    try:
        found = await asyncio.get_running_loop().getaddrinfo(
            name, port, type=socket.SOCK_STREAM, flags=socket.AI_PASSIVE
        )
    except socket.gaierror as error:
        raise OSError(f"{host!r} is not a host: {error.strerror}") from None
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
