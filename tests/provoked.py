"""A driver that is provoked in virtual time."""

from collections.abc import Callable, Iterable
from typing import Any

from attrs import evolve

from i7000 import Firmware, Model, Protocol, ReportSettings, TypeCode
from i7000.cli.faults import read_faults
from i7000.conformance.believed import read
from i7000.conformance.provoked import Judgement, Line, Session, judge
from i7000.conformance.scenarios import SCENARIOS, Bus, Scenario
from i7000.device import Eeprom, factory
from i7000.link import VirtualPort
from i7000.simulator.provoking import Player
from i7000.simulator.simulator import Simulated
from i7000.simulator.sources import default_sources

__all__ = ["BY_NAME", "Poll", "bus_of", "eeproms", "provoked"]

BY_NAME = {scenario.name: scenario for scenario in SCENARIOS}
Poll = Callable[[VirtualPort], Iterable[str]]
_LONGEST = 120.0
_AFTER = 2


def eeproms(scenario: Scenario, *, rtu: bool = False, checksum: bool = False) -> tuple[Eeprom, Eeprom]:
    """Two modules with type K, as the scenario changes them."""
    model = Model.M_7019R if rtu else Model.find(scenario.model or "I-7018")
    made = factory(model, None if scenario.firmware is None else Firmware(scenario.firmware))
    mask = made.channel_mask
    for channel in scenario.blank:
        mask &= ~(1 << channel)
    first = evolve(
        made,
        address=1,
        type_codes=(TypeCode.K,) * len(made.type_codes),
        protocol=Protocol.MODBUS_RTU if rtu else Protocol.DCON,
        channel_mask=mask,
        report_settings=ReportSettings(checksum=checksum),
    )
    return first, evolve(first, address=2)


def bus_of(modules: Iterable[Eeprom]) -> Bus:
    every = tuple(modules)
    return Bus(
        frozenset(it.protocol for it in every),
        all(it.report_settings.checksum for it in every),
        tuple(it.model.value for it in every),
    )


def provoked(scenario: Scenario, poll: Poll, modules: tuple[Eeprom, ...], seed: int = 0, **others: Any) -> Judgement:
    """Play a scenario while a driver polls, until a little after its end."""
    port = VirtualPort([Simulated(it, default_sources(it)) for it in modules], seed=seed)
    port.timeout = 0.3
    lines: list[Line] = []

    def connect(sources: Any) -> None:
        port.signals[:] = sources

    player = Player(scenario, port, connect, modules, lambda text: read_faults(text.split()))
    port.observe = player.observe
    left = _AFTER
    while left and port.now() < _LONGEST:
        left -= player.finished
        for text in poll(port):
            said = read(text)
            assert said is not None
            lines.append(Line(port.now(), len(lines) + 1, said))
        port.sleep(0.02)
    return judge(player.session(Session(lines=tuple(lines), now=port.now(), **others)))
