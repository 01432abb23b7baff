"""Lines and ports: requests over serial ports, networks, simulated modules and processes (extra ``serial``).

`Line` asks and runs procedures in a program without an event loop, `AsyncLine` in tasks of asyncio. `open_target` opens
what a text names: a device, a URL of pyserial, ``sim:`` or ``exec:``. `VirtualPort` is a serial port with simulated
modules in virtual time, for tests.
Parts: `conversation` is what both lines do, without I/O; `port` has the blocking calls of a port; `process` is the port
of ``exec:``; `observed` has what an observer hears.
"""

from i7000.link.async_line import AsyncLine
from i7000.link.errors import LinkError
from i7000.link.line import Line
from i7000.link.observed import Abandoned, Asked, Happened, Observed, Received, Tuned, Written
from i7000.link.port import Port
from i7000.link.process import ProcessPort
from i7000.link.target import TargetOptions, open_target
from i7000.link.virtual import VirtualPort

__all__ = [
    "Abandoned",
    "Asked",
    "AsyncLine",
    "Happened",
    "Line",
    "LinkError",
    "Observed",
    "Port",
    "ProcessPort",
    "Received",
    "TargetOptions",
    "Tuned",
    "VirtualPort",
    "Written",
    "open_target",
]
