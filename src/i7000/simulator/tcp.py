"""TCP, with the bytes as they are on the line.

Laws: a host that does not read loses what it is sent, as on a line; nothing waits for it.
"""

import asyncio
from collections.abc import AsyncIterator
from contextlib import asynccontextmanager
from typing import cast

from i7000.simulator.simulator import Host, Simulator

__all__ = ["LOOPBACK", "Connection", "listen"]

LOOPBACK = "127.0.0.1"
_MOST_UNREAD = 1 << 16


class Connection(asyncio.Protocol):
    """A host on the network, whose bytes are those of the line."""

    def __init__(self, simulator: Simulator, connections: "set[Connection]") -> None:
        """Make one that is in `connections` for as long as the host is there."""
        self.simulator = simulator
        self.connections = connections

    def connection_made(self, transport: asyncio.BaseTransport) -> None:
        """Connect the host to the bus."""
        self.transport = cast(asyncio.Transport, transport)
        host, port, *_ = transport.get_extra_info("peername")
        self.host = Host(self.simulator, f"{host}:{port}", self.write)
        self.connections.add(self)

    def data_received(self, data: bytes) -> None:
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
        """Send to the host, unless it has not read for long."""
        if self.transport.get_write_buffer_size() < _MOST_UNREAD:
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
    server = await asyncio.get_running_loop().create_server(lambda: connection(simulator, connections), host, port)
    try:
        address, found, *_ = server.sockets[0].getsockname()
        yield f"[{address}]:{found}" if ":" in address else f"{address}:{found}"
    finally:
        server.close()
        for one in connections:
            one.close()
