"""Two modules at 100 and 500 degC on a line that is often late: no poll delivers the value of the other one."""

import asyncio
from itertools import cycle, islice
from typing import Any

import pytest
from attrs import evolve

from i7000 import Model, Profile, Protocol, TypeCode, Unit, dcon, modbus
from i7000.device import Signals, State, factory, power_on
from i7000.host import Answered, Outcome, Query, Response, TimedOut
from i7000.link import AsyncLine, Line, Observed, VirtualPort, Written
from i7000.simulator.faults import Faults

FAULTS = Faults(late=0.25, late_by=0.9)
SEED = 3
POLLS = 100
PROFILE = Profile(Model.M_7019R, type_codes=(TypeCode.K,) * 8)


def module(address: int, protocol: Protocol) -> State:
    made = factory(Model.M_7019R)
    return power_on(evolve(made, address=address, protocol=protocol, type_codes=(TypeCode.K,) * 8), now=0.0)


HOT = Signals.of(Unit.CELSIUS, *[100.0] * 4, *[500.0] * 4)
DCON: tuple[tuple[Query[Response], float], ...] = (
    (dcon.ReadAnalogInputs(0x01), 100.0),
    (dcon.ReadAnalogInputs(0x02), 500.0),
)
CHANNELS: tuple[tuple[Query[Response], float], ...] = (
    (dcon.ReadAnalogInput(0x03, 0), 100.0),
    (dcon.ReadAnalogInput(0x03, 4), 500.0),
)
MODBUS: tuple[tuple[Query[Response], float], ...] = (
    (modbus.ReadInputRegisters(0x04, 0, 4), 100.0),
    (modbus.ReadInputRegisters(0x04, 4, 4), 500.0),
)
"""Two requests of equal length to one module: nothing in a response says which of them it answers."""


def port() -> VirtualPort:
    modules = (
        module(0x01, Protocol.DCON),
        module(0x02, Protocol.DCON),
        module(0x03, Protocol.DCON),
        module(0x04, Protocol.MODBUS_RTU),
    )
    signals = (Signals.of(Unit.CELSIUS, *[100.0] * 8), Signals.of(Unit.CELSIUS, *[500.0] * 8), HOT, HOT)
    return VirtualPort(modules, signals, FAULTS, seed=SEED)


def value(response: Response) -> float | None:
    """The first reading of a response."""
    if isinstance(response, modbus.InputRegisters):
        return modbus.readings(response.values, PROFILE)[0].value
    if isinstance(response, dcon.AnalogInput):
        return dcon.reading(response, 0, PROFILE).value
    assert isinstance(response, dcon.AnalogInputs)
    return dcon.readings(response, PROFILE)[0].value


def check(requests: Any, outcomes: list[Outcome[Response]], seen: list[Observed]) -> None:
    """Compare each value with the module that was asked."""
    wrong = [
        (number, outcome)
        for number, ((_, degrees), outcome) in enumerate(zip(cycle(requests), outcomes, strict=False))
        if isinstance(outcome, Answered) and value(outcome.response) != pytest.approx(degrees, abs=0.1)
    ]

    assert wrong == []
    assert {Answered, TimedOut} >= {type(outcome) for outcome in outcomes}
    assert sum(isinstance(outcome, Answered) for outcome in outcomes) > 0.9 * POLLS
    assert sum(isinstance(it, Written) for it in seen) > 1.2 * POLLS  # many were late


each_pair = pytest.mark.parametrize("requests", [DCON, CHANNELS, MODBUS], ids=["modules", "channels", "modbus"])
each_sleep = pytest.mark.parametrize("sleep", [0.0, 0.7])


@each_pair
@each_sleep
def test_a_line_never_delivers_another_value(requests: Any, sleep: float) -> None:
    seen: list[Observed] = []
    outcomes = []

    with Line(port(), observe=seen.append) as line:
        for command, _ in islice(cycle(requests), POLLS):
            outcomes.append(line.ask(command, PROFILE))
            line.wait(sleep)

    check(requests, outcomes, seen)


@each_pair
@each_sleep
def test_a_line_for_asyncio_never_delivers_another_value(requests: Any, sleep: float) -> None:
    seen: list[Observed] = []

    async def poll() -> list[Outcome[Response]]:
        outcomes = []
        async with AsyncLine(port(), observe=seen.append) as line:
            for command, _ in islice(cycle(requests), POLLS):
                outcomes.append(await line.ask(command, PROFILE))
                await line.wait(sleep)
        return outcomes

    check(requests, asyncio.run(poll()), seen)
