"""A simulated bus of 32 modules under 8 hosts at once: how much it carries, and that it carries all of it rightly."""

import asyncio
import os
import random
import subprocess
import sys
from array import array
from collections.abc import Iterable, Iterator
from contextlib import contextmanager, suppress
from itertools import islice
from pathlib import Path
from time import perf_counter

from attrs import define, field, frozen

from tests.benchmarks.stations import STATIONS, VALUES, Exchange, Station
from tests.benchmarks.timing import Result, shown

CLIENTS = 8
READING_SECONDS, WRITING_SECONDS = 8.0, 4.0
MOST_ROUNDS = 50_000
"""That one host goes in a turn."""
PATIENCE = 2.0
"""Seconds after which an answer is lost."""
MOST_GROWTH = 512
"""KB that the simulator's memory may grow by from a quarter of a turn to its end."""


@define
class Tally:
    """What hosts found."""

    latencies: "array[float]" = field(factory=lambda: array("d"))
    wrong: list[tuple[bytes, bytes]] = field(factory=list)
    """Answers that are not the right one, with their requests."""
    lost: list[bytes] = field(factory=list)
    """Requests that nothing came back to."""


@frozen
class Turn:
    """What came of a turn."""

    tally: Tally
    rate: float
    """Requests in a second, in the middle of it."""
    work: float
    """Seconds of the processor that the simulator took for each."""
    growth: float
    """KB by which the simulator's memory grew after a quarter of it."""


class Host:
    """A host that asks one thing after another, and stops at the first that is not answered rightly."""

    def __init__(self, tally: Tally, reader: asyncio.StreamReader, writer: asyncio.StreamWriter) -> None:
        """Make one that is connected."""
        self.tally = tally
        self.reader = reader
        self.writer = writer

    async def ask(self, exchange: Exchange) -> bool:
        """Send a request, and return whether the response is right."""
        request, expected = exchange
        began = perf_counter()
        self.writer.write(request)
        try:
            async with asyncio.timeout(PATIENCE):
                answer = await self.reader.readexactly(len(expected))
        except (TimeoutError, asyncio.IncompleteReadError):
            self.tally.lost.append(request)
            return False
        self.tally.latencies.append(perf_counter() - began)
        if answer != expected:
            self.tally.wrong.append((request, answer))
        return answer == expected

    async def hear_nothing(self) -> None:
        """Make sure that nothing comes that was not asked for."""
        with suppress(TimeoutError):
            async with asyncio.timeout(0.1):
                self.tally.wrong.append((b"", await self.reader.read(1000)))


async def converse(port: int, plan: Iterator[Iterable[Exchange]], seconds: float, tally: Tally) -> None:
    """Send requests until the time is over or a response is wrong; finish the open one."""
    reader, writer = await asyncio.open_connection("127.0.0.1", port)
    host = Host(tally, reader, writer)
    over = perf_counter() + seconds
    for exchanges in islice(plan, MOST_ROUNDS):
        if perf_counter() > over or not all([await host.ask(exchange) for exchange in exchanges]):
            break
    await host.hear_nothing()
    writer.close()
    await writer.wait_closed()


def readings(client: int) -> Iterator[Iterable[Exchange]]:
    """Send requests to all modules for ever, each host in its own order."""
    chance = random.Random(client)
    asked = [station.reads() for station in STATIONS]
    while True:
        for exchanges in chance.sample(asked, len(asked)):
            yield (chance.choice(exchanges),)


def settings(client: int, last: dict[Station, int]) -> Iterator[Iterable[Exchange]]:
    """Write settings of the modules that are one's own, in an order of one's own, and read them back, for ever."""
    chance = random.Random(client)
    own = STATIONS[4 * client : 4 * client + 4]
    prepared = {station: [station.writes(value) + station.written(value) for value in VALUES] for station in own}
    while True:
        for station in chance.sample(own, len(own)):
            value = chance.choice(VALUES)
            yield prepared[station][value]
            last[station] = value


@contextmanager
def served() -> Iterator[tuple[int, int]]:
    """Run the simulator; the value is its port and the number of its process."""
    command = [sys.executable, "-m", "tests.benchmarks.served"]
    process = subprocess.Popen(command, stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True)  # noqa: S603 - our own
    try:
        assert process.stdout is not None
        yield int(process.stdout.readline().rpartition(":")[2]), process.pid
        process.communicate(timeout=10)
        assert process.returncode == 0
    finally:
        process.kill()
        process.wait()


def resident(pid: int) -> float:
    """Return the memory of a process in KB; NaN if the system does not report it."""
    status = Path(f"/proc/{pid}/status")
    if not status.exists():
        return float("nan")
    return float(next(line for line in status.read_text().splitlines() if line.startswith("VmRSS")).split()[1])


def worked(pid: int) -> float:
    """Return the processor seconds of a process; NaN if the system does not report them."""
    stat = Path(f"/proc/{pid}/stat")
    if not stat.exists():
        return float("nan")
    user, system = stat.read_text().rpartition(")")[2].split()[11:13]
    return (int(user) + int(system)) / os.sysconf("SC_CLK_TCK")


async def turn(port: int, pid: int, plans: list[Iterator[Iterable[Exchange]]], seconds: float) -> Turn:
    """Run several hosts at once."""
    tally = Tally()
    conversations = [asyncio.create_task(converse(port, plan, seconds, tally)) for plan in plans]
    await asyncio.sleep(seconds / 4)
    asked, began, work, memory = len(tally.latencies), perf_counter(), worked(pid), resident(pid)
    await asyncio.sleep(seconds / 2)
    answered = len(tally.latencies) - asked
    rate, work = answered / (perf_counter() - began), (worked(pid) - work) / max(1, answered)
    await asyncio.gather(*conversations)
    return Turn(tally, rate, work, resident(pid) - memory)


def results_of(kind: str, done: Turn) -> Iterator[Result]:
    """Yield the figures of a turn."""
    tally = done.tally
    ordered = sorted(tally.latencies)
    bus = f"{kind}, {CLIENTS} hosts, {len(STATIONS)} modules"
    yield shown(f"{bus}: requests a second", done.rate)
    yield shown(f"{bus}: us of the processor for each, network included", done.work * 1e6)
    for part in (50, 99):
        latency = ordered[len(ordered) * part // 100] * 1000 if ordered else float("nan")
        yield shown(f"{bus}: ms of latency, percentile {part}", latency)
    yield Result(f"{bus}: wrong answers of {len(ordered)}", len(tally.wrong), "0", met=not tally.wrong)
    yield Result(f"{bus}: lost answers", len(tally.lost), "0", met=not tally.lost)
    grown = f"{bus}: KB of memory grown since a quarter of the time"
    yield Result(grown, done.growth, f"<= {MOST_GROWTH}", met=done.growth <= MOST_GROWTH)


def load_results() -> Iterator[Result]:
    """Read everything; write and read back; then read what all have been set to."""
    with served() as (port, pid):
        plans = [readings(client) for client in range(CLIENTS)]
        yield from results_of("read", asyncio.run(turn(port, pid, plans, READING_SECONDS)))
        last: dict[Station, int] = {}
        plans = [settings(client, last) for client in range(CLIENTS)]
        yield from results_of("write", asyncio.run(turn(port, pid, plans, WRITING_SECONDS)))
        tally = Tally()
        kept = [exchange for station, value in last.items() for exchange in station.written(value)]
        asyncio.run(converse(port, iter([kept]), PATIENCE, tally))
        right = len(tally.latencies) - len(tally.wrong)
        what = f"settings that are as they were last written, of {len(kept)}"
        yield Result(what, right, str(len(kept)), met=right == len(kept))
