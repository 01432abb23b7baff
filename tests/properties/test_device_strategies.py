"""That the strategies for modules and lines make what they say."""

from typing import Any

import pytest
from hypothesis import Phase, find, given, settings
from hypothesis import strategies as st

from i7000 import Model, Protocol, Unit
from i7000.device import Eeprom, LogCommand, Signal, Signals, State, factory, power_on, step
from i7000.host import Bus, Policy
from i7000.strategies import device, host

FROM_THE_FACTORY = power_on(factory(Model.I_7017), now=0.0)
QUICKLY = settings(max_examples=10_000, database=None, phases=(Phase.generate, Phase.shrink))
ONCE = settings(QUICKLY, phases=(Phase.generate,))


@pytest.mark.parametrize(
    ("strategy", "plainest"),
    [
        (device.signals(), Signals()),
        (device.eeproms(), FROM_THE_FACTORY.eeprom),
        (device.eeproms(Model.M_7019R, protocol=Protocol.DCON), None),
        (device.states(), FROM_THE_FACTORY),
        (device.logs(), FROM_THE_FACTORY.eeprom.log.planned(0.0)),
        (host.policies(), Policy()),
        (host.buses(), Bus[Any]()),
    ],
)
def test_the_smallest_example_is_the_plainest(strategy: st.SearchStrategy[Any], plainest: object) -> None:
    smallest = find(strategy, lambda _: True, settings=QUICKLY)

    assert smallest.protocol is Protocol.DCON if plainest is None else smallest == plainest


@pytest.mark.parametrize(
    ("models", "wanted"),
    [
        ([], lambda it: it.ram.init_mode),
        ([Model.M_7019R], lambda it: it.ram.protocol is Protocol.MODBUS_RTU and it.eeprom.address > 100),
        ([], lambda it: len(set(it.eeprom.type_codes)) > 1),
        ([], lambda it: it.eeprom.host_watchdog_timed_out),
        ([Model.I_7019R], lambda it: it.ram != power_on(it.eeprom, init_switch=it.ram.init_switch, now=0.0).ram),
        ([Model.I_7017Z], lambda it: it.ram.checksum and it.profile.single_ended),
        ([Model.M_7017mC_16], lambda it: it.eeprom.log.command is not LogCommand.STOP and it.eeprom.log.records),
    ],
    ids=["init", "modbus", "mixed", "watchdog", "talked-to", "single-ended", "logging"],
)
def test_modules_of_every_sort_are_made(models: list[Model], wanted: Any) -> None:
    assert wanted(find(device.states(*models), wanted, settings=ONCE))


@given(st.sampled_from(Model), st.data())
def test_modules_are_of_the_models_and_the_protocol_asked_for(model: Model, data: st.DataObject) -> None:
    protocol = data.draw(st.sampled_from(sorted(model.protocols)))
    state = data.draw(device.states(model, protocol=protocol, now=5.0, dialogue=0))

    assert (model, protocol, 5.0) == (state.eeprom.model, state.ram.protocol, state.ram.fed_at)
    assert isinstance(data.draw(device.eeproms(model)), Eeprom)


def test_a_frame_to_a_module_is_mostly_answered() -> None:
    def answered(case: tuple[State, bytes]) -> bool:
        return step(*case, Signals(), 0.0)[1] is not None

    for protocol in Protocol:
        states = device.states(Model.M_7019R, protocol=protocol, dialogue=0)
        assert find(states.flatmap(lambda it: st.tuples(st.just(it), device.frames(it))), answered, settings=ONCE)


@pytest.mark.parametrize("unit", Unit)
def test_signals_have_every_unit(unit: Unit) -> None:
    def has_unit(signals: Signals) -> bool:
        return any(isinstance(it, Signal) and it.unit is unit for it in signals.channels)

    assert has_unit(find(device.signals(), has_unit, settings=ONCE))


@given(device.logs())
def test_records_are_counted_up_to_the_last(log: Any) -> None:
    indices = [record.index for record in log.records]

    assert indices == list(range(log.last_index - len(indices) + 1, log.last_index + 1))


@pytest.mark.parametrize(
    "wanted",
    [
        lambda it: it.pending is not None and it.pending.sent,
        lambda it: it.pending is not None and not it.pending.sent,
        lambda it: it.pending is None and it.last is not None,
        lambda it: it.rest,
        lambda it: it.echo and it.last and it.last.rtu,
    ],
    ids=["open", "waiting", "over", "begun", "echo"],
)
def test_lines_of_every_sort_are_made(wanted: Any) -> None:
    assert wanted(find(host.buses(), wanted, settings=ONCE))
