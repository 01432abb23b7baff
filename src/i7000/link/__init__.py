"""Lines and ports: requests over serial ports, networks, simulated modules and processes (extra ``serial``).

`Line` asks and runs procedures in a program without an event loop, `AsyncLine` in tasks of asyncio. `open_target` opens
what a text names: a device, a URL of pyserial, ``sim:`` or ``exec:``. `VirtualPort` is a serial port with simulated
modules in virtual time, for tests.
Parts: `conversation` is what both lines do, without I/O; `port` has the blocking calls of a port, `worker` makes them
in a thread. `guarded` is a port that refuses what is not allowed. `process` is the port of ``exec:``, `rfc2217` that of
``rfc2217:``. `observed` has what an observer hears.
The names below are imported when they are first used, since asyncio and the simulator take time to import.
"""

from typing import TYPE_CHECKING

from i7000.lazy import imported_at_use

if TYPE_CHECKING:
    from i7000.link.async_line import AsyncLine
    from i7000.link.bench import Bench, BenchError
    from i7000.link.errors import LinkError
    from i7000.link.guarded import BudgetError, GuardedPort
    from i7000.link.line import Line
    from i7000.link.observed import Abandoned, Asked, Happened, Observed, PowerCycled, Received, Tuned, Written
    from i7000.link.port import Port
    from i7000.link.process import ProcessPort
    from i7000.link.target import TargetOptions, open_target
    from i7000.link.virtual import VirtualPort

__all__ = [
    "Abandoned",
    "Asked",
    "AsyncLine",
    "Bench",
    "BenchError",
    "BudgetError",
    "GuardedPort",
    "Happened",
    "Line",
    "LinkError",
    "Observed",
    "Port",
    "PowerCycled",
    "ProcessPort",
    "Received",
    "TargetOptions",
    "Tuned",
    "VirtualPort",
    "Written",
    "open_target",
]

_PLACES = {
    "async_line": ("AsyncLine",),
    "bench": ("Bench", "BenchError"),
    "errors": ("LinkError",),
    "guarded": ("BudgetError", "GuardedPort"),
    "line": ("Line",),
    "observed": ("Abandoned", "Asked", "Happened", "Observed", "PowerCycled", "Received", "Tuned", "Written"),
    "port": ("Port",),
    "process": ("ProcessPort",),
    "target": ("TargetOptions", "open_target"),
    "virtual": ("VirtualPort",),
}
__getattr__ = imported_at_use(__name__, _PLACES)


def __dir__() -> list[str]:
    """Return the public names."""
    return sorted(__all__)
