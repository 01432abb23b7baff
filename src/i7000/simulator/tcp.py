"""TCP, with the bytes as they are on the line.

Laws: a host that does not read loses what it is sent, as on a line; nothing waits for it. However much a host sends,
the others get their turn.
"""

import asyncio
from collections.abc import AsyncIterator
from contextlib import asynccontextmanager
from typing import Any, cast

from i7000.simulator.simulator import Host, Simulator

__all__ = ["LOOPBACK", "Connection", "listen"]

LOOPBACK = "127.0.0.1"
_MOST_UNREAD = 1 << 16
_AT_ONCE = 1024
"""Bytes of a host that are heard before it is another's turn."""


class Connection(asyncio.BufferedProtocol):
    """A host on the network, whose bytes are those of the line."""

    def __init__(self, simulator: Simulator, connections: "set[Connection]") -> None:
        """Make one that is in `connections` for as long as the host is there."""
        self.simulator = simulator
        self.connections = connections
        self._received = bytearray(_AT_ONCE)

    def connection_made(self, transport: asyncio.BaseTransport) -> None:
        """Connect the host to the bus."""
        self.transport = cast(asyncio.Transport, transport)
        self.host = Host(self.simulator, _place(transport.get_extra_info("peername")), self.write)
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

    def connection_lost(self, exc: Exception | None) -> None:  # noqa: ARG002 - however it was lost
        """Forget the host."""
        self.host.close()
        self.connections.discard(self)

    def close(self) -> None:
        """Hang up."""
        self.transport.abort()

    def write(self, data: bytes) -> None:
        """Send to the host, unless it has not read for long, or is gone."""
        if not self.transport.is_closing() and self.transport.get_write_buffer_size() < _MOST_UNREAD:
            self.transport.write(data)


@asynccontextmanager
async def listen(
    simulator: Simulator,
    host: str = LOOPBACK,
    port: int = 0,
    *,
    connection: type[Connection] = Connection,
) -> AsyncIterator[str]:
    """Wait for hosts on the network; the value is where: ``127.0.0.1:5020``.

    Shape: port 0 is any that is free.
    Errors: `OSError` where it cannot.
    """
    connections: set[Connection] = set()
    loop = asyncio.get_running_loop()
    try:
        server = await loop.create_server(lambda: connection(simulator, connections), host, port)
    except UnicodeError:
        raise OSError(f"{host!r} cannot be the name of a host") from None
    try:
        yield _place(server.sockets[0].getsockname())
    finally:
        server.close()
        for one in connections:
            one.close()


def _place(address: tuple[Any, ...]) -> str:
    host, port, *_ = address
    return f"[{host}]:{port}" if ":" in host else f"{host}:{port}"
