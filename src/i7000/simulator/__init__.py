"""A simulated bus to try drivers without hardware (extra ``simulator``).

In a test without an event loop::

    from i7000 import Model
    from i7000.simulator import Faults, simulate

    with simulate(Model.I_7018, faults=Faults(late=0.1)) as url:
        ...  # give url to your driver
        url.power_cycle()
        url.faults = Faults()

In an event loop: ``async with listen(Simulator(modules)) as place``. `Host` needs neither port nor network.

Parts: `simulator` is the bus and its hosts, `threaded` runs one in a thread. `sources` are the input signals,
`recordings` the same from CSV files. `faults` are the faults of the line, `foreign` finds frames of the wrong protocol,
`changes` puts changes of modules in words. `memory` keeps the EEPROMs in a file, and `files` opens files safely.
`pseudo_terminal`, `tcp` and `rfc2217` (with `telnet`) connect hosts to the bus, or to another line (`served`):
`proxy` is one in front of a real port (`target`). `deliveries` has the responses on their way.
Laws: time, randomness and I/O are here; the behaviour of modules is in `i7000.device`. The names below are imported
when they are first used, since networks take time to import.
"""

from typing import TYPE_CHECKING

from i7000.lazy import imported_at_use

if TYPE_CHECKING:
    from i7000.simulator.faults import Exchange, Faults, Piece, Transfer, Way
    from i7000.simulator.observed import Change, Observed
    from i7000.simulator.pseudo_terminal import open_pty
    from i7000.simulator.recordings import read_recording
    from i7000.simulator.rfc2217 import Rfc2217Connection
    from i7000.simulator.simulator import Host, Simulated, Simulator
    from i7000.simulator.sources import (
        COLD_JUNCTION,
        OPEN,
        Fixed,
        Noise,
        Ramp,
        Recorded,
        Sine,
        Source,
        Sources,
        default_sources,
    )
    from i7000.simulator.tcp import listen
    from i7000.simulator.threaded import RunningSimulator, simulate

__all__ = [
    "COLD_JUNCTION",
    "OPEN",
    "Change",
    "Exchange",
    "Faults",
    "Fixed",
    "Host",
    "Noise",
    "Observed",
    "Piece",
    "Ramp",
    "Recorded",
    "Rfc2217Connection",
    "RunningSimulator",
    "Simulated",
    "Simulator",
    "Sine",
    "Source",
    "Sources",
    "Transfer",
    "Way",
    "default_sources",
    "listen",
    "open_pty",
    "read_recording",
    "simulate",
]

_PLACES = {
    "faults": ("Exchange", "Faults", "Piece", "Transfer", "Way"),
    "observed": ("Change", "Observed"),
    "pseudo_terminal": ("open_pty",),
    "recordings": ("read_recording",),
    "rfc2217": ("Rfc2217Connection",),
    "simulator": ("Host", "Simulated", "Simulator"),
    "sources": (
        "COLD_JUNCTION", "OPEN", "Fixed", "Noise", "Ramp", "Recorded", "Sine", "Source", "Sources", "default_sources",
    ),
    "tcp": ("listen",),
    "threaded": ("RunningSimulator", "simulate"),
}  # fmt: skip
__getattr__ = imported_at_use(__name__, _PLACES)


def __dir__() -> list[str]:
    """Return the public names."""
    return sorted(__all__)
