"""The simulator of the load run, in a process of its own: it ends with its standard input, or when its time is over.

Its first line is where hosts find it.
"""

import asyncio
import sys

from i7000.simulator.simulator import Simulator
from i7000.simulator.tcp import listen
from tests.benchmarks.stations import STATIONS

LONGEST = 120.0
"""Seconds."""


async def serve() -> None:
    """Simulate the bus."""
    loop = asyncio.get_running_loop()
    simulator = Simulator([station.simulated() for station in STATIONS])
    async with listen(simulator) as place:
        simulated = asyncio.create_task(simulator.run())
        loop.add_reader(sys.stdin, simulated.cancel)
        print(place, flush=True)  # noqa: T201
        await asyncio.wait((simulated,), timeout=LONGEST)
        loop.remove_reader(sys.stdin)
        simulated.cancel()


if __name__ == "__main__":
    asyncio.run(serve())
